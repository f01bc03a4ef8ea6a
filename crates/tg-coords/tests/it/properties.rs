//! The main invariants on generated members and motions.

use crate::common::{Random, distance, plane, space};
use nalgebra::SVector;
use proptest::prelude::*;
use tg_coords::{CoordType, Member, Pose, Twist};

fn invariants<const D: usize>(
    member: &Member<D>,
    pose: &Pose<D>,
    twist: &Twist<D>,
    scale: f64,
) -> Result<(), TestCaseError> {
    let (q, q_dot) = (member.place(pose), member.place_velocity(pose, twist));
    // Rigid placements satisfy the constraints, and their velocities the differentiated ones.
    for phi in member.constraints() {
        let reach = q.iter().map(SVector::norm).fold(0.0, f64::max);
        prop_assert!(phi.residual(&q).abs() <= 1e-14 * reach * reach + 1e-13 * phi.scale());
        let rate: f64 = phi.gradient(&q).iter().zip(&q_dot).map(|(g, v)| g.dot(v)).sum();
        let speed = q_dot.iter().map(SVector::norm).fold(0.0, f64::max);
        prop_assert!(rate.abs() <= 1e-13 * (reach + phi.scale().sqrt()) * speed);
    }
    // Coordinates → pose → coordinates, velocities → twist → velocities.
    let fit = member.pose(&q).unwrap();
    prop_assert!(fit.misfit < 1e-12 * scale);
    prop_assert!(distance(&member.place(&fit.pose), &q) < 1e-12 * scale);
    let rate = member.twist(&q, &q_dot).unwrap();
    prop_assert!(distance(&member.place_velocity(&fit.pose, &rate), &q_dot) < 1e-11 * scale);
    // A change of type changes no energy.
    let energy = member.kinetic_energy(&q_dot);
    for to in CoordType::ALL.into_iter().filter(|t| t.span() == member.coord_type().span()) {
        let other = member.with_type(to).unwrap();
        let converted = other.kinetic_energy(&other.place_velocity(pose, twist));
        prop_assert!((converted - energy).abs() <= 1e-11 * energy);
    }
    prop_assert!(energy >= 0.0);
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn members_of_space(seed: u64, which in 0..7_usize, far in -100.0..100.0_f64, spin in -50.0..50.0_f64) {
        let random = &mut Random(seed);
        let sample = space(crate::common::SPACE_TYPES[which], random);
        let mut pose = random.pose3();
        pose.position *= far;
        let twist = Twist::spatial(random.vector::<3>() * spin, random.vector::<3>() * spin);
        invariants(&sample.member, &pose, &twist, 100.0)?;
    }

    #[test]
    fn members_of_the_plane(seed: u64, which in 0..6_usize, far in -100.0..100.0_f64, spin in -50.0..50.0_f64) {
        let random = &mut Random(seed);
        let sample = plane(crate::common::PLANE_TYPES[which], random);
        let mut pose = random.pose2();
        pose.position *= far;
        let twist = Twist::planar(random.vector::<2>() * spin, spin);
        invariants(&sample.member, &pose, &twist, 100.0)?;
    }

    /// A flattened basis loses digits of the mass matrix as cond(X̄)² ε, no faster.
    #[test]
    fn flat_bases_lose_digits_as_documented(seed: u64, exponent in 0.0..6.0_f64) {
        let random = &mut Random(seed);
        let sample = space(CoordType::Rrrr, random);
        let mut nodes = sample.member.local_nodes().to_vec();
        let (a, b) = (random.unit(), random.unit());
        let off = nodes[3] - nodes[0];
        let inside = (nodes[1] - nodes[0]) * a + (nodes[2] - nodes[0]) * b;
        nodes[3] = nodes[0] + inside + off * 10.0_f64.powf(-exponent);
        let flat = Member::new(CoordType::Rrrr, &nodes, *sample.member.mass_properties()).unwrap();
        let (pose, twist) = (random.pose3(), Twist::spatial(random.vector(), random.vector()));
        let energy = flat.kinetic_energy(&flat.place_velocity(&pose, &twist));
        let true_energy = sample.member.kinetic_energy(&sample.member.place_velocity(&pose, &twist));
        let bound = 100.0 * f64::EPSILON * flat.condition().powi(2);
        prop_assert!((energy / true_energy - 1.0).abs() < bound);
    }

    /// The size of the member and the unit of length change nothing but the numbers' size.
    #[test]
    fn units_of_length_scale_out(seed: u64, which in 0..7_usize, exponent in -8..8_i32) {
        let unit = 10.0_f64.powi(exponent);
        let random = &mut Random(seed);
        let sample = space(crate::common::SPACE_TYPES[which], random);
        let member = &sample.member;
        let nodes: Vec<_> = member.local_nodes().iter().map(|n| n * unit).collect();
        let given = member.mass_properties();
        let mass = tg_coords::MassProperties::from_second_moment(
            given.mass(), given.centre() * unit, given.second_moment() * (unit * unit)).unwrap();
        let scaled = Member::new(member.coord_type(), &nodes, mass).unwrap();
        prop_assert!((scaled.condition() / member.condition() - 1.0).abs() < 1e-10);
        for (a, b) in member.mass_centre_weights().as_slice().iter().zip(scaled.mass_centre_weights().as_slice()) {
            prop_assert!((a - b).abs() < 1e-11);
        }
        for i in 0..nodes.len() {
            for j in 0..nodes.len() {
                let (a, b) = (member.mass_matrix().get(i, j), scaled.mass_matrix().get(i, j));
                prop_assert!((a - b).abs() < 1e-10 * sample.mass);
            }
        }
    }
}
