//! Trial runs: positions of one method to be compared with another's.

use std::sync::atomic::Ordering::Relaxed;

use tg_integrate::{Run as Integration, State, StepReport};
use tg_scene::Structure;

use super::method::Method;
use crate::answer::Failure;
use crate::progress::INTERRUPTED;

/// Times at which positions are compared; errors grow, and the end is one of them.
pub(super) const LOOKS: f64 = 16.0;

/// Positions of all basic points at the times at which runs are compared, or why the run fails.
pub(super) fn trial<const D: usize>(
    structure: &Structure<D>,
    method: &Method,
    end: f64,
) -> Result<Vec<f64>, String> {
    let model = &structure.model;
    let mut stepper = method.stepper(model).map_err(|error| error.to_string())?;
    let start = stepper.start(0.0, &model.initial_coordinates(), &structure.velocities);
    let mut state = start.map_err(|error| error.to_string())?;
    let stride = ((end / method.step / LOOKS).round() as u64).max(1);
    let (mut seen, mut count) = (Vec::new(), 0_u64);
    let mut look = |state: &State, _: &StepReport| {
        if count.is_multiple_of(stride) {
            for member in model.members() {
                let coord_type = model.member(member).coord_type();
                let nodes = model.member_nodes(member, &state.q);
                let points = nodes.iter().enumerate().filter(|(k, _)| coord_type.is_point(*k));
                seen.extend(points.flat_map(|(_, point)| point.iter().copied()));
            }
        }
        count += 1;
    };
    let run = Integration::new(method.step, end).observe(&mut look).cancel_on(&INTERRUPTED);
    run.go(stepper.as_mut(), &mut state).map_err(|error| error.to_string())?;
    Ok(seen)
}

/// Largest difference of two runs \[m\]; infinite where one failed or is not a number.
pub(super) fn distance(a: &Result<Vec<f64>, String>, b: &Result<Vec<f64>, String>) -> f64 {
    let (Ok(a), Ok(b)) = (a, b) else { return f64::INFINITY };
    if a.len() != b.len() {
        return f64::INFINITY;
    }
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, |largest: f64, apart| {
        // `max` would pass over what is not a number.
        if apart.is_nan() { f64::INFINITY } else { largest.max(apart) }
    })
}

/// Ctrl-C ends the search, not only the trial.
pub(super) fn go_on() -> Result<(), Failure> {
    if INTERRUPTED.load(Relaxed) {
        return Err(Failure::analysis("stopped by Ctrl-C before a step was chosen"));
    }
    Ok(())
}

/// No trial came near enough: what was tried, why the last one failed if it did, and what would mend it.
pub(super) fn unreached(tried: &str, accuracy: f64, last: Result<Vec<f64>, String>, mend: &str) -> Failure {
    let why = last.err().map_or_else(String::new, |why| format!(": {why}"));
    Failure::analysis(format!("no {tried} reaches an error of {accuracy} m{why}; {mend}"))
}
