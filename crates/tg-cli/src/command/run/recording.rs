//! What is written while a run goes on: rows, pictures, checkpoints, progress.

use std::io::ErrorKind;
use std::sync::atomic::Ordering::Relaxed;
use std::time::{Duration, Instant};

use indicatif::ProgressBar;
use serde_json::{Value, json};
use tg_integrate::{Observer, State, StepReport, Summary};
use tg_report::{ReportError, ResultsWriter};
use tg_scene::RunSettings;
use tg_trade::Method;

use super::channels::Channels;
use super::checkpoint::Checkpoint;
use crate::answer::Failure;
use crate::picture::Painter;
use crate::progress::{INTERRUPTED, bar};

/// Part of a step by which rounding may shift the time of a row.
const ROUNDING: f64 = 1e-3;

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
    /// What the run has counted, with what it had before it was interrupted.
    totals: Summary,
    /// Whether the start has been seen, which is no step.
    begun: bool,
    /// Time on the clock between checkpoints.
    between_checkpoints: Duration,
    /// When the last checkpoint was written.
    last_checkpoint: Option<Instant>,
    /// Time of the last checkpoint \[s\].
    goes_on_from: Option<f64>,
    progress: ProgressBar,
    duration: f64,
    failure: Option<Failure>,
}

impl<'p, 's, const D: usize> Recording<'p, 's, D> {
    pub(super) fn new(
        writer: ResultsWriter,
        channels: Channels<'s, D>,
        painter: &'p Painter<'s, D>,
        (settings, between_checkpoints): (&RunSettings, Duration),
        method: Method,
        earlier: Option<(f64, Summary)>,
    ) -> Self {
        let step = method.step;
        let resumed = earlier.map(|(t, _)| t);
        Self {
            writer,
            channels,
            painter,
            rows: Due::new(settings.every.unwrap_or(step), step, resumed),
            frames: Due::new((1.0 / settings.frame_rate).max(step), step, resumed),
            method,
            resumed,
            totals: earlier.map_or_else(Summary::default, |(_, totals)| totals),
            begun: false,
            between_checkpoints,
            last_checkpoint: None,
            goes_on_from: resumed,
            progress: bar(1000, "{wide_bar} {percent}% of the motion, {eta} left"),
            duration: settings.duration,
            failure: None,
        }
    }

    /// What has been counted; `summary` says how the run ended.
    pub(super) fn totals(&self, summary: Summary) -> Summary {
        Summary { ended: summary.ended, ..self.totals }
    }

    fn record(&mut self, state: &State, report: &StepReport) -> Result<(), Failure> {
        if self.resumed.is_some_and(|t| state.t <= t) {
            return Ok(());
        }
        if self.rows.is(state.t) {
            let row = self.channels.row(state, report)?;
            self.writer.row(row).map_err(|error| self.unwritten(error))?;
        }
        if self.frames.is(state.t) {
            self.writer.frame(&self.painter.frame_at(state)?).map_err(|error| self.unwritten(error))?;
        }
        if self.last_checkpoint.is_none_or(|last| last.elapsed() >= self.between_checkpoints) {
            self.checkpoint(state)?;
        }
        Ok(())
    }

    fn checkpoint(&mut self, state: &State) -> Result<(), Failure> {
        self.last_checkpoint = Some(Instant::now());
        let checkpoint = Checkpoint { method: self.method, state: state.clone(), totals: self.totals };
        self.writer.checkpoint(&checkpoint).map_err(|error| self.unwritten(error))?;
        self.goes_on_from = Some(state.t);
        Ok(())
    }

    /// The system refuses to write in the middle of a run: what was written stays.
    fn unwritten(&self, error: ReportError) -> Failure {
        unwritten(error, self.goes_on_from)
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
        let (duration, from) = (self.duration, self.goes_on_from);
        let finished = self.writer.finish(|manifest| {
            manifest.settings["duration"] = json!(duration);
            manifest.summary = summary.clone();
            manifest.warnings = warnings.to_vec();
            manifest.interrupted = why;
        });
        finished.map_err(|error| unwritten(error, from))
    }
}

/// The failure of an analysis, with what would mend it where the folder is still what it was.
fn unwritten(error: ReportError, from: Option<f64>) -> Failure {
    let room = matches!(&error, ReportError::Io { source, .. } if source.kind() != ErrorKind::NotFound);
    match from.filter(|_| room) {
        Some(t) => {
            Failure::analysis(format!("{error}; what is written stays, --resume goes on from t = {t} s"))
        }
        None => Failure::analysis(error),
    }
}

impl<const D: usize> Observer for Recording<'_, '_, D> {
    /// A failure to write ends the run as Ctrl-C does, and is told at its end.
    fn observe(&mut self, state: &State, report: &StepReport) {
        if self.begun {
            self.totals += *report;
        }
        self.begun = true;
        if self.failure.is_none()
            && let Err(failure) = self.record(state, report)
        {
            self.failure = Some(failure);
            INTERRUPTED.store(true, Relaxed);
        }
        self.progress.set_position((1000.0 * state.t / self.duration) as u64);
    }
}
