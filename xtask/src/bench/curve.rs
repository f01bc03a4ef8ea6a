//! Error against processor time: one curve per scheme and size.

use serde::Serialize;

use super::clock::{median, timed};
use super::scene::{MastRun, Trajectory, error};
use super::scheme::{Dial, SCHEMES, Scheme};
use crate::TaskError;

/// Samples of a trajectory: 2 s, the start included.
pub(crate) const SAMPLES: usize = 201;

/// One measured run of 2 s.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Point {
    pub(crate) tool: String,
    /// Scheme or integrator.
    pub(crate) variant: String,
    /// Step \[s\] or tolerance.
    pub(crate) dial: String,
    /// Processor time of the 2 s \[s\]: the median sample times their number.
    pub(crate) seconds: f64,
    /// Largest distance of a node from the converged trajectory \[m\].
    pub(crate) error: f64,
}

/// A run of the mast in 2 s; `None` if a step fails, as explicit schemes do when it is too large.
fn point(
    run: &MastRun,
    scheme: &Scheme,
    dial: Dial,
    converged: &Trajectory,
) -> Result<Option<Point>, TaskError> {
    let (mut stepper, mut state) = scheme.start(&run.scene, dial)?;
    let (mut samples, mut times) = (vec![run.positions(&state.q)], Vec::new());
    while samples.len() < SAMPLES {
        let (seconds, done) = timed(|| dial.advance(stepper.as_mut(), &mut state));
        if done.is_err() {
            return Ok(None);
        }
        times.push(seconds);
        samples.push(run.positions(&state.q));
    }
    let dial = match dial {
        Dial::Steps(_) => format!("{:.3e} s", dial.step()),
        Dial::Tolerance(tolerance) => format!("tolerance {tolerance:.0e}"),
    };
    Ok(Some(Point {
        tool: "ours".into(),
        variant: scheme.name.into(),
        dial,
        seconds: median(times) * (SAMPLES - 1) as f64,
        error: error(&samples, converged),
    }))
}

/// All schemes' points; a curve ends where a run would take longer than `limit` seconds.
pub(crate) fn curves(run: &MastRun, converged: &Trajectory, limit: f64) -> Result<Vec<Point>, TaskError> {
    let mut points = Vec::new();
    for scheme in &SCHEMES {
        for &dial in scheme.dials {
            let Some(point) = point(run, scheme, dial, converged)? else { continue };
            let seconds = point.seconds;
            points.push(point);
            // The next is about twice as long.
            if 2.0 * seconds > limit {
                break;
            }
        }
    }
    Ok(points)
}

/// The faster of two passes, point by point.
pub(crate) fn fastest(passes: Vec<Vec<Point>>) -> Vec<Point> {
    let mut best: Vec<Point> = Vec::new();
    for point in passes.into_iter().flatten() {
        let same =
            |p: &&mut Point| p.tool == point.tool && p.variant == point.variant && p.dial == point.dial;
        match best.iter_mut().find(same) {
            Some(known) => known.seconds = known.seconds.min(point.seconds),
            None => best.push(point),
        }
    }
    best
}

/// Seconds in which a curve reaches an error, between its points by their slope in logarithms; `None` if it does not.
pub(crate) fn seconds_to(target: f64, curve: &[&Point]) -> Option<f64> {
    let mut best: Option<f64> = None;
    let mut keep = |seconds: f64| best = Some(best.map_or(seconds, |best: f64| best.min(seconds)));
    for point in curve.iter().filter(|point| point.error <= target) {
        keep(point.seconds);
    }
    for pair in curve.windows(2) {
        if let [coarse, fine] = pair
            && coarse.error > target
            && fine.error < target
            && fine.seconds > coarse.seconds
        {
            let part = (target / coarse.error).ln() / (fine.error / coarse.error).ln();
            keep(coarse.seconds * (fine.seconds / coarse.seconds).powf(part));
        }
    }
    best
}
