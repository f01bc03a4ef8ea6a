//! Structures that several tests use.

use nalgebra::{Vector2, Vector3};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_equilibria::EquilibriaReport;
use tg_model::{CableLaw, Joining, MemberId, Model, ModelBuilder};

/// The compliant mechanism of Rhodes, Tanouye and Vikas (Table 1) with free lengths L01 and L02.
pub(crate) fn mechanism(free: [f64; 2]) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    let fixed = [[0.0, 0.0], [3.19, 0.0], [-2.55, 4.93]];
    let fixed: Vec<_> =
        fixed.iter().enumerate().map(|(k, &p)| b.anchor(&format!("{}", k + 1), p).unwrap()).collect();
    let bar = b.bar("bar 1-4", 1.0, [0.0, 0.0], [9.0, 0.0]).unwrap();
    let nodes = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vector2::from);
    let mass = MassProperties::from_polar_moment(1.0, Vector2::zeros(), 1.0).unwrap();
    let body = Member::new(CoordType::Ruv, &nodes, mass).unwrap();
    let body = b.member("body", body, Pose::planar(9.0, 0.0, 0.0)).unwrap();
    b.joint("1", &[fixed[0].into(), bar.node(0)], Joining::Share).unwrap();
    b.joint("4", &[bar.node(1), body.node(0)], Joining::Share).unwrap();
    let law = || CableLaw::linear(2.81);
    b.cable("2-6", fixed[1], body.at([4.25, 0.0]), law(), free[0]).unwrap();
    b.cable("3-5", fixed[2], body.at([-0.3, -3.45]), law(), free[1]).unwrap();
    b.build().unwrap()
}

/// A spring from a point of space to a point of a member.
pub(crate) struct Spring<const D: usize> {
    pub(crate) from: [f64; D],
    pub(crate) to: [f64; D],
    pub(crate) stiffness: f64,
    pub(crate) free: f64,
}

/// Adds springs to one member.
pub(crate) fn add_springs<const D: usize>(b: &mut ModelBuilder<D>, member: MemberId, springs: &[Spring<D>]) {
    for (k, s) in springs.iter().enumerate() {
        let from = b.anchor(&format!("anchor {k}"), s.from).unwrap();
        b.cable(&format!("spring {k}"), from, member.at(s.to), CableLaw::linear(s.stiffness), s.free)
            .unwrap();
    }
}

/// A body in space.
pub(crate) fn body(b: &mut ModelBuilder<3>, name: &str, at: [f64; 3]) -> MemberId {
    let nodes = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let mass = MassProperties::from_principal_moments(1.0, Vector3::zeros(), [1.0; 3]).unwrap();
    let member = Member::new(CoordType::Ruvw, &nodes, mass).unwrap();
    b.member(name, member, Pose::translation(at.into())).unwrap()
}

/// Every path is accounted for, and every proof is tight.
#[track_caller]
pub(crate) fn assert_complete(report: &EquilibriaReport) {
    assert!(report.accounts_for_all(), "{report}");
    assert!(report.largest_radius < 1e-10, "{report}");
}
