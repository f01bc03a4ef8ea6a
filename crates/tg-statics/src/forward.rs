//! Forward statics: equilibrium from a start configuration.
//!
//! ```text
//! F(q, u) + A(q)ᵀ λ = 0,   Φ(q) = 0          (31)
//! ```
//! Newton's method with a line search comes first ([`crate::newton`]), in load steps if asked; where it ends before
//! equilibrium, dynamic relaxation brings the structure near a minimum of its energy and Newton's method finishes. Rigid
//! motions that supports and loads leave free are gauged: the structure settles where it stands.

use tg_model::Tensioned;
use tg_tangent::{Configuration, EigenOptions, Metric, Sign, TangentError, lowest};

use crate::forward_error::ForwardError;
use crate::forward_options::{ForwardOptions, ForwardReport, Seek};
use crate::gauge::held_coordinates;
use crate::newton::{NewtonRun, newton};
use crate::newton_system::NewtonSystem;
use crate::relaxation::Relaxation;
use crate::rigid::RigidMotions;
use crate::size::size;

/// Residual forces at which relaxation hands over to Newton's method, one after the other.
const HANDOVERS: [f64; 4] = [1e-1, 1e-2, 1e-4, 1e-6];
/// Steps of relaxation for each.
const RELAXATION_STEPS: u32 = 20_000;
/// Smallest part of a load step before Newton's method is given up on it.
const SMALLEST_STEP: f64 = 1.0 / 1024.0;
/// Displacement along an unstable shape, per size of the structure, from which relaxation leaves an unstable
/// equilibrium.
const NUDGE: f64 = 1e-2;
const MOST_NUDGES: u32 = 8;
/// Stops after which relaxation has left an unstable equilibrium: it gathers speed until it is past the next minimum.
const LEAVING_STOPS: u32 = 1;

/// An equilibrium and how it was found.
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// Coordinates, inputs, multipliers.
    pub configuration: Configuration,
    /// What it took.
    pub report: ForwardReport,
}

/// Forward statics of one structure.
pub struct Forward<'s> {
    structure: &'s dyn Tensioned,
    options: ForwardOptions,
}

impl<'s> Forward<'s> {
    /// Forward statics with these settings.
    pub fn new(structure: &'s dyn Tensioned, options: ForwardOptions) -> Self {
        Self { structure, options }
    }

    /// The equilibrium at inputs `u`, from full coordinates `q`, whose prescribed components stay.
    ///
    /// # Errors
    /// No equilibrium is reached; the error keeps the last configuration.
    pub fn solve(&self, q: &[f64], u: &[f64]) -> Result<Equilibrium, ForwardError> {
        self.solve_from(q, u, u)
    }

    /// The equilibrium at inputs `to`, in [`ForwardOptions::load_steps`] equal steps from inputs `from`, which `q` should
    /// be in equilibrium with or near to. Steps that fail are halved.
    ///
    /// # Errors
    /// As [`Forward::solve`].
    pub fn solve_from(&self, q: &[f64], from: &[f64], to: &[f64]) -> Result<Equilibrium, ForwardError> {
        let mut walk = Walk::new(self.structure, &self.options, q, from)?;
        let mix = |s: f64| -> Vec<f64> { from.iter().zip(to).map(|(a, b)| a + s * (b - a)).collect() };
        let (mut done, mut step) = (0.0, 1.0 / f64::from(self.options.load_steps.max(1)));
        while done < 1.0 {
            let next = if done + step > 1.0 - 1e-9 { 1.0 } else { done + step };
            let u = if next == 1.0 { to.to_vec() } else { mix(next) };
            if walk.newton(&u)? {
                done = next;
                walk.report.load_steps += 1;
            } else if step > SMALLEST_STEP && from != to {
                step *= 0.5;
            } else if self.options.relax && walk.relax(&u, 0)? {
                done = next;
                walk.report.load_steps += 1;
            } else {
                return Err(walk.failure(&u, next)?);
            }
        }
        if self.options.seek == Seek::Stable {
            walk.settle(to)?;
        }
        walk.finish(to)
    }
}

/// The state of one search.
struct Walk<'s> {
    structure: &'s dyn Tensioned,
    options: ForwardOptions,
    system: NewtonSystem,
    start: Vec<f64>,
    q: Vec<f64>,
    lambda: Vec<f64>,
    last: NewtonRun,
    report: ForwardReport,
}

impl<'s> Walk<'s> {
    fn new(
        structure: &'s dyn Tensioned,
        options: &ForwardOptions,
        q: &[f64],
        u: &[f64],
    ) -> Result<Self, ForwardError> {
        let start = Configuration::at(structure.mechanics(), q, u)?;
        let system = NewtonSystem::new(structure.mechanics(), held_coordinates(structure, q, u)?, false)?;
        let report = ForwardReport { gauged: system.gauged(), ..ForwardReport::default() };
        let last = NewtonRun { iterations: 0, residual: Default::default(), converged: false };
        Ok(Self {
            structure,
            options: *options,
            system,
            start: q.to_vec(),
            q: q.to_vec(),
            lambda: start.lambda,
            last,
            report,
        })
    }

    /// Newton's method at inputs `u`; where it does not converge, the state stays as it was.
    fn newton(&mut self, u: &[f64]) -> Result<bool, ForwardError> {
        let (mut q, mut lambda) = (self.q.clone(), self.lambda.clone());
        let ForwardOptions { tolerance, max_iterations, .. } = self.options;
        let run = newton(
            &mut self.system,
            self.structure.mechanics(),
            &mut q,
            u,
            &mut lambda,
            tolerance,
            max_iterations,
        )?;
        self.report.iterations += run.iterations;
        self.last = run;
        if run.converged {
            (self.q, self.lambda) = (q, lambda);
        }
        Ok(run.converged)
    }

    /// Relaxes, with attempts of Newton's method on the way, the first after so many stops; whether one converged.
    fn relax(&mut self, u: &[f64], stops: u32) -> Result<bool, ForwardError> {
        let mut relaxation = Relaxation::new(self.structure)?;
        let mut found = false;
        for target in HANDOVERS {
            let arrived = relaxation.run(&mut self.q, u, target, stops, RELAXATION_STEPS);
            self.report.relaxation_steps = self.report.relaxation_steps.max(relaxation.steps);
            self.report.relaxation_stops = self.report.relaxation_stops.max(relaxation.stops);
            let arrived = arrived?;
            let mechanics = self.structure.mechanics();
            self.lambda = Configuration::at(mechanics, &self.q, u)?.lambda;
            self.system = NewtonSystem::new(mechanics, held_coordinates(self.structure, &self.q, u)?, false)?;
            self.report.gauged = self.system.gauged();
            found = self.newton(u)?;
            if found || !arrived {
                break;
            }
        }
        Ok(found)
    }

    /// Leaves unstable equilibria downhill until one is stable.
    fn settle(&mut self, u: &[f64]) -> Result<(), ForwardError> {
        for _ in 0..MOST_NUDGES {
            let at = Configuration::at(self.structure.mechanics(), &self.q, u)?;
            let spectrum =
                lowest(self.structure.mechanics(), &at, &EigenOptions::new(1, Metric::Coordinates))?;
            let Some(pair) = spectrum.pairs.first().filter(|pair| pair.sign == Sign::Negative) else {
                return Ok(());
            };
            self.report.left_unstable += 1;
            let size = size(self.structure, &self.q);
            self.q.iter_mut().zip(&pair.shape).for_each(|(q, x)| *q += NUDGE * size * x);
            if !self.relax(u, LEAVING_STOPS)? {
                return Err(self.failure(u, 1.0)?);
            }
        }
        Err(self.failure(u, 1.0)?)
    }

    fn finish(mut self, u: &[f64]) -> Result<Equilibrium, ForwardError> {
        let configuration = Configuration::at(self.structure.mechanics(), &self.q, u)?;
        self.report.fallbacks = self.system.fallbacks();
        self.report.residual = configuration.imbalance().0;
        self.report.constraint_residual = self.last.residual.constraint;
        Ok(Equilibrium { configuration, report: self.report })
    }

    /// The error, with its likely cause.
    fn failure(&self, u: &[f64], reached: f64) -> Result<ForwardError, TangentError> {
        let mechanics = self.structure.mechanics();
        let at = Configuration::at(mechanics, &self.q, u)?;
        let (residual, worst) = at.imbalance();
        // At the start: where a load has carried the structure off, its work is small against all else.
        let free = RigidMotions::free(self.structure, &self.start)?;
        let gauged = free.without_work(self.structure, &self.start, u)?.count();
        Ok(ForwardError::NotReached {
            residual,
            coordinate: mechanics.coordinate_name(mechanics.free()[worst]),
            violation: self.last.residual.constraint,
            load: reached,
            loaded_rigid_motions: free.count() - gauged,
            last: Box::new(at),
            report: Box::new(self.report),
        })
    }
}
