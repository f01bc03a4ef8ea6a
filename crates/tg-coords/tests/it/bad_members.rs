//! One test for each way to describe a member that does not exist.

use crate::common::v;
use nalgebra::{Matrix2, Matrix3, Vector2, Vector3};
use tg_coords::{CONDITION_LIMIT, CoordType, CoordsError, MassProperties, Member};

fn space(t: CoordType, nodes: &[Vector3<f64>]) -> Result<Member<3>, CoordsError> {
    Member::new(t, nodes, MassProperties::massless(nodes[0])?)
}

fn plane(t: CoordType, nodes: &[Vector2<f64>]) -> Result<Member<2>, CoordsError> {
    Member::new(t, nodes, MassProperties::massless(nodes[0])?)
}

/// The condition number that the refusal carries.
fn condition<M>(result: Result<M, CoordsError>) -> f64 {
    match result {
        Err(CoordsError::DegenerateBasis { condition, limit, .. }) => {
            assert_eq!(limit, CONDITION_LIMIT);
            assert!(condition > limit);
            condition
        }
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("accepted"),
    }
}

#[test]
fn collinear_points() {
    let line = [v([0.0, 0.0]), v([0.1, 0.3]), v([0.2, 0.6])];
    assert!(condition(plane(CoordType::Rrr, &line)) > 1e15);
    let error = plane(CoordType::Rrr, &line).unwrap_err().to_string();
    assert!(error.contains("RRR") && error.contains("condition number"), "{error}");
}

#[test]
fn coplanar_points() {
    let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 2.0]];
    condition(space(CoordType::Rrrr, &flat.map(Vector3::from)));
}

#[test]
fn coplanar_vectors() {
    let (a, b) = (v([0.3, 0.1, 0.7]), v([0.2, -0.5, 0.1]));
    condition(space(CoordType::Ruvw, &[a, a, b, a * 0.3 - b * 2.0]));
}

#[test]
fn zero_length() {
    let p = v([0.3, 0.4]);
    assert_eq!(condition(plane(CoordType::Rr, &[p, p])), f64::INFINITY);
    assert_eq!(condition(plane(CoordType::Ru, &[p, p * 0.0])), f64::INFINITY);
    assert_eq!(condition(plane(CoordType::Ruv, &[p, p, p * 0.0])), f64::INFINITY);
    assert_eq!(condition(Member::thin_rod(1.0, p, p)), f64::INFINITY);
}

/// The condition number is that of X̄, and the limit is where it is said to be.
#[test]
fn nearly_degenerate() {
    let with = |slope: f64| {
        let nodes = [v([0.0, 0.0]), v([1.0, 0.0]), v([1.0, slope])];
        plane(CoordType::Ruv, &nodes)
    };
    // [[1, 1], [0, δ]] has condition 2/δ for small δ.
    assert!((with(1e-6).unwrap().condition() / 2e6 - 1.0).abs() < 1e-6);
    assert!(with(2.1 / CONDITION_LIMIT).is_ok());
    assert!((condition(with(1.9 / CONDITION_LIMIT)) * 1.9 / CONDITION_LIMIT / 2.0 - 1.0).abs() < 1e-6);
    let scaled = [v([0.0, 0.0]), v([3.0, 0.0]), v([0.0, 0.5])];
    assert!((plane(CoordType::Ruv, &scaled).unwrap().condition() - 6.0).abs() < 1e-14);
    let bar = plane(CoordType::Rr, &scaled[..2]).unwrap();
    let particle = plane(CoordType::R, &scaled[..1]).unwrap();
    assert_eq!((bar.condition(), particle.condition()), (1.0, 1.0));
}

#[test]
fn types_that_do_not_fit_the_space() {
    for t in CoordType::ALL {
        let nodes3 = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
        let nodes2 = [Vector2::zeros(), Vector2::x(), Vector2::y(), Vector2::x() * 2.0];
        let in_space = space(t, &nodes3[..t.nodes()]);
        let in_plane = plane(t, &nodes2[..t.nodes()]);
        match t.span() {
            3 => {
                let error = in_plane.unwrap_err();
                assert_eq!(error, CoordsError::Dimension { coord_type: t, dimension: 2 });
                assert!(error.to_string().contains("use RUV, RRV or RRR"), "{error}");
            }
            2 => {
                let error = in_space.unwrap_err();
                assert_eq!(error, CoordsError::Dimension { coord_type: t, dimension: 3 });
                assert!(error.to_string().contains("use RUVW"), "{error}");
            }
            _ => assert!(in_space.is_ok() && in_plane.is_ok()),
        }
    }
}

#[test]
fn wrong_number_of_nodes() {
    let nodes = [v([0.0, 0.0]), v([1.0, 0.0]), v([0.0, 1.0])];
    let expected = |t, expected, found| CoordsError::NodeCount { coord_type: t, expected, found };
    let few = plane(CoordType::Rrr, &nodes[..2]).unwrap_err();
    assert_eq!(few, expected(CoordType::Rrr, 3, 2));
    let many = plane(CoordType::Rr, &nodes).unwrap_err();
    assert_eq!(many, expected(CoordType::Rr, 2, 3));
    let mass = MassProperties::massless(nodes[0]).unwrap();
    let none = Member::<2>::new(CoordType::R, &[], mass).unwrap_err();
    assert_eq!(none, expected(CoordType::R, 1, 0));
}

#[test]
fn non_finite_nodes() {
    for bad in [f64::NAN, f64::INFINITY] {
        let error = plane(CoordType::Rr, &[v([0.0, 0.0]), v([1.0, bad])]).unwrap_err();
        assert_eq!(error, CoordsError::NotFinite { what: "local node" });
    }
    // Finite, but its square is not.
    assert!(matches!(
        plane(CoordType::Rr, &[v([0.0, 0.0]), v([1e200, 0.0])]),
        Err(CoordsError::NotFinite { .. })
    ));
    let bar = plane(CoordType::Rr, &[v([0.0, 0.0]), v([1.0, 0.0])]).unwrap();
    assert!(bar.point_weights(v([f64::NAN, 0.0])).is_err());
    assert!(bar.vector_weights(v([0.0, f64::INFINITY])).is_err());
}

#[test]
fn a_mass_centre_off_a_bar_or_particle() {
    let mass = MassProperties::rod(1.0, v([0.5, 0.1]), v([1.0, 0.0]), 0.1).unwrap();
    let error = Member::new(CoordType::Rr, &[v([0.0, 0.0]), v([1.0, 0.0])], mass);
    assert!(matches!(
        error.unwrap_err(),
        CoordsError::OffAxis { what: "mass centre", distance, .. } if (distance - 0.1).abs() < 1e-15
    ));
    let mass = MassProperties::point(1.0, v([0.0, 0.1])).unwrap();
    let error = Member::new(CoordType::R, &[v([0.0, 0.0])], mass).unwrap_err();
    assert!(matches!(error, CoordsError::OffParticle { what: "mass centre", .. }));
}

#[test]
fn a_thick_bar_in_space() {
    let nodes = [Vector3::zeros(), Vector3::x()];
    let centre = Vector3::x() * 0.5;
    let bar = |j: Matrix3<f64>| {
        Member::new(CoordType::Rr, &nodes, MassProperties::from_second_moment(1.0, centre, j)?)
    };
    let mut j = Matrix3::zeros();
    j[(0, 0)] = 0.1;
    assert!(bar(j).is_ok());
    j[(1, 1)] = 1e-3;
    assert!(matches!(
        bar(j).unwrap_err(),
        CoordsError::ThickBar { axial, rest } if axial == 0.1 && (rest - 1e-3).abs() < 1e-15
    ));
    let askew = MassProperties::rod(1.0, centre, v([1.0, 1e-3, 0.0]), 0.1).unwrap();
    let error = Member::new(CoordType::Ru, &nodes, askew).unwrap_err();
    assert!(matches!(error, CoordsError::ThickBar { .. }));
}

#[test]
fn a_particle_with_inertia() {
    let mass = MassProperties::from_second_moment(1.0, Vector2::zeros(), Matrix2::identity());
    let error = Member::new(CoordType::R, &[Vector2::zeros()], mass.unwrap()).unwrap_err();
    assert_eq!(error, CoordsError::ExtendedParticle { trace: 2.0 });
}

#[test]
fn a_change_to_another_span() {
    let bar = Member::thin_rod(1.0, Vector3::zeros(), Vector3::x()).unwrap();
    let error = bar.with_type(CoordType::Rrrr).unwrap_err();
    assert!(matches!(error, CoordsError::Span { .. }));
    assert!(error.to_string().contains("RR") && error.to_string().contains("RRRR"));
}

#[test]
#[should_panic(expected = "node 2 of 2")]
fn a_node_that_does_not_exist_panics_at_the_caller() {
    let bar = Member::thin_rod(1.0, Vector3::zeros(), Vector3::x()).unwrap();
    bar.node_weights(2);
}
