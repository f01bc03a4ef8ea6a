//! Newton's iteration of one step, with factors that are kept while they serve.

use tg_model::At;
use tg_sparse::SparseError;

use super::{Converged, Failed, Symplectic, Work};
use crate::state::State;
use crate::system::{Factors, Failure, larger};

/// The first correction removes most of a smooth residual; those after it are not trusted to do better than this.
const FASTEST: f64 = 0.02;
/// What the last correction, whose residual is not looked at, is to leave of the tolerance.
const POLISHED: f64 = 1e-2;
/// A residual that falls less than this in an iteration asks for new factors, unless it fell so much more in the one before: a
/// correction of the constraints, whose residual stood out, shows that of the dynamic rows.
const SLOW: f64 = 0.1;
/// One that falls less than this with new factors is rounding.
const STANDS: f64 = 0.5;
/// Steps differ in their rounding by no more than this.
const ROUNDING: f64 = 4.0;
/// A step that took more iterations leaves the next one without factors. On the masts of 8, 32 and 128 stages five cost a
/// twentieth to an eighth less than four, and no more than six.
const KEEP_UP_TO: u32 = 5;

impl Symplectic<'_> {
    /// One implicit step from `state`, written back only if it converges. `last` accepts a frozen active set that
    /// contradicts the law.
    pub(super) fn advance(&mut self, state: &mut State, h: f64, last: bool) -> Result<Converged, Failed> {
        self.predict(state, h);
        let Work { q_end, v_end, .. } = &self.work;
        self.supports.check(state, q_end, v_end, h).map_err(|jump| self.failed(jump, 0, 0.0))?;
        let resolution = 4.0 * f64::EPSILON * largest(&state.q);
        let mut has_factors = self.recall(state, h);
        let (mut frozen, mut iterations, mut factored) = (false, 0, 0);
        let (mut before, mut fell_before, mut slowest) = (f64::INFINITY, 1.0_f64, FASTEST);
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
            // One more correction, whose residual need not be looked at. Where factors are new it is: what stands then is
            // rounding, by which the next steps know it. Old factors may stand as well.
            let last_one = factored == 0
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
            let is_small = residual <= self.options.tolerance || correction <= resolution;
            let stands = is_small && factored > 0 && fell > STANDS;
            if stands {
                self.factored.rounding = residual;
            }
            let polished = factored > 0 && residual <= POLISHED * self.options.tolerance;
            let rounding = is_small && residual <= ROUNDING * self.factored.rounding;
            if last_one || stands || polished || rounding {
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
            // New factors serve until nothing falls any more.
            let falls = fell <= SLOW || fell * fell_before <= SLOW * SLOW;
            has_factors &= falls || (is_small && factored > 0);
            fell_before = if iterations == 0 { 1.0 } else { fell };
            before = residual;
            iterations += 1;
            let solved = if has_factors {
                self.system.apply()
            } else {
                factored += 1;
                self.factor_and_solve(state, h, frozen)
            };
            solved.map_err(|error| self.failed(Failure::Solver(error), iterations, scale))?;
            has_factors = self.options.keep_factors;
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
        self.keep(state, h, frozen || iterations > KEEP_UP_TO || !self.options.keep_factors);
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
        let rounding = self.kept.rounding(state);
        let (w, mechanics) = (&mut self.work, self.system.mechanics);
        let f = &mut self.factored;
        (f.t, f.h, f.rounding) = (t, h, rounding);
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
        (f.t, f.h, f.rounding) = (state.t, if frozen { 0.0 } else { h }, 0.0);
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
            self.kept.set(state, (f.t, f.h, f.rounding), &f.q, &f.delta);
        }
    }
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |largest, x| larger(largest, x.abs()))
}
