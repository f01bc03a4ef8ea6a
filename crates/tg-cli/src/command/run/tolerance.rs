//! A tolerance for an accuracy.
//!
//! Trial runs over the whole motion, each with a tenth of the tolerance before: an explicit scheme of high order costs little
//! more then. The error goes roughly with the tolerance, so that a run is off by about 10/9 of its difference to the next.

use serde_json::{Value, json};
use tg_scene::Structure;

use super::method::Method;
use super::trial::{LOOKS, distance, go_on, trial, unreached};
use crate::answer::Failure;

/// Tolerance of the first trial, and the powers of ten below it that are tried.
const FIRST: i32 = -3;
const FINEST: i32 = -13;
/// Part of the accuracy that the estimated error may fill: it goes with the tolerance only roughly.
const SAFETY: f64 = 0.5;

/// A method with its tolerance chosen, and the trials that it was chosen by.
pub(super) fn choose<const D: usize>(
    structure: &Structure<D>,
    end: f64,
    accuracy: f64,
    method: Method,
) -> Result<(Method, Value), Failure> {
    let at = |power: i32| 10.0_f64.powi(power);
    let with = |power: i32| Method { tolerance: Some(at(power)), ..method };
    // The steps of a trial end where positions are compared only: shorter ones would hide what the tolerance does.
    let run = |power: i32| trial(structure, &Method { step: end / LOOKS, ..with(power) }, end);
    let mut trials = Vec::new();
    let mut coarse = run(FIRST);
    for power in (FINEST + 1..=FIRST).rev() {
        let fine = run(power - 1);
        go_on()?;
        let error = 10.0 / 9.0 * distance(&coarse, &fine);
        trials.push(json!({ "tolerance": at(power), "estimated_error": error.is_finite().then_some(error) }));
        if error <= SAFETY * accuracy {
            return Ok((with(power), json!({ "trials": trials })));
        }
        coarse = fine;
    }
    let tried = format!("tolerance down to {:.0e}", at(FINEST));
    Err(unreached(&tried, accuracy, coarse, "ask for less, or take another scheme"))
}
