//! Derivatives of the force along a direction, for directions that the tangent's pattern does not hold.

use tg_model::{At, Mechanics};
use tg_tangent::Configuration;

use crate::derivative::central;
use crate::error::ModalError;

/// First difference step per extent of the structure (or per input); 13 halvings follow.
const STEP: f64 = 1e-2;
/// The same where an input is zero: the unit of rest lengths is the metre, and forces enter linearly.
const STEP_FROM_ZERO: f64 = 1e-3;

/// What the force is differentiated by.
#[derive(Clone, Copy)]
pub(crate) enum Along<'a> {
    /// Full coordinates along a direction.
    Coordinates(&'a [f64]),
    /// Full velocities along a direction.
    Velocities(&'a [f64]),
    /// One input.
    Input(usize),
}

/// ∂F along a direction, over the full coordinates, each cable staying as it is, taut or slack.
pub(crate) fn force(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    along: Along<'_>,
    what: impl FnOnce() -> String,
) -> Result<Vec<f64>, ModalError> {
    let rest = vec![0.0; at.q.len()];
    let mut taut = vec![false; mechanics.sizes().switches];
    mechanics.active_set(At { q: &at.q, v: &rest, u: &at.u, taut: None }, &mut taut);
    let (mut q, mut v, mut u) = (at.q.clone(), rest.clone(), at.u.clone());
    let h = match along {
        Along::Coordinates(e) | Along::Velocities(e) => {
            let most = |x: &[f64]| x.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            if most(e) == 0.0 {
                return Ok(rest);
            }
            STEP * extent(&at.q) / most(e)
        }
        Along::Input(k) => {
            if u[k] == 0.0 {
                STEP_FROM_ZERO
            } else {
                STEP * u[k].abs()
            }
        }
    };
    let derivative = central(h, |h| {
        let moved = |x: &mut [f64], from: &[f64], e: &[f64]| {
            x.iter_mut().zip(from.iter().zip(e)).for_each(|(x, (from, e))| *x = from + h * e);
        };
        match along {
            Along::Coordinates(e) => moved(&mut q, &at.q, e),
            Along::Velocities(e) => moved(&mut v, &rest, e),
            Along::Input(k) => u[k] = at.u[k] + h,
        }
        let mut f = vec![0.0; q.len()];
        mechanics.force(At { q: &q, v: &v, u: &u, taut: Some(&taut) }, &mut f);
        f
    });
    if derivative.iter().all(|x| x.is_finite()) {
        Ok(derivative)
    } else {
        Err(ModalError::NotFinite { what: what() })
    }
}

/// Extent of the coordinates \[m\], one where they all are equal.
fn extent(q: &[f64]) -> f64 {
    let (low, high) = q.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &q| (l.min(q), h.max(q)));
    if high > low { high - low } else { 1.0 }
}
