//! Whether fixed steps resolve the motion: by what angle the acceleration turns in a step.
//!
//! ```text
//! a_k = (q̇_{k+1} - q̇_k)/h,   4 sin²(θ/2) = Σ |a_{k+1} - a_k|² / Σ |a_{k+1}|²
//! ```
//! For an oscillation or a rotation of circular frequency ω, θ = h ω, and the error of a scheme of order p grows with θ^p. A
//! scheme of fixed steps has no estimate of its error and does not fail where θ is large.

use crate::run::Observer;
use crate::state::State;
use crate::stepper::StepReport;

/// Part of the largest coordinate by which an acceleration has to bend a step to count: less is rounding, or does no harm.
const FELT: f64 = 1e-10;

/// An observer that watches by what angle the acceleration turns in a step.
///
/// ```
/// # use tg_integrate::{NewtonOptions, Run, Stepper, Symplectic, Turning};
/// # use tg_model::{Joining, ModelBuilder};
/// # let mut b = ModelBuilder::<2>::new();
/// # b.gravity([0.0, -9.81])?;
/// # let pivot = b.anchor("pivot", [0.0, 0.0])?;
/// # let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.1, -1.0])?;
/// # b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
/// # let model = b.build()?;
/// # let mut stepper = Symplectic::new(&model, NewtonOptions::default())?;
/// # let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
/// let mut turning = Turning::default();
/// Run::new(0.01, 10.0).observe(&mut turning).go(&mut stepper, &mut state)?;
/// // A pendulum of ω = 3.8 rad/s.
/// assert!((turning.angle() - 0.038).abs() < 2e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Turning {
    t: f64,
    v: Vec<f64>,
    /// h a of the last step, where it was felt.
    change: Vec<f64>,
    /// Length of the last step \[s\]; zero before the first.
    h: f64,
    turned: f64,
    size: f64,
}

impl Turning {
    /// The angle θ \[rad\], from 0 to π, over all steps so far, the strongest accelerations weighing most. Well below 1 steps
    /// resolve the motion, above 1 they do not. A velocity that jumps counts as not resolved. Zero where there is no acceleration.
    pub fn angle(&self) -> f64 {
        if self.size > 0.0 { 2.0 * (0.5 * (self.turned / self.size).sqrt()).min(1.0).asin() } else { 0.0 }
    }
}

impl Observer for Turning {
    fn observe(&mut self, state: &State, _: &StepReport) {
        let first = self.v.len() != state.v.len();
        if first {
            self.v.clone_from(&state.v);
            self.change = vec![0.0; state.v.len()];
        }
        let h = state.t - self.t;
        let largest = state.q.iter().fold(0.0_f64, |largest, q| largest.max(q.abs()));
        let (mut turned, mut size) = (0.0, 0.0);
        for ((before, last), v) in self.v.iter_mut().zip(&mut self.change).zip(&state.v) {
            let change = v - *before;
            turned += (change - *last) * (change - *last);
            size += change * change;
            (*before, *last) = (*v, change);
        }
        // Accelerations are compared over equal steps only, but for the rounding of the time.
        let follows = self.h > 0.0 && (h - self.h).abs() <= 1e-6 * h;
        if follows && h * size.sqrt() > FELT * largest {
            self.turned += turned / (h * h);
            self.size += size / (h * h);
        }
        self.t = state.t;
        self.h = if first { 0.0 } else { h };
    }
}
