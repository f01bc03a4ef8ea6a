//! The equations of one step: start, residual (54), correction, and the state at the end (53b).

use tg_model::{At, ProjectionError, Run};

use super::{Symplectic, Work};
use crate::state::State;
use crate::system::larger;

impl Symplectic<'_> {
    /// Start of the iteration: Δ and ν, supports and inputs at their times, p_k and A(q_k).
    pub(super) fn predict(&mut self, state: &State, h: f64) {
        let last = self.previous.get(state, h);
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
            let starts = w.delta[full.clone()].iter_mut().zip(&state.v[full.clone()]);
            match last {
                Some((excess, _)) => {
                    starts.zip(&excess[full.clone()]).for_each(|((d, v), excess)| *d = h * v + excess);
                }
                None => starts.for_each(|(d, v)| *d = h * v),
            }
            if self.project {
                w.p[unknown..unknown + len].copy_from_slice(&w.inertial[full]);
            }
        }
        let half = 0.5 * h * h;
        let starts = w.nu.iter_mut().zip(&state.lambda);
        match last {
            Some((_, last)) => {
                starts.zip(last).for_each(|((nu, now), last)| *nu = half * (now + (now - last)));
            }
            None => starts.for_each(|(nu, now)| *nu = half * now),
        }
        self.system.set_upper(&state.q);
    }

    /// Residual (54) into the right-hand side; the largest term of its dynamic rows.
    pub(super) fn residual(&mut self, state: &State, h: f64, frozen: bool) -> f64 {
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
    pub(super) fn correct(&mut self) -> f64 {
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
    pub(super) fn contradictions(&mut self) -> u32 {
        let Work { q_mid, v_mid, inputs, taut, taut_by_law, .. } = &mut self.work;
        let at = At { q: q_mid, v: v_mid, u: inputs, taut: None };
        self.system.mechanics.active_set(at, taut_by_law);
        taut.iter().zip(taut_by_law).filter(|(a, b)| *a != *b).count() as u32
    }

    /// Momentum (53b), its projection, and the new state. With Δ of (54) it is p_k and the impulses of the step: what
    /// Newton's method leaves of (54) then stays in the positions, where from Δ/h it would add up in the momentum. The force
    /// is that of the iterate before the last correction, which moved it by less than its rounding.
    pub(super) fn finish(&mut self, state: &mut State, h: f64) -> Result<(), ProjectionError> {
        let Self { system, projector, work: w, .. } = self;
        for ((end, q), delta) in w.q_end.iter_mut().zip(&state.q).zip(&w.delta) {
            *end = q + delta;
        }
        for &Run { coordinate, len, .. } in system.layout.runs() {
            let run = coordinate..coordinate + len;
            w.v_end[run.clone()].copy_from_slice(&state.v[run]);
        }
        // Momentum that the supports' velocity at the start lends, against that at the end.
        let moving = system.mechanics.features().moving_supports;
        if moving {
            for ((change, start), end) in w.v_mid.iter_mut().zip(&state.v).zip(&w.v_end) {
                *change = start - end;
            }
            system.inertia.product(&w.v_mid, &mut w.inertial);
        } else {
            w.inertial.fill(0.0);
        }
        system.spread_multipliers(&w.nu);
        let rate = 1.0 / h;
        for (impulse, (force, reaction)) in
            w.inertial.iter_mut().zip(w.force.iter().zip(&system.constraint_force))
        {
            *impulse += h * force + rate * reaction;
        }
        if !self.project {
            // The normal part of p_k as well.
            for (p, &i) in w.p.iter_mut().zip(system.mechanics.free()) {
                let normal = *p - system.inertia.row(i, &state.v);
                *p += h * w.force[i] + rate * system.constraint_force[i];
                w.inertial[i] += normal;
            }
        }
        projector.velocity_after_impulse(
            &w.q_end,
            |jacobian, impulse| {
                system.spread(jacobian, &w.nu);
                for &Run { coordinate, unknown, len } in system.layout.runs() {
                    let full = coordinate..coordinate + len;
                    let terms = w.inertial[full.clone()].iter().zip(&system.constraint_force[full]);
                    for (impulse, (first, reaction)) in impulse[unknown..unknown + len].iter_mut().zip(terms)
                    {
                        *impulse = first + rate * reaction;
                    }
                }
            },
            &mut w.v_end,
        )?;
        if !self.project {
            // (53b) itself.
            for ((kept, p), &i) in state.memory.iter_mut().zip(&w.p).zip(system.mechanics.free()) {
                *kept = p + rate * system.constraint_force[i];
            }
        }
        self.previous.set(state, h, &w.delta, &w.v_end);
        state.advance_time(h);
        state.q.copy_from_slice(&w.q_end);
        state.v.copy_from_slice(&w.v_end);
        for (lambda, nu) in state.lambda.iter_mut().zip(&w.nu) {
            *lambda = 2.0 / (h * h) * nu;
        }
        Ok(())
    }
}
