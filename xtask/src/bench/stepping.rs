//! What one step costs.

use allocation_counter::measure;

use super::clock::{cpu, median, timed};
use super::scene::Scene;
use super::scheme::{Dial, SAMPLE, Scheme};
use crate::TaskError;

/// Cost of the steps of 1 ms from a structure's start.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cost {
    /// Processor time of a step \[µs\]: the median of chunks of ten.
    pub(crate) micros: f64,
    /// Newton iterations of a step.
    pub(crate) iterations: f64,
    /// Allocations of all steps but the first ten.
    pub(crate) allocations: u64,
}

/// Steps for about `budget` seconds, at least five chunks and at most 2 s of motion.
pub(crate) fn cost(scene: &Scene, scheme: &Scheme, budget: f64) -> Result<Cost, TaskError> {
    let (mut stepper, mut state) = scheme.start(scene, Dial::PAPER)?;
    let (mut times, mut iterations, mut allocations) = (Vec::new(), 0_u64, 0);
    let start = cpu();
    while times.len() < 5 || (times.len() < 200 && cpu() - start < budget) {
        let (mut seconds, mut done) = (0.0, Ok(0));
        let counted =
            measure(|| (seconds, done) = timed(|| Dial::PAPER.advance(stepper.as_mut(), &mut state)));
        iterations += done?;
        allocations += if times.is_empty() { 0 } else { counted.count_total };
        times.push(seconds);
    }
    let chunk = f64::from(Dial::PAPER.calls());
    let steps = times.len() as u64 * u64::from(Dial::PAPER.calls());
    Ok(Cost {
        micros: 1e6 * median(times) / chunk,
        iterations: iterations as f64 / steps as f64,
        allocations,
    })
}

/// Processor time of the first `samples` of 10 ms from the start \[s\], a sample: the median over runs for about `budget`
/// seconds.
pub(crate) fn first(scene: &Scene, scheme: &Scheme, samples: usize, budget: f64) -> Result<f64, TaskError> {
    let (start, mut times) = (cpu(), Vec::new());
    while times.is_empty() || cpu() - start < budget {
        let (mut stepper, mut state) = scheme.start(scene, Dial::PAPER)?;
        for _ in 0..samples {
            let (seconds, done) = timed(|| Dial::PAPER.advance(stepper.as_mut(), &mut state));
            done?;
            times.push(seconds);
        }
    }
    Ok(median(times))
}

/// Processor time of a whole run of `duration` seconds at 1 ms \[s\].
pub(crate) fn whole(scene: &Scene, scheme: &Scheme, duration: f64) -> Result<f64, TaskError> {
    let (mut stepper, mut state) = scheme.start(scene, Dial::PAPER)?;
    let samples = (duration / SAMPLE).round() as u64;
    let (seconds, done) =
        timed(|| (0..samples).try_for_each(|_| Dial::PAPER.advance(stepper.as_mut(), &mut state).map(drop)));
    done?;
    Ok(seconds)
}
