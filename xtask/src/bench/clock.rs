//! Processor time of this process, and what a measured piece of work costs.

use rustix::time::{ClockId, clock_gettime};

/// Processor time of this process so far \[s\].
pub(crate) fn cpu() -> f64 {
    let now = clock_gettime(ClockId::ProcessCPUTime);
    now.tv_sec as f64 + 1e-9 * now.tv_nsec as f64
}

/// Processor time of `work` \[s\].
pub(crate) fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = cpu();
    let result = work();
    (cpu() - start, result)
}

/// The middle of the values; NaN if there are none.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Median time of one call \[s\] over `budget` seconds, after a first call that warms up, and is taken if it is longer.
pub(crate) fn repeated<E>(budget: f64, mut work: impl FnMut() -> Result<(), E>) -> Result<f64, E> {
    /// Calls after which the budget counts.
    const LEAST: usize = 3;
    /// Calls that say enough.
    const MOST: usize = 1000;
    let (first, done) = timed(&mut work);
    done?;
    if first > budget {
        return Ok(first);
    }
    let (start, mut times) = (cpu(), Vec::new());
    while times.len() < LEAST || (times.len() < MOST && cpu() - start < budget) {
        let (seconds, done) = timed(&mut work);
        done?;
        times.push(seconds);
    }
    Ok(median(times))
}
