//! A step for an accuracy.

use super::{Choice, Trial, Tried, apart, trial};
use crate::error::ChoiceError;
use crate::method::Method;
use crate::richardson::{error_from_half, observed_order};
use crate::subject::{LOOKS, Subject};

/// Steps that are not tried any more.
const FINEST: u64 = 2_000_000;
/// Part of the accuracy that is aimed at: the order is known roughly.
const SAFETY: f64 = 0.7;
/// Part of the steps that a coarser trial must save.
const WORTH: f64 = 0.7;
/// Most by which the number of steps grows between trials: the error of a step that is far too long says little.
const JUMP: f64 = 16.0;
/// The order that a first distance is read with: a higher one changes the error by a third at most.
const FIRST_ORDER: f64 = 2.0;

pub(super) fn choose<const D: usize>(
    subject: &Subject<'_, D>,
    accuracy: f64,
    method: &Method,
) -> Result<Choice, ChoiceError> {
    let most = f64::from(method.scheme.order());
    let (end, looks) = (subject.end(), u64::from(LOOKS));
    let with = |steps: u64| Method { step: end / steps as f64, tolerance: None, ..*method };
    let run = |steps: u64| trial(subject, &with(steps), steps / looks);
    let (mut trials, mut steps, mut too_few) = (Vec::new(), looks, 0);
    let mut before: Option<(f64, f64)> = None;
    let mut known: Option<(u64, Trial)> = None;
    loop {
        let coarse = match known.take() {
            Some((n, trial)) if n == steps => trial,
            _ => run(steps)?,
        };
        let fine = run(2 * steps)?;
        let (n, distance) = (steps as f64, apart(&coarse, &fine));
        let seen = before.map(|before| observed_order(before, (n, distance), most));
        let error = error_from_half(distance, seen.unwrap_or(FIRST_ORDER.min(most)));
        trials.push(Tried::new(&with(steps), error));
        let wanted = if error.is_finite() {
            (error / (SAFETY * accuracy)).powf(1.0 / seen.unwrap_or(most))
        } else {
            2.0
        };
        // Upwards to whole steps between looks.
        let next = ((n * wanted.min(JUMP) / looks as f64).ceil() as u64).max(1) * looks;
        before = distance.is_finite().then_some((n, distance));
        if error > accuracy {
            too_few = too_few.max(steps);
            steps = next.max(steps + looks);
        } else if too_few < next && (next as f64) < WORTH * n {
            steps = next;
        } else {
            return Ok(Choice { method: with(steps), error, trials });
        }
        if steps > FINEST {
            let tried = format!("step down to {:.1e} s", end / FINEST as f64);
            let last = fine.err().map(Box::new);
            return Err(ChoiceError::Unreached { tried, accuracy, last, mend: "ask for less" });
        }
        known = Some((2 * n as u64, fine));
    }
}
