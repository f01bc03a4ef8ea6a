//! Free bodies against forces known by hand and against the multipliers.

use approx::assert_relative_eq;
use nalgebra::{SVector, Vector2, Vector3};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_fixtures::prism;
use tg_model::{CableLaw, Joining, Mechanics, MemberId, Model, ModelBuilder, MomentAxes};
use tg_statics::{
    Action, EquilibriumReport, Forward, ForwardOptions, FreeBodyReport, Line, Source, Verdict, Wrench,
    stability,
};

fn reaction<'r, const D: usize>(
    report: &'r FreeBodyReport<D>,
    member: MemberId,
    joint: &str,
) -> &'r Action<D> {
    let body = report.body(member).unwrap();
    let of = |action: &&Action<D>| matches!(&action.source, Source::Joint { name } if name == joint);
    body.reactions.iter().find(of).unwrap()
}

fn supports<const D: usize>(report: &FreeBodyReport<D>) -> SVector<f64, D> {
    let reactions = report.bodies.iter().flat_map(|body| &body.reactions);
    let supports = reactions.filter(|action| matches!(action.source, Source::Support { .. }));
    supports.map(|action| action.wrench.force).sum()
}

/// Two bars hang in a row, the joint shared or constrained: the link lifts what hangs below.
#[test]
fn a_hanging_chain_carries_what_hangs_below() {
    let g = 10.0;
    for joining in [Joining::Share, Joining::Constrain] {
        let mut b = ModelBuilder::<2>::new();
        b.gravity([0.0, -g]).unwrap();
        let ceiling = b.anchor("ceiling", [0.0, 0.0]).unwrap();
        let upper = b.bar("upper", 2.0, [0.0, 0.0], [0.0, -1.0]).unwrap();
        let lower = b.bar("lower", 2.0, [0.0, -1.0], [0.0, -2.0]).unwrap();
        b.joint("hook", &[ceiling.into(), upper.node(0)], Joining::Share).unwrap();
        b.joint("link", &[upper.node(1), lower.node(0)], joining).unwrap();
        let model = b.build().unwrap();
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
        let report = FreeBodyReport::new(&model, &q, &u).unwrap();
        assert!(report.unbalance < 1e-14 && report.indeterminate == 0, "{}", report.unbalance);
        let lift = reaction(&report, lower, "link");
        assert_relative_eq!(lift.wrench.force, Vector2::new(0.0, 2.0 * g), epsilon = 1e-12);
        assert!(lift.determinate);
        let pull = reaction(&report, upper, "link");
        assert_relative_eq!(pull.wrench.force, -lift.wrench.force, epsilon = 1e-12);
        let hook = reaction(&report, upper, "hook");
        assert_relative_eq!(hook.wrench.force, Vector2::new(0.0, 4.0 * g), epsilon = 1e-12);
        if joining == Joining::Constrain {
            let theirs = EquilibriumReport::new(&model, &q, &u).unwrap();
            assert_relative_eq!(theirs.joints[0].force, lift.wrench.force, epsilon = 1e-11);
        }
    }
}

/// A spring of zero free length that has no length has no direction, and needs none.
#[test]
fn a_spring_without_length_pulls_nowhere() {
    let mut b = ModelBuilder::<2>::new();
    let peg = b.anchor("peg", [0.0, -1.0]).unwrap();
    let ceiling = b.anchor("ceiling", [0.0, 0.0]).unwrap();
    let bar = b.bar("bar", 2.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
    b.joint("hook", &[ceiling.into(), bar.node(0)], Joining::Share).unwrap();
    b.cable("spring", peg, bar.node(1), CableLaw::linear(3.0), 0.0).unwrap();
    let model = b.build().unwrap();
    let mut q = model.initial_coordinates();
    q[2..4].copy_from_slice(&[0.0, -1.0]);
    let report = FreeBodyReport::new(&model, &q, &model.inputs_at(0.0)).unwrap();
    assert!(report.unbalance == 0.0, "{}", report.unbalance);
}

/// A body of space on a hinged bar, a ball joint at a material point and cables, under loads and weight.
fn crane(joining: Joining) -> (Model<3>, MemberId, MemberId) {
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -9.81]).unwrap();
    let foot = b.anchor("foot", [0.0, 0.0, 0.0]).unwrap();
    let mast = b.bar("mast", 3.0, [0.0, 0.0, 0.0], [0.0, 0.1, 2.0]).unwrap();
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Vector3::from);
    let mass =
        MassProperties::from_principal_moments(2.0, Vector3::new(0.3, 0.2, 0.1), [0.2, 0.3, 0.25]).unwrap();
    let jib = Member::new(CoordType::Rrrr, &corners, mass).unwrap();
    let jib = b.member("jib", jib, Pose::translation(Vector3::new(0.0, 0.1, 2.0))).unwrap();
    b.joint("heel", &[foot.into(), mast.node(0)], joining).unwrap();
    b.joint("top", &[mast.node(1), jib.node(0)], joining).unwrap();
    let pegs = [[2.0, 0.0, 0.0], [-2.0, 2.0, 0.0], [-2.0, -2.0, 0.0], [0.0, 2.0, 4.0], [0.5, -2.0, 3.0]];
    for (k, peg) in pegs.into_iter().enumerate() {
        let peg = b.anchor(&format!("peg {k}"), peg).unwrap();
        for (i, end) in
            [mast.node(1), jib.node(1), jib.node(2), jib.at([0.2, 0.3, 0.9])].into_iter().enumerate()
        {
            let law = if i == 1 { CableLaw::linear(150.0) } else { CableLaw::slacking(200.0) };
            b.cable(&format!("rope {k} {i}"), peg, end, law, if i == 2 { 0.0 } else { 1.5 }).unwrap();
        }
    }
    b.load("hook", jib.at([1.2, 0.1, 0.0]), [3.0, -1.0, -20.0], 1.0).unwrap();
    b.moment("slew", jib, MomentAxes::Space, [0.3, -0.2, 1.5], 1.0).unwrap();
    b.moment("motor", jib, MomentAxes::Body, [0.5, 0.4, -0.6], 1.0).unwrap();
    b.joint_moments("tilt", mast, [2.0, -1.0], 1.0).unwrap();
    b.moment("wind", mast, MomentAxes::Space, [1.0, 0.5, 0.2], 1.0).unwrap();
    (b.build().unwrap(), mast, jib)
}

#[test]
fn reactions_of_bodies_in_space_are_those_of_the_multipliers() {
    let mut heels = Vec::new();
    for joining in [Joining::Share, Joining::Constrain] {
        let (model, mast, jib) = crane(joining);
        let u = model.inputs_at(0.0);
        let forward = Forward::new(&model, ForwardOptions::default());
        let found = forward.solve(&model.initial_coordinates(), &u).unwrap().configuration;
        let report = FreeBodyReport::new(&model, &found.q, &u).unwrap();
        assert!(report.unbalance < 1e-11, "{joining:?}: {}", report.unbalance);
        assert_eq!(report.indeterminate, 0);
        let (heel, top) = (reaction(&report, mast, "heel"), reaction(&report, jib, "top"));
        let theirs = EquilibriumReport::new(&model, &found.q, &u).unwrap();
        match joining {
            Joining::Constrain => {
                for (joint, ours) in theirs.joints.iter().zip([heel, top]) {
                    assert_relative_eq!(joint.force, ours.wrench.force, epsilon = 1e-9);
                }
            }
            Joining::Share => {
                // What the ground carries at the anchor that the mast shares.
                let ground = theirs.supports.iter().find(|s| (s.force - heel.wrench.force).norm() < 1e-9);
                assert!(ground.is_some(), "{:?} {:?}", heel.wrench, theirs.supports);
            }
        }
        heels.push((heel.wrench.force, top.wrench.force));

        // The sum about any point is zero, and every force of the list is there.
        for point in [Vector3::zeros(), Vector3::new(3.0, -1.0, 2.0)] {
            for body in &report.bodies {
                let sum = body.unbalance_about(&point);
                assert!(sum.force.norm() < 1e-9 && sum.moment.norm() < 1e-9, "{}", body.name);
            }
        }
        let jib = report.body(jib).unwrap();
        assert_eq!(jib.given.len(), 15 + 1 + 3);

        // A millimetre aside nothing balances any more.
        let mut off = found.q.clone();
        let free = model.free();
        off[free[free.len() - 1]] += 1e-3;
        assert!(FreeBodyReport::new(&model, &off, &u).unwrap().unbalance > 1e-4);
    }
    assert_relative_eq!(heels[0].0, heels[1].0, epsilon = 1e-8);
    assert_relative_eq!(heels[0].1, heels[1].1, epsilon = 1e-8);
}

/// A plate of the plane on a guide and two strings: supports at material points, and a moment.
#[test]
fn supports_at_material_points_are_those_of_the_multipliers() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -10.0]).unwrap();
    let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]].map(Vector2::from);
    let mass = MassProperties::from_polar_moment(3.0, Vector2::new(0.5, 0.25), 1.0).unwrap();
    let plate = Member::new(CoordType::Rrr, &corners, mass).unwrap();
    let plate = b.member("plate", plate, Pose::planar(0.0, 0.0, 0.0)).unwrap();
    for (name, x, corner) in [("left", 0.0, 0), ("right", 2.5, 1)] {
        let hook = b.anchor(name, [x, 2.0]).unwrap();
        b.cable(&format!("{name} string"), hook, plate.node(corner), CableLaw::slacking(1e3), 1.9).unwrap();
    }
    b.support("guide", plate.at([1.0, 0.5]), 0, 0.0).unwrap();
    b.moment("motor", plate, 2.0, 1.0).unwrap();
    let model = b.build().unwrap();
    let u = model.inputs_at(0.0);
    let forward = Forward::new(&model, ForwardOptions::default());
    let found = forward.solve(&model.initial_coordinates(), &u).unwrap().configuration;
    let report = FreeBodyReport::new(&model, &found.q, &u).unwrap();
    assert!(report.unbalance < 1e-12, "{}", report.unbalance);
    let theirs = EquilibriumReport::new(&model, &found.q, &u).unwrap();
    let ground: Vector2<f64> = theirs.supports.iter().map(|support| support.force).sum();
    // The multipliers' supports include the hooks of the strings.
    let strings: Vector2<f64> = report.bodies[0]
        .given
        .iter()
        .filter(|action| matches!(action.source, Source::Cable { .. }))
        .map(|action| action.wrench.force)
        .sum();
    assert_relative_eq!(supports(&report) + strings, ground, epsilon = 1e-9);
}

/// Between two pins the push along a bar is anybody's guess; that across is not.
#[test]
fn indeterminate_reactions_say_so() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -10.0]).unwrap();
    let pegs = [0.0, 2.0].map(|x| b.anchor(&format!("peg at {x}"), [x, 0.0]).unwrap());
    let beam = b.bar("beam", 4.0, [0.0, 0.0], [2.0, 0.0]).unwrap();
    let hanging = b.bar("hanging", 1.0, [0.0, 0.0], [0.0, -1.0]).unwrap();
    b.joint("left", &[pegs[0].into(), beam.node(0)], Joining::Share).unwrap();
    b.joint("right", &[pegs[1].into(), beam.node(1)], Joining::Share).unwrap();
    b.joint("loose", &[pegs[0].into(), hanging.node(0)], Joining::Share).unwrap();
    let model = b.build().unwrap();
    let report = FreeBodyReport::new(&model, &model.initial_coordinates(), &[]).unwrap();
    assert_eq!(report.indeterminate, 1);
    assert!(report.unbalance < 1e-14);
    for joint in ["left", "right"] {
        let action = reaction(&report, beam, joint);
        assert!(!action.determinate);
        // The smallest of all is without push.
        assert_relative_eq!(action.wrench.force, Vector2::new(0.0, 20.0), epsilon = 1e-12);
    }
    assert!(reaction(&report, hanging, "loose").determinate);
}

#[test]
fn feet_of_a_prism_carry_its_weight() {
    let prism = prism(3, 40.0, 9.81, CableLaw::slacking).unwrap();
    let (q, u) = (prism.model.initial_coordinates(), prism.model.inputs_at(0.0));
    let found = Forward::new(&prism.model, ForwardOptions::default()).solve(&q, &u).unwrap();
    let report = FreeBodyReport::new(&prism.model, &found.configuration.q, &u).unwrap();
    assert!(report.unbalance < 1e-11, "{}", report.unbalance);
    assert_relative_eq!(supports(&report), Vector3::new(0.0, 0.0, 3.0 * 9.81), epsilon = 1e-9);
}

/// κ h b = m g l/2: equilibrium at every angle, on a spring of zero free length.
#[test]
fn a_balanced_arm_rests_everywhere_and_is_neutral() {
    let (mass, g, length, height, at) = (2.0, 9.81, 0.8, 0.5, 0.3);
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -g]).unwrap();
    let pivot = b.anchor("pivot", [0.0, 0.0]).unwrap();
    let hook = b.anchor("hook", [0.0, height]).unwrap();
    let arm = b.bar("arm", mass, [0.0, 0.0], [length, 0.0]).unwrap();
    b.joint("hinge", &[pivot.into(), arm.node(0)], Joining::Share).unwrap();
    let law = CableLaw::linear(mass * g * 0.5 * length / (height * at));
    b.cable("spring", hook, arm.at([at, 0.0]), law, 0.0).unwrap();
    let model = b.build().unwrap();
    let u = model.inputs_at(0.0);
    for k in 0..8 {
        let (sin, cos) = (0.3 + 0.7 * f64::from(k)).sin_cos();
        let mut q = model.initial_coordinates();
        q[2..4].copy_from_slice(&[length * cos, length * sin]);
        let found = Forward::new(&model, ForwardOptions::default()).solve(&q, &u).unwrap().configuration;
        assert!(found.q.iter().zip(&q).all(|(a, b)| (a - b).abs() < 1e-12));
        assert_eq!(stability(&model, &found, 1).unwrap().verdict, Verdict::Neutral);
        let report = FreeBodyReport::new(&model, &q, &u).unwrap();
        assert!(report.unbalance < 1e-13 && report.indeterminate == 0);
    }
}

#[test]
fn lines_and_wrenches_agree() {
    let (from, to) = (Vector3::new(1.0, -2.0, 0.5), Vector3::new(-0.5, 1.0, 3.0));
    let line = Line::through(&from, &to);
    assert_relative_eq!(line.direction.norm(), 1.0, epsilon = 1e-15);
    assert_relative_eq!(line.direction.dot(&line.moment), 0.0, epsilon = 1e-15);
    let about_origin = Wrench::force(line.direction * 7.0).moved(&from, &Vector3::zeros());
    assert_relative_eq!(about_origin.moment, line.times(7.0).moment, epsilon = 1e-14);
    assert_relative_eq!(line.times(7.0).moved(&Vector3::zeros(), &to).moment.norm(), 0.0, epsilon = 1e-14);
}
