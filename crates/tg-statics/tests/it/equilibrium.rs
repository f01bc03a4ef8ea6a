//! Member forces and reactions against balances that do not use them.

use approx::assert_relative_eq;
use nalgebra::{Vector2, Vector3};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_fixtures::prism;
use tg_model::{CableLaw, Joining, Mechanics, ModelBuilder};
use tg_statics::{EquilibriumReport, Forward, ForwardOptions};

#[test]
fn bars_of_a_prism_carry_what_a_node_balances() {
    for n in 3..7 {
        let prism = prism(n, 10.0, 0.0, CableLaw::slacking).unwrap();
        let q = prism.model.initial_coordinates();
        let report = EquilibriumReport::new(&prism.model, &q, &prism.model.inputs_at(0.0)).unwrap();
        assert!(report.imbalance < 1e-12, "{}", report.imbalance);
        for member in &report.members {
            assert_relative_eq!(member.axial.unwrap(), prism.forces[2], max_relative = 1e-11);
        }
        assert!(report.supports.is_empty() && report.joints.is_empty());
        assert!(report.residuals.iter().all(|node| node.force.norm() < 1e-11));
        for (k, (_, cable)) in report.cables.iter().enumerate() {
            let expected = prism.forces[usize::from(k >= 2 * n)];
            assert_relative_eq!(cable.tension, expected, max_relative = 1e-11);
        }
    }
}

#[test]
fn feet_carry_the_weight() {
    let prism = prism(3, 40.0, 9.81, CableLaw::slacking).unwrap();
    let (q, u) = (prism.model.initial_coordinates(), prism.model.inputs_at(0.0));
    let found = Forward::new(&prism.model, ForwardOptions::default()).solve(&q, &u).unwrap();
    assert_eq!(found.report.gauged, 3, "two translations and the rotation about the vertical");
    let report = EquilibriumReport::new(&prism.model, &found.configuration.q, &u).unwrap();
    assert!(report.imbalance < 1e-12, "{}", report.imbalance);
    let sum: Vector3<f64> = report.supports.iter().map(|support| support.force).sum();
    assert_relative_eq!(sum, Vector3::new(0.0, 0.0, 3.0 * 9.81), epsilon = 1e-11);
    // By symmetry each foot carries a third.
    for support in &report.supports {
        assert_relative_eq!(support.force.z, 9.81, max_relative = 1e-10);
    }
}

/// Two bars in a row hang from the ceiling by a constrained joint; all forces are known.
#[test]
fn a_hanging_chain_carries_what_hangs_below() {
    let g = 10.0;
    for coord_type in [CoordType::Rr, CoordType::Ru] {
        let mut b = ModelBuilder::<2>::new();
        b.gravity([0.0, -g]).unwrap();
        let ceiling = b.anchor("ceiling", [0.0, 0.0]).unwrap();
        let rod = Member::thin_rod(2.0, Vector2::zeros(), Vector2::new(0.0, -1.0)).unwrap();
        let rod = rod.with_type(coord_type).unwrap();
        let upper = b.member("upper", rod.clone(), Pose::identity()).unwrap();
        let lower = b.member("lower", rod, Pose::planar(0.0, -1.0, 0.0)).unwrap();
        b.joint("hook", &[ceiling.into(), upper.node(0)], Joining::Share).unwrap();
        b.joint("link", &[upper.at([0.0, -1.0]), lower.node(0)], Joining::Constrain).unwrap();
        let model = b.build().unwrap();
        let report = EquilibriumReport::new(&model, &model.initial_coordinates(), &[]).unwrap();
        assert!(report.imbalance < 1e-13, "{}", report.imbalance);
        assert_eq!(report.joints.len(), 1);
        // The link lifts the lower bar.
        assert_relative_eq!(report.joints[0].force, Vector2::new(0.0, 2.0 * g), epsilon = 1e-11);
        let ceiling: Vector2<f64> = report.supports.iter().map(|support| support.force).sum();
        assert_relative_eq!(ceiling, Vector2::new(0.0, 4.0 * g), epsilon = 1e-11);
        // The mean of the tension along each bar: half of its own weight and what hangs below.
        for (member, expected) in report.members.iter().zip([3.0 * g, g]) {
            assert_relative_eq!(member.axial.unwrap(), expected, max_relative = 1e-11);
        }
    }
}

#[test]
fn a_body_on_three_strings_balances_by_moments() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -10.0]).unwrap();
    let corners = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]].map(Vector2::from);
    let mass = MassProperties::from_polar_moment(3.0, Vector2::new(0.5, 0.25), 1.0).unwrap();
    let plate = Member::new(CoordType::Rrr, &corners, mass).unwrap();
    let plate = b.member("plate", plate, Pose::planar(0.0, 0.0, 0.0)).unwrap();
    let (left, right) = (b.anchor("left", [0.0, 2.0]).unwrap(), b.anchor("right", [2.0, 2.0]).unwrap());
    b.cable("left string", left, plate.node(0), CableLaw::slacking(1e4), 2.0).unwrap();
    b.cable("right string", right, plate.node(1), CableLaw::slacking(1e4), 2.0).unwrap();
    b.support("guide", plate.at([1.0, 0.5]), 0, 0.0).unwrap();
    let model = b.build().unwrap();
    let q = model.initial_coordinates();
    let found = Forward::new(&model, ForwardOptions::default()).solve(&q, &model.inputs_at(0.0)).unwrap();
    let report = EquilibriumReport::new(&model, &found.configuration.q, &model.inputs_at(0.0)).unwrap();
    // Moments about the string on the left, level to first order in the stretch of 1e-3.
    assert_relative_eq!(report.cables[1].1.tension, 30.0 * 0.5 / 2.0, max_relative = 1e-2);
    let vertical: f64 = report.cables.iter().map(|(_, cable)| cable.tension).sum();
    assert_relative_eq!(vertical, 30.0, max_relative = 1e-5);
    assert_eq!(report.members[0].axial, None);
    let sizes = model.sizes();
    assert_eq!(report.configuration.lambda.len(), sizes.constraints);
}
