//! Intrinsic constraints: rigid motions satisfy them, and nothing else does.

use crate::common::{Random, flat, jacobian, plane_cases, space_cases, unflat, v};
use nalgebra::{DMatrix, SVector};
use tg_coords::{CoordType, Member, Pose, Twist};

#[test]
fn order_labels_values_and_scales() {
    let labels =
        |member: &Member<3>| -> Vec<&str> { member.constraints().iter().map(|c| c.label()).collect() };
    for (sample, _, _) in space_cases(20) {
        match sample.member.coord_type().span() {
            3 => assert_eq!(labels(&sample.member), ["u·u", "v·v", "w·w", "v·w", "u·w", "u·v"]),
            1 => assert_eq!(labels(&sample.member), ["u·u"]),
            _ => assert!(labels(&sample.member).is_empty()),
        }
    }
    let nodes = [v([1.0, 1.0]), v([4.0, 5.0]), v([1.0, 3.0])];
    let mass = tg_coords::MassProperties::massless(v([0.0, 0.0])).unwrap();
    let member = Member::new(CoordType::Rrr, &nodes, mass).unwrap();
    let found: Vec<_> = member.constraints().iter().map(|c| (c.label(), c.value(), c.scale())).collect();
    let expected = [("u·u", 25.0, 25.0), ("v·v", 4.0, 4.0), ("u·v", 8.0, 10.0)];
    assert_eq!(found, expected);
    assert_eq!(member.constraints()[2].a().as_slice(), [-1.0, 1.0, 0.0]);
    assert_eq!(member.constraints()[2].b().as_slice(), [-1.0, 0.0, 1.0]);
}

fn vanish<const D: usize>(member: &Member<D>, pose: &Pose<D>, twist: &Twist<D>) {
    let q = member.place(pose);
    let rate = flat(&member.place_velocity(pose, twist));
    for phi in member.constraints() {
        assert!(phi.residual(&q).abs() < 1e-14 * (phi.scale() + q[0].norm_squared()));
        assert!(flat(&phi.gradient(&q)).dot(&rate).abs() < 1e-12 * phi.scale());
    }
}

#[test]
fn rigid_motions_satisfy_them() {
    for seed in 0..20 {
        for (sample, pose, twist) in space_cases(seed) {
            vanish(&sample.member, &pose, &twist);
        }
        for (sample, pose, twist) in plane_cases(seed) {
            vanish(&sample.member, &pose, &twist);
        }
    }
}

/// Full rank, and a null space that is spanned by the velocities of rigid motions.
fn rank_and_nullspace<const D: usize>(
    member: &Member<D>,
    pose: &Pose<D>,
    twists: &[Twist<D>],
    expected_freedom: usize,
) {
    let span = member.coord_type().span();
    let q = member.place(pose);
    let a = jacobian(member, &q);
    let rank = span * (span + 1) / 2;
    assert_eq!(a.nrows(), rank);
    let n = a.ncols();
    assert_eq!(n - rank, expected_freedom);
    if rank > 0 {
        let values = a.clone().svd(false, false).singular_values;
        assert!(values.min() > 1e-3 * values.max(), "{values}");
    }
    let rigid: Vec<_> = twists.iter().map(|t| flat(&member.place_velocity(pose, t))).collect();
    let rigid = DMatrix::from_columns(&rigid);
    assert!((&a * &rigid).amax() < 1e-13);
    // As many independent rigid velocities as the null space has dimensions: they span it.
    let values = rigid.svd(false, false).singular_values;
    let independent = values.iter().filter(|&&v| v > 1e-10 * values.max()).count();
    assert_eq!(independent, expected_freedom);
}

#[test]
fn gradients_detect_every_non_rigid_direction() {
    for seed in 30..40 {
        for (sample, pose, _) in space_cases(seed) {
            let freedom = [3, 5, 0, 6][sample.member.coord_type().span()];
            let mut twists = Vec::new();
            for k in 0..3 {
                let e = SVector::from_fn(|i, _| f64::from(u8::from(i == k)));
                twists.push(Twist::spatial(e, SVector::zeros()));
                twists.push(Twist::spatial(SVector::zeros(), e));
            }
            rank_and_nullspace(&sample.member, &pose, &twists, freedom);
        }
        for (sample, pose, _) in plane_cases(seed) {
            let freedom = [2, 3, 3][sample.member.coord_type().span()];
            let twists = [
                Twist::planar(v([1.0, 0.0]), 0.0),
                Twist::planar(v([0.0, 1.0]), 0.0),
                Twist::planar(v([0.0, 0.0]), 1.0),
            ];
            rank_and_nullspace(&sample.member, &pose, &twists, freedom);
        }
    }
}

/// Φ is quadratic, so central differences of Φ and of its gradient are exact up to rounding.
fn differences<const D: usize>(member: &Member<D>, random: &mut Random) {
    let h = 0.5;
    let q = flat(&random.nodes::<D>(member.coord_type().nodes()));
    for phi in member.constraints() {
        let gradient = flat(&phi.gradient(&unflat::<D>(&q)));
        let hessian = phi.hessian();
        for i in 0..q.len() {
            let (mut up, mut down) = (q.clone(), q.clone());
            up[i] += h;
            down[i] -= h;
            let (up, down) = (unflat::<D>(&up), unflat::<D>(&down));
            let slope = (phi.residual(&up) - phi.residual(&down)) / (2.0 * h);
            assert!((slope - gradient[i]).abs() < 1e-13 * (1.0 + phi.scale()));
            let column = (flat(&phi.gradient(&up)) - flat(&phi.gradient(&down))) / (2.0 * h);
            for j in 0..q.len() {
                let same_axis = f64::from(u8::from(i % D == j % D));
                let expected = hessian.get(j / D, i / D) * same_axis;
                assert!((column[j] - expected).abs() < 1e-13);
            }
        }
    }
}

#[test]
fn gradient_and_hessian_by_central_differences() {
    let random = &mut Random(8);
    for seed in 0..5 {
        for (sample, _, _) in space_cases(seed) {
            differences(&sample.member, random);
        }
        for (sample, _, _) in plane_cases(seed) {
            differences(&sample.member, random);
        }
    }
}

#[test]
fn constraints_do_not_depend_on_the_type() {
    let random = &mut Random(9);
    for (sample, _, _) in space_cases(50) {
        let member = &sample.member;
        let from = member.coord_type();
        let q = random.nodes::<3>(from.nodes());
        for to in CoordType::ALL.into_iter().filter(|t| t.span() == from.span()) {
            let other = member.with_type(to).unwrap();
            let converted = from.convert(to, &q).unwrap();
            for (a, b) in member.constraints().iter().zip(other.constraints()) {
                assert_eq!(a.label(), b.label());
                assert!((a.value() - b.value()).abs() < 1e-14 * a.scale());
                let (ra, rb) = (a.residual(&q), b.residual(&converted));
                assert!((ra - rb).abs() < 1e-13 * (1.0 + a.scale()));
            }
        }
    }
}
