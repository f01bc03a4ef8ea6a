//! Newton's method on the static equations (31), globalised by a line search on a merit that includes the constraints.
//!
//! ```text
//! merit = |r|²/f² + |Φ/s|²,   r = F + Aᵀλ,   f the largest force, s the constraints' sizes
//! ```
//! The Newton direction lowers it by twice itself per unit step. Where the matrix is singular, or no step along the
//! direction lowers the merit, a multiple of the identity is added to K until one does (Levenberg).

use tg_model::{At, Mechanics};
use tg_tangent::TangentError;

use crate::newton_system::{NewtonSystem, Residual};
use crate::size::members;

/// Share of the predicted decrease that a step must reach (Armijo).
const SUFFICIENT: f64 = 1e-4;
/// Halvings of one step.
const MOST_HALVINGS: u32 = 12;
/// First shift, per size of K, and its growth.
const FIRST_SHIFT: f64 = 1e-6;
const SHIFT_GROWTH: f64 = 30.0;
const MOST_SHIFTS: u32 = 6;
/// Scaled constraint residual at which positions count as consistent: some roundings of a squared length.
const CONSISTENT: f64 = 1e-14;
/// Residuals below which a step that brings nothing more is the end: rounding has taken over.
const ROUNDED: f64 = 1e-9;
/// Roundings of the terms of a force that it may be off by at the end.
const ROUNDINGS: f64 = 256.0;

/// What one run of Newton's method did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NewtonRun {
    pub(crate) iterations: u32,
    pub(crate) residual: Residual,
    pub(crate) converged: bool,
}

/// Improves `q` (free components) and `lambda` until forces balance to `tolerance` of the largest force.
pub(crate) fn newton(
    system: &mut NewtonSystem,
    mechanics: &dyn Mechanics,
    q: &mut [f64],
    u: &[f64],
    lambda: &mut [f64],
    tolerance: f64,
    most: u32,
) -> Result<NewtonRun, TangentError> {
    let rest = vec![0.0; q.len()];
    let reach = 0.5 * members(mechanics);
    let (mut trial_q, mut trial_lambda) = (q.to_vec(), lambda.to_vec());
    let mut iterations = 0;
    loop {
        let scale = mechanics.force_scale(At { q, v: &rest, u, taut: None });
        if scale == 0.0 {
            // Without any force there is nothing for constraints to balance.
            lambda.fill(0.0);
        }
        let scale = scale.max(f64::MIN_POSITIVE);
        let residual = system.evaluate(mechanics, q, u, lambda, scale);
        let made = iterations;
        let run = |converged| Ok(NewtonRun { iterations: made, residual, converged });
        if residual.force <= tolerance && residual.constraint <= CONSISTENT {
            return run(true);
        }
        if iterations == most || !residual.merit.is_finite() {
            return run(false);
        }
        iterations += 1;
        let mut shift = 0.0;
        let mut accepted = false;
        for _ in 0..MOST_SHIFTS {
            if shift > 0.0 {
                // The last trial has left the system at its own place.
                system.evaluate(mechanics, q, u, lambda, scale);
            }
            let factored = system.factor(mechanics, q, u, lambda, shift, None);
            shift = if shift == 0.0 { FIRST_SHIFT * system.scale() } else { shift * SHIFT_GROWTH };
            if factored.is_err() {
                continue;
            }
            let Ok(step) = system.newton_step(mechanics) else { continue };
            let largest = step.q.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            let (dq, dl) = (step.q.to_vec(), step.lambda.to_vec());
            let mut length = if largest > reach && reach > 0.0 { reach / largest } else { 1.0 };
            for _ in 0..MOST_HALVINGS {
                trial_q.copy_from_slice(q);
                mechanics.free().iter().zip(&dq).for_each(|(&i, d)| trial_q[i] += length * d);
                for ((t, l), d) in trial_lambda.iter_mut().zip(&*lambda).zip(&dl) {
                    *t = l + length * d;
                }
                let trial = system.evaluate(mechanics, &trial_q, u, &trial_lambda, scale);
                if trial.merit <= (1.0 - 2.0 * SUFFICIENT * length) * residual.merit {
                    accepted = true;
                    break;
                }
                length *= 0.5;
            }
            if accepted || (residual.force <= ROUNDED && residual.constraint <= ROUNDED) {
                break;
            }
        }
        if !accepted {
            // More than rounding is left where no equilibrium exists: just beyond a limit point.
            let rounding = tolerance.max(ROUNDINGS * f64::EPSILON * system.force_terms(mechanics, q) / scale);
            return run(residual.force <= ROUNDED.min(rounding) && residual.constraint <= ROUNDED);
        }
        q.copy_from_slice(&trial_q);
        lambda.copy_from_slice(&trial_lambda);
    }
}
