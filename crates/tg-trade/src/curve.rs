//! Error against processor time of one scheme.

use serde::Serialize;
use tg_scene::Scheme;

use crate::error::TrialError;
use crate::errors::{Errors, Quantity};
use crate::method::Method;
use crate::motion::Motion;
use crate::reference::Reference;
use crate::subject::{LOOKS, Subject};

/// Powers of ten of the tolerances of a curve.
const TOLERANCES: std::ops::RangeInclusive<i32> = 2..=12;
/// Doublings of the number of steps.
const DOUBLINGS: u32 = 20;
/// Runs of which the fastest counts, where they are short.
const REPEATS: usize = 3;
/// Seconds from which a run is not repeated.
const LONG: f64 = 0.2;
/// Errors below so many times the reference's uncertainty say nothing.
pub(crate) const TOLD: f64 = 3.0;

/// What measuring may cost.
#[derive(Clone, Copy, Debug)]
pub struct Budget {
    /// Processor time of one run \[s\].
    pub run: f64,
}

/// A scheme at finer and finer steps or tolerances.
#[derive(Clone, Debug, Serialize)]
pub struct Curve {
    /// The scheme.
    pub scheme: Scheme,
    /// From coarse to fine.
    pub rungs: Vec<Rung>,
    /// Why there is no rung, or no finer one, if a run failed.
    pub failure: Option<String>,
}

/// One setting.
#[derive(Clone, Debug, Serialize)]
pub struct Rung {
    /// The method.
    pub method: Method,
    /// Its errors against the reference.
    pub errors: Errors,
    /// Processor time \[s\].
    pub seconds: f64,
    /// Steps, or calls under error control.
    pub steps: u64,
    /// Newton iterations, or evaluations of the accelerations.
    pub iterations: u64,
}

impl Curve {
    /// Runs a scheme at finer and finer settings, until its error is lost in the reference's uncertainty or a run exceeds the
    /// budget.
    pub fn measure<const D: usize>(
        subject: &Subject<'_, D>,
        reference: &Reference,
        scheme: Scheme,
        spectral_radius: f64,
        budget: Budget,
    ) -> Self {
        let subject = subject.limited(budget.run);
        let look = subject.end() / f64::from(LOOKS);
        let with = |step, tolerance| Method { scheme, step, tolerance, spectral_radius };
        let ladder: Vec<Method> = if scheme.controls_error() {
            TOLERANCES.map(|power| with(look, Some(10.0_f64.powi(-power)))).collect()
        } else {
            (0..DOUBLINGS).map(|k| with(look / f64::from(1_u32 << k), None)).collect()
        };
        let mut curve = Self { scheme, rungs: Vec::new(), failure: None };
        for method in ladder {
            match fastest(&subject, &method) {
                Ok(motion) => {
                    let errors = reference.errors(&motion);
                    let told =
                        errors[Quantity::Positions] > TOLD * reference.uncertainty[Quantity::Positions];
                    let (seconds, summary) = (motion.seconds, motion.summary);
                    if errors[Quantity::Positions].is_finite() {
                        curve.failure = None;
                        let (steps, iterations) = (summary.steps, summary.iterations);
                        curve.rungs.push(Rung { method, errors, seconds, steps, iterations });
                    }
                    if !told || 2.0 * seconds > budget.run {
                        break;
                    }
                }
                Err(TrialError::TooLong { .. }) => break,
                // A long step may fail where a shorter one does not.
                Err(error) => curve.failure = Some(error.to_string()),
            }
        }
        curve
    }

    /// Processor times \[s\] and a quantity's errors, from coarse to fine.
    pub fn points(&self, quantity: Quantity) -> (Vec<f64>, Vec<f64>) {
        self.rungs.iter().map(|rung| (rung.seconds, rung.errors[quantity])).unzip()
    }
}

/// The motion, of the fastest of some runs.
fn fastest<const D: usize>(subject: &Subject<'_, D>, method: &Method) -> Result<Motion, TrialError> {
    let mut best = subject.motion(method)?;
    for _ in 1..REPEATS {
        if best.seconds > LONG {
            break;
        }
        let again = subject.motion(method)?;
        best.seconds = best.seconds.min(again.seconds);
    }
    Ok(best)
}

/// The setting with the least processor time of those that are exact to `error`.
pub fn cheapest(curves: &[Curve], quantity: Quantity, error: f64) -> Option<&Rung> {
    let rungs = curves.iter().flat_map(|curve| &curve.rungs);
    let exact = rungs.filter(|rung| rung.errors[quantity] <= error);
    exact.min_by(|a, b| a.seconds.total_cmp(&b.seconds))
}
