//! A step for an accuracy.
//!
//! Trial runs over the whole motion, since errors grow, with steps h and h/2: the schemes are of second order, so that the
//! positions of the first are off by about 4/3 of their difference, and an error ε wants the step h √(ε / error).

use std::sync::atomic::Ordering::Relaxed;

use serde_json::{Value, json};
use tg_integrate::{Run as Integration, State, StepReport};
use tg_scene::{RunSettings, Structure};

use super::stepper;
use crate::answer::Failure;
use crate::progress::INTERRUPTED;

/// Steps of the first trial.
const FIRST: f64 = 64.0;
/// Times at which positions are compared.
const LOOKS: f64 = 16.0;
/// Steps that are not tried any more.
const FINEST: f64 = 2e6;
/// The estimate is one: the step stays on the safe side.
const SAFETY: f64 = 0.8;

/// The step, and the trials that it was chosen by.
pub(super) fn step<const D: usize>(
    structure: &Structure<D>,
    settings: &RunSettings,
    accuracy: f64,
) -> Result<(f64, Value), Failure> {
    let end = settings.duration;
    let mut trials = Vec::new();
    let mut steps = FIRST;
    let mut coarse = trial(structure, settings, end, steps);
    while steps < FINEST {
        let fine = trial(structure, settings, end, 2.0 * steps);
        if INTERRUPTED.load(Relaxed) {
            return Err(Failure::analysis("stopped by Ctrl-C before a step was chosen"));
        }
        let error = match (&coarse, &fine) {
            (Some(coarse), Some(fine)) => 4.0 / 3.0 * distance(coarse, fine),
            _ => f64::INFINITY,
        };
        trials.push(json!({ "step": end / steps, "estimated_error": error.is_finite().then_some(error) }));
        if error <= accuracy {
            let factor = SAFETY * (accuracy / error.max(f64::MIN_POSITIVE)).sqrt();
            // Beyond twice what was tried the order of the scheme is no longer seen.
            let step = end / steps * factor.clamp(SAFETY, 2.0);
            let whole = settings.duration / (settings.duration / step).ceil();
            let evidence = json!({ "trials": trials });
            return Ok((whole, evidence));
        }
        let wanted = if error.is_finite() { (error / accuracy).sqrt() } else { 2.0 };
        if wanted <= 4.0 || !error.is_finite() {
            (steps, coarse) = (2.0 * steps, fine);
        } else {
            steps *= wanted.log2().floor().exp2();
            coarse = trial(structure, settings, end, steps);
        }
    }
    let message =
        format!("no step down to {:.1e} s reaches an error of {accuracy} m; ask for less", end / FINEST);
    Err(Failure::analysis(message))
}

/// Positions of all basic points at the times at which runs are compared; none if the run fails.
fn trial<const D: usize>(
    structure: &Structure<D>,
    settings: &RunSettings,
    end: f64,
    steps: f64,
) -> Option<Vec<f64>> {
    let model = &structure.model;
    let mut stepper = stepper(structure, settings).ok()?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &structure.velocities).ok()?;
    let (mut seen, mut count, stride) = (Vec::new(), 0_u64, (steps / LOOKS) as u64);
    let mut look = |state: &State, _: &StepReport| {
        if count % stride == 0 {
            for member in model.members() {
                let coord_type = model.member(member).coord_type();
                let nodes = model.member_nodes(member, &state.q);
                let points = nodes.iter().enumerate().filter(|(k, _)| coord_type.is_point(*k));
                seen.extend(points.flat_map(|(_, point)| point.iter().copied()));
            }
        }
        count += 1;
    };
    Integration::new(end / steps, end)
        .observe(&mut look)
        .cancel_on(&INTERRUPTED)
        .go(stepper.as_mut(), &mut state)
        .ok()?;
    Some(seen)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let apart = a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if a.len() == b.len() { apart } else { f64::INFINITY }
}
