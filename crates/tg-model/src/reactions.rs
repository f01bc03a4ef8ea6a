//! What supports do to a moving structure.
//!
//! ```text
//! M q̈ - Aᵀ λ = F + R:   R lives on the prescribed components, q̈ and λ follow from A q̈ = -Ȧ q̇
//! ```

use crate::mechanics::{At, Mechanics};
use crate::projector::{ProjectionError, Projector};

/// Half the interval \[s\] over which prescribed velocities are compared for their rate: the error is some 1e-11 of the
/// velocity's third derivative, and rounding leaves 1e-11 of the velocity per second.
const HALF: f64 = 1e-5;

/// Forces of the supports on a structure in motion; all buffers are made once.
pub struct Reactions<'m> {
    projector: Projector<'m>,
    prescribed: Vec<usize>,
    force: Vec<f64>,
    inputs: Vec<f64>,
    acceleration: Vec<f64>,
    /// Prescribed velocities before and after, and the coordinates that come along.
    around: [Vec<f64>; 3],
    rates: Vec<f64>,
    lambda: Vec<f64>,
    jacobian: Vec<f64>,
    reactions: Vec<f64>,
}

impl<'m> Reactions<'m> {
    /// Prepares for a system.
    ///
    /// # Errors
    /// The pattern cannot be analysed.
    pub fn new(mechanics: &'m dyn Mechanics) -> Result<Self, ProjectionError> {
        let sizes = mechanics.sizes();
        let mut prescribed = vec![true; sizes.coordinates];
        mechanics.free().iter().for_each(|&i| prescribed[i] = false);
        let prescribed: Vec<usize> = (0..sizes.coordinates).filter(|&i| prescribed[i]).collect();
        let full = || vec![0.0; sizes.coordinates];
        Ok(Self {
            projector: Projector::new(mechanics)?,
            force: full(),
            inputs: vec![0.0; sizes.inputs],
            acceleration: full(),
            around: [full(), full(), full()],
            rates: vec![0.0; sizes.constraints],
            lambda: vec![0.0; sizes.constraints],
            jacobian: vec![0.0; mechanics.jacobian_pattern().len()],
            reactions: vec![0.0; prescribed.len()],
            prescribed,
        })
    }

    /// The prescribed coordinates, ascending: what the reactions act on.
    pub fn coordinates(&self) -> &[usize] {
        &self.prescribed
    }

    /// Reactions \[N\] at a consistent state, one for each of [`Reactions::coordinates`], positive along the axis.
    ///
    /// # Errors
    /// The matrix is singular or not finite.
    pub fn at(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<&[f64], ProjectionError> {
        let mechanics = self.projector.mechanics();
        mechanics.inputs(t, &mut self.inputs);
        mechanics.force(At { q, v, u: &self.inputs, taut: None }, &mut self.force);
        let [before, after, coordinates] = &mut self.around;
        mechanics.prescribe(t - HALF, coordinates, before);
        mechanics.prescribe(t + HALF, coordinates, after);
        self.acceleration.fill(0.0);
        for &i in &self.prescribed {
            self.acceleration[i] = (after[i] - before[i]) / (2.0 * HALF);
        }
        self.rates.fill(0.0);
        for entry in mechanics.constraint_hessian() {
            self.rates[entry.constraint] += entry.value * v[entry.row] * v[entry.col];
        }
        self.projector.acceleration(q, &self.force, &self.rates, &mut self.acceleration, &mut self.lambda)?;
        // All of M q̈ - F - Aᵀ λ; it vanishes on the free components.
        self.force.iter_mut().for_each(|f| *f = -*f);
        for entry in mechanics.mass() {
            self.force[entry.row] += entry.value * self.acceleration[entry.col];
        }
        mechanics.jacobian(q, &mut self.jacobian);
        for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(&self.jacobian) {
            self.force[i] -= a * self.lambda[row];
        }
        for (reaction, &i) in self.reactions.iter_mut().zip(&self.prescribed) {
            *reaction = self.force[i];
        }
        Ok(&self.reactions)
    }
}
