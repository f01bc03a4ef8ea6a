//! What is given and what is refused is a matter of ratios: it changes with no unit of length or mass.

use crate::common::v;
use nalgebra::{Matrix2, Matrix3, SVector, Vector3};
use tg_coords::{CoordType, CoordsError, MassProperties, Member, Pose, ROUNDING_TOLERANCE};

/// M = m/6 [2 1; 1 2] (eq. 18 for a uniform rod), and the turn from x to y.
fn check_rod<const D: usize>(length: f64) {
    let along = |axis: usize| SVector::<f64, D>::from_fn(|i, _| if i == axis { length } else { 0.0 });
    for mass in [1e-9, 1.0, 1e9] {
        let rod = Member::thin_rod(mass, SVector::zeros(), along(0)).unwrap();
        let m = rod.mass_matrix();
        for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let expected = if i == j { mass / 3.0 } else { mass / 6.0 };
            assert!((m.get(i, j) / expected - 1.0).abs() < 1e-13, "{length:e} m, {mass:e} kg");
        }
        assert!(m.is_positive_definite());
        let fit = rod.pose(&[SVector::zeros(), along(1)]).unwrap();
        assert!(fit.misfit < 1e-15);
        assert!(((fit.pose.apply_point(&along(0)) - along(1)) / length).amax() < 1e-15);
    }
}

/// From far below the atoms to far beyond the stars; in space squares of squares of lengths still are numbers.
#[test]
fn a_rod_of_any_length_and_mass() {
    [1e-140, 1e-9, 1.0, 1e9, 1e140].into_iter().for_each(check_rod::<2>);
    [1e-70, 1e-9, 1.0, 1e9, 1e70].into_iter().for_each(check_rod::<3>);
}

/// m/4 [1 1; 1 1]: the mass centre alone has inertia.
#[test]
fn a_rod_with_all_mass_in_its_middle_is_semidefinite() {
    for mass in [1e-9, 1.0, 1e9] {
        let properties = MassProperties::rod(mass, v([0.5, 0.0]), v([1.0, 0.0]), 0.0).unwrap();
        let rod = Member::new(CoordType::Rr, &[v([0.0, 0.0]), v([1.0, 0.0])], properties).unwrap();
        assert!((rod.mass_matrix().get(0, 1) / mass - 0.25).abs() < 1e-15);
        assert!(!rod.mass_matrix().is_positive_definite());
    }
}

#[test]
fn a_mass_matrix_that_overflows_is_refused() {
    let properties = MassProperties::rod(1e305, v([5e4, 0.0]), v([1.0, 0.0]), 0.0).unwrap();
    let error = Member::new(CoordType::Rr, &[v([0.0, 0.0]), v([1e5, 0.0])], properties).unwrap_err();
    assert_eq!(error, CoordsError::NotFinite { what: "mass matrix" });
}

#[test]
fn what_counts_as_on_the_axis_grows_with_the_bar() {
    for length in [1e-4, 1.0, 1e4] {
        let bar = Member::thin_rod(1.0, v([0.0, 0.0]), v([length, 0.0])).unwrap();
        let off = |part: f64| v([0.3 * length, part * ROUNDING_TOLERANCE * length]);
        assert!(bar.point_weights(off(0.9)).is_ok() && bar.vector_weights(off(0.9)).is_ok(), "{length:e}");
        assert!(bar.point_weights(off(1.1)).is_err() && bar.vector_weights(off(1.1)).is_err(), "{length:e}");
        // A long lever is rounded like itself, not like the bar.
        let lever = v([1e4 * length, 0.9e4 * ROUNDING_TOLERANCE * length]);
        assert!(bar.vector_weights(lever).is_ok(), "{length:e}");
    }
    // A particle has no length: far from its origin it carries its point up to the rounding of that.
    let particle = Member::particle(1.0, v([1e6, 0.0])).unwrap();
    assert!(particle.point_weights(v([1e6 + 1e-9, 0.0])).is_ok());
    assert!(particle.point_weights(v([1e6 + 1e-7, 0.0])).is_err());
}

/// Collapsed alike in all directions a body is still turned as it is.
#[test]
fn the_rotation_of_a_body_does_not_depend_on_its_size() {
    let local = [v([0.0, 0.0]), v([1.0, 0.0]), v([0.0, 1.0])];
    let mass = MassProperties::massless(v([0.0, 0.0])).unwrap();
    let body = Member::new(CoordType::Ruv, &local, mass).unwrap();
    let pose = Pose::planar(0.0, 0.0, 0.7);
    for size in [1e-14, 1.0, 1e14] {
        let q: Vec<_> = body.place(&pose).iter().map(|node| node * size).collect();
        let fit = body.pose(&q).unwrap();
        assert!((fit.pose.angle() - 0.7).abs() < 1e-14, "{size:e}");
        assert!((fit.misfit / (size - 1.0).abs() - 1.0).abs() < 1e-14 || size == 1.0, "{size:e}");
    }
}

/// A bar between rounding and its own length: the shortest that has a direction.
#[test]
fn a_bar_loses_its_direction_at_the_rounding_of_its_length() {
    for length in [1e-6, 1.0, 1e6] {
        let bar = Member::thin_rod(1.0, v([0.0, 0.0]), v([length, 0.0])).unwrap();
        let shrunk = |part: f64| bar.pose(&[v([0.0, 0.0]), v([0.0, part * f64::EPSILON * length])]);
        assert!((shrunk(1.5).unwrap().pose.angle() - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
        assert!(matches!(shrunk(0.5), Err(CoordsError::NoOrientation { .. })), "{length:e}");
    }
}

#[test]
fn an_axis_of_any_length_gives_its_direction() {
    let turn = |size: f64| Pose::from_axis_angle(Vector3::zeros(), v([size, -2.0 * size, 2.0 * size]), 0.4);
    let expected = turn(1.0).unwrap();
    for size in [1e-300, 1e-160, 1e160, 1e300] {
        assert!((turn(size).unwrap().rotation - expected.rotation).amax() < 1e-15, "{size:e}");
    }
    let rod = |size: f64| MassProperties::rod(1.0, v([0.0, 0.0]), v([3.0 * size, 4.0 * size]), 0.25).unwrap();
    for size in [1e-300, 1.0, 1e300] {
        let expected = Matrix2::new(0.09, 0.12, 0.12, 0.16);
        assert!((rod(size).second_moment() - expected).amax() < 1e-16, "{size:e}");
    }
}

const SIZES: [f64; 3] = [1e-12, 4.0, 1e12];

/// The smallest eigenvalue of [a b; b a] is a - b.
#[test]
fn a_second_moment_is_judged_against_its_size() {
    for size in SIZES {
        let second = |b: f64| {
            let j = Matrix2::new(1.0, b, b, 1.0) * size;
            MassProperties::from_second_moment(1.0, v([0.0, 0.0]), j)
        };
        // Rounding is accepted; the largest entry is b times the size.
        assert!(second(1.0).is_ok() && second(1.0 + 0.9 * ROUNDING_TOLERANCE).is_ok(), "{size:e}");
        for b in [1.0 + 1.1 * ROUNDING_TOLERANCE, 1.5] {
            let Err(CoordsError::NegativeSecondMoment { eigenvalue }) = second(b) else { panic!("{size:e}") };
            assert!((eigenvalue / ((1.0 - b) * size) - 1.0).abs() < 1e-5, "{eigenvalue:e}");
        }
        let skew = |part: f64| {
            let j = Matrix2::new(1.0, part * ROUNDING_TOLERANCE, 0.0, 0.5) * size;
            MassProperties::from_second_moment(1.0, v([0.0, 0.0]), j)
        };
        assert!(skew(0.9).is_ok(), "{size:e}");
        let Err(CoordsError::NotSymmetric { asymmetry, .. }) = skew(4.0) else { panic!("{size:e}") };
        assert!((asymmetry / ROUNDING_TOLERANCE - 4.0).abs() < 1e-12);
    }
}

#[test]
fn moments_of_inertia_are_judged_against_their_size() {
    let centre: SVector<f64, 3> = Vector3::zeros();
    for size in SIZES {
        for k in 0..3 {
            let moments = |excess: f64| {
                let mut moments = [0.25 * size, 0.75 * size, 0.0];
                moments[2] = moments[0] + moments[1] + excess * ROUNDING_TOLERANCE * size;
                moments.rotate_right(k);
                moments
            };
            let refused = |excess: f64| {
                let by_axes = MassProperties::from_principal_moments(1.0, centre, moments(excess));
                let matrix = Matrix3::from_diagonal(&moments(excess).into());
                let by_matrix = MassProperties::from_inertia_matrix(1.0, centre, matrix);
                assert_eq!(by_axes.is_err(), by_matrix.is_err());
                by_axes.is_err()
            };
            assert!(!refused(0.0) && !refused(0.9), "{size:e}");
            assert!(refused(1.1) && refused(1e8), "{size:e}");
        }
        // What the diagonal hides: about the axes at 45° the moments are 1 ± b, and 1.
        let hidden = |b: f64| {
            let matrix = Matrix3::new(1.0, b, 0.0, b, 1.0, 0.0, 0.0, 0.0, 1.0) * size;
            MassProperties::from_inertia_matrix(1.0, centre, matrix)
        };
        assert!(hidden(0.49).is_ok() && hidden(0.51).is_err(), "{size:e}");
    }
}

/// A body that is one point has no moments; no division by its size.
#[test]
fn no_extent_is_no_mistake() {
    let zero = Vector3::zeros();
    let given = [
        MassProperties::from_second_moment(2.0, zero, Matrix3::zeros()),
        MassProperties::from_inertia_matrix(2.0, zero, Matrix3::zeros()),
        MassProperties::from_principal_moments(2.0, zero, [0.0; 3]),
        MassProperties::rod(2.0, zero, Vector3::x(), 0.0),
    ];
    for properties in given {
        assert_eq!(properties, MassProperties::point(2.0, zero));
    }
}

#[test]
fn inertia_beside_a_bars_axis_is_judged_against_its_size() {
    let nodes = [Vector3::zeros(), Vector3::x()];
    for size in SIZES {
        let bar = |part: f64| {
            let j = Matrix3::from_diagonal(&v([size, part * ROUNDING_TOLERANCE * size, 0.0]));
            Member::new(
                CoordType::Ru,
                &nodes,
                MassProperties::from_second_moment(1.0, Vector3::zeros(), j).unwrap(),
            )
        };
        assert!(bar(0.9).is_ok(), "{size:e}");
        assert!(matches!(bar(1.1), Err(CoordsError::ThickBar { .. })), "{size:e}");
    }
}
