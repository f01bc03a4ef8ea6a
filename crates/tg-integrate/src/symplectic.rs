//! The modified symplectic scheme, Algorithm 1 of the framework paper.
//!
//! ```text
//! Ḿ Δ - h p_k - h²/2 F(q_m, q̇_m, t_m) - A(q_k)ᵀ ν = 0        (53a), (54)    Δ = q_{k+1} - q_k,  ν = h²/2 λ
//! Φ(q_{k+1}) = 0                                              (53c)
//! p_{k+1} = Ḿ Δ/h + h/2 F + A(q_{k+1})ᵀ ν/h                   (53b)
//! Jac = [M + h²/4 (-∂F/∂q) + h/2 (-∂F/∂q̇), -A(q_k)ᵀ; A(q_{k+1}), 0]         (55)
//! q_m = q_k + Δ/2,  q̇_m = Δ/h,  t_m = t_k + h/2                              (49)
//! ```
//! Ḿ has the free rows of M and all columns, so moving supports enter through Δ alone. Measured additions:
//!
//! - The momentum is projected on A M⁻¹ p = 0 at the end of each step. Its normal part would flip sign every step and
//!   never decay: invisible in q, it pollutes q̇, λ and the energy. The state keeps the projected velocity;
//!   p_k = Ḿ q̇_k. (53b)'s last term is normal, and the projection would remove h/2 F's part along it as well, but
//!   only to the rounding of that part, which at rest is far above q̇.
//! - Newton starts from q_k + h q̇_k.
//! - The unknown is Δ, not q_{k+1}: no digits cancel at small steps.
//! - Residuals are compared with their own terms (dynamic rows) and with the member's size (constraints), so that the
//!   tolerance means the same at every h. A correction below the resolution of q ends the iteration as well.
//! - Law (30) with damping jumps at re-tensioning, and a step may have no solution. After a few iterations the active
//!   set is frozen; a result that contradicts it is not taken, but the step is repeated in 2, 4, 8 … substeps; only
//!   the smallest substep is accepted against a cable's law, and the report counts it.
//!
//! The midpoint rule does not damp what it cannot resolve: a damper with h η/2 far above the mass that it acts on
//! reverses the closing velocity instead of stopping it (measured: factor -0.88 at a ratio of 15). Choose h smaller.

use tg_model::{At, Mechanics, ProjectionError, Projector};

use crate::check;
use crate::error::{StartError, StepError};
use crate::state::State;
use crate::stepper::{NewtonOptions, StepReport, Stepper};
use crate::system::{Factors, Failure, NewtonSystem, Worst};

/// The modified symplectic scheme: second order, no numerical dissipation, one step of history.
pub struct Symplectic<'m> {
    options: NewtonOptions,
    system: NewtonSystem<'m>,
    projector: Projector<'m>,
    work: Work,
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
    inputs: Vec<f64>,
    taut: Vec<bool>,
    taut_by_law: Vec<bool>,
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
                inputs: vec![0.0; sizes.inputs],
                taut: vec![false; sizes.switches],
                taut_by_law: vec![false; sizes.switches],
            },
            trial: State { q: zeros(), v: zeros(), lambda: vec![0.0; m], ..State::default() },
            project: true,
            either_way: false,
            system,
            projector,
        })
    }

    /// The scheme as printed, which carries the whole momentum from step to step: to study the projection. The
    /// multipliers are then polluted by the normal part; coordinates are the same to rounding.
    #[must_use]
    pub fn carrying_momentum(mut self) -> Self {
        self.project = false;
        self.trial.memory = vec![0.0; self.work.p.len()];
        self
    }

    /// A stepper that also takes negative steps.
    pub(crate) fn either_way(mut self) -> Self {
        self.either_way = true;
        self
    }

    /// One implicit step from `state`, written back only if it converges. `last` accepts a frozen active set that
    /// contradicts the law.
    fn advance(&mut self, state: &mut State, h: f64, last: bool) -> Result<Converged, Failed> {
        self.predict(state, h);
        let half = 0.5 * h * h;
        let factors = Factors { mass: 1.0, stiffness: 0.5 * half, damping: 0.5 * h };
        let resolution = 4.0 * f64::EPSILON * largest(&state.q);
        let mut frozen = false;
        let mut iterations = 0;
        let mut correction = f64::INFINITY;
        loop {
            let worst = self.residual(state, h, frozen);
            let fail = move |failure| Failed { failure, iterations, worst };
            if !worst.residual.is_finite() {
                return Err(fail(Failure::NotFinite));
            }
            if worst.residual <= self.options.tolerance || correction <= resolution {
                let forced = if frozen { self.contradictions() } else { 0 };
                if forced > 0 && !last {
                    return Err(fail(Failure::NotConverged));
                }
                self.finish(state, h).map_err(|error| fail(Failure::Projection(error)))?;
                let frozen = frozen && forced == 0;
                return Ok(Converged { iterations, residual: worst.residual, frozen, forced });
            }
            if iterations == self.options.max_iterations {
                return Err(fail(Failure::NotConverged));
            }
            if iterations == self.options.freeze_after && !self.work.taut.is_empty() {
                frozen = true;
                let Work { q_mid, v_mid, inputs, taut, .. } = &mut self.work;
                let at = At { q: q_mid, v: v_mid, u: inputs, taut: None };
                self.system.mechanics.active_set(at, taut);
            }
            iterations += 1;
            let Work { q_mid, v_mid, q_end, inputs, taut, nu, .. } = &self.work;
            let at = At { q: q_mid, v: v_mid, u: inputs, taut: frozen.then_some(taut) };
            if let Err(error) = self.system.solve(at, factors, q_end, nu) {
                return Err(fail(Failure::Solver(error)));
            }
            correction = self.correct();
        }
    }

    /// Start of the iteration: Δ = h q̇_k, supports and inputs at their times, p_k and A(q_k).
    fn predict(&mut self, state: &State, h: f64) {
        let (w, mechanics) = (&mut self.work, self.system.mechanics);
        w.q_end.copy_from_slice(&state.q);
        w.v_end.copy_from_slice(&state.v);
        mechanics.prescribe(state.t + h, &mut w.q_end, &mut w.v_end);
        mechanics.inputs(state.t + 0.5 * h, &mut w.inputs);
        for i in 0..w.delta.len() {
            w.delta[i] = w.q_end[i] - state.q[i];
        }
        for (k, &i) in mechanics.free().iter().enumerate() {
            w.delta[i] = h * state.v[i];
            w.p[k] = if self.project { self.system.inertia.row(i, &state.v) } else { state.memory[k] };
        }
        for (nu, lambda) in w.nu.iter_mut().zip(&state.lambda) {
            *nu = 0.5 * h * h * lambda;
        }
        self.system.set_upper(&state.q);
    }

    /// Residual (54) into the right-hand side; the worst scaled row.
    fn residual(&mut self, state: &State, h: f64, frozen: bool) -> Worst {
        let w = &mut self.work;
        for i in 0..w.delta.len() {
            w.q_end[i] = state.q[i] + w.delta[i];
            w.q_mid[i] = state.q[i] + 0.5 * w.delta[i];
            w.v_mid[i] = w.delta[i] / h;
        }
        let taut = frozen.then_some(w.taut.as_slice());
        let at = At { q: &w.q_mid, v: &w.v_mid, u: &w.inputs, taut };
        self.system.mechanics.force(at, &mut w.force);
        self.system.spread_multipliers(&w.nu);
        let half = 0.5 * h * h;
        let mut scale = 0.0_f64;
        for (k, &i) in self.system.mechanics.free().iter().enumerate() {
            let inertial = self.system.inertia.row(i, &w.delta);
            let (momentum, force) = (h * w.p[k], half * w.force[i]);
            let reaction = self.system.constraint_force[i];
            scale = scale.max(inertial.abs()).max(momentum.abs()).max(force.abs()).max(reaction.abs());
            self.system.rhs[k] = inertial - momentum - force - reaction;
        }
        let constraints = self.system.constraint_rows(&w.q_end);
        self.system.dynamic_rows(scale).max(constraints)
    }

    /// Applies the correction; its largest coordinate change.
    fn correct(&mut self) -> f64 {
        let (w, rhs) = (&mut self.work, &self.system.rhs);
        let mut largest = 0.0_f64;
        for (k, &i) in self.system.mechanics.free().iter().enumerate() {
            w.delta[i] -= rhs[k];
            largest = largest.max(rhs[k].abs());
        }
        for (nu, delta) in w.nu.iter_mut().zip(&rhs[self.system.layout.unknowns()..]) {
            *nu -= delta;
        }
        largest
    }

    /// Number of cables whose law contradicts the frozen active set at the solution.
    fn contradictions(&mut self) -> u32 {
        let Work { q_mid, v_mid, inputs, taut, taut_by_law, .. } = &mut self.work;
        let at = At { q: q_mid, v: v_mid, u: inputs, taut: None };
        self.system.mechanics.active_set(at, taut_by_law);
        taut.iter().zip(taut_by_law).filter(|(a, b)| *a != *b).count() as u32
    }

    /// Momentum (53b), its projection, and the new state.
    fn finish(&mut self, state: &mut State, h: f64) -> Result<(), ProjectionError> {
        let w = &mut self.work;
        self.system.set_upper(&w.q_end);
        self.system.spread_multipliers(&w.nu);
        for (k, &i) in self.system.mechanics.free().iter().enumerate() {
            let reaction = self.system.constraint_force[i] / h;
            w.p[k] = self.system.inertia.row(i, &w.delta) / h + 0.5 * h * w.force[i] + reaction;
            w.v_end[i] = w.delta[i] / h;
        }
        self.projector.velocity_of_momentum(&w.q_end, &w.p, &mut w.v_end)?;
        if !self.project {
            state.memory.copy_from_slice(&w.p);
        }
        state.advance_time(h);
        state.q.copy_from_slice(&w.q_end);
        state.v.copy_from_slice(&w.v_end);
        for (lambda, nu) in state.lambda.iter_mut().zip(&w.nu) {
            *lambda = 2.0 / (h * h) * nu;
        }
        Ok(())
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
            trial.copy_from(state);
            let last = halving == self.options.halvings;
            match self.advance_in(&mut trial, h, 1 << halving, last, &mut report) {
                Ok(()) => {
                    state.copy_from(&trial);
                    failed = None;
                    break;
                }
                Err(failure) => failed = Some(failure),
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

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}
