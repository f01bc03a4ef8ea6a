//! Points and vectors as linear forms, against rigid kinematics and a dense solve.

use crate::common::{Random, flat, plane_cases, space_cases, v, velocity2, velocity3};
use nalgebra::{DMatrix, DVector, SVector, Vector3};
use tg_coords::{CoordType, CoordsError, Member, Pose, Weights};

/// A random material point: node 0 plus a combination of base vectors.
fn material<const D: usize>(member: &Member<D>, random: &mut Random) -> SVector<f64, D> {
    let nodes = member.local_nodes();
    let mut point = nodes[0];
    for (a, node) in nodes.iter().enumerate().skip(1) {
        let base = if member.coord_type().is_point(a) { node - nodes[0] } else { *node };
        point += base * (2.0 * random.unit());
    }
    point
}

fn check_points<const D: usize>(member: &Member<D>, pose: &Pose<D>, random: &mut Random) {
    let q = member.place(pose);
    let (first, second) = (material(member, random), material(member, random));
    let point = member.point_weights(first).unwrap();
    let expected = pose.position + pose.rotation * first;
    assert!((point.apply(&q) - expected).amax() < 1e-13);
    let vector = member.vector_weights(second - first).unwrap();
    let expected = pose.rotation * (second - first);
    assert!((vector.apply(&q) - expected).amax() < 1e-13);
    // A shift moves points and leaves vectors alone: points count one, vectors nothing.
    let points = member.coord_type().points();
    let count = |w: &Weights| w.as_slice()[..points].iter().sum::<f64>();
    assert!((count(&point) - 1.0).abs() < 1e-13);
    assert!(count(&vector).abs() < 1e-13);
    // Virtual work: f·(C δq) = (Cᵀ f)·δq.
    let (force, shift) = (random.vector::<D>(), random.nodes::<D>(q.len()));
    let mut forces = vec![SVector::zeros(); q.len()];
    point.spread(&force, &mut forces);
    let work = force.dot(&point.apply(&shift));
    assert!((work - flat(&forces).dot(&flat(&shift))).abs() < 1e-13);
}

#[test]
fn points_and_vectors_follow_the_pose() {
    let random = &mut Random(3);
    for seed in 0..10 {
        for (sample, pose, twist) in space_cases(seed) {
            check_points(&sample.member, &pose, random);
            let local = material(&sample.member, random);
            let rate = sample.member.point_weights(local).unwrap();
            let rate = rate.apply(&sample.member.place_velocity(&pose, &twist));
            let expected = velocity3(&pose, &twist, &(pose.position + pose.rotation * local));
            assert!((rate - expected).amax() < 1e-13);
            let q = sample.member.place(&pose);
            let centre = sample.member.mass_centre_weights().apply(&q);
            assert!((centre - pose.position - pose.rotation * sample.centre).amax() < 1e-13);
        }
        for (sample, pose, twist) in plane_cases(seed) {
            check_points(&sample.member, &pose, random);
            let local = material(&sample.member, random);
            let rate = sample.member.point_weights(local).unwrap();
            let rate = rate.apply(&sample.member.place_velocity(&pose, &twist));
            let expected = velocity2(&pose, &twist, &(pose.position + pose.rotation * local));
            assert!((rate - expected).amax() < 1e-13);
        }
    }
}

/// (A.2) for four points: barycentric coordinates by a dense solve of [1 r̄_a] w = [1 r̄].
#[test]
fn four_point_weights_are_barycentric() {
    let random = &mut Random(4);
    let sample = crate::common::space(CoordType::Rrrr, random);
    let nodes = sample.member.local_nodes();
    let lhs = DMatrix::from_fn(4, 4, |i, j| if i == 0 { 1.0 } else { nodes[j][i - 1] });
    for _ in 0..20 {
        let local: Vector3<f64> = random.vector();
        let rhs = DVector::from_vec(vec![1.0, local.x, local.y, local.z]);
        let expected = lhs.clone().lu().solve(&rhs).unwrap();
        let weights = sample.member.point_weights(local).unwrap();
        for (w, e) in weights.as_slice().iter().zip(expected.iter()) {
            assert!((w - e).abs() < 1e-13);
        }
    }
}

#[test]
fn the_weights_of_a_node_are_a_unit_form() {
    for (sample, _, _) in space_cases(5) {
        let member = &sample.member;
        let t = member.coord_type();
        for (a, node) in member.local_nodes().iter().enumerate() {
            let weights = if t.is_point(a) {
                member.point_weights(*node).unwrap()
            } else {
                member.vector_weights(*node).unwrap()
            };
            for (b, w) in weights.as_slice().iter().enumerate() {
                let unit = member.node_weights(a).as_slice()[b];
                assert!((w - unit).abs() < 1e-14);
                assert_eq!(unit, f64::from(u8::from(a == b)));
            }
        }
    }
}

#[test]
fn a_bar_carries_its_axis_only() {
    let bar = Member::thin_rod(1.0, v([1.0, 0.0, 0.0]), v([3.0, 0.0, 0.0])).unwrap();
    let on = bar.point_weights(v([4.0, 0.0, 0.0])).unwrap();
    assert!((on.as_slice()[0] + 0.5).abs() < 1e-15 && (on.as_slice()[1] - 1.5).abs() < 1e-15);
    // Rounding of the axis is accepted, anything that a person could have meant is not.
    assert!(bar.point_weights(v([2.0, 1e-12, 0.0])).is_ok());
    match bar.point_weights(v([2.5, 0.3, 0.4])) {
        Err(CoordsError::OffAxis { what, distance, nearest }) => {
            assert_eq!(what, "point");
            assert!((distance - 0.5).abs() < 1e-15);
            assert!((nearest[0] - 2.5).abs() < 1e-15 && nearest[1].abs() < 1e-15);
        }
        other => panic!("{other:?}"),
    }
    assert!(bar.point_weights(v([2.0, 1e-7, 0.0])).is_err());
    let error = bar.vector_weights(v([0.0, 1.0, 0.0])).unwrap_err();
    assert!(matches!(error, CoordsError::OffAxis { what: "vector", .. }));
    assert!(bar.vector_weights(v([-7.0, 0.0, 0.0])).is_ok());
}

/// Far from its frame's origin a bar's points carry the rounding of their coordinates.
#[test]
fn a_bar_far_from_its_origin_accepts_its_own_points() {
    let from = v([1.0e7, 2.0e7 / 3.0, -1.0e7 / 7.0]);
    let to = from + v([1e-3, 2e-3, 3e-3]);
    let bar = Member::thin_rod(1.0, from, to).unwrap();
    let weights = bar.point_weights(from + (to - from) * 0.37).unwrap();
    assert!((weights.as_slice()[1] - 0.37).abs() < 1e-5);
}

#[test]
fn a_particle_carries_its_point_only() {
    let particle = Member::particle(2.0, v([0.1, 0.2])).unwrap();
    let own = particle.point_weights(v([0.1, 0.2])).unwrap();
    assert_eq!(own.as_slice(), [1.0]);
    let error = particle.point_weights(v([0.1, 0.3])).unwrap_err();
    assert!(matches!(error, CoordsError::OffParticle { what: "point", .. }));
    assert!(particle.vector_weights(v([0.0, 0.0])).is_ok());
    let error = particle.vector_weights(v([0.0, 1e-3])).unwrap_err();
    assert_eq!(error, CoordsError::OffParticle { what: "vector", distance: 1e-3 });
}

#[test]
#[should_panic(expected = "nodes against weights")]
fn a_list_of_the_wrong_length_panics_at_the_caller() {
    Weights::unit(0, 2).apply(&[v([1.0, 2.0])]);
}
