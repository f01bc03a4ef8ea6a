//! What is written while a run goes on: rows, pictures, checkpoints, progress.

use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use tg_integrate::{Observer, State, StepReport};
use tg_report::ResultsWriter;
use tg_scene::RunSettings;
use tg_trade::Method;

use super::channels::Channels;
use crate::answer::Failure;
use crate::picture::Painter;
use crate::progress::{INTERRUPTED, bar};

/// Time between checkpoints \[s\].
const BETWEEN_CHECKPOINTS: Duration = Duration::from_secs(5);
/// Part of a step by which rounding may shift the time of a row.
const ROUNDING: f64 = 1e-3;

/// What `--resume` goes on with.
#[derive(Deserialize, Serialize)]
pub(super) struct Checkpoint {
    /// How the run is stepped.
    pub(super) method: Method,
    pub(super) state: State,
}

/// Times at which something is due: multiples of an interval.
struct Due {
    interval: f64,
    slack: f64,
    next: f64,
}

impl Due {
    /// From the start, or after the time up to which everything has had its turn.
    fn new(interval: f64, step: f64, after: Option<f64>) -> Self {
        let slack = ROUNDING * step;
        let next = after.map_or(0.0, |t| ((t + slack) / interval).floor() + 1.0);
        Self { interval, slack, next }
    }

    fn is(&mut self, t: f64) -> bool {
        let due = t + self.slack >= self.next * self.interval;
        if due {
            self.next = ((t + self.slack) / self.interval).floor() + 1.0;
        }
        due
    }
}

/// Writes a run as it goes.
pub(super) struct Recording<'p, 's, const D: usize> {
    writer: ResultsWriter,
    channels: Channels<'s, D>,
    painter: &'p Painter<'s, D>,
    rows: Due,
    frames: Due,
    method: Method,
    /// State times up to this one are in the folder already.
    resumed: Option<f64>,
    last_checkpoint: Option<Instant>,
    progress: ProgressBar,
    duration: f64,
    failure: Option<Failure>,
}

impl<'p, 's, const D: usize> Recording<'p, 's, D> {
    pub(super) fn new(
        writer: ResultsWriter,
        channels: Channels<'s, D>,
        painter: &'p Painter<'s, D>,
        settings: &RunSettings,
        (method, resumed): (Method, Option<f64>),
    ) -> Self {
        let step = method.step;
        Self {
            writer,
            channels,
            painter,
            rows: Due::new(settings.every.unwrap_or(step), step, resumed),
            frames: Due::new((1.0 / settings.frame_rate).max(step), step, resumed),
            method,
            resumed,
            last_checkpoint: None,
            progress: bar(1000, "{wide_bar} {percent}% of the motion, {eta} left"),
            duration: settings.duration,
            failure: None,
        }
    }

    fn record(&mut self, state: &State, report: &StepReport) -> Result<(), Failure> {
        if self.resumed.is_some_and(|t| state.t <= t) {
            return Ok(());
        }
        if self.rows.is(state.t) {
            let row = self.channels.row(state, report)?;
            self.writer.row(row)?;
        }
        if self.frames.is(state.t) {
            self.writer.frame(&self.painter.frame_at(state)?)?;
        }
        if self.last_checkpoint.is_none_or(|last| last.elapsed() >= BETWEEN_CHECKPOINTS) {
            self.checkpoint(state)?;
        }
        Ok(())
    }

    fn checkpoint(&mut self, state: &State) -> Result<(), Failure> {
        self.last_checkpoint = Some(Instant::now());
        self.writer.checkpoint(&Checkpoint { method: self.method, state: state.clone() })?;
        Ok(())
    }

    /// Closes the folder; `why` says what interrupted the run.
    pub(super) fn finish(
        mut self,
        state: &State,
        summary: &Value,
        warnings: &[String],
        why: Option<String>,
    ) -> Result<(), Failure> {
        self.progress.finish_and_clear();
        if let Some(failure) = self.failure.take() {
            return Err(failure);
        }
        self.checkpoint(state)?;
        self.writer.finish(|manifest| {
            manifest.summary = summary.clone();
            manifest.warnings = warnings.to_vec();
            manifest.interrupted = why;
        })?;
        Ok(())
    }
}

impl<const D: usize> Observer for Recording<'_, '_, D> {
    /// A failure to write ends the run as Ctrl-C does, and is told at its end.
    fn observe(&mut self, state: &State, report: &StepReport) {
        if self.failure.is_none()
            && let Err(failure) = self.record(state, report)
        {
            self.failure = Some(failure);
            INTERRUPTED.store(true, Relaxed);
        }
        self.progress.set_position((1000.0 * state.t / self.duration) as u64);
    }
}
