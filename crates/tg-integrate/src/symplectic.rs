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
//! - The factors of (55) are kept over iterations and steps while they serve: new ones are taken where the residual falls by
//!   less than a factor of ten, and after a step of more than four iterations. On the guyed mast of 32 stages a step then takes
//!   four iterations and a third of the time that full Newton steps take. The last correction is applied without
//!   another look at its residual.
//! - The unknown is Δ, not q_{k+1}: no digits cancel at small steps.
//! - Residuals are compared with their own terms (dynamic rows) and with the member's size (constraints), so that the
//!   tolerance means the same at every h. A correction below the resolution of q ends the iteration as well.
//! - Law (30) with damping jumps at re-tensioning, and a step may have no solution. After a few iterations the active
//!   set is frozen; a result that contradicts it is not taken, but the step is repeated in 2, 4, 8 … substeps; only
//!   the smallest substep is accepted against a cable's law, and the report counts it.
//!
//! The midpoint rule does not damp what it cannot resolve: a damper with h η/2 far above the mass that it acts on
//! reverses the closing velocity instead of stopping it (measured: factor -0.88 at a ratio of 15). Choose h smaller.

use tg_model::{At, Mechanics, ProjectionError, Projector, Run};
use tg_sparse::SparseError;

use crate::check;
use crate::error::{StartError, StepError};
use crate::kept::Kept;
use crate::state::State;
use crate::stepper::{NewtonOptions, StepReport, Stepper};
use crate::system::{Factors, Failure, NewtonSystem, Worst, larger};

/// The first correction removes most of a smooth residual; those after it are not trusted to do better than this.
const FASTEST: f64 = 0.02;
/// What the last correction, whose residual is not looked at, is to leave of the tolerance: with full Newton steps it would
/// have been as little.
const POLISHED: f64 = 1e-3;
/// A residual that falls less than this in an iteration asks for new factors.
const SLOW: f64 = 0.1;
/// A step that took more iterations leaves the next one without factors. On the masts of 2 and 32 stages four cost less than
/// two or three (factors are taken too often) and no more than five.
const KEEP_UP_TO: u32 = 4;

/// The modified symplectic scheme: second order, no numerical dissipation, one step of history.
pub struct Symplectic<'m> {
    options: NewtonOptions,
    system: NewtonSystem<'m>,
    projector: Projector<'m>,
    work: Work,
    /// Where the factors that the system holds were taken.
    factored: Factored,
    kept: Kept,
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
            kept: Kept::new(n, 0),
            trial: State {
                q: zeros(),
                v: zeros(),
                lambda: vec![0.0; m],
                memory: vec![0.0; Kept::new(n, 0).end()],
                ..State::default()
            },
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
        self.kept = Kept::new(self.trial.q.len(), self.work.p.len());
        self.trial.memory = vec![0.0; self.kept.end()];
        self
    }

    /// Length of its states' memory.
    pub(crate) fn memory(&self) -> usize {
        self.kept.end()
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
        let resolution = 4.0 * f64::EPSILON * largest(&state.q);
        let mut has_factors = self.recall(state, h);
        let (mut frozen, mut iterations, mut factored) = (false, 0, 0);
        let (mut before, mut slowest) = (f64::INFINITY, FASTEST);
        let mut correction = f64::INFINITY;
        loop {
            let scale = self.residual(state, h, frozen);
            let mut residual = self.system.largest(scale);
            if !residual.is_finite() {
                return Err(self.failed(Failure::NotFinite, iterations, scale));
            }
            let fell = residual / before;
            if iterations > 0 {
                slowest = slowest.max(fell);
            }
            // One more correction, whose residual need not be looked at.
            let last_one = has_factors
                && iterations > 0
                && fell < SLOW
                && slowest * residual <= POLISHED * self.options.tolerance;
            if last_one {
                iterations += 1;
                self.system
                    .apply()
                    .map_err(|error| self.failed(Failure::Solver(error), iterations, scale))?;
                self.correct();
                residual *= slowest;
            }
            // Rounding ends the descent at some residual below the tolerance.
            let stands = residual <= self.options.tolerance && fell > SLOW;
            if last_one || stands || residual <= POLISHED * self.options.tolerance || correction <= resolution
            {
                return self.accept(
                    state,
                    h,
                    frozen,
                    last,
                    Converged { iterations, residual, frozen, forced: 0 },
                    scale,
                );
            }
            if iterations == self.options.max_iterations {
                return Err(self.failed(Failure::NotConverged, iterations, scale));
            }
            if factored == self.options.freeze_after && !frozen && !self.work.taut.is_empty() {
                frozen = true;
                has_factors = false;
                let Work { q_mid, v_mid, inputs, taut, .. } = &mut self.work;
                let at = At { q: q_mid, v: v_mid, u: inputs, taut: None };
                self.system.mechanics.active_set(at, taut);
            }
            has_factors &= fell <= SLOW || iterations == 0;
            before = residual;
            iterations += 1;
            let solved = if has_factors {
                self.system.apply()
            } else {
                factored += 1;
                self.factor_and_solve(state, h, frozen)
            };
            solved.map_err(|error| self.failed(Failure::Solver(error), iterations, scale))?;
            has_factors = true;
            correction = self.correct();
        }
    }

    /// Takes a converged iterate, unless it contradicts the laws of cables held by a frozen active set.
    fn accept(
        &mut self,
        state: &mut State,
        h: f64,
        frozen: bool,
        last: bool,
        converged: Converged,
        scale: f64,
    ) -> Result<Converged, Failed> {
        let iterations = converged.iterations;
        let forced = if frozen { self.contradictions() } else { 0 };
        if forced > 0 && !last {
            return Err(self.failed(Failure::NotConverged, iterations, scale));
        }
        self.finish(state, h).map_err(|error| self.failed(Failure::Projection(error), iterations, scale))?;
        self.keep(state, h, frozen || iterations > KEEP_UP_TO);
        Ok(Converged { frozen: frozen && forced == 0, forced, ..converged })
    }

    fn failed(&self, failure: Failure, iterations: u32, scale: f64) -> Failed {
        Failed { failure, iterations, worst: self.system.worst(scale) }
    }

    /// Whether the system holds the factors that this step is to begin with; takes them where the state says.
    fn recall(&mut self, state: &State, h: f64) -> bool {
        let Some((t, q, delta)) = self.kept.get(state, h) else { return false };
        let held = &self.factored;
        if held.h == h && held.t == t && held.q == q && held.delta == delta {
            return true;
        }
        let (w, mechanics) = (&mut self.work, self.system.mechanics);
        let f = &mut self.factored;
        (f.t, f.h) = (t, h);
        f.q.copy_from_slice(q);
        f.delta.copy_from_slice(delta);
        // The matrix of that step, in the buffers that the residual fills again.
        mechanics.inputs(t + 0.5 * h, &mut w.inputs);
        for i in 0..f.q.len() {
            w.q_end[i] = f.q[i] + f.delta[i];
            w.q_mid[i] = f.q[i] + 0.5 * f.delta[i];
            w.v_mid[i] = f.delta[i] / h;
        }
        self.system.set_upper(&f.q);
        let done = self.factor(h, false);
        self.system.set_upper(&state.q);
        mechanics.inputs(state.t + 0.5 * h, &mut self.work.inputs);
        done.is_ok()
    }

    /// Factors at the present iterate, notes where, and solves with every check.
    fn factor_and_solve(&mut self, state: &State, h: f64, frozen: bool) -> Result<(), SparseError> {
        let f = &mut self.factored;
        (f.t, f.h) = (state.t, if frozen { 0.0 } else { h });
        f.q.copy_from_slice(&state.q);
        f.delta.copy_from_slice(&self.work.delta);
        self.factor(h, frozen)?;
        self.system.solve_checked()
    }

    fn factor(&mut self, h: f64, frozen: bool) -> Result<(), SparseError> {
        let factors = Factors { mass: 1.0, stiffness: 0.25 * h * h, damping: 0.5 * h };
        let Work { q_mid, v_mid, q_end, inputs, taut, nu, .. } = &self.work;
        let at = At { q: q_mid, v: v_mid, u: inputs, taut: frozen.then_some(taut) };
        self.system.factor(at, factors, q_end, nu)
    }

    /// Notes in the state what the next step starts from.
    fn keep(&mut self, state: &mut State, h: f64, forget: bool) {
        let f = &self.factored;
        if forget || f.h != h {
            self.kept.clear(state);
        } else {
            self.kept.set(state, f.t, f.h, &f.q, &f.delta);
        }
    }

    /// Start of the iteration: Δ = h q̇_k, supports and inputs at their times, p_k and A(q_k).
    fn predict(&mut self, state: &State, h: f64) {
        let (w, mechanics) = (&mut self.work, self.system.mechanics);
        w.q_end.copy_from_slice(&state.q);
        w.v_end.copy_from_slice(&state.v);
        mechanics.prescribe(state.t + h, &mut w.q_end, &mut w.v_end);
        mechanics.inputs(state.t + 0.5 * h, &mut w.inputs);
        for ((delta, end), q) in w.delta.iter_mut().zip(&w.q_end).zip(&state.q) {
            *delta = end - q;
        }
        if self.project {
            self.system.inertia.product(&state.v, &mut w.inertial);
        } else {
            let carried = w.p.len();
            w.p.copy_from_slice(&state.memory[..carried]);
        }
        for &Run { coordinate, unknown, len } in self.system.layout.runs() {
            let full = coordinate..coordinate + len;
            w.delta[full.clone()].iter_mut().zip(&state.v[full.clone()]).for_each(|(d, v)| *d = h * v);
            if self.project {
                w.p[unknown..unknown + len].copy_from_slice(&w.inertial[full]);
            }
        }
        for (nu, lambda) in w.nu.iter_mut().zip(&state.lambda) {
            *nu = 0.5 * h * h * lambda;
        }
        self.system.set_upper(&state.q);
    }

    /// Residual (54) into the right-hand side; the largest term of its dynamic rows.
    fn residual(&mut self, state: &State, h: f64, frozen: bool) -> f64 {
        let Self { system, work: w, .. } = self;
        let rate = 1.0 / h;
        let points = w.q_end.iter_mut().zip(&mut w.q_mid).zip(&mut w.v_mid);
        for (((end, mid), v), (q, delta)) in points.zip(state.q.iter().zip(&w.delta)) {
            *end = q + delta;
            *mid = q + 0.5 * delta;
            *v = rate * delta;
        }
        let taut = frozen.then_some(w.taut.as_slice());
        let at = At { q: &w.q_mid, v: &w.v_mid, u: &w.inputs, taut };
        system.mechanics.force(at, &mut w.force);
        system.spread_multipliers(&w.nu);
        system.inertia.product(&w.delta, &mut w.inertial);
        let half = 0.5 * h * h;
        let mut scale = 0.0_f64;
        for &Run { coordinate, unknown, len } in system.layout.runs() {
            let full = coordinate..coordinate + len;
            let rows = system.rhs[unknown..unknown + len].iter_mut().zip(&w.p[unknown..]);
            let terms = w.inertial[full.clone()].iter().zip(&w.force[full.clone()]);
            for (((r, p), (inertial, force)), reaction) in rows.zip(terms).zip(&system.constraint_force[full])
            {
                let (momentum, force) = (h * p, half * force);
                let term =
                    larger(larger(inertial.abs(), momentum.abs()), larger(force.abs(), reaction.abs()));
                scale = larger(scale, term);
                *r = inertial - momentum - force - reaction;
            }
        }
        system.constraint_rows(&w.q_end);
        scale
    }

    /// Applies the correction; its largest coordinate change.
    fn correct(&mut self) -> f64 {
        let Self { system, work: w, .. } = self;
        let (rhs, multipliers) = system.rhs.split_at(system.layout.unknowns());
        let mut largest = 0.0_f64;
        for &Run { coordinate, unknown, len } in system.layout.runs() {
            for (delta, change) in w.delta[coordinate..coordinate + len].iter_mut().zip(&rhs[unknown..]) {
                *delta -= change;
                largest = larger(largest, change.abs());
            }
        }
        for (nu, change) in w.nu.iter_mut().zip(multipliers) {
            *nu -= change;
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

    /// Momentum (53b), its projection, and the new state. The force is that of the iterate before the last correction, which
    /// moved it by less than its rounding.
    fn finish(&mut self, state: &mut State, h: f64) -> Result<(), ProjectionError> {
        let Self { system, projector, work: w, .. } = self;
        for ((end, q), delta) in w.q_end.iter_mut().zip(&state.q).zip(&w.delta) {
            *end = q + delta;
        }
        for &Run { coordinate, len, .. } in system.layout.runs() {
            let run = coordinate..coordinate + len;
            w.v_end[run.clone()].iter_mut().zip(&w.delta[run]).for_each(|(v, delta)| *v = delta / h);
        }
        // Momentum of the supports' mean velocity against that at the end.
        let moving = system.mechanics.features().moving_supports;
        if moving {
            for i in 0..w.delta.len() {
                w.v_mid[i] = w.delta[i] / h - w.v_end[i];
            }
            system.inertia.product(&w.v_mid, &mut w.inertial);
        } else {
            w.inertial.fill(0.0);
        }
        projector.velocity_after_impulse(
            &w.q_end,
            |jacobian, impulse| {
                system.spread(jacobian, &w.nu);
                let rate = 1.0 / h;
                for &Run { coordinate, unknown, len } in system.layout.runs() {
                    let full = coordinate..coordinate + len;
                    let forces = w.force[full.clone()].iter().zip(&system.constraint_force[full.clone()]);
                    let impulses = impulse[unknown..unknown + len].iter_mut().zip(&w.inertial[full]);
                    for ((impulse, supports), (force, reaction)) in impulses.zip(forces) {
                        *impulse = 0.5 * h * force + rate * reaction + supports;
                    }
                }
            },
            &mut w.v_end,
        )?;
        if !self.project {
            // (53b) itself.
            for (k, &i) in system.mechanics.free().iter().enumerate() {
                let impulse = 0.5 * h * w.force[i] + system.constraint_force[i] / h;
                state.memory[k] = system.inertia.row(i, &w.delta) / h + impulse;
            }
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
        state.memory.resize(self.kept.end(), 0.0);
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
                    std::mem::swap(state, &mut trial);
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
    x.iter().fold(0.0, |largest, x| larger(largest, x.abs()))
}
