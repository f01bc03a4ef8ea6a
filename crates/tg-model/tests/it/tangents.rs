//! Forces, tangents and constraint derivatives against central differences, on random structures of every kind.

use crate::support::mixed::{Mixed, Plane, Space, Spatial, mixed, random_state};
use crate::support::{Random, assert_close, derivative, seeds};
use crate::support::{active_set, constraints, damping, force, jacobian, select, stiffness};
use nalgebra::DMatrix;
use tg_model::{At, Mechanics};

const SEEDS: u64 = seeds(12);
/// Step of the five-point formula: truncation and rounding both below 1e-10 of the result.
const STEP: f64 = 1e-3;
const TOLERANCE: f64 = 1e-8;

fn each_structure(check: impl Fn(&dyn Mechanics, &[f64], &[f64], &[f64], &mut Random)) {
    fn with<S: Space<D>, const D: usize>(
        check: &impl Fn(&dyn Mechanics, &[f64], &[f64], &[f64], &mut Random),
    ) {
        for seed in 0..SEEDS {
            let mixed: Mixed<D> = mixed::<S, D>(seed, true);
            let r = &mut Random::new(1000 + seed);
            let (q, v, u) = random_state(&mixed, r);
            check(&mixed.model, &q, &v, &u, r);
        }
    }
    with::<Plane, 2>(&check);
    with::<Spatial, 3>(&check);
}

#[test]
fn stiffness_is_the_derivative_of_the_force() {
    each_structure(|m, q, v, u, _| {
        let found = stiffness(m, At { q, v, u, taut: None });
        let expected = -derivative(q, STEP, |q| force(m, At { q, v, u, taut: None }));
        assert_close(
            &select(&found, m.free(), m.free()),
            &select(&expected, m.free(), m.free()),
            TOLERANCE,
            "-∂F/∂q",
        );
    });
}

#[test]
fn damping_is_the_derivative_of_the_force() {
    each_structure(|m, q, v, u, _| {
        assert!(m.features().damping);
        let found = damping(m, At { q, v, u, taut: None });
        let expected = -derivative(v, STEP, |v| force(m, At { q, v, u, taut: None }));
        assert_close(
            &select(&found, m.free(), m.free()),
            &select(&expected, m.free(), m.free()),
            TOLERANCE,
            "-∂F/∂q̇",
        );
    });
}

#[test]
fn tangents_follow_a_frozen_active_set() {
    each_structure(|m, q, v, u, r| {
        let flags: Vec<bool> = (0..m.sizes().switches).map(|_| r.value() > 0.0).collect();
        assert_ne!(flags, active_set(m, At { q, v, u, taut: None }), "the flags must change something");
        let taut = Some(flags.as_slice());
        let by_position = -derivative(q, STEP, |q| force(m, At { q, v, u, taut }));
        let by_velocity = -derivative(v, STEP, |v| force(m, At { q, v, u, taut }));
        let free = m.free();
        let found = stiffness(m, At { q, v, u, taut });
        assert_close(&select(&found, free, free), &select(&by_position, free, free), TOLERANCE, "-∂F/∂q");
        let found = damping(m, At { q, v, u, taut });
        assert_close(&select(&found, free, free), &select(&by_velocity, free, free), TOLERANCE, "-∂F/∂q̇");
    });
}

/// The last line of (B.3) as printed, `(η/l) l̂ (L̇ - l̇ l̂)ᵀ` without its second term, would be seen by the tests above.
#[test]
fn random_states_exercise_the_damping_term_of_the_stiffness() {
    each_structure(|m, q, v, u, _| {
        let still = vec![0.0; v.len()];
        let taut = active_set(m, At { q, v, u, taut: None });
        let taut = Some(taut.as_slice());
        let moving = stiffness(m, At { q, v, u, taut });
        let resting = stiffness(m, At { q, v: &still, u, taut });
        let asymmetric = select(&(&moving - moving.transpose()), m.free(), m.free());
        assert!((moving - resting).amax() > 0.1 && asymmetric.amax() > 0.1);
    });
}

#[test]
fn force_is_the_negative_gradient_of_the_potential_at_rest() {
    each_structure(|m, q, v, u, _| {
        let still = vec![0.0; v.len()];
        let found = force(m, At { q, v: &still, u, taut: None });
        let gradient = derivative(q, STEP, |q| vec![m.potential(q, u)]);
        let found = DMatrix::from_row_slice(1, found.len(), &found);
        assert_close(&found, &-gradient, TOLERANCE, "F = -∂V/∂q");
    });
}

#[test]
fn jacobian_is_the_derivative_of_the_constraints() {
    each_structure(|m, q, _, _, _| {
        let expected = derivative(q, 0.1, |q| constraints(m, q));
        assert_close(&jacobian(m, q), &expected, 1e-12, "∂Φ/∂q");
    });
}

#[test]
fn hessian_is_the_derivative_of_the_jacobian() {
    each_structure(|m, q, _, _, _| {
        let (n, rows) = (q.len(), m.sizes().constraints);
        let mut found = vec![DMatrix::zeros(n, n); rows];
        for e in m.constraint_hessian() {
            found[e.constraint][(e.row, e.col)] += e.value;
        }
        // Row c + rows·i of the derivative is that of ∂Φ_c/∂q_i: the Jacobian is stored by columns.
        let expected = derivative(q, 0.1, |q| jacobian(m, q).as_slice().to_vec());
        for (c, found) in found.iter().enumerate() {
            let expected = expected.rows_with_step(c, n, rows - 1);
            assert_close(found, &expected.into_owned(), 1e-12, "∂²Φ/∂q²");
        }
    });
}

#[test]
fn patterns_stay_inside_the_system() {
    each_structure(|m, q, _, _, _| {
        let n = q.len();
        let inside = |pattern: &[(usize, usize)], rows| pattern.iter().all(|&(i, j)| i < rows && j < n);
        assert!(inside(m.stiffness_pattern(), n) && inside(m.damping_pattern(), n));
        assert!(inside(m.jacobian_pattern(), m.sizes().constraints));
        assert!(m.free().windows(2).all(|pair| pair[0] < pair[1]) && m.free().len() < n);
    });
}
