//! Forward statics: far starts, slack structures, gauges, unstable equilibria, and starts that must fail.

use approx::assert_relative_eq;
use tg_fixtures::{prism, spine};
use tg_model::{CableLaw, Joining, Model, ModelBuilder, Tensioned};
use tg_statics::{
    Configuration, Forward, ForwardError, ForwardOptions, InputFamily, Seek, Verdict, critical_parameter,
    stability,
};

/// A mast of unit length and mass on a pin, held upright by two guys of rest length 1.4 m from (±1, 0).
fn mast(law: &CableLaw) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -10.0]).unwrap();
    let foot = b.anchor("foot", [0.0, 0.0]).unwrap();
    let mast = b.bar("mast", 1.0, [0.0, 0.0], [0.0, 1.0]).unwrap();
    b.joint("pin", &[foot.into(), mast.node(0)], Joining::Share).unwrap();
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, [x, 0.0]).unwrap();
        b.cable(&format!("{name} guy"), peg, mast.node(1), law.clone(), 1.4).unwrap();
    }
    b.build().unwrap()
}

/// Energy of the mast at an angle from the vertical.
fn mast_energy(stiffness: f64, angle: f64) -> f64 {
    let guy = |x: f64| ((angle.sin() - x).powi(2) + angle.cos().powi(2)).sqrt() - 1.4;
    let elastic = |x: f64| 0.5 * stiffness * guy(x).max(0.0).powi(2);
    elastic(-1.0) + elastic(1.0) + 5.0 * angle.cos()
}

#[test]
fn an_unstable_mast_is_found_as_it_is_or_left_for_a_stable_lean() {
    let model = mast(&CableLaw::slacking(2.0));
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let any = Forward::new(&model, ForwardOptions::default()).solve(&q, &u).unwrap();
    assert_eq!(any.report.iterations, 0, "upright is an equilibrium");
    assert_eq!(stability(&model, &any.configuration, 1).unwrap().verdict, Verdict::Unstable);

    let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
    let found = Forward::new(&model, options).solve(&q, &u).unwrap();
    assert_eq!(found.report.left_unstable, 1);
    assert!(found.report.relaxation_steps > 0);
    let tip = model.form(model.members().next().unwrap().node(1)).unwrap().eval(&found.configuration.q);
    let angle = tip.x.atan2(tip.y);
    // The energy of the one angle is flat there and curved upwards.
    let slope = (mast_energy(2.0, angle + 1e-5) - mast_energy(2.0, angle - 1e-5)) / 2e-5;
    assert!(slope.abs() < 1e-8 && angle.abs() > 0.5, "{angle} {slope:.1e}");
    assert_eq!(stability(&model, &found.configuration, 1).unwrap().verdict, Verdict::Stable);
}

/// Upright, guys have l² = 2 ± 2 sin θ, l' = ±1/√2, l'' = -1/(2√2). Two-way springs of rest length μ then give
/// V'' = κ Σ (l'² + (l - μ) l'') - 5 = κ μ/√2 - 5.
#[test]
fn the_critical_rest_length_of_a_mast() {
    let model = mast(&CableLaw::linear(100.0));
    let q = model.initial_coordinates();
    let family = InputFamily::new(&model, &[0.0; 2], &[1.0, 1.0]);
    let critical = critical_parameter(&family, &q, (0.01, 1.0)).unwrap();
    assert_relative_eq!(critical.parameter, 5.0 * 2.0_f64.sqrt() / 100.0, max_relative = 1e-12);
    assert!(critical.evaluations < 12, "{}", critical.evaluations);
    let error = critical_parameter(&family, &q, (0.5, 1.0)).unwrap_err();
    assert!(error.to_string().contains("no sign change"), "{error}");
}

#[test]
fn a_far_start_is_relaxed() {
    let prism = prism(3, 10.0, 0.0, CableLaw::slacking).unwrap();
    let (q, u) = (prism.model.initial_coordinates(), prism.model.inputs_at(0.0));
    let mut relaxed = 0;
    for start in 0..20 {
        let mut far = q.clone();
        for (i, x) in far.iter_mut().enumerate() {
            *x += 0.6 * (1.3 + 2.1 * i as f64 + 5.7 * f64::from(start)).sin();
        }
        let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
        let found = Forward::new(&prism.model, options).solve(&far, &u).unwrap();
        relaxed += u32::from(found.report.relaxation_steps > 0);
        assert!(found.report.residual < 1e-11, "{:?}", found.report);
        let verdict = stability(&prism.model, &found.configuration, 1).unwrap().verdict;
        assert_ne!(verdict, Verdict::Unstable);
    }
    println!("{relaxed} of 20 starts were relaxed");
}

#[test]
fn slack_structures_settle_where_nothing_pulls() {
    // Loose cables: any assembled configuration is an equilibrium; a bead hangs straight down from a slack start.
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -10.0]).unwrap();
    let hook = b.anchor("hook", [0.0, 0.0]).unwrap();
    let bead = b.particle("bead", 1.0, [0.3, 0.2]).unwrap();
    b.cable("string", hook, bead.node(0), CableLaw::slacking(1000.0), 1.0).unwrap();
    let model = b.build().unwrap();
    let found = Forward::new(&model, ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() })
        .solve(&model.initial_coordinates(), &model.inputs_at(0.0))
        .unwrap();
    let position = model.form(model.members().next().unwrap().node(0)).unwrap().eval(&found.configuration.q);
    assert_relative_eq!(position.x, 0.0, epsilon = 1e-10);
    assert_relative_eq!(position.y, -1.01, max_relative = 1e-12);
    assert!(found.report.relaxation_steps > 0, "{:?}", found.report);
}

#[test]
fn load_steps_follow_a_branch_that_one_step_leaves() {
    let spine = spine(3, 8.0, 0.0).unwrap();
    let (q, from) = (spine.model.initial_coordinates(), spine.model.inputs_at(0.0));
    let mut to = from.clone();
    // Shorten the outer cables on one side: the spine bends that way.
    for level in 0..3 {
        to[6 * level] -= 0.015;
    }
    let solve = |steps| {
        let options = ForwardOptions { load_steps: steps, ..ForwardOptions::default() };
        Forward::new(&spine.model, options).solve_from(&q, &from, &to).unwrap()
    };
    let (one, many) = (solve(1), solve(10));
    assert!(many.report.load_steps >= 10);
    let apart = one.configuration.q.iter().zip(&many.configuration.q).map(|(a, b)| (a - b).abs());
    assert!(apart.fold(0.0, f64::max) < 1e-10);
    let top = spine.model.form(spine.bodies[2].mass_centre()).unwrap();
    assert!(top.eval(&many.configuration.q).x > 0.005, "{}", top.eval(&many.configuration.q));
}

#[test]
fn a_load_that_nothing_balances_is_told() {
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -9.81]).unwrap();
    let ends = [b.particle("a", 1.0, [0.0; 3]).unwrap(), b.particle("b", 1.0, [1.0, 0.0, 0.0]).unwrap()];
    b.cable("string", ends[0].node(0), ends[1].node(0), CableLaw::linear(10.0), 0.8).unwrap();
    let model = b.build().unwrap();
    let options = ForwardOptions { max_iterations: 10, ..ForwardOptions::default() };
    let error =
        Forward::new(&model, options).solve(&model.initial_coordinates(), &model.inputs_at(0.0)).unwrap_err();
    let ForwardError::NotReached { loaded_rigid_motions, ref last, .. } = error else { panic!("{error}") };
    assert!(loaded_rigid_motions > 0);
    assert!(error.to_string().contains("add supports"), "{error}");
    assert_eq!(last.q.len(), 6);
}

/// A structure far from the origin, on a scale of kilometres or millimetres, settles alike.
#[test]
fn place_and_scale_do_not_matter() {
    let reports: Vec<f64> = [0.0, 1e3]
        .map(|shift| {
            let prism = prism(3, 10.0, 0.0, CableLaw::slacking).unwrap();
            let (mut q, u) = (prism.model.initial_coordinates(), prism.model.inputs_at(0.0));
            q.iter_mut().step_by(3).for_each(|x| *x += shift);
            q.iter_mut().enumerate().for_each(|(i, x)| *x += 0.05 * (i as f64).sin());
            let found =
                Forward::new(&prism.model, ForwardOptions { tolerance: 1e-9, ..ForwardOptions::default() })
                    .solve(&q, &u)
                    .unwrap();
            assert_eq!(found.report.gauged, 6);
            let at = Configuration::at(&prism.model, &found.configuration.q, &u).unwrap();
            let (mut lengths, mut gradients) = (vec![0.0; 9], vec![0.0; prism.model.length_pattern().len()]);
            prism.model.lengths(&at.q, &mut lengths, &mut gradients);
            lengths[8]
        })
        .to_vec();
    assert_relative_eq!(reports[0], reports[1], max_relative = 1e-9);
}

/// A hinged bar between two springs at their rest lengths, pushed aside: where it settles no force acts at all.
#[test]
fn an_equilibrium_without_any_force() {
    for law in [CableLaw::linear, CableLaw::slacking] {
        for push in [1e-6, 1e-3, 0.1] {
            let mut b = ModelBuilder::<2>::new();
            let foot = b.anchor("foot", [0.0, 0.0]).unwrap();
            let bar = b.bar("bar", 1.0, [0.0, 0.0], [f64::sin(push), f64::cos(push)]).unwrap();
            b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share).unwrap();
            for (name, x) in [("left", -1.0), ("right", 1.0)] {
                let peg = b.anchor(name, [x, 1.0]).unwrap();
                b.cable(name, peg, bar.node(1), law(100.0), 1.0).unwrap();
            }
            let model = b.build().unwrap();
            let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
            let found = Forward::new(&model, ForwardOptions::default()).solve(&q, &u).unwrap();
            let tip = model.form(bar.node(1)).unwrap().eval(&found.configuration.q);
            assert!(tip.x.abs() < 1e-12 && (tip.y - 1.0).abs() < 1e-12, "{push}: {tip}");
        }
    }
}

/// A shallow arch of two springs carries at most κ(l₀ - l) 2y/l at l³ = l₀; a load larger by a billionth has no shallow
/// equilibrium, however little the forces miss it by.
#[test]
fn just_beyond_a_limit_point() {
    let (stiffness, rise) = (50.0, 0.3_f64);
    let rest = 1.0_f64.hypot(rise);
    let carried = |y: f64| 2.0 * stiffness * (rest - 1.0_f64.hypot(y)) * y / 1.0_f64.hypot(y);
    let limit = carried((rest.powf(2.0 / 3.0) - 1.0).sqrt());
    for beyond in [-1e-9, 1e-10, 1e-9, 1e-8, 1e-6] {
        let load = limit * (1.0 + beyond);
        let mut b = ModelBuilder::<2>::new();
        let crown = b.particle("crown", 1.0, [0.0, rise]).unwrap();
        b.support("guide", crown.node(0), 0, 0.0).unwrap();
        for (name, x) in [("left", -1.0), ("right", 1.0)] {
            let peg = b.anchor(name, [x, 0.0]).unwrap();
            b.cable(name, peg, crown.node(0), CableLaw::linear(stiffness), rest).unwrap();
        }
        b.load("press", crown.node(0), [0.0, -load], 1.0).unwrap();
        let model = b.build().unwrap();
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
        match Forward::new(&model, ForwardOptions::default()).solve(&q, &u) {
            Ok(found) => {
                let off = (carried(found.configuration.q[1]) - load).abs();
                assert!(off < 1e-11, "{beyond:e}: a force of {off:.1e} N is left");
            }
            Err(error) => assert!(matches!(error, ForwardError::NotReached { .. }), "{error}"),
        }
    }
}
