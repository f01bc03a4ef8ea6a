//! Shapes as motions of members.

use crate::support::{all_modes, as_built};
use tg_fixtures::spine;
use tg_modal::member_twists;
use tg_model::{Joining, ModelBuilder};

/// A hinged rod turns by 1/√(mL²/3) per modal coordinate.
#[test]
fn twist_of_a_pendulum() {
    let (mass, length) = (1.7, 0.8);
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let pivot = b.anchor("pivot", [0.0, 0.0]).unwrap();
    let bar = b.bar("bar", mass, [0.0, 0.0], [0.0, -length]).unwrap();
    b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share).unwrap();
    let model = b.build().unwrap();
    let at = as_built(&model);
    let found = all_modes(&model, &at);
    let twist = member_twists(&model, &at.q, &found.list[0].shape).unwrap()[0];
    let exact = 1.0 / (mass * length * length / 3.0).sqrt();
    // The tip's component along x is the largest and positive: counterclockwise.
    assert!((twist.angular_velocity() / exact - 1.0).abs() < 1e-13);
    assert!(member_twists(&model, &at.q, &[0.0]).is_err());
}

/// The kinetic energy of the members' twists is ½ in every mass-normalised shape.
#[test]
fn twists_carry_the_modal_mass() {
    let spine = spine(3, 8.0, 0.0).unwrap();
    let at = as_built(&spine.model);
    for mode in &all_modes(&spine.model, &at).list {
        let twists = member_twists(&spine.model, &at.q, &mode.shape).unwrap();
        let mut twice = 0.0;
        for (&body, twist) in spine.bodies.iter().zip(&twists) {
            let properties = spine.model.member(body).mass_properties();
            let omega = twist.angular_velocity();
            // Frames are not turned.
            let v = twist.velocity + omega.cross(&properties.centre());
            twice += properties.mass() * v.norm_squared() + omega.dot(&(properties.inertia_matrix() * omega));
        }
        assert!((twice - 1.0).abs() < 1e-12, "{twice}");
    }
}
