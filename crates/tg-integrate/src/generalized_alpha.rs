//! The generalised-α scheme of Chung and Hulbert for constrained systems in the form of Arnold and Brüls
//! (Multibody System Dynamics 18, 2007), for comparison: second order, with numerical dissipation set by ρ∞.
//!
//! ```text
//! M q̈ - F - Aᵀ λ = 0,  Φ(q) = 0                                   at t_{n+1}
//! (1-α_m) a_{n+1} + α_m a_n = (1-α_f) q̈_{n+1} + α_f q̈_n
//! q_{n+1} = q_n + h q̇_n + h² (½-β) a_n + h² β a_{n+1},   q̇_{n+1} = q̇_n + h (1-γ) a_n + h γ a_{n+1}
//! α_m = (2ρ-1)/(ρ+1),  α_f = ρ/(ρ+1),  γ = ½ + α_f - α_m,  β = ¼ (γ + ½)²
//! ```
//! Prescribed components follow their signals; their acceleration is the central difference of the rate over the
//! step's length. Velocities are not projected: the scheme is shown as it is.

use tg_model::{At, Mechanics, Projector};

use crate::check;
use crate::error::{StartError, StepError};
use crate::state::State;
use crate::stepper::{NewtonOptions, StepReport, Stepper};
use crate::supports::Supports;
use crate::system::{Factors, Failure, NewtonSystem, Worst};

/// Coefficients for one spectral radius.
#[derive(Clone, Copy, Debug)]
struct Coefficients {
    alpha_m: f64,
    alpha_f: f64,
    beta: f64,
    gamma: f64,
}

/// Generalised-α with spectral radius ρ∞ at infinite frequency.
pub struct GeneralizedAlpha<'m> {
    options: NewtonOptions,
    c: Coefficients,
    system: NewtonSystem<'m>,
    projector: Projector<'m>,
    supports: Supports,
    q: Vec<f64>,
    v: Vec<f64>,
    /// q̈ at the end of the step, full.
    acceleration: Vec<f64>,
    /// a_{n+1}, full.
    a: Vec<f64>,
    /// Change of q against the predictor.
    delta: Vec<f64>,
    lambda: Vec<f64>,
    /// λ/β', the multipliers of rows that are divided by β'.
    scaled_lambda: Vec<f64>,
    force: Vec<f64>,
    inputs: Vec<f64>,
    before: Vec<f64>,
    after: Vec<f64>,
}

impl<'m> GeneralizedAlpha<'m> {
    /// A stepper with 0 ≤ ρ∞ < 1: 0 damps most, 1 would not damp at all (and is not stable with constraints).
    ///
    /// # Errors
    /// ρ∞ or an option is out of range, or the pattern of the system cannot be analysed.
    pub fn new(
        mechanics: &'m dyn Mechanics,
        rho_infinity: f64,
        options: NewtonOptions,
    ) -> Result<Self, StartError> {
        if !(0.0..1.0).contains(&rho_infinity) {
            return Err(StartError::Parameter {
                name: "spectral radius",
                value: rho_infinity,
                must: "be at least 0 and less than 1",
            });
        }
        options.check()?;
        let alpha_m = (2.0 * rho_infinity - 1.0) / (rho_infinity + 1.0);
        let alpha_f = rho_infinity / (rho_infinity + 1.0);
        let gamma = 0.5 + alpha_f - alpha_m;
        let c = Coefficients { alpha_m, alpha_f, beta: 0.25 * (gamma + 0.5).powi(2), gamma };
        let sizes = mechanics.sizes();
        let system = NewtonSystem::new(mechanics, true)?;
        let zeros = || vec![0.0; sizes.coordinates];
        Ok(Self {
            options,
            c,
            system,
            projector: Projector::new(mechanics)?,
            supports: Supports::new(mechanics),
            q: zeros(),
            v: zeros(),
            acceleration: zeros(),
            a: zeros(),
            delta: zeros(),
            lambda: vec![0.0; sizes.constraints],
            scaled_lambda: vec![0.0; sizes.constraints],
            force: zeros(),
            inputs: vec![0.0; sizes.inputs],
            before: zeros(),
            after: zeros(),
        })
    }

    /// Accelerations of the prescribed components at time `t` into `acceleration`.
    fn prescribe_acceleration(&mut self, t: f64, h: f64) {
        if !self.system.mechanics.features().moving_supports {
            return;
        }
        let coordinates = &mut self.delta;
        self.before.fill(0.0);
        self.after.fill(0.0);
        self.system.mechanics.prescribe(t - 0.5 * h, coordinates, &mut self.before);
        self.system.mechanics.prescribe(t + 0.5 * h, coordinates, &mut self.after);
        for i in 0..self.acceleration.len() {
            self.acceleration[i] = (self.after[i] - self.before[i]) / h;
        }
    }

    /// β' = ∂q̈/∂q and γ' = ∂q̇/∂q of the scheme; rows are divided by β'.
    fn slopes(&self, h: f64) -> (f64, f64) {
        let Coefficients { alpha_m, alpha_f, beta, gamma } = self.c;
        ((1.0 - alpha_m) / (h * h * beta * (1.0 - alpha_f)), gamma / (h * beta))
    }

    /// Kinematics of the scheme for a change δ of q against the predictor.
    fn kinematics(&mut self, state: &State, h: f64) {
        let Coefficients { alpha_m, alpha_f, beta, gamma } = self.c;
        let n = self.q.len();
        let (acceleration_n, a_n) = state.memory.split_at(n);
        for &i in self.system.mechanics.free() {
            let predicted = state.q[i] + h * state.v[i] + h * h * (0.5 - beta) * a_n[i];
            self.q[i] = predicted + self.delta[i];
            self.a[i] = self.delta[i] / (h * h * beta);
            self.v[i] = state.v[i] + h * (1.0 - gamma) * a_n[i] + h * gamma * self.a[i];
            self.acceleration[i] = ((1.0 - alpha_m) * self.a[i] + alpha_m * a_n[i]
                - alpha_f * acceleration_n[i])
                / (1.0 - alpha_f);
        }
    }

    /// Residual divided by β' into the right-hand side, and the scale of its dynamic rows.
    fn residual(&mut self, beta_prime: f64) -> f64 {
        let at = At { q: &self.q, v: &self.v, u: &self.inputs, taut: None };
        self.system.mechanics.force(at, &mut self.force);
        self.system.set_upper(&self.q);
        self.system.spread_multipliers(&self.lambda);
        let mut scale = 0.0_f64;
        for (k, &i) in self.system.mechanics.free().iter().enumerate() {
            let inertial = self.system.inertia.row(i, &self.acceleration);
            let (force, reaction) = (self.force[i], self.system.constraint_force[i]);
            scale = scale.max(inertial.abs()).max(force.abs()).max(reaction.abs());
            self.system.rhs[k] = (inertial - force - reaction) / beta_prime;
        }
        self.system.constraint_rows(&self.q);
        scale / beta_prime
    }

    fn iterate(&mut self, state: &State, h: f64) -> Result<(u32, f64), (Failure, u32, Worst)> {
        let (beta_prime, gamma_prime) = self.slopes(h);
        let factors = Factors { mass: 1.0, stiffness: 1.0 / beta_prime, damping: gamma_prime / beta_prime };
        let resolution = 4.0 * f64::EPSILON * state.q.iter().fold(0.0, |l: f64, q| l.max(q.abs()));
        let (mut iterations, mut correction) = (0, f64::INFINITY);
        loop {
            self.kinematics(state, h);
            let scale = self.residual(beta_prime);
            let residual = self.system.largest(scale);
            if residual <= self.options.tolerance || (correction <= resolution && residual.is_finite()) {
                return Ok((iterations, residual));
            }
            if !residual.is_finite() || iterations == self.options.max_iterations {
                let failure = if residual.is_finite() { Failure::NotConverged } else { Failure::NotFinite };
                return Err((failure, iterations, self.system.worst(scale)));
            }
            iterations += 1;
            for (scaled, lambda) in self.scaled_lambda.iter_mut().zip(&self.lambda) {
                *scaled = lambda / beta_prime;
            }
            let at = At { q: &self.q, v: &self.v, u: &self.inputs, taut: None };
            self.system
                .solve(at, factors, &self.q, &self.scaled_lambda)
                .map_err(|error| (error, self.system.worst(scale)))
                .map_err(|(error, worst)| (Failure::Solver(error), iterations, worst))?;
            correction = 0.0;
            for (k, &i) in self.system.mechanics.free().iter().enumerate() {
                self.delta[i] -= self.system.rhs[k];
                correction = correction.max(self.system.rhs[k].abs());
            }
            let multipliers = &self.system.rhs[self.system.layout.unknowns()..];
            for (lambda, change) in self.lambda.iter_mut().zip(multipliers) {
                *lambda -= change * beta_prime;
            }
        }
    }
}

impl Stepper for GeneralizedAlpha<'_> {
    fn mechanics(&self) -> &dyn Mechanics {
        self.system.mechanics
    }

    /// Also solves `M q̈ - Aᵀλ = F, A q̈ = -Ȧ q̇` for the first acceleration.
    fn start(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError> {
        let start = check::start(self.system.mechanics, t, q, v)?;
        let mut state = check::project(&mut self.projector, start)?;
        let mechanics = self.system.mechanics;
        self.acceleration.fill(0.0);
        mechanics.prescribed_acceleration(t, &mut self.acceleration);
        mechanics.inputs(t, &mut self.inputs);
        let at = At { q: &state.q, v: &state.v, u: &self.inputs, taut: None };
        mechanics.force(at, &mut self.force);
        let mut rates = vec![0.0; mechanics.sizes().constraints];
        for entry in mechanics.constraint_hessian() {
            rates[entry.constraint] += entry.value * state.v[entry.row] * state.v[entry.col];
        }
        self.projector.acceleration(
            &state.q,
            &self.force,
            &rates,
            &mut self.acceleration,
            &mut state.lambda,
        )?;
        state.memory = [self.acceleration.as_slice(), self.acceleration.as_slice()].concat();
        Ok(state)
    }

    fn step(&mut self, state: &mut State, h: f64) -> Result<StepReport, StepError> {
        let t = state.t;
        check::step(state, h, self.system.mechanics.sizes(), 2 * self.q.len())?;
        let fallbacks = self.system.fallbacks();
        self.q.copy_from_slice(&state.q);
        self.v.copy_from_slice(&state.v);
        self.a.copy_from_slice(&state.memory[self.q.len()..]);
        self.prescribe_acceleration(t + h, h);
        self.system.mechanics.prescribe(t + h, &mut self.q, &mut self.v);
        self.system.mechanics.inputs(t + h, &mut self.inputs);
        self.lambda.copy_from_slice(&state.lambda);
        for (delta, a) in self.delta.iter_mut().zip(&self.a) {
            *delta = h * h * self.c.beta * a;
        }
        let checked = self.supports.check(state, &self.q, &self.v, h);
        let checked = checked.map_err(|jump| (jump, 0, self.system.worst(0.0)));
        match checked.and_then(|()| self.iterate(state, h)) {
            Ok((iterations, residual)) => {
                let n = self.q.len();
                state.advance_time(h);
                state.q.copy_from_slice(&self.q);
                state.v.copy_from_slice(&self.v);
                state.lambda.copy_from_slice(&self.lambda);
                state.memory[..n].copy_from_slice(&self.acceleration);
                state.memory[n..].copy_from_slice(&self.a);
                let fallbacks = (self.system.fallbacks() - fallbacks) as u32;
                Ok(StepReport { iterations, residual, substeps: 1, fallbacks, ..StepReport::default() })
            }
            Err((failure, iterations, worst)) => {
                let failure = self.system.failure(failure, iterations, worst);
                Err(StepError { t, h, residual: worst.residual, failure })
            }
        }
    }
}
