//! Second moments from conventional data and back, and what is refused.

use crate::common::{Random, v};
use nalgebra::{Matrix2, Matrix3, Vector3};
use tg_coords::{CoordsError, MassProperties};

/// A box a × b × c has J = m/12 diag(a², b², c²) and I = m/12 diag(b² + c², …).
#[test]
fn box_moments() {
    let (m, [a, b, c]) = (3.0, [0.4, 0.5, 0.7_f64]);
    let i = [b * b + c * c, a * a + c * c, a * a + b * b].map(|x| x * m / 12.0);
    let expected = Matrix3::from_diagonal(&(v([a * a, b * b, c * c]) * (m / 12.0)));
    let centre = v([0.1, -0.2, 0.3]);
    let by_moments = MassProperties::from_principal_moments(m, centre, i).unwrap();
    let by_matrix =
        MassProperties::from_inertia_matrix(m, centre, Matrix3::from_diagonal(&i.into())).unwrap();
    let by_second = MassProperties::from_second_moment(m, centre, expected).unwrap();
    for properties in [by_moments, by_matrix, by_second] {
        assert!((properties.second_moment() - expected).amax() < 1e-15);
        let back = properties.inertia_matrix() - Matrix3::from_diagonal(&i.into());
        assert!(back.amax() < 1e-15);
        assert_eq!((properties.mass(), properties.centre()), (m, centre));
    }
}

#[test]
fn turned_axes_turn_the_inertia() {
    let r = Random(6).rotation3();
    let moments = [0.3, 0.4, 0.6];
    let inertia = r * Matrix3::from_diagonal(&moments.into()) * r.transpose();
    let centre = Vector3::zeros();
    let turned = MassProperties::from_principal_axes(1.0, centre, moments, r).unwrap();
    assert!((turned.inertia_matrix() - inertia).amax() < 1e-15);
    let direct = MassProperties::from_inertia_matrix(1.0, centre, inertia).unwrap();
    assert!((direct.second_moment() - turned.second_moment()).amax() < 1e-15);
    // The sense of an axis is free.
    let mut mirrored = r;
    mirrored.set_column(0, &-r.column(0));
    let mirrored = MassProperties::from_principal_axes(1.0, centre, moments, mirrored).unwrap();
    assert!((mirrored.second_moment() - turned.second_moment()).amax() < 1e-15);
    let stretched = MassProperties::from_principal_axes(1.0, centre, moments, r * 1.001);
    assert!(matches!(stretched, Err(CoordsError::NotRotation { .. })));
}

#[test]
fn rods() {
    let (from, to) = (v([1.0, 0.0, 0.0]), v([1.0, 3.0, 4.0]));
    let uniform = MassProperties::thin_rod(2.4, from, to).unwrap();
    assert_eq!(uniform.centre(), v([1.0, 1.5, 2.0]));
    // m L²/12 = 5 about any transverse axis, nothing about its own.
    let axis = v([0.0, 0.6, 0.8]);
    let inertia = uniform.inertia_matrix();
    assert!((inertia * axis).amax() < 1e-15);
    assert!((inertia * v([1.0, 0.0, 0.0]) - v([5.0, 0.0, 0.0])).amax() < 1e-14);
    let same = MassProperties::rod(2.4, uniform.centre(), axis * 1e-200, 5.0).unwrap();
    assert!((same.second_moment() - uniform.second_moment()).amax() < 1e-14);
    let plane = MassProperties::thin_rod(2.4, v([0.0, 0.0]), v([3.0, 4.0])).unwrap();
    assert!((plane.polar_moment() - 5.0).abs() < 1e-14);
}

#[test]
fn plane_point_and_massless() {
    let split = MassProperties::from_polar_moment(2.0, v([0.0, 1.0]), 0.6).unwrap();
    assert_eq!(split.second_moment(), Matrix2::identity() * 0.3);
    assert_eq!(split.polar_moment(), 0.6);
    let point = MassProperties::point(2.0, v([1.0, 2.0, 3.0])).unwrap();
    assert_eq!(point.second_moment(), Matrix3::zeros());
    let none = MassProperties::massless(v([1.0, 2.0])).unwrap();
    assert_eq!((none.mass(), none.second_moment()), (0.0, Matrix2::zeros()));
}

/// A lamina and a thin rod lie on the limit of the inequality and are accepted.
#[test]
fn limits_of_the_triangle_inequality_are_accepted() {
    let origin = Vector3::zeros();
    for moments in [[0.1, 0.2, 0.1 + 0.2], [0.0, 0.7, 0.7], [0.0; 3]] {
        assert!(MassProperties::from_principal_moments(1.0, origin, moments).is_ok());
        let r = Random(7).rotation3();
        let turned = r * Matrix3::from_diagonal(&moments.into()) * r.transpose();
        assert!(MassProperties::from_inertia_matrix(1.0, origin, turned).is_ok());
    }
}

#[test]
fn the_violated_triangle_inequality_is_named() {
    let origin = Vector3::zeros();
    for (moments, name) in [
        ([1.0, 1.0, 2.1], "I_x + I_y < I_z"),
        ([1.0, 2.1, 1.0], "I_x + I_z < I_y"),
        ([2.1, 1.0, 1.0], "I_y + I_z < I_x"),
        ([-0.1, 1.0, 1.0], "I_x + I_y < I_z"),
    ] {
        let error = MassProperties::from_principal_moments(1.0, origin, moments).unwrap_err();
        let CoordsError::TriangleInequality { violated, .. } = &error else {
            panic!("{error:?}");
        };
        assert!(*violated == name || moments[0] < 0.0, "{violated}");
        assert!(error.to_string().contains(violated));
    }
    let diagonal = Matrix3::new(1.0, 0.1, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0, 2.1);
    let error = MassProperties::from_inertia_matrix(1.0, origin, diagonal).unwrap_err();
    assert!(error.to_string().contains("I_xx + I_yy < I_zz"), "{error}");
    // Principal moments 0.2, 1.8, 2.1: sound on the diagonal, wrong in the principal axes.
    let hidden = Matrix3::new(1.0, 0.8, 0.0, 0.8, 1.0, 0.0, 0.0, 0.0, 1.0);
    assert!(MassProperties::from_inertia_matrix(1.0, origin, hidden).is_err());
    let error = MassProperties::from_inertia_matrix(1.0, origin, hidden).unwrap_err();
    assert!(error.to_string().contains("I_1 + I_2 < I_3"), "{error}");
}

#[test]
fn bad_masses() {
    let origin = v([0.0, 0.0]);
    for mass in [0.0, -1.0] {
        let error = MassProperties::point(mass, origin).unwrap_err();
        assert_eq!(error, CoordsError::Mass { mass });
        assert!(error.to_string().contains("massless"));
        assert!(MassProperties::thin_rod(mass, origin, v([1.0, 0.0])).is_err());
        assert!(MassProperties::rod(mass, origin, v([1.0, 0.0]), 1.0).is_err());
        assert!(MassProperties::from_polar_moment(mass, origin, 1.0).is_err());
        let space = MassProperties::from_principal_moments(mass, Vector3::zeros(), [1.0; 3]);
        assert_eq!(space, Err(CoordsError::Mass { mass }));
        let space = MassProperties::from_inertia_matrix(mass, Vector3::zeros(), Matrix3::identity());
        assert_eq!(space, Err(CoordsError::Mass { mass }));
    }
}

/// An asymmetry of rounding size is split evenly between the two entries.
#[test]
fn rounding_of_a_symmetric_matrix_is_evened_out() {
    let given = Matrix2::new(1.0, 0.25 + 1e-12, 0.25, 1.0);
    let j = MassProperties::from_second_moment(1.0, v([0.0, 0.0]), given).unwrap().second_moment();
    assert_eq!(j[(0, 1)], j[(1, 0)]);
    assert!((j[(0, 1)] - (0.25 + 0.5e-12)).abs() < 1e-16);
}

#[test]
fn bad_second_moments() {
    let origin = v([0.0, 0.0]);
    let skew = MassProperties::from_second_moment(1.0, origin, Matrix2::new(1.0, 0.1, 0.0, 1.0));
    assert!(
        matches!(skew, Err(CoordsError::NotSymmetric { asymmetry, .. }) if (asymmetry - 0.1).abs() < 1e-15)
    );
    let skew = Matrix3::new(1.0, 0.1, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
    let skew = MassProperties::from_inertia_matrix(1.0, Vector3::zeros(), skew);
    assert!(matches!(skew, Err(CoordsError::NotSymmetric { what: "inertia matrix", .. })));
    // Eigenvalues 3 and -1.
    let negative = MassProperties::from_second_moment(1.0, origin, Matrix2::new(1.0, 2.0, 2.0, 1.0));
    assert!(
        matches!(negative, Err(CoordsError::NegativeSecondMoment { eigenvalue }) if (eigenvalue + 1.0).abs() < 1e-14)
    );
    assert!(MassProperties::from_polar_moment(1.0, origin, -1e-3).is_err());
    assert!(MassProperties::rod(1.0, origin, v([1.0, 0.0]), -1e-3).is_err());
    let axis = MassProperties::rod(1.0, origin, origin, 1.0);
    assert!(matches!(axis, Err(CoordsError::ZeroAxis { .. })));
}

#[test]
fn non_finite_numbers() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    let o = v([0.0, 0.0]);
    let o3 = Vector3::zeros();
    let e = v([1.0, 0.0]);
    let refused = [
        MassProperties::point(nan, o),
        MassProperties::point(inf, o),
        MassProperties::point(1.0, v([nan, 0.0])),
        MassProperties::massless(v([0.0, inf])),
        MassProperties::thin_rod(1.0, o, v([nan, 0.0])),
        MassProperties::thin_rod(1.0, o, v([1e200, 0.0])),
        MassProperties::rod(1.0, o, v([nan, 0.0]), 1.0),
        MassProperties::rod(1.0, o, e, nan),
        MassProperties::from_polar_moment(1.0, o, nan),
        MassProperties::from_second_moment(1.0, o, Matrix2::new(nan, 0.0, 0.0, 1.0)),
    ];
    for result in refused {
        assert!(matches!(result, Err(CoordsError::NotFinite { .. })), "{result:?}");
    }
    let refused = [
        MassProperties::from_principal_moments(1.0, o3, [1.0, nan, 1.0]),
        MassProperties::from_inertia_matrix(1.0, o3, Matrix3::identity() * inf),
        MassProperties::from_principal_axes(1.0, o3, [1.0; 3], Matrix3::identity() * nan),
    ];
    for result in refused {
        assert!(matches!(result, Err(CoordsError::NotFinite { .. })), "{result:?}");
    }
}
