//! The driver: steps to an end time, shows every accepted step to observers, and stops in good order.

use std::ops::AddAssign;
use std::sync::atomic::{AtomicBool, Ordering};

use thiserror::Error;

use crate::error::{StepError, StepFailure};
use crate::state::State;
use crate::stepper::{StepReport, Stepper};

/// Sees each accepted step, and the start with an empty report.
pub trait Observer {
    /// Called once at the start of a run and after each accepted step.
    fn observe(&mut self, state: &State, report: &StepReport);
}

impl<F: FnMut(&State, &StepReport)> Observer for F {
    fn observe(&mut self, state: &State, report: &StepReport) {
        self(state, report);
    }
}

/// Part of a step by which the remaining time may miss a whole step and still count as one (or as none): rounding
/// of the accumulated time.
const WHOLE: f64 = 1e-6;

/// A run to be made: step, end, and who watches.
///
/// ```
/// # use tg_integrate::{NewtonOptions, Run, Stepper, Symplectic};
/// # use tg_model::{Joining, ModelBuilder};
/// # let mut b = ModelBuilder::<2>::new();
/// # b.gravity([0.0, -9.81])?;
/// # let pivot = b.anchor("pivot", [0.0, 0.0])?;
/// # let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0])?;
/// # b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
/// # let model = b.build()?;
/// let mut stepper = Symplectic::new(&model, NewtonOptions::default())?;
/// let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
/// let mut lowest = 0.0_f64;
/// let tip = model.form(bar.node(1))?;
/// let mut watch = |state: &tg_integrate::State, _: &_| lowest = lowest.min(tip.eval(&state.q).y);
/// Run::new(1e-3, 1.0).observe(&mut watch).go(&mut stepper, &mut state)?;
/// assert!(lowest < -0.99);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Run<'a> {
    step: f64,
    end: f64,
    observers: Vec<&'a mut dyn Observer>,
    stop: Option<StopCondition<'a>>,
    cancel: Option<&'a AtomicBool>,
}

type StopCondition<'a> = Box<dyn FnMut(&State) -> bool + 'a>;

/// How a run ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Ended {
    /// The end time was reached.
    #[default]
    AtEnd,
    /// The stop condition held after a step.
    Stopped,
    /// It was cancelled between two steps.
    Cancelled,
}

/// Totals of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// How it ended.
    pub ended: Ended,
    /// Accepted steps.
    pub steps: u64,
    /// Newton iterations; evaluations of the accelerations in explicit schemes.
    pub iterations: u64,
    /// Steps that had to be divided.
    pub divided: u64,
    /// Substeps that needed a frozen active set.
    pub frozen: u64,
    /// Cables held against their law.
    pub forced: u64,
    /// Systems solved by the pivoting factorisation.
    pub fallbacks: u64,
    /// Substeps that explicit schemes made again.
    pub rejected: u64,
    /// Largest scaled residual left by a step.
    pub residual: f64,
}

/// A run that failed; the state is that of the last accepted step, observers keep what they saw.
#[derive(Clone, Debug, Error)]
#[error("after {} steps: {failure}", summary.steps)]
pub struct RunError {
    /// The failed step.
    pub failure: Box<StepError>,
    /// Totals up to it.
    pub summary: Summary,
}

impl<'a> Run<'a> {
    /// A run with constant `step` \[s\] until time `end` \[s\]; the last step may be shorter.
    pub fn new(step: f64, end: f64) -> Self {
        Self { step, end, observers: Vec::new(), stop: None, cancel: None }
    }

    /// Adds an observer.
    #[must_use]
    pub fn observe(mut self, observer: &'a mut dyn Observer) -> Self {
        self.observers.push(observer);
        self
    }

    /// Stops after the first step whose state satisfies the predicate.
    #[must_use]
    pub fn stop_when(mut self, predicate: impl FnMut(&State) -> bool + 'a) -> Self {
        self.stop = Some(Box::new(predicate));
        self
    }

    /// Stops between two steps once the flag is true.
    #[must_use]
    pub fn cancel_on(mut self, flag: &'a AtomicBool) -> Self {
        self.cancel = Some(flag);
        self
    }

    /// Runs from `state`, which follows the accepted steps.
    ///
    /// # Errors
    /// The step is not positive and finite, the end is NaN, or a step fails; `state` is then that of the last accepted
    /// step.
    pub fn go(mut self, stepper: &mut dyn Stepper, state: &mut State) -> Result<Summary, RunError> {
        let mut summary = Summary::default();
        self.check(state.t)?;
        self.show(state, &StepReport::default());
        loop {
            let left = (self.end - state.t) - state.t_rest;
            if left <= WHOLE * self.step {
                summary.ended = Ended::AtEnd;
                return Ok(summary);
            }
            if self.cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                summary.ended = Ended::Cancelled;
                return Ok(summary);
            }
            let h = if left < (1.0 - WHOLE) * self.step { left } else { self.step };
            match stepper.step(state, h) {
                Ok(report) => {
                    summary += report;
                    self.show(state, &report);
                }
                Err(failure) => return Err(RunError { failure: Box::new(failure), summary }),
            }
            if self.stop.as_mut().is_some_and(|stop| stop(state)) {
                summary.ended = Ended::Stopped;
                return Ok(summary);
            }
        }
    }

    /// Bad numbers would end the run in silence (an infinite step) or never (an end that is NaN).
    fn check(&self, t: f64) -> Result<(), RunError> {
        let failure = if !(self.step.is_finite() && self.step > 0.0) {
            StepFailure::BadStep
        } else if self.end.is_nan() {
            StepFailure::BadEnd { end: self.end }
        } else {
            return Ok(());
        };
        let failure = Box::new(StepError { t, h: self.step, residual: f64::NAN, failure });
        Err(RunError { failure, summary: Summary::default() })
    }

    fn show(&mut self, state: &State, report: &StepReport) {
        for observer in &mut self.observers {
            observer.observe(state, report);
        }
    }
}

impl AddAssign<StepReport> for Summary {
    fn add_assign(&mut self, report: StepReport) {
        self.steps += 1;
        self.iterations += u64::from(report.iterations);
        self.divided += u64::from(report.substeps > 1);
        self.frozen += u64::from(report.frozen);
        self.forced += u64::from(report.forced);
        self.fallbacks += u64::from(report.fallbacks);
        self.rejected += u64::from(report.rejected);
        self.residual = self.residual.max(report.residual);
    }
}
