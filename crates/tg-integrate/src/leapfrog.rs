//! The leapfrog scheme with exact constraints: explicit forces, one force evaluation and one factorisation a step.
//!
//! ```text
//! M v' = M v_k + h/2 (F_k + A(q_k)ᵀ λ),   q_{k+1} = q_k + h v',   Φ(q_{k+1}) = 0
//! M v_{k+1} = M v' + h/2 (F_{k+1} + A(q_{k+1})ᵀ μ),   A(q_{k+1}) v_{k+1} = 0
//! ```
//! This is RATTLE (H. C. Andersen 1983; B. Leimkuhler, R. Skeel 1994): of second order, symplectic and reversible where forces
//! do not depend on velocity. Where they do, F_{k+1} is taken at the velocity 2 v' - v_k, which is of second order and no
//! unknown; both half steps at q_{k+1} share it.
//!
//! The matrix `[M -Aᵀ; A 0]` of q_{k+1} projects the velocities there and opens the next step: its multipliers
//! act along A(q_k)ᵀ, so that Newton's iteration on Φ with this one matrix converges as fast as A changes in a step.
//! Forces are explicit: the step is limited by the highest frequency, h ω < 2, and by the hardest damper.

use tg_model::{At, Inertia, Mechanics, Projector, Run};

use crate::check;
use crate::error::{StartError, StepError};
use crate::state::State;
use crate::stepper::{NewtonOptions, StepReport, Stepper};
use crate::supports::Supports;
use crate::system::{Failure, larger};

/// The leapfrog scheme: the cheapest of second order on structures that are not stiff. The memory of a state is: length of the
/// last step, then force and last displacement of the free coordinates.
pub struct Leapfrog<'m> {
    options: NewtonOptions,
    mechanics: &'m dyn Mechanics,
    projector: Projector<'m>,
    supports: Supports,
    inertia: Inertia,
    runs: Vec<Run>,
    unknowns: usize,
    moving: bool,
    scales: Vec<f64>,
    /// Where the projector's system was factored.
    factored: Vec<f64>,
    delta: Vec<f64>,
    excess: Vec<f64>,
    inertial: Vec<f64>,
    q: Vec<f64>,
    v: Vec<f64>,
    force: Vec<f64>,
    inputs: Vec<f64>,
    /// Right-hand side in, correction out.
    rhs: Vec<f64>,
}

impl<'m> Leapfrog<'m> {
    /// A stepper for a system, with its workspace. Of the options, `tolerance` and `max_iterations` are about Φ.
    ///
    /// # Errors
    /// An option is out of range, or the pattern of the system cannot be analysed.
    pub fn new(mechanics: &'m dyn Mechanics, options: NewtonOptions) -> Result<Self, StartError> {
        options.check()?;
        let sizes = mechanics.sizes();
        let mut projector = Projector::new(mechanics)?;
        let layout = projector.system().layout();
        let (runs, unknowns) = (layout.runs().to_vec(), layout.unknowns());
        let zeros = || vec![0.0; sizes.coordinates];
        Ok(Self {
            options,
            mechanics,
            projector,
            supports: Supports::new(mechanics),
            inertia: Inertia::new(sizes.coordinates, mechanics.mass()),
            runs,
            unknowns,
            moving: mechanics.features().moving_supports,
            scales: mechanics.constraint_scales().iter().map(|scale| 1.0 / scale).collect(),
            // No configuration equals it.
            factored: vec![f64::NAN; sizes.coordinates],
            delta: zeros(),
            excess: zeros(),
            inertial: zeros(),
            q: zeros(),
            v: zeros(),
            force: zeros(),
            inputs: vec![0.0; sizes.inputs],
            rhs: vec![0.0; unknowns + sizes.constraints],
        })
    }

    /// The displacement Δ = h v' onto Φ(q_{k+1}) = 0, with q_{k+1}; iterations and the scaled residual left.
    fn displace(&mut self, state: &State, h: f64) -> Result<(u32, f64), Failed> {
        if self.factored != state.q {
            self.factored.copy_from_slice(&state.q);
            if let Err(source) = self.projector.system().factor(&state.q) {
                self.factored.fill(f64::NAN);
                return Err(Failed::at_start(Failure::Solver(source)));
            }
        }
        self.q.copy_from_slice(&state.q);
        self.v.copy_from_slice(&state.v);
        self.mechanics.prescribe(state.t + h, &mut self.q, &mut self.v);
        self.supports.check(state, &self.q, &self.v, h).map_err(Failed::at_start)?;
        for ((delta, q), start) in self.delta.iter_mut().zip(&self.q).zip(&state.q) {
            *delta = q - start;
        }
        // Start: the last step's acceleration once more.
        let (force, last) = state.memory[1..].split_at(self.unknowns);
        let continues = if state.memory[0] == h { 1.0 } else { 0.0 };
        for &Run { coordinate, unknown, len } in &self.runs {
            let full = coordinate..coordinate + len;
            let starts = state.v[full.clone()].iter().zip(&last[unknown..]);
            for (delta, (v, last)) in self.delta[full].iter_mut().zip(starts) {
                *delta = h * v + continues * (h * v - last);
            }
        }
        for ((excess, delta), v) in self.excess.iter_mut().zip(&self.delta).zip(&state.v) {
            *excess = delta - h * v;
        }
        self.inertia.product(&self.excess, &mut self.inertial);
        let half = 0.5 * h * h;
        for &Run { coordinate, unknown, len } in &self.runs {
            let terms = force[unknown..].iter().zip(&self.inertial[coordinate..coordinate + len]);
            for (rhs, (force, inertial)) in self.rhs[unknown..unknown + len].iter_mut().zip(terms) {
                *rhs = half * force - inertial;
            }
        }
        let mut before = f64::INFINITY;
        for iteration in 0..=self.options.max_iterations {
            let residual = self.constraint_rows(state);
            // The first correction also brings in the forces.
            let stands = residual > 0.5 * before && residual <= ACCEPTED;
            if iteration > 0 && (residual <= self.options.tolerance || stands) {
                return Ok((iteration, residual));
            }
            let failed = |failure| Failed { failure, iterations: iteration, residual };
            if !residual.is_finite() {
                // Without a bad number at the start, the iteration has run away.
                let ran_away = iteration > 0 && force.iter().all(|force| force.is_finite());
                let (failure, residual) =
                    if ran_away { (Failure::NotConverged, before) } else { (Failure::NotFinite, residual) };
                return Err(Failed { residual, ..failed(failure) });
            }
            before = residual;
            self.projector.system().solve(&mut self.rhs).map_err(|source| failed(Failure::Solver(source)))?;
            for &Run { coordinate, unknown, len } in &self.runs {
                let change = &self.rhs[unknown..unknown + len];
                self.delta[coordinate..coordinate + len].iter_mut().zip(change).for_each(|(x, d)| *x += d);
            }
            self.rhs[..self.unknowns].fill(0.0);
        }
        Err(Failed {
            failure: Failure::NotConverged,
            iterations: self.options.max_iterations,
            residual: before,
        })
    }

    /// q_{k+1} and -Φ there into the lower rows; the largest scaled one, NaN if any is.
    fn constraint_rows(&mut self, state: &State) -> f64 {
        for ((q, start), delta) in self.q.iter_mut().zip(&state.q).zip(&self.delta) {
            *q = start + delta;
        }
        let rows = &mut self.rhs[self.unknowns..];
        self.mechanics.constraints(&self.q, rows);
        let (mut largest, mut sum) = (0.0, 0.0);
        for (phi, scale) in rows.iter_mut().zip(&self.scales) {
            largest = larger((*phi * scale).abs(), largest);
            sum += *phi;
            *phi = -*phi;
        }
        if f64::is_nan(sum) { f64::NAN } else { largest }
    }

    /// Force at q_{k+1}, velocities there, and the new state.
    fn close(&mut self, state: &mut State, h: f64) -> Result<(), Failure> {
        let rate = 1.0 / h;
        // `v` holds the supports' velocities at the end.
        for &Run { coordinate, len, .. } in &self.runs {
            let full = coordinate..coordinate + len;
            let half_steps = self.delta[full.clone()].iter().zip(&state.v[full.clone()]);
            for (v, (delta, start)) in self.v[full].iter_mut().zip(half_steps) {
                *v = 2.0 * rate * delta - start;
            }
        }
        self.mechanics.inputs(state.t + h, &mut self.inputs);
        let at = At { q: &self.q, v: &self.v, u: &self.inputs, taut: None };
        self.mechanics.force(at, &mut self.force);
        for &Run { coordinate, len, .. } in &self.runs {
            let full = coordinate..coordinate + len;
            self.v[full.clone()].iter_mut().zip(&self.delta[full]).for_each(|(v, delta)| *v = rate * delta);
        }
        if self.moving {
            // Momentum of the supports' mean velocity against that at the end.
            for ((excess, delta), v) in self.excess.iter_mut().zip(&self.delta).zip(&self.v) {
                *excess = rate * delta - v;
            }
            self.inertia.product(&self.excess, &mut self.inertial);
        } else {
            self.inertial.fill(0.0);
        }
        let Self { force, inertial, runs, projector, q, v, factored, .. } = self;
        let impulse = |_: &[f64], impulse: &mut [f64]| {
            for &Run { coordinate, unknown, len } in &*runs {
                let terms = force[coordinate..].iter().zip(&inertial[coordinate..]);
                for (impulse, (force, supports)) in impulse[unknown..unknown + len].iter_mut().zip(terms) {
                    *impulse = 0.5 * h * force + supports;
                }
            }
        };
        factored.fill(f64::NAN);
        projector.velocity_after_impulse(q, impulse, v).map_err(Failure::Projection)?;
        check::bounded(self.mechanics, q, v).map_err(Failure::Told)?;
        factored.copy_from_slice(q);
        state.advance_time(h);
        state.q.copy_from_slice(&self.q);
        state.v.copy_from_slice(&self.v);
        for (lambda, mu) in state.lambda.iter_mut().zip(self.projector.multipliers()) {
            *lambda = 2.0 * rate * mu;
        }
        self.remember(state, h);
        Ok(())
    }

    /// Force and displacement into the state's memory.
    fn remember(&self, state: &mut State, h: f64) {
        let (head, rest) = state.memory.split_at_mut(1);
        head[0] = h;
        let (force, last) = rest.split_at_mut(self.unknowns);
        for &Run { coordinate, unknown, len } in &self.runs {
            let full = coordinate..coordinate + len;
            force[unknown..unknown + len].copy_from_slice(&self.force[full.clone()]);
            last[unknown..unknown + len].copy_from_slice(&self.delta[full]);
        }
    }

    /// A failure in words.
    fn explain(&self, failed: Failed) -> crate::error::StepFailure {
        let rows = self.rhs[self.unknowns..].iter().zip(&self.scales).map(|(phi, scale)| (phi * scale).abs());
        let worst = rows.enumerate().fold((0, 0.0), |a, (j, r)| if r <= a.1 { a } else { (j, r) }).0;
        let name = if self.scales.is_empty() {
            self.mechanics.coordinate_name(self.mechanics.free()[0])
        } else {
            self.mechanics.constraint_name(worst)
        };
        failed.failure.explain(self.mechanics, (name, Vec::new()), failed.iterations, failed.residual)
    }
}

/// Scaled residual of Φ that is accepted where rounding ends the descent above the tolerance.
const ACCEPTED: f64 = 1e-11;

/// A displacement that was not found.
struct Failed {
    failure: Failure,
    iterations: u32,
    residual: f64,
}

impl Failed {
    fn at_start(failure: Failure) -> Self {
        Self { failure, iterations: 0, residual: f64::NAN }
    }
}

impl Stepper for Leapfrog<'_> {
    fn mechanics(&self) -> &dyn Mechanics {
        self.mechanics
    }

    fn start(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError> {
        let start = check::start(self.mechanics, t, q, v)?;
        let mut state = check::project(&mut self.projector, start)?;
        self.mechanics.inputs(t, &mut self.inputs);
        let at = At { q: &state.q, v: &state.v, u: &self.inputs, taut: None };
        self.mechanics.force(at, &mut self.force);
        state.memory = vec![0.0; 1 + 2 * self.unknowns];
        self.remember(&mut state, 0.0);
        Ok(state)
    }

    fn step(&mut self, state: &mut State, h: f64) -> Result<StepReport, StepError> {
        check::step(state, h, self.mechanics.sizes(), 1 + 2 * self.unknowns)?;
        let fallbacks = self.projector.fallbacks();
        let t = state.t;
        let done = self.displace(state, h).and_then(|(iterations, residual)| {
            let failed = |failure| Failed { failure, iterations, residual };
            self.close(state, h).map_err(failed).map(|()| (iterations, residual))
        });
        match done {
            Ok((iterations, residual)) => {
                let fallbacks = (self.projector.fallbacks() - fallbacks) as u32;
                Ok(StepReport { iterations, residual, substeps: 1, fallbacks, ..StepReport::default() })
            }
            Err(failed) => {
                let residual = failed.residual;
                Err(StepError { t, h, residual, failure: self.explain(failed) })
            }
        }
    }
}
