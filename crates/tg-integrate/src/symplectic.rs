//! The modified symplectic scheme, Algorithm 1 of the framework paper.
//!
//! ```text
//! Ḿ Δ - h p_k - h²/2 F(q_m, q̇_m, t_m) - A(q_k)ᵀ ν = 0        (53a), (54)    Δ = q_{k+1} - q_k,  ν = h²/2 λ
//! Φ(q_{k+1}) = 0                                              (53c)
//! p_{k+1} = Ḿ Δ/h + h/2 F + A(q_{k+1})ᵀ ν/h                   (53b)
//!         = p_k + h F + (A(q_k) + A(q_{k+1}))ᵀ ν/h            (53b) with Δ of (54)
//! Jac = [M + h²/4 (-∂F/∂q) + h/2 (-∂F/∂q̇), -A(q_k)ᵀ; A(q_{k+1}), 0]         (55)
//! q_m = q_k + Δ/2,  q̇_m = Δ/h,  t_m = t_k + h/2                              (49)
//! ```
//! Ḿ has the free rows of M and all columns, so moving supports enter through Δ alone. Measured additions:
//!
//! - The momentum is projected on A M⁻¹ p = 0 at the end of each step. Its normal part would flip sign every step and
//!   never decay: invisible in q, it pollutes q̇, λ and the energy. The state keeps the projected velocity;
//!   p_k = Ḿ q̇_k. (53b)'s last term is normal, and the projection would remove the forces' part along it as well, but
//!   only to the rounding of that part, which at rest is far above q̇.
//! - Newton starts from Δ = h q̇_k + (h q̇_k - Δ_last), the last step's acceleration once more, and from multipliers that go on
//!   as they did, where steps resolve the motion. On the guyed mast of 32 stages that saves half of the factorisations.
//! - The factors of (55) are kept over iterations and steps while they serve: new ones are taken where the residual falls by
//!   less than a factor of ten, and after a step of more than five iterations. A step of that mast then takes four or five
//!   iterations, one in eight has new factors, and the time is less than a third of that of full Newton steps. The last
//!   correction is applied without another look at its residual.
//! - The momentum is taken from p_k and the impulses. From Δ/h, what kept factors leave of (54), always with one sign, adds
//!   up: 6e-14 of p a step moved a pendulum by 2e-7 m after 131 072 steps, of an error of 2e-8 m of the scheme.
//! - The unknown is Δ, not q_{k+1}: no digits cancel at small steps.
//! - Residuals are compared with their own terms (dynamic rows) and with the member's size (constraints), so that the
//!   tolerance means the same at every h. A correction below the resolution of q ends the iteration as well.
//! - Law (30) with damping jumps at re-tensioning, and a step may have no solution. After a few iterations the active
//!   set is frozen; a result that contradicts it is not taken, but the step is repeated in 2, 4, 8 … substeps; only
//!   the smallest substep is accepted against a cable's law, and the report counts it.
//!
//! The midpoint rule does not damp what it cannot resolve: a damper with h η/2 far above the mass that it acts on
//! reverses the closing velocity instead of stopping it (measured: factor -0.88 at a ratio of 15). Choose h smaller.

mod equations;
mod newton;

use tg_model::{Mechanics, Projector};

use crate::check;
use crate::error::{StartError, StepError};
use crate::kept::Kept;
use crate::previous::Previous;
use crate::state::State;
use crate::stepper::{NewtonOptions, StepReport, Stepper};
use crate::supports::Supports;
use crate::system::{Failure, NewtonSystem, Worst};

/// The modified symplectic scheme: second order, no numerical dissipation, one step of history.
pub struct Symplectic<'m> {
    options: NewtonOptions,
    system: NewtonSystem<'m>,
    projector: Projector<'m>,
    supports: Supports,
    work: Work,
    /// Where the factors that the system holds were taken.
    factored: Factored,
    kept: Kept,
    previous: Previous,
    /// Where substeps are tried.
    trial: State,
    /// Whether p_k is the projected momentum Ḿ q̇_k, or carried in the state's memory as printed.
    project: bool,
    /// Whether steps may go back in time, as within a composition.
    either_way: bool,
}

/// Vectors of one step.
struct Work {
    delta: Vec<f64>,
    nu: Vec<f64>,
    p: Vec<f64>,
    q_mid: Vec<f64>,
    v_mid: Vec<f64>,
    q_end: Vec<f64>,
    v_end: Vec<f64>,
    force: Vec<f64>,
    /// M x over the full coordinates.
    inertial: Vec<f64>,
    inputs: Vec<f64>,
    taut: Vec<bool>,
    taut_by_law: Vec<bool>,
}

/// A step and the displacement in it at which the Newton matrix was factored.
#[derive(Default)]
struct Factored {
    t: f64,
    /// Zero for factors that serve one step only.
    h: f64,
    /// The residual at which it stood, zero if it did not.
    rounding: f64,
    q: Vec<f64>,
    delta: Vec<f64>,
}

/// A converged substep.
struct Converged {
    iterations: u32,
    residual: f64,
    frozen: bool,
    forced: u32,
}

/// A substep that failed.
struct Failed {
    failure: Failure,
    iterations: u32,
    worst: Worst,
}

impl<'m> Symplectic<'m> {
    /// A stepper for a system, with its workspace.
    ///
    /// # Errors
    /// An option is out of range, or the pattern of the system cannot be analysed.
    pub fn new(mechanics: &'m dyn Mechanics, options: NewtonOptions) -> Result<Self, StartError> {
        options.check()?;
        let sizes = mechanics.sizes();
        let (n, m) = (sizes.coordinates, sizes.constraints);
        let projector = Projector::new(mechanics)?;
        let system = NewtonSystem::new(mechanics, false)?;
        let zeros = || vec![0.0; n];
        let kept = Kept::new(n, 0);
        let previous = Previous::new(n, m, kept.end());
        Ok(Self {
            options,
            work: Work {
                delta: zeros(),
                nu: vec![0.0; m],
                p: vec![0.0; mechanics.free().len()],
                q_mid: zeros(),
                v_mid: zeros(),
                q_end: zeros(),
                v_end: zeros(),
                force: zeros(),
                inertial: zeros(),
                inputs: vec![0.0; sizes.inputs],
                taut: vec![false; sizes.switches],
                taut_by_law: vec![false; sizes.switches],
            },
            factored: Factored { q: zeros(), delta: zeros(), ..Factored::default() },
            kept,
            previous,
            trial: State {
                q: zeros(),
                v: zeros(),
                lambda: vec![0.0; m],
                memory: vec![0.0; previous.end()],
                ..State::default()
            },
            project: true,
            either_way: false,
            supports: Supports::new(mechanics),
            system,
            projector,
        })
    }

    /// The scheme as printed, which carries the whole momentum from step to step: to study the projection. The
    /// multipliers are then polluted by the normal part; coordinates are the same to rounding.
    #[must_use]
    pub fn carrying_momentum(mut self) -> Self {
        self.project = false;
        let (n, m) = (self.trial.q.len(), self.trial.lambda.len());
        self.kept = Kept::new(n, self.work.p.len());
        self.previous = Previous::new(n, m, self.kept.end());
        self.trial.memory = vec![0.0; self.previous.end()];
        self
    }

    /// Length of its states' memory.
    pub(crate) fn memory(&self) -> usize {
        self.previous.end()
    }

    /// A stepper that also takes negative steps.
    pub(crate) fn either_way(mut self) -> Self {
        self.either_way = true;
        self
    }
}

impl Stepper for Symplectic<'_> {
    fn mechanics(&self) -> &dyn Mechanics {
        self.system.mechanics
    }

    fn start(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError> {
        let start = check::start(self.system.mechanics, t, q, v)?;
        let mut state = check::project(&mut self.projector, start)?;
        if !self.project {
            let row = |&i: &usize| self.system.inertia.row(i, &state.v);
            state.memory = self.system.mechanics.free().iter().map(row).collect();
        }
        state.memory.resize(self.previous.end(), 0.0);
        Ok(state)
    }

    fn step(&mut self, state: &mut State, h: f64) -> Result<StepReport, StepError> {
        let t = state.t;
        let length = if self.either_way { h.abs() } else { h };
        check::step(state, length, self.system.mechanics.sizes(), self.trial.memory.len())?;
        let fallbacks = self.fallbacks();
        let mut report = StepReport::default();
        let mut failed = None;
        // The trial state leaves `self` while `advance` borrows it.
        let mut trial = std::mem::take(&mut self.trial);
        for halving in 0..=self.options.halvings {
            let last = halving == self.options.halvings;
            let (substeps, report) = (1 << halving, &mut report);
            // One step leaves the state as it is when it fails; of several some may succeed before.
            let done = if halving == 0 {
                self.advance_in(state, h, substeps, last, report)
            } else {
                trial.copy_from(state);
                let done = self.advance_in(&mut trial, h, substeps, last, report);
                if done.is_ok() {
                    std::mem::swap(state, &mut trial);
                }
                done
            };
            failed = done.err();
            // A support that jumps does so in parts of the step as well, or an end of a part hides it.
            let is_hopeless =
                failed.as_ref().is_some_and(|f| matches!(f.failure, Failure::SupportJumps { .. }));
            if failed.is_none() || is_hopeless {
                break;
            }
        }
        self.trial = trial;
        match failed {
            None => {
                report.fallbacks = (self.fallbacks() - fallbacks) as u32;
                Ok(report)
            }
            Some(Failed { failure, iterations, worst }) => {
                let failure = self.system.failure(failure, iterations, worst);
                Err(StepError { t, h, residual: worst.residual, failure })
            }
        }
    }
}

impl Symplectic<'_> {
    /// A step in equal substeps; the report is of this attempt, but counts all iterations so far.
    fn advance_in(
        &mut self,
        state: &mut State,
        h: f64,
        substeps: u32,
        last: bool,
        report: &mut StepReport,
    ) -> Result<(), Failed> {
        *report = StepReport { iterations: report.iterations, substeps, ..StepReport::default() };
        for _ in 0..substeps {
            let done = self.advance(state, h / f64::from(substeps), last);
            report.iterations += match &done {
                Ok(converged) => converged.iterations,
                Err(failed) => failed.iterations,
            };
            let converged = done?;
            report.residual = report.residual.max(converged.residual);
            report.frozen += u32::from(converged.frozen);
            report.forced += converged.forced;
        }
        Ok(())
    }

    fn fallbacks(&self) -> u64 {
        self.system.fallbacks() + self.projector.fallbacks()
    }
}
