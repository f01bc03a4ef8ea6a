//! Newton's third law and the virtual work of rigid motions: generalised forces as wrenches.

use crate::support::mixed::{
    Mixed, Plane, Space, Spatial, local_point, member, mixed, random_state, rigid_motion, spins,
};
use crate::support::{Random, force};
use nalgebra::{SMatrix, SVector};
use tg_coords::{CoordType, Twist};
use tg_model::{At, CableLaw, ModelBuilder};

fn work(f: &[f64], x: &[f64]) -> f64 {
    f.iter().zip(x).map(|(f, x)| f * x).sum()
}

fn cable_forces_balance<S: Space<D>, const D: usize>() {
    for seed in 0..10 {
        let mixed: Mixed<D> = mixed::<S, D>(seed, false);
        let (q, v, u) = random_state(&mixed, &mut Random::new(seed));
        let f = force(&mixed.model, At { q: &q, v: &v, u: &u, taut: None });
        let size = f.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(size > 10.0);
        for d in 0..D {
            let mut t = SVector::<f64, D>::zeros();
            t[d] = 1.0;
            let motion = rigid_motion(&mixed, &q, t, SMatrix::zeros());
            assert!(work(&f, &motion).abs() < 1e-12 * size, "resultant along {d}");
        }
        for spin in spins::<D>() {
            let motion = rigid_motion(&mixed, &q, SVector::zeros(), spin);
            assert!(motion.iter().all(|x| x.is_finite()));
            assert!(work(&f, &motion).abs() < 1e-11 * size, "moment of {spin}");
        }
    }
}

#[test]
fn cables_have_no_resultant_and_no_moment() {
    cable_forces_balance::<Plane, 2>();
    cable_forces_balance::<Spatial, 3>();
}

/// The generalised force on one member does, on each rigid motion of that member, the work of the tension at the
/// material point where the cable ends.
fn tension_acts_at_its_material_point<S: Space<D>, const D: usize>() {
    let r = &mut Random::new(77);
    for &kind in S::TYPES {
        let body = member::<D>(kind, r);
        let local = local_point(&body, r);
        let pose = S::pose(r.array(0.3), r);
        let mut far = [0.5; D];
        far[0] = 4.0;
        let mut b = ModelBuilder::<D>::new();
        let id = b.member("body", body.clone(), pose).unwrap();
        let ball = b.particle("ball", 1.0, far).unwrap();
        b.cable("tie", id.at(local.into()), ball.node(0), CableLaw::linear(10.0), 1.0).unwrap();
        b.load("push", id.at(local.into()), [2.0; D], 1.5).unwrap();
        let model = b.build().unwrap();
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
        let at_rest = vec![0.0; q.len()];
        let f = force(&model, At { q: &q, v: &at_rest, u: &u, taut: None });

        let point = pose.apply_point(&local);
        let line = SVector::<f64, D>::from(far) - point;
        let pull = line.normalize() * (10.0 * (line.norm() - 1.0)) + SVector::from([3.0; D]);
        // The frame of a bar or a particle is not seen in its coordinates: the twist is that of the fitted frame.
        let origin = model.pose(id, &q).unwrap().pose.position;
        let motions =
            (0..D).map(|d| (SVector::<f64, D>::from_fn(|i, _| f64::from(i == d)), SMatrix::zeros()));
        for (velocity, spin) in motions.chain(spins::<D>().into_iter().map(|s| (SVector::zeros(), s))) {
            let twist = Twist { velocity, spin };
            let mut v = vec![0.0; q.len()];
            model.set_twist(id, &twist, &q, &mut v).unwrap();
            let of_point = velocity + spin * (point - origin);
            assert!((work(&f, &v) - pull.dot(&of_point)).abs() < 1e-11 * pull.norm(), "{kind}: {twist:?}");
        }
    }
}

#[test]
fn tensions_and_loads_act_at_their_material_points() {
    tension_acts_at_its_material_point::<Plane, 2>();
    tension_acts_at_its_material_point::<Spatial, 3>();
}

#[test]
fn gravity_is_a_force_at_the_mass_centre() {
    let r = &mut Random::new(5);
    for kind in CoordType::ALL.into_iter().filter(|kind| kind.fits(3)) {
        let body = member::<3>(kind, r);
        let (mass, centre) = (body.mass_properties().mass(), body.mass_properties().centre());
        let pose = Spatial::pose(r.array(2.0), r);
        let g = [0.3, -1.2, -9.81];
        let mut b = ModelBuilder::<3>::new();
        b.gravity(g).unwrap();
        let id = b.member("body", body, pose).unwrap();
        let model = b.build().unwrap();
        let q = model.initial_coordinates();
        let f = force(&model, At { q: &q, v: &q, u: &[], taut: None });
        let twist = Twist::spatial([0.4, 0.1, -0.7].into(), [1.0, -2.0, 0.5].into());
        let mut v = vec![0.0; q.len()];
        model.set_twist(id, &twist, &q, &mut v).unwrap();
        let origin = model.pose(id, &q).unwrap().pose.position;
        let rate = twist.velocity + twist.spin * (pose.apply_point(&centre) - origin);
        let weight = SVector::<f64, 3>::from(g) * mass;
        assert!((work(&f, &v) - weight.dot(&rate)).abs() < 1e-12, "{kind}");
        let energy = model.energy(&q, &v, &[]).gravity;
        assert!((energy + weight.dot(&pose.apply_point(&centre))).abs() < 1e-12, "{kind}");
    }
}
