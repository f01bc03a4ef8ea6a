//! Undamped modes: closed forms, finite differences of the nonlinear dynamics, dense against sparse.

use crate::support::{all_modes, as_built, displaced, equilibrium, mass_product, oscillator};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_fixtures::{prism, spine};
use tg_modal::{
    Input, ModeKind, ModeOptions, Output, SupportMotion, damped, modes, participation, state_space,
};
use tg_model::{At, CableLaw, Joining, Mechanics, Model, ModelBuilder, Projector};
use tg_tangent::{Configuration, Method};

/// κ/m along the cables, T/(m l) across them.
#[test]
fn a_particle_between_two_cables() {
    let mut b = ModelBuilder::<2>::new();
    let (mass, stiffness, tension) = (0.7, 250.0, 4.0);
    oscillator(&mut b, "bead", [0.0, 0.0], mass, &CableLaw::slacking(stiffness), tension);
    let model = b.build().unwrap();
    let found = all_modes(&model, &as_built(&model));
    let exact = [2.0 * tension / mass, 2.0 * stiffness / mass];
    for (mode, exact) in found.list.iter().zip(exact) {
        assert!((mode.omega_squared / exact - 1.0).abs() < 1e-13, "{} {exact}", mode.omega_squared);
        let ModeKind::Vibration { frequency } = mode.kind else { panic!("{:?}", mode.kind) };
        assert!((frequency * std::f64::consts::TAU / exact.sqrt() - 1.0).abs() < 1e-13);
    }
}

/// m g d / (m d² + I): all of it is the multiplier term.
#[test]
fn compound_pendulums_of_every_type() {
    let (mass, moment, distance) = (1.3, 0.2, 0.4);
    for coord_type in [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr] {
        let properties = MassProperties::from_polar_moment(mass, [0.0, 0.0].into(), moment).unwrap();
        let pivot = [0.1, distance];
        let nodes = match coord_type {
            CoordType::Ruv => [pivot, [1.0, 0.0], [0.0, 1.0]],
            CoordType::Rrv => [pivot, [1.0, 0.3], [0.3, 1.0]],
            _ => [pivot, [1.0, 0.3], [0.3, -1.0]],
        };
        let member = Member::new(coord_type, &nodes.map(Into::into), properties).unwrap();
        let mut b = ModelBuilder::<2>::new();
        b.gravity([0.0, -9.81]).unwrap();
        // The pivot is above the mass centre once the body is turned by atan(0.1/0.4).
        let radius = f64::hypot(0.1, distance);
        let pose = Pose::planar(0.0, 0.0, f64::atan2(0.1, distance));
        let body = b.member("body", member, pose).unwrap();
        let anchor = b.anchor("pivot", [0.0, radius]).unwrap();
        b.joint("hinge", &[anchor.into(), body.node(0)], Joining::Constrain).unwrap();
        let model = b.build().unwrap();
        let found = all_modes(&model, &as_built(&model));
        let exact = mass * 9.81 * radius / (mass * radius * radius + moment);
        assert_eq!(found.list.len(), 1);
        let error = found.list[0].omega_squared / exact - 1.0;
        assert!(error.abs() < 1e-12, "{coord_type:?} {error:e}");
    }
}

/// A mast on two horizontal guys at its top: (2κL² - mgL/2) / (mL²/3), critical at κ = mg/4L.
fn guyed(stiffness: f64) -> Model<2> {
    let (mass, length) = (2.0, 1.5);
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let foot = b.anchor("foot", [0.0, 0.0]).unwrap();
    let bar = b.bar("mast", mass, [0.0, 0.0], [0.0, length]).unwrap();
    b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share).unwrap();
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, [x, length]).unwrap();
        b.cable(name, peg, bar.node(1), CableLaw::slacking(stiffness), 0.5).unwrap();
    }
    b.build().unwrap()
}

#[test]
fn an_inverted_pendulum_loses_stability_at_the_critical_stiffness() {
    let (mass, length) = (2.0, 1.5);
    let critical = mass * 9.81 / (4.0 * length);
    for factor in [0.5, 0.99, 1.0, 1.01, 2.0] {
        let stiffness = factor * critical;
        let model = guyed(stiffness);
        let found = all_modes(&model, &as_built(&model));
        let exact = 3.0 * (2.0 * stiffness - 0.5 * mass * 9.81 / length) / mass;
        let mode = &found.list[0];
        assert!((mode.omega_squared - exact).abs() < 1e-14, "{factor}: {mode:?} {exact}");
        match mode.kind {
            ModeKind::Unstable { rate } => {
                assert!(factor < 1.0 && (rate / (-exact).sqrt() - 1.0).abs() < 1e-11);
            }
            ModeKind::Zero => assert_eq!(factor, 1.0),
            ModeKind::Vibration { .. } => assert!(factor > 1.0),
        }
        assert_eq!(
            (found.counts.negative, found.counts.zero),
            match factor {
                f if f < 1.0 => (1, 0),
                1.0 => (0, 1),
                _ => (0, 0),
            }
        );
    }
}

#[test]
fn free_structures_have_six_zero_modes() {
    for n in [3, 4, 5] {
        let prism = prism(n, 20.0, 0.0, CableLaw::slacking).unwrap();
        let found = all_modes(&prism.model, &as_built(&prism.model));
        assert_eq!(found.list.len(), 5 * n);
        let rigid = found.list.iter().filter(|mode| mode.kind == ModeKind::Zero).count();
        assert_eq!((found.counts.negative, found.counts.zero, rigid), (0, 6, 6), "{n}");
        assert!(found.is_complete());
        assert_eq!(found.frequencies().count(), 5 * n - 6);
    }
    let axes = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Into::into);
    let properties =
        MassProperties::from_principal_moments(1.0, [0.1, 0.0, 0.0].into(), [1.0, 1.5, 2.0]).unwrap();
    let mut b = ModelBuilder::<3>::new();
    b.member("asteroid", Member::new(CoordType::Ruvw, &axes, properties).unwrap(), Pose::identity()).unwrap();
    let model = b.build().unwrap();
    let found = all_modes(&model, &as_built(&model));
    assert_eq!((found.list.len(), found.counts.zero), (6, 6));
}

/// Accelerations of the nonlinear structure, displaced along a shape by ±ε onto the constraints: -ω² φ.
#[test]
fn modes_are_those_of_the_nonlinear_accelerations() {
    let spine = spine(3, 8.0, 0.0).unwrap();
    let prism = prism(3, 20.0, 0.0, CableLaw::slacking).unwrap();
    for model in [&spine.model, &prism.model] {
        let at = as_built(model);
        let found = all_modes(model, &at);
        for mode in &found.list {
            let size = mode.shape.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            let [coarse, fine] = [2e-4 / size, 1e-4 / size].map(|epsilon| {
                let [plus, minus] = [epsilon, -epsilon].map(|e| acceleration(model, &at, &mode.shape, e));
                plus.iter().zip(&minus).map(|(p, m)| (p - m) / (2.0 * epsilon)).collect::<Vec<_>>()
            });
            let error = (0..fine.len())
                .map(|i| ((4.0 * fine[i] - coarse[i]) / 3.0 + mode.omega_squared * mode.shape[i]).abs());
            let worst = error.fold(0.0, f64::max) / (size * found.largest);
            println!("{:.4e} {worst:.1e}", mode.omega_squared);
            assert!(worst < 1e-9, "{} {worst:.1e}", mode.omega_squared);
        }
    }
}

/// q̈ at rest at the configuration displaced by `epsilon` times the shape.
fn acceleration(model: &Model<3>, at: &Configuration, shape: &[f64], epsilon: f64) -> Vec<f64> {
    let q = displaced(model, &at.q, |i| epsilon * shape[i]);
    let rest = vec![0.0; q.len()];
    let (mut force, mut a) = (rest.clone(), rest.clone());
    model.force(At { q: &q, v: &rest, u: &at.u, taut: None }, &mut force);
    let constraints = model.sizes().constraints;
    let rates = vec![0.0; constraints];
    let mut projector = Projector::new(model).unwrap();
    projector.acceleration(&q, &force, &rates, &mut a, &mut vec![0.0; constraints]).unwrap();
    a
}

#[test]
fn shapes_are_mass_orthonormal_and_oriented() {
    let spine = spine(4, 8.0, 0.0).unwrap();
    let found = all_modes(&spine.model, &as_built(&spine.model));
    for (r, a) in found.list.iter().enumerate() {
        let largest =
            a.shape.iter().fold(0.0_f64, |m, x| if x.abs() > m.abs() * (1.0 + 1e-6) { *x } else { m });
        assert!(largest > 0.0);
        for (c, b) in found.list.iter().enumerate() {
            let product = mass_product(&spine.model, &a.shape, &b.shape);
            assert!((product - f64::from(u8::from(r == c))).abs() < 1e-12, "{r} {c} {product}");
        }
    }
}

#[test]
fn dense_and_sparse_modes_agree() {
    let spine = spine(5, 8.0, 0.0).unwrap();
    let at = as_built(&spine.model);
    let options = ModeOptions { method: Method::Dense, ..ModeOptions::new(12) };
    let dense = modes(&spine.model, &at, &options).unwrap();
    let sparse = modes(&spine.model, &at, &ModeOptions { method: Method::Sparse, ..options }).unwrap();
    assert_eq!((dense.method, sparse.method), (Method::Dense, Method::Sparse));
    assert_eq!(dense.counts, sparse.counts);
    assert_eq!(dense.list.len(), 12);
    for (k, (a, b)) in dense.list.iter().zip(&sparse.list).enumerate() {
        let error = (a.omega_squared - b.omega_squared).abs();
        println!("{:.6e} {:.1e} {:.1e}", a.omega_squared, error, a.accuracy);
        assert!(error <= a.accuracy);
        // Pairs of equal frequency share a space: the part of one shape in the other method's.
        let near = sparse.list.iter().filter(|m| (m.omega_squared / a.omega_squared - 1.0).abs() < 1e-6);
        let share: f64 = near.map(|m| mass_product(&spine.model, &a.shape, &m.shape).powi(2)).sum();
        assert!(k == 11 || (share - 1.0).abs() < 1e-9, "{k} {share}");
    }
}

/// What the tolerance on equilibrium means: an imbalance ε shifts ω² by 0.01 ε of the largest here.
#[test]
fn frequencies_near_an_equilibrium() {
    let spine = spine(3, 8.0, 0.0).unwrap();
    let model = &spine.model;
    let q = model.initial_coordinates();
    for factor in [1e-3, 1e-5] {
        let mut u = model.inputs_at(0.0);
        u.iter_mut().enumerate().for_each(|(k, u)| *u *= 1.0 + factor * (3.7 * k as f64).sin());
        let near = Configuration::at(model, &q, &u).unwrap();
        let options = ModeOptions { imbalance: 1.0, ..ModeOptions::all() };
        let there = modes(model, &near, &options).unwrap();
        let exact = all_modes(model, &equilibrium(model, &q, &u));
        let pairs = there.list.iter().zip(&exact.list);
        let shift = pairs.map(|(a, b)| (a.omega_squared - b.omega_squared).abs() / exact.largest);
        let (shift, imbalance) = (shift.fold(0.0, f64::max), near.imbalance().0);
        println!("imbalance {imbalance:.1e} shifts by {shift:.1e}");
        assert!(shift < 0.02 * imbalance);
    }
}

/// A bar between two pegs, one end on a roller: its length holds it.
#[test]
fn structures_that_cannot_move_have_no_modes() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([-9.81, 0.0]).unwrap();
    let left = b.anchor("left", [0.0, 0.0]).unwrap();
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
    b.joint("pin", &[left.into(), bar.node(0)], Joining::Share).unwrap();
    b.support("roller", bar.node(1), 1, 0.0).unwrap();
    let model = b.build().unwrap();
    assert_eq!((model.free().len(), model.sizes().constraints), (1, 1));
    let at = as_built(&model);
    let found = all_modes(&model, &at);
    assert!(found.list.is_empty() && found.is_complete());
    assert!(damped(&model, &at, &found).unwrap().is_empty());
    let motion = SupportMotion::translation(&model, &at, 0).unwrap();
    let parts = participation(&model, &at, &found, &motion).unwrap();
    assert!(parts.total.abs() < 1e-15 && (parts.rigid_mass - 1.0).abs() < 1e-15);
    let tip = Output::displacement("tip", &[(model.free()[0], 1.0)]);
    let linear = state_space(&model, &at, &found, &[Input::Ground(motion)], &[tip]).unwrap();
    assert_eq!((linear.a.nrows(), linear.d[(0, 0)]), (0, 1.0));
}
