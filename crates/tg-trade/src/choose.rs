//! A step or a tolerance for an accuracy.
//!
//! Trial runs go over the whole motion, since errors grow. Each is compared with one of half the step (and a tenth of the
//! tolerance), which gives its error; what is chosen has been tried itself, so that the run to be made has the error that is
//! reported. How honest that is: docs/accuracy-and-speed.md, "The estimated error".

mod step;
mod tolerance;

use serde::Serialize;
use tg_model::Model;

use crate::error::{ChoiceError, TrialError};
use crate::errors::{Errors, Quantity};
use crate::method::Method;
use crate::motion::Motion;
use crate::subject::Subject;

/// Rounding of positions per largest coordinate: the most that schemes at rest were seen to leave is a third of it.
const ROUNDING: f64 = 256.0 * f64::EPSILON;

/// A method that reaches an accuracy.
#[derive(Clone, Debug, Serialize)]
pub struct Choice {
    /// The method.
    pub method: Method,
    /// Estimated error of its positions \[m\].
    pub error: f64,
    /// What was tried, in turn; the last one is the method's own.
    pub trials: Vec<Tried>,
}

/// One trial.
#[derive(Clone, Debug, Serialize)]
pub struct Tried {
    /// Longest step \[s\].
    pub step: f64,
    /// Relative tolerance under error control.
    pub tolerance: Option<f64>,
    /// Estimated error of the positions \[m\]; none where a run failed.
    pub estimated_error: Option<f64>,
}

/// Chooses the step of a scheme, or the tolerance if it can control its error, so that positions are exact to `accuracy` \[m\].
/// Under error control steps are at most as long as the method's.
///
/// # Errors
/// The accuracy is below rounding, nothing that was tried reaches it, or the trials were cancelled.
pub fn choose<const D: usize>(
    subject: &Subject<'_, D>,
    accuracy: f64,
    method: &Method,
) -> Result<Choice, ChoiceError> {
    if !(accuracy.is_finite() && accuracy > 0.0) {
        return Err(ChoiceError::Accuracy(accuracy));
    }
    let largest =
        subject.model().initial_coordinates().iter().fold(0.0_f64, |largest, q| largest.max(q.abs()));
    let rounding = ROUNDING * largest;
    if accuracy < rounding {
        return Err(ChoiceError::BelowRounding { accuracy, rounding });
    }
    if method.scheme.controls_error() {
        tolerance::choose(subject, accuracy, method)
    } else {
        step::choose(subject, accuracy, method)
    }
}

/// A trial run: a motion or why there is none.
type Trial = Result<Motion, TrialError>;

/// Runs a method, looked at every `stride` steps.
fn trial<const D: usize>(
    subject: &Subject<'_, D>,
    method: &Method,
    stride: u64,
) -> Result<Trial, ChoiceError> {
    let model: &Model<D> = subject.model();
    let run = || {
        let mut stepper = method.stepper(model)?;
        subject.motion_every(stepper.as_mut(), method.step, stride)
    };
    match run() {
        // Ctrl-C ends the search, not only the trial.
        Err(TrialError::Cancelled) => Err(ChoiceError::Cancelled),
        Err(error @ TrialError::TooLong { .. }) => Err(ChoiceError::TooLong(error)),
        trial => Ok(trial),
    }
}

/// Distance of the positions of two trials \[m\]; infinite where one failed.
fn apart(a: &Trial, b: &Trial) -> f64 {
    let errors = a.as_ref().ok().zip(b.as_ref().ok()).map(|(a, b)| a.distance(b));
    errors.unwrap_or(Errors::all(f64::INFINITY))[Quantity::Positions]
}

impl Tried {
    fn new(method: &Method, error: f64) -> Self {
        let estimated_error = error.is_finite().then_some(error);
        Self { step: method.step, tolerance: method.tolerance, estimated_error }
    }
}
