//! A tolerance for an accuracy.

use super::{Choice, Tried, apart, trial};
use crate::error::ChoiceError;
use crate::method::Method;
use crate::subject::{LOOKS, Subject};

/// Powers of ten between the first tolerance and the finest.
const FIRST: i32 = -3;
const FINEST: i32 = -13;
/// Part of the accuracy that the estimated error may fill: it goes with the tolerance only roughly.
const SAFETY: f64 = 0.5;
/// A tolerance is exceeded by a tenth of itself, as the companion's error is left out.
const COMPANION: f64 = 10.0 / 9.0;

pub(super) fn choose<const D: usize>(
    subject: &Subject<'_, D>,
    accuracy: f64,
    method: &Method,
) -> Result<Choice, ChoiceError> {
    let (end, looks) = (subject.end(), f64::from(LOOKS));
    // Rows of a table stay where they were: the longest step is divided, not replaced.
    let step = method.step / (method.step * looks / end).ceil().max(1.0);
    let stride = ((end / step / looks) * (1.0 + 1e-9)).max(1.0) as u64;
    let with = |power: i32, parts: u32| Method {
        step: step / f64::from(parts),
        tolerance: Some(10.0_f64.powi(power)),
        ..*method
    };
    let mut trials = Vec::new();
    let mut power = FIRST;
    loop {
        let coarse = trial(subject, &with(power, 1), stride)?;
        // Half of the longest step as well: where steps are never refused, the tolerance alone changes nothing.
        let fine = trial(subject, &with(power - 1, 2), 2 * stride)?;
        let error = COMPANION * apart(&coarse, &fine);
        let method = with(power, 1);
        trials.push(Tried::new(&method, error));
        if error <= SAFETY * accuracy {
            return Ok(Choice { method, error, trials });
        }
        if power == FINEST {
            let (tried, last) = (format!("tolerance down to {:.0e}", 10.0_f64.powi(FINEST)), fine.err());
            let mend = "ask for less, or take another scheme";
            return Err(ChoiceError::Unreached { tried, accuracy, last: last.map(Box::new), mend });
        }
        let missing = if error.is_finite() { (error / accuracy).log10().floor() as i32 } else { 1 };
        power = (power - missing.max(1)).max(FINEST);
    }
}
