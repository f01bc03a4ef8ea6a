//! Poses and twists by themselves.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

use crate::common::{Random, rotation2, v};
use nalgebra::{Matrix2, Matrix3, Vector3};
use tg_coords::{CoordsError, Pose, Twist};

#[test]
fn a_planar_pose_turns_counterclockwise() {
    let pose = Pose::planar(1.0, 2.0, FRAC_PI_2);
    let moved = pose.apply_point(&v([1.0, 0.0]));
    assert!((moved - v([1.0, 3.0])).amax() < 1e-15);
    assert!((pose.apply_vector(&v([0.0, 1.0])) - v([-1.0, 0.0])).amax() < 1e-15);
    assert!((pose.angle() - FRAC_PI_2).abs() < 1e-15);
    for angle in [-3.0, -1.0, 0.0, 0.4, 2.0, 3.1] {
        assert!((Pose::planar(1.0, 2.0, angle).angle() - angle).abs() < 1e-15);
    }
    assert_eq!(Pose::planar(0.0, 0.0, 0.3).rotation, rotation2(0.3));
}

#[test]
fn an_axis_and_an_angle_give_a_right_handed_turn() {
    // A third of a turn about the diagonal permutes the axes.
    let axis = v([5.0, 5.0, 5.0]);
    let pose = Pose::from_axis_angle(v([1.0, 0.0, 0.0]), axis, 2.0 * FRAC_PI_3).unwrap();
    assert!((pose.apply_point(&Vector3::x()) - v([1.0, 1.0, 0.0])).amax() < 1e-15);
    assert!((pose.apply_vector(&Vector3::y()) - Vector3::z()).amax() < 1e-15);
    let error = Pose::from_axis_angle(Vector3::zeros(), Vector3::zeros(), 1.0).unwrap_err();
    assert!(matches!(error, CoordsError::ZeroAxis { .. }));
    let error = Pose::from_axis_angle(Vector3::zeros(), Vector3::x(), f64::NAN).unwrap_err();
    assert!(matches!(error, CoordsError::NotFinite { .. }));
}

#[test]
fn poses_compose() {
    let random = &mut Random(19);
    let (a, b) = (random.pose3(), random.pose3());
    let r = random.vector();
    let both = a.compose(&b);
    assert!((both.apply_point(&r) - a.apply_point(&b.apply_point(&r))).amax() < 1e-14);
    assert_eq!(a.compose(&Pose::identity()), a);
    let shifted = Pose::translation(r).compose(&a);
    assert!((shifted.position - a.position - r).amax() < 1e-15);
}

#[test]
fn what_is_no_rotation_is_refused() {
    let o = v([0.0, 0.0]);
    let mirror = Pose::new(o, Matrix2::new(1.0, 0.0, 0.0, -1.0)).unwrap_err();
    assert!(matches!(mirror, CoordsError::NotRotation { determinant, .. } if determinant == -1.0));
    let sheared = Pose::new(o, Matrix2::new(1.0, 1e-3, 0.0, 1.0)).unwrap_err();
    assert!(
        matches!(sheared, CoordsError::NotRotation { deviation, .. } if (deviation - 1e-3).abs() < 1e-12)
    );
    let mirror = Pose::new(Vector3::zeros(), -Matrix3::identity()).unwrap_err();
    assert!(matches!(mirror, CoordsError::NotRotation { determinant, .. } if determinant == -1.0));
    assert!(Pose::new(o, Matrix2::identity() * f64::NAN).is_err());
    assert!(Pose::new(v([f64::INFINITY, 0.0]), Matrix2::identity()).is_err());
    // Seven digits are not enough, and the message says by how much they miss.
    let rounded = Matrix2::new(0.8660254, -0.5, 0.5, 0.8660254);
    assert!(Pose::new(o, rounded).is_err());
    assert!(Pose::new(o, rotation2(0.3)).is_ok());
}

/// Ṙ = Ω R by central differences of a turn about ω.
#[test]
fn the_spin_is_the_rate_of_the_rotation() {
    let omega = v([0.3, -0.5, 0.8]);
    let twist = Twist::spatial(Vector3::zeros(), omega);
    assert_eq!(twist.angular_velocity(), omega);
    let start = Random(20).pose3().rotation;
    let at = |t: f64| {
        let turn = Pose::from_axis_angle(Vector3::zeros(), omega, omega.norm() * t).unwrap();
        turn.rotation * start
    };
    let h = 1e-5;
    let rate = (at(h) - at(-h)) / (2.0 * h);
    assert!((rate - twist.spin * start).amax() < 1e-9);
    let planar = Twist::planar(v([1.0, 2.0]), 0.7);
    let rate = (rotation2(0.2 + 0.7 * h) - rotation2(0.2 - 0.7 * h)) / (2.0 * h);
    assert!((rate - planar.spin * rotation2(0.2)).amax() < 1e-9);
    assert_eq!(planar.angular_velocity(), 0.7);
    assert_eq!(Twist::<3>::zero().angular_velocity(), Vector3::zeros());
}
