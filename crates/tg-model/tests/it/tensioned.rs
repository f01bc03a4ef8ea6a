//! Cables one by one, rigid motions, member forces, changed laws: the extra trait and what goes with it.

use crate::support::mixed::{Mixed, Plane, Space, Spatial, mixed, random_state, rigid_motion, spins};
use crate::support::{Random, assert_close, derivative, force, jacobian, scatter, seeds, select, stiffness};
use nalgebra::{DMatrix, DVector, SMatrix, SVector};
use tg_model::{At, CableLaw, ConstraintSource, Mechanics, Model, Tensioned};

const STEP: f64 = 1e-3;

fn each_structure(check: impl Fn(&dyn Tensioned, &[f64], &[f64])) {
    fn with<S: Space<D>, const D: usize>(check: &impl Fn(&dyn Tensioned, &[f64], &[f64])) {
        for seed in 0..seeds(8) {
            let mixed: Mixed<D> = mixed::<S, D>(seed, true);
            let (q, _, u) = random_state(&mixed, &mut Random::new(2000 + seed));
            check(&mixed.model, &q, &u);
        }
    }
    with::<Plane, 2>(&check);
    with::<Spatial, 3>(&check);
}

fn lengths(s: &dyn Tensioned, q: &[f64]) -> (Vec<f64>, DMatrix<f64>) {
    let pattern = s.length_pattern();
    let (mut lengths, mut gradients) = (vec![f64::NAN; s.cable_count()], vec![f64::NAN; pattern.len()]);
    s.lengths(q, &mut lengths, &mut gradients);
    let dense = scatter(s.cable_count(), q.len(), &pattern, &gradients);
    (lengths, dense)
}

#[test]
fn gradients_are_derivatives_of_lengths() {
    each_structure(|s, q, _| {
        let (_, found) = lengths(s, q);
        assert_close(&found, &derivative(q, STEP, |q| lengths(s, q).0), 1e-8, "∂l/∂q");
    });
}

/// F without cables plus -Σ f ∂l/∂q is F, for velocities at rest.
#[test]
fn tensions_and_gradients_make_up_the_force() {
    each_structure(|s, q, u| {
        let rest = vec![0.0; q.len()];
        let at = |u| At { q, v: &rest, u, taut: None };
        let mut slack = u.to_vec();
        let (lengths, gradients) = lengths(s, q);
        // Other rest lengths change the force by the difference of tensions alone.
        slack[..s.cable_count()].iter_mut().for_each(|rest| *rest *= 1.1);
        let change = DVector::from_iterator(
            s.cable_count(),
            (0..s.cable_count())
                .map(|c| s.static_tension(c, lengths[c], slack[c]) - s.static_tension(c, lengths[c], u[c])),
        );
        let expected = -(gradients.transpose() * change);
        let found = DVector::from_vec(force(s, at(&slack))) - DVector::from_vec(force(s, at(u)));
        let free = s.free();
        for &i in free {
            assert!(
                (found[i] - expected[i]).abs() < 1e-9 * (1.0 + expected.amax()),
                "{} {}",
                found[i],
                expected[i]
            );
        }
    });
}

#[test]
fn geometric_stiffness_is_the_derivative_at_constant_tension() {
    each_structure(|s, q, u| {
        let tension: Vec<f64> = (0..s.cable_count()).map(|c| 1.0 + c as f64 + u[c]).collect();
        let mut values = vec![f64::NAN; s.stiffness_pattern().len()];
        s.geometric_stiffness(q, &tension, &mut values);
        let found = scatter(q.len(), q.len(), s.stiffness_pattern(), &values);
        let pull = |q: &[f64]| {
            let gradient = lengths(s, q).1;
            (gradient.transpose() * DVector::from_column_slice(&tension)).iter().copied().collect()
        };
        let expected = derivative(q, STEP, pull);
        assert_close(
            &select(&found, s.free(), s.free()),
            &select(&expected, s.free(), s.free()),
            1e-7,
            "K_g",
        );
    });
}

/// Along a rigid motion no cable and no intrinsic constraint changes, to first order.
#[test]
fn rigid_motions_keep_lengths() {
    each_structure(|s, q, _| {
        let (_, gradients) = lengths(s, q);
        let (rows, sizes) = (jacobian(s, q), s.constraint_scales());
        for field in s.rigid_motions(q) {
            let field = DVector::from_vec(field);
            assert!((&gradients * &field).amax() < 1e-12 * (1.0 + field.amax()));
            let rates = &rows * &field;
            // The random state leaves joints open; dot products are what a rigid motion keeps.
            for entry in s.constraint_hessian() {
                let rate = rates[entry.constraint] / sizes[entry.constraint];
                assert!(rate.abs() < 1e-12 * (1.0 + field.amax()), "{rate}");
            }
        }
    });
}

/// D translations, then D(D-1)/2 rotations about the origin: of points like the points', of base vectors without the shift.
#[test]
fn rigid_motions_are_those_of_every_member() {
    fn check<S: Space<D>, const D: usize>(seed: u64) {
        let mixed: Mixed<D> = mixed::<S, D>(seed, false);
        let q = mixed.model.initial_coordinates();
        let unit = |axis: usize| SVector::<f64, D>::from_fn(|i, _| f64::from(u8::from(i == axis)));
        let shifts = (0..D).map(|axis| rigid_motion(&mixed, &q, unit(axis), SMatrix::zeros()));
        let turns = spins::<D>().into_iter().map(|spin| rigid_motion(&mixed, &q, SVector::zeros(), spin));
        assert_eq!(mixed.model.rigid_motions(&q), shifts.chain(turns).collect::<Vec<_>>());
    }
    for seed in 0..seeds(4) {
        check::<Plane, 2>(seed);
        check::<Spatial, 3>(seed);
    }
}

#[test]
fn members_rigidity_forces_sum_to_the_constraint_force() {
    fn check<S: Space<D>, const D: usize>(seed: u64) {
        let mixed: Mixed<D> = mixed::<S, D>(seed, true);
        let model: &Model<D> = &mixed.model;
        let r = &mut Random::new(3000 + seed);
        let (q, _, _) = random_state(&mixed, r);
        let mut values = vec![0.0; model.jacobian_pattern().len()];
        model.jacobian(&q, &mut values);
        // Multipliers of intrinsic constraints only.
        let intrinsic = |source: &ConstraintSource| matches!(source, ConstraintSource::Rigidity(_));
        let lambda: Vec<f64> = model
            .constraint_sources()
            .iter()
            .map(|source| if intrinsic(source) { r.value() } else { 0.0 })
            .collect();
        let expected = jacobian(model, &q).transpose() * DVector::from_column_slice(&lambda);
        let mut sum = DVector::zeros(q.len());
        for member in model.members() {
            // A velocity that is one at one component finds the places of the member's nodes.
            let index: Vec<f64> = (0..q.len()).map(|i| i as f64).collect();
            let places = model.member_nodes(member, &index);
            for (place, force) in places.iter().zip(model.rigidity_forces(member, &values, &lambda)) {
                for d in 0..D {
                    sum[place[d] as usize] += force[d];
                }
            }
        }
        assert!((sum - expected).amax() < 1e-12);
    }
    for seed in 0..6 {
        check::<Plane, 2>(seed);
        check::<Spatial, 3>(seed);
    }
}

#[test]
fn a_changed_law_is_the_model_built_with_it() {
    let mixed: Mixed<3> = mixed::<Spatial, 3>(4, true);
    let (q, v, u) = random_state(&mixed, &mut Random::new(77));
    let cable = mixed.model.cables().next().unwrap();
    let old = mixed.model.cable_law(cable).clone();
    let changed = mixed.model.with_law(cable, CableLaw::linear(123.0)).unwrap();
    let state = changed.cable(cable, &q, &v, &u);
    assert!((state.tension - 123.0 * (state.length - state.rest)).abs() < 1e-9);
    let at = At { q: &q, v: &v, u: &u, taut: None };
    let expected = -derivative(&q, STEP, |q| force(&changed, At { q, ..at }));
    let free = changed.free();
    assert_close(
        &select(&stiffness(&changed, at), free, free),
        &select(&expected, free, free),
        1e-8,
        "-∂F/∂q",
    );
    // And back.
    let back = changed.with_law(cable, old).unwrap();
    assert_eq!(force(&back, at), force(&mixed.model, at));
    assert!(mixed.model.with_law(cable, CableLaw::linear(-1.0)).is_err());
}

#[test]
fn the_force_scale_is_the_largest_single_force() {
    each_structure(|s, q, u| {
        let rest = vec![0.0; q.len()];
        let scale = s.force_scale(At { q, v: &rest, u, taut: None });
        let (lengths, _) = lengths(s, q);
        let tensions = (0..s.cable_count()).map(|c| s.static_tension(c, lengths[c], u[c]).abs());
        assert!(scale.is_finite() && tensions.clone().all(|f| f <= scale));
        assert!(scale > 0.0);
    });
}
