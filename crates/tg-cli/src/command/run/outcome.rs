//! What a run counts, and what makes its result doubtful.

use serde_json::{Value, json};
use tg_integrate::{Ended, RunError, State, Summary, Turning};
use tg_trade::Method;

/// Angle by which the acceleration may turn in a step before the result is doubtful \[rad\].
const RESOLVED: f64 = 1.0;

/// The totals of a run, and why it did not come to its end.
pub(crate) fn ended(outcome: Result<Summary, RunError>) -> (Summary, Option<String>) {
    match outcome {
        Ok(summary) if summary.ended == Ended::Cancelled => (summary, Some("stopped by Ctrl-C".to_string())),
        Ok(summary) => (summary, None),
        Err(error) => (error.summary, Some(error.to_string())),
    }
}

/// The totals of a run for its document.
pub(super) fn counts(summary: &Summary, state: &State) -> Value {
    json!({
        "end": state.t,
        "steps": summary.steps,
        "iterations": summary.iterations,
        "divided_steps": summary.divided,
        "rejected_substeps": summary.rejected,
        "frozen_substeps": summary.frozen,
        "forced_cables": summary.forced,
        "fallbacks": summary.fallbacks,
        "largest_residual": summary.residual,
    })
}

/// What makes the result doubtful.
pub(crate) fn doubts(summary: &Summary, turning: &Turning, method: &Method) -> Vec<String> {
    let mut doubts = Vec::new();
    // Under error control steps are divided as a rule, and a switch that is passed over is all that can go wrong.
    let controlled = method.tolerance.is_some();
    if summary.forced > 0 && controlled {
        doubts.push(format!(
            "{} times a cable went slack or taut too often to be followed: the error may be larger than the tolerance; \
             the symplectic scheme with a small step shows whether",
            summary.forced
        ));
    } else if summary.forced > 0 {
        doubts.push(format!(
            "{} times a cable was held taut or slack against its law, where a damped cable re-tensions; a smaller step does \
             so less often",
            summary.forced
        ));
    }
    if summary.divided > summary.steps / 10 && !controlled {
        doubts.push(format!(
            "{} of {} steps had to be divided; choose a smaller step",
            summary.divided, summary.steps
        ));
    }
    if turning.angle() > RESOLVED && !controlled {
        doubts.push(format!(
            "the acceleration turns by {:.1} rad in a step: the steps do not resolve the motion; choose a step ten times \
             smaller, or --accuracy",
            turning.angle()
        ));
    }
    doubts
}
