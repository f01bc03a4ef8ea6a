//! Poses and twists from coordinates: round trips, and the best fit of coordinates that are off.

use crate::common::{Random, distance, plane_cases, quaternion_matrix, rotation2, space_cases, v};
use nalgebra::{DMatrix, Matrix2, Matrix3, Matrix4, SMatrix, SVector, Vector3};
use tg_coords::{CoordType, CoordsError, MassProperties, Member, Pose, Twist};

fn round_trip<const D: usize>(member: &Member<D>, pose: &Pose<D>, twist: &Twist<D>) {
    let (q, q_dot) = (member.place(pose), member.place_velocity(pose, twist));
    let fit = member.pose(&q).unwrap();
    assert!(fit.misfit < 1e-13);
    fit.pose.check().unwrap();
    assert!(distance(&member.place(&fit.pose), &q) < 1e-13);
    let rate = member.twist(&q, &q_dot).unwrap();
    assert!(distance(&member.place_velocity(&fit.pose, &rate), &q_dot) < 1e-12);
    if member.coord_type().span() == D {
        assert!((fit.pose.rotation - pose.rotation).amax() < 1e-13);
        assert!((fit.pose.position - pose.position).amax() < 1e-13);
        assert!((rate.spin - twist.spin).amax() < 1e-12);
        assert!((rate.velocity - twist.velocity).amax() < 1e-12);
    }
}

#[test]
fn rigid_motions_come_back() {
    for seed in 200..230 {
        for (s, pose, twist) in space_cases(seed) {
            round_trip(&s.member, &pose, &twist);
        }
        for (s, pose, twist) in plane_cases(seed) {
            round_trip(&s.member, &pose, &twist);
            if s.member.coord_type().span() == 1 {
                // A bar in the plane has a full orientation.
                let fit = s.member.pose(&s.member.place(&pose)).unwrap();
                assert!((fit.pose.rotation - pose.rotation).amax() < 1e-13);
            }
        }
    }
}

/// The deformation gradient, by solving F [ū v̄ w̄] = [u v w].
fn deformation<const D: usize>(member: &Member<D>, q: &[SVector<f64, D>]) -> DMatrix<f64> {
    let base = |nodes: &[SVector<f64, D>]| {
        DMatrix::from_fn(D, D, |i, k| {
            let first = if member.coord_type().is_point(k + 1) { nodes[0][i] } else { 0.0 };
            nodes[k + 1][i] - first
        })
    };
    base(q) * base(member.local_nodes()).try_inverse().unwrap()
}

fn fixed<const D: usize>(m: &DMatrix<f64>) -> SMatrix<f64, D, D> {
    SMatrix::from_fn(|i, j| m[(i, j)])
}

/// Nearest rotation by the quaternion method: the top eigenvector of a symmetric 4 × 4 matrix.
fn nearest_rotation(f: &Matrix3<f64>) -> Matrix3<f64> {
    let t = f.trace();
    let z = [f[(2, 1)] - f[(1, 2)], f[(0, 2)] - f[(2, 0)], f[(1, 0)] - f[(0, 1)]];
    let mut k = Matrix4::zeros();
    k[(0, 0)] = t;
    for i in 0..3 {
        k[(0, i + 1)] = z[i];
        k[(i + 1, 0)] = z[i];
        for j in 0..3 {
            k[(i + 1, j + 1)] = f[(i, j)] + f[(j, i)] - if i == j { t } else { 0.0 };
        }
    }
    let eigen = k.symmetric_eigen();
    let q = eigen.eigenvectors.column(eigen.eigenvalues.imax()).into_owned();
    quaternion_matrix([q[0], q[1], q[2], q[3]])
}

fn disturbed<const D: usize>(q: &[SVector<f64, D>], size: f64, random: &mut Random) -> Vec<SVector<f64, D>> {
    q.iter().map(|v| v + random.vector::<D>() * size).collect()
}

#[test]
fn the_best_fit_in_space_is_the_quaternion_methods() {
    let random = &mut Random(21);
    for seed in 0..20 {
        for (s, pose, _) in space_cases(seed) {
            if s.member.coord_type().span() < 3 {
                continue;
            }
            let q = disturbed(&s.member.place(&pose), 0.3, random);
            let f = fixed::<3>(&deformation(&s.member, &q));
            let fit = s.member.pose(&q).unwrap();
            assert!((fit.pose.rotation - nearest_rotation(&f)).amax() < 1e-9);
            let misfit = (f - fit.pose.rotation).norm() / 3.0_f64.sqrt();
            assert!((fit.misfit - misfit).abs() < 1e-13);
            // No nearby or distant rotation is closer.
            let best = (f - fit.pose.rotation).norm();
            for _ in 0..50 {
                let angle = 10.0_f64.powf(-2.0 + 2.0 * random.unit());
                let turn = Pose::from_axis_angle(Vector3::zeros(), random.vector(), angle).unwrap();
                assert!((f - turn.rotation * fit.pose.rotation).norm() >= best);
                assert!((f - random.rotation3()).norm() >= best);
            }
            // The mass centre is that of the coordinates.
            let g = s.member.mass_centre_weights().apply(&q);
            assert!((fit.pose.apply_point(&s.centre) - g).amax() < 1e-13);
        }
    }
}

#[test]
fn the_best_fit_in_the_plane_is_closed_form() {
    let random = &mut Random(22);
    for seed in 0..20 {
        for (s, pose, _) in plane_cases(seed) {
            if s.member.coord_type().span() < 2 {
                continue;
            }
            let q = disturbed(&s.member.place(&pose), 0.2, random);
            let f = fixed::<2>(&deformation(&s.member, &q));
            let angle = (f[(1, 0)] - f[(0, 1)]).atan2(f.trace());
            let fit = s.member.pose(&q).unwrap();
            assert!((fit.pose.rotation - rotation2(angle)).amax() < 1e-13);
            let misfit = (f - rotation2(angle)).norm() / 2.0_f64.sqrt();
            assert!((fit.misfit - misfit).abs() < 1e-13);
            for _ in 0..20 {
                let other = rotation2(angle + 3.0 * random.unit());
                assert!((f - other).norm() >= (f - fit.pose.rotation).norm());
            }
        }
    }
}

/// Turned inside out in one direction: a rotation is still nearest and must not be a reflection.
#[test]
fn a_weakly_inverted_body_still_gets_a_rotation() {
    let nodes = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let mass = MassProperties::massless(Vector3::zeros()).unwrap();
    let body = Member::new(CoordType::Ruvw, &nodes, mass).unwrap();
    let q = [nodes[0], nodes[1], nodes[2] * 0.8, nodes[3] * -0.3];
    let fit = body.pose(&q).unwrap();
    assert!((fit.pose.rotation - Matrix3::identity()).amax() < 1e-14);
    let expected = ((0.2_f64.powi(2) + 1.3_f64.powi(2)) / 3.0).sqrt();
    assert!((fit.misfit - expected).abs() < 1e-14);
    // Flattened to a plane the normal follows from the other two.
    let q = [nodes[0], nodes[1], nodes[2], Vector3::zeros()];
    assert!((body.pose(&q).unwrap().pose.rotation - Matrix3::identity()).amax() < 1e-14);
    // Flattened to a line, mirrored, or gone: no rotation is nearest.
    let e = nodes[1];
    let none = Vector3::zeros();
    let m = -nodes[3];
    for q in [[none, e, none, none], [none; 4], [none, -nodes[1], -nodes[2], m], [none, e, nodes[2], m]] {
        let error = body.pose(&q).unwrap_err();
        assert!(matches!(error, CoordsError::NoOrientation { .. }), "{q:?}");
    }
}

/// Flattened, so that a singular value is zero, and turning: what is left of it says how fast.
#[test]
fn a_flattened_body_still_has_a_twist() {
    let nodes = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let mass = MassProperties::massless(Vector3::zeros()).unwrap();
    let body = Member::new(CoordType::Ruvw, &nodes, mass).unwrap();
    let (velocity, omega) = (v([1.0, 2.0, 3.0]), v([0.3, -0.5, 0.8]));
    let flat = [nodes[0], nodes[1], nodes[2] * 0.5, Vector3::zeros()];
    let mut rates = flat.map(|node| omega.cross(&node));
    rates[0] += velocity;
    let twist = body.twist(&flat, &rates).unwrap();
    assert!((twist.angular_velocity() - omega).amax() < 1e-15);
    assert!((twist.velocity - velocity).amax() < 1e-15);
}

#[test]
fn the_fit_converges_linearly_to_the_truth() {
    let random = &mut Random(23);
    for (s, pose, _) in space_cases(24) {
        if s.member.coord_type().span() == 0 {
            continue;
        }
        let q = s.member.place(&pose);
        let truth = s.member.pose(&q).unwrap().pose;
        let direction = random.nodes::<3>(q.len());
        let errors: Vec<[f64; 2]> = [1e-3, 1e-4, 1e-5]
            .into_iter()
            .map(|size| {
                let off: Vec<_> = q.iter().zip(&direction).map(|(q, d)| q + d * size).collect();
                let fit = s.member.pose(&off).unwrap();
                let turned = (fit.pose.rotation - truth.rotation).norm();
                [turned, fit.misfit]
            })
            .collect();
        for pair in errors.windows(2) {
            for k in 0..2 {
                let ratio = pair[0][k] / pair[1][k];
                assert!((ratio - 10.0).abs() < 0.2, "{} {errors:?}", s.member.coord_type());
            }
        }
    }
}

/// Off the constraints too, the twist of a body is the rate of its pose.
fn rate_by_differences<const D: usize>(member: &Member<D>, pose: &Pose<D>, random: &mut Random) {
    let q = disturbed(&member.place(pose), 0.2, random);
    let q_dot = random.nodes::<D>(q.len());
    let h = 1e-5;
    let at = |t: f64| {
        let moved: Vec<_> = q.iter().zip(&q_dot).map(|(q, v)| q + v * t).collect();
        member.pose(&moved).unwrap().pose
    };
    let twist = member.twist(&q, &q_dot).unwrap();
    let spin = (at(h).rotation - at(-h).rotation) / (2.0 * h);
    let velocity = (at(h).position - at(-h).position) / (2.0 * h);
    assert!((twist.spin + twist.spin.transpose()).amax() < 1e-14);
    assert!((spin - twist.spin * at(0.0).rotation).amax() < 1e-7);
    assert!((velocity - twist.velocity).amax() < 1e-7);
}

#[test]
fn the_twist_is_the_rate_of_the_pose() {
    let random = &mut Random(25);
    for seed in 60..70 {
        for (s, pose, _) in space_cases(seed) {
            if s.member.coord_type().span() == 3 {
                rate_by_differences(&s.member, &pose, random);
            }
        }
        for (s, pose, _) in plane_cases(seed) {
            rate_by_differences(&s.member, &pose, random);
        }
    }
}

#[test]
fn fits_do_not_depend_on_the_type() {
    let random = &mut Random(26);
    for (s, pose, _) in space_cases(71) {
        let from = s.member.coord_type();
        let q = disturbed(&s.member.place(&pose), 0.1, random);
        let q_dot = random.nodes::<3>(q.len());
        let (fit, twist) = (s.member.pose(&q).unwrap(), s.member.twist(&q, &q_dot).unwrap());
        for to in CoordType::ALL.into_iter().filter(|t| t.span() == from.span()) {
            let other = s.member.with_type(to).unwrap();
            let p = from.convert(to, &q).unwrap();
            let p_dot = from.convert(to, &q_dot).unwrap();
            let (fit2, twist2) = (other.pose(&p).unwrap(), other.twist(&p, &p_dot).unwrap());
            assert!((fit.pose.rotation - fit2.pose.rotation).amax() < 1e-12);
            assert!((fit.pose.position - fit2.pose.position).amax() < 1e-12);
            assert!((fit.misfit - fit2.misfit).abs() < 1e-12);
            assert!((twist.spin - twist2.spin).amax() < 1e-12);
            assert!((twist.velocity - twist2.velocity).amax() < 1e-12);
        }
    }
}

/// The shortest arc turns by the angle between the directions, about their common normal.
#[test]
fn a_bar_takes_the_shortest_arc() {
    let bar = Member::thin_rod(1.0, v([1.0, 0.0, 0.0]), v([3.0, 0.0, 0.0])).unwrap();
    for angle in [0.0, 1e-12, 1e-8, 1e-3, 0.5, 1.6, 3.0, 3.1, std::f64::consts::PI] {
        let tip: Vector3<f64> = v([2.0 * f64::cos(angle), 0.0, 2.0 * f64::sin(angle)]);
        let q = [v([5.0, 6.0, 7.0]), v([5.0, 6.0, 7.0]) + tip];
        let fit = bar.pose(&q).unwrap();
        fit.pose.check().unwrap();
        assert!(fit.misfit < 1e-15);
        assert!(distance(&bar.place(&fit.pose), &q) < 1e-14, "{angle}");
        let turned = ((fit.pose.rotation.trace() - 1.0) / 2.0).clamp(-1.0, 1.0).acos();
        assert!((turned - angle).abs() < 2e-8);
    }
    let q = [Vector3::zeros(), v([0.0, 2.2, 0.0])];
    assert!((bar.pose(&q).unwrap().misfit - 0.1).abs() < 1e-15);
}

/// Every direction near the opposite one, where the arc is about to lose its plane.
#[test]
fn nearly_opposite_bars_keep_an_orthonormal_rotation() {
    let random = &mut Random(27);
    for size in [0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3] {
        for _ in 0..50 {
            let local: Vector3<f64> = random.vector();
            let bar = Member::thin_rod(1.0, Vector3::zeros(), local).unwrap();
            let tip = (-local / local.norm() + random.vector::<3>() * size).normalize();
            let q = [Vector3::zeros(), tip * local.norm()];
            let r = bar.pose(&q).unwrap().pose.rotation;
            assert!((r.transpose() * r - Matrix3::identity()).amax() < 2e-15);
            assert!((r.determinant() - 1.0).abs() < 4e-15);
            assert!((r * local - q[1]).amax() < 3e-15, "{size}");
        }
    }
    let bar = Member::thin_rod(1.0, v([0.0, 0.0]), v([0.6, 0.8])).unwrap();
    let half = bar.pose(&[v([0.0, 0.0]), v([-0.6, -0.8])]).unwrap();
    assert!((half.pose.rotation + Matrix2::identity()).amax() < 1e-15);
}

#[test]
fn a_bar_does_not_spin_about_its_axis() {
    for seed in 80..90 {
        for (s, pose, twist) in space_cases(seed) {
            if s.member.coord_type().span() != 1 {
                continue;
            }
            let (q, q_dot) = (s.member.place(&pose), s.member.place_velocity(&pose, &twist));
            let u = CoordType::Ru;
            let axis = s.member.coord_type().convert(u, &q).unwrap()[1].normalize();
            let omega = s.member.twist(&q, &q_dot).unwrap().angular_velocity();
            let given = twist.angular_velocity();
            assert!(omega.dot(&axis).abs() < 1e-14);
            assert!((omega - (given - axis * axis.dot(&given))).amax() < 1e-12);
        }
    }
}

#[test]
fn bad_coordinates_are_refused() {
    let bar = Member::thin_rod(1.0, v([0.0, 0.0]), v([1.0, 0.0])).unwrap();
    let o = v([0.0, 0.0]);
    let e = v([1.0, 0.0]);
    assert!(matches!(bar.pose(&[o]), Err(CoordsError::NodeCount { found: 1, .. })));
    assert!(matches!(bar.pose(&[o, o]), Err(CoordsError::NoOrientation { .. })));
    let nan = v([f64::NAN, 0.0]);
    assert!(matches!(bar.pose(&[o, nan]), Err(CoordsError::NotFinite { what: "coordinate" })));
    assert!(matches!(bar.twist(&[o, e], &[o, nan]), Err(CoordsError::NotFinite { what: "velocity" })));
    assert!(matches!(bar.twist(&[o, e], &[o]), Err(CoordsError::NodeCount { .. })));
}
