//! What is simulated again and again: a model, its start and its end.

use std::cell::Cell;
use std::sync::atomic::AtomicBool;

use cpu_time::ThreadTime;
use tg_integrate::{Ended, Run, State, StepReport, Stepper};
use tg_model::Model;

use crate::error::TrialError;
use crate::method::Method;
use crate::motion::Motion;

/// Times at which motions are compared, besides the start; errors grow, and the end is one of them.
pub const LOOKS: u32 = 128;

/// What is simulated: a model from its initial coordinates to an end.
#[derive(Clone, Copy)]
pub struct Subject<'s, const D: usize> {
    model: &'s Model<D>,
    velocities: &'s [f64],
    end: f64,
    cancel: Option<&'s AtomicBool>,
    limit: f64,
}

impl<'s, const D: usize> Subject<'s, D> {
    /// A model, its full velocities at t = 0 \[m/s\] and the end \[s\].
    pub fn new(model: &'s Model<D>, velocities: &'s [f64], end: f64) -> Self {
        Self { model, velocities, end, cancel: None, limit: f64::INFINITY }
    }

    /// The same; motions end, without a result, once the flag is true.
    #[must_use]
    pub fn cancel_on(self, flag: &'s AtomicBool) -> Self {
        Self { cancel: Some(flag), ..self }
    }

    /// The same; motions end, without a result, after some seconds of processor time.
    #[must_use]
    pub fn limited(self, seconds: f64) -> Self {
        Self { limit: seconds, ..self }
    }

    /// The model.
    pub fn model(&self) -> &'s Model<D> {
        self.model
    }

    /// The end \[s\].
    pub fn end(&self) -> f64 {
        self.end
    }

    /// Looks between which whole steps fit, if the motion has at least [`LOOKS`] of them.
    fn stride(&self, step: f64) -> u64 {
        ((self.end / step) / f64::from(LOOKS) * (1.0 + 1e-9)).max(1.0) as u64
    }

    /// The motion by a method.
    ///
    /// # Errors
    /// See [`TrialError`].
    pub fn motion(&self, method: &Method) -> Result<Motion, TrialError> {
        let mut stepper = method.stepper(self.model)?;
        self.motion_by(stepper.as_mut(), method.step)
    }

    /// The motion by a stepper, with a step \[s\].
    ///
    /// # Errors
    /// See [`TrialError`].
    pub fn motion_by(&self, stepper: &mut dyn Stepper, step: f64) -> Result<Motion, TrialError> {
        self.motion_every(stepper, step, self.stride(step))
    }

    /// The motion by a stepper, looked at every so many steps, and at the end.
    pub(crate) fn motion_every(
        &self,
        stepper: &mut dyn Stepper,
        step: f64,
        stride: u64,
    ) -> Result<Motion, TrialError> {
        let model = self.model;
        let start = ThreadTime::now();
        let mut state = stepper.start(0.0, &model.initial_coordinates(), self.velocities)?;
        let mut motion = Motion { dimension: D, ..Motion::default() };
        let (mut count, looking) = (0_u64, Cell::new(0.0));
        let last = self.end * (1.0 - 1e-9);
        let mut look = |state: &State, _: &StepReport| {
            if count.is_multiple_of(stride) || state.t >= last {
                let since = ThreadTime::now();
                self.look(state, &mut motion);
                looking.set(looking.get() + since.elapsed().as_secs_f64());
            }
            count += 1;
        };
        let mut steps = 0_u32;
        let mut run = Run::new(step, self.end).observe(&mut look).stop_when(|_| {
            steps = steps.wrapping_add(1);
            // A look at the clock costs as much as a small step.
            steps.is_multiple_of(64) && start.elapsed().as_secs_f64() > self.limit
        });
        if let Some(flag) = self.cancel {
            run = run.cancel_on(flag);
        }
        let summary = run.go(stepper, &mut state)?;
        match summary.ended {
            Ended::AtEnd => {}
            Ended::Stopped => return Err(TrialError::TooLong { limit: self.limit }),
            Ended::Cancelled => return Err(TrialError::Cancelled),
        }
        motion.seconds = start.elapsed().as_secs_f64() - looking.get();
        motion.summary = summary;
        Ok(motion)
    }

    /// What is compared, at one time.
    fn look(&self, state: &State, motion: &mut Motion) {
        let (model, State { t, q, v, .. }) = (self.model, state);
        motion.times.push(*t);
        for member in model.members() {
            let coord_type = model.member(member).coord_type();
            let nodes = model.member_nodes(member, q);
            let points = nodes.iter().enumerate().filter(|(k, _)| coord_type.is_point(*k));
            motion.positions.extend(points.flat_map(|(_, point)| point.iter().copied()));
        }
        let inputs = model.inputs_at(*t);
        motion.tensions.extend(model.cables().map(|cable| model.cable(cable, q, v, &inputs).tension));
        motion.energy.push(model.energy(q, v, &inputs).total());
    }
}
