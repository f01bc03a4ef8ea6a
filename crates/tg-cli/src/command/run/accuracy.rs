//! A step for an accuracy.
//!
//! Trial runs over the whole motion, since errors grow, with steps h and h/2. With a scheme of order p the positions of the
//! first are off by about 2^p/(2^p - 1) of their difference, and an error ε wants the step h (ε / error)^(1/p). The factor is
//! taken as 4/3 for all, p = 2: where cables go slack no fixed step has a higher order.

use serde_json::{Value, json};
use tg_scene::Structure;

use super::method::Method;
use super::trial::{distance, go_on, trial, unreached};
use crate::answer::Failure;

/// Steps of the first trial: a multiple of the number of looks.
const FIRST: f64 = 64.0;
/// Steps that are not tried any more.
const FINEST: f64 = 2e6;
/// The estimate is one: the step stays on the safe side.
const SAFETY: f64 = 0.8;
/// Most by which the number of steps grows between trials: the error of a step that is far too long says little.
const JUMP: f64 = 16.0;

/// A method with its step chosen, and the trials that it was chosen by.
pub(super) fn choose<const D: usize>(
    structure: &Structure<D>,
    end: f64,
    accuracy: f64,
    method: Method,
) -> Result<(Method, Value), Failure> {
    let by_order = |ratio: f64| ratio.powf(1.0 / f64::from(method.scheme.order()));
    let run = |steps: f64| trial(structure, &Method { step: end / steps, ..method }, end);
    let mut trials = Vec::new();
    let mut steps = FIRST;
    let mut coarse = run(steps);
    while steps < FINEST {
        let fine = run(2.0 * steps);
        go_on()?;
        let error = 4.0 / 3.0 * distance(&coarse, &fine);
        trials.push(json!({ "step": end / steps, "estimated_error": error.is_finite().then_some(error) }));
        if error <= accuracy {
            let factor = SAFETY * by_order(accuracy / error.max(f64::MIN_POSITIVE));
            // Beyond twice what was tried the order of the scheme is no longer seen.
            let step = end / steps * factor.clamp(SAFETY, 2.0);
            let whole = end / (end / step).ceil();
            return Ok((Method { step: whole, ..method }, json!({ "trials": trials })));
        }
        let wanted = if error.is_finite() { by_order(error / accuracy).min(JUMP) } else { 2.0 };
        if wanted <= 4.0 {
            (steps, coarse) = (2.0 * steps, fine);
        } else {
            steps *= wanted.log2().floor().exp2();
            coarse = run(steps);
        }
    }
    Err(unreached(&format!("step down to {:.1e} s", end / FINEST), accuracy, coarse, "ask for less"))
}
