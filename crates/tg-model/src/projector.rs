//! Consistent states: projection of q and q̇ onto the constraints in the metric of the mass matrix.
//!
//! ```text
//! [M -Aᵀ] [δq̇]   [p - M q̇]          [M -Aᵀ] [δq]   [  0  ]
//! [A   0 ] [ν ] = [ -A q̇  ]          [A   0 ] [ν ] = [-Φ(q)]   repeated
//! ```
//! on the free components, A q̇ over all of them: among all velocities that satisfy the constraints' rate, the one
//! nearest in kinetic energy. It is what an impulse of the constraints does. M may be singular as long as it is
//! definite on the null space of A, if tg-sparse has its `pivoting` feature, which the solver crates switch on; without
//! it a coordinate without mass is an error that names it.

use tg_sparse::SparseError;
use thiserror::Error;

use crate::inertia::Inertia;
use crate::inertial_system::InertialSystem;
use crate::jacobian::Jacobian;
use crate::layout::{Layout, Run};
use crate::mechanics::Mechanics;

/// Scaled constraint residual at which positions count as consistent: a few roundings of a squared length.
const CONSISTENT: f64 = 4.0 * f64::EPSILON;
/// Scaled residual that is accepted where rounding ends the descent earlier.
const ACCEPTED: f64 = 1e-13;
const MAX_ITERATIONS: u32 = 30;
/// Share of its terms that A q̇ may keep: some roundings. A solve that leaves more is repeated for the rest, then made
/// with every check.
const RATE_LEFT: f64 = 1e-13;
/// Share that is accepted after that.
const RATE_ACCEPTED: f64 = 1e-11;

/// By how much a projection moved a state.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// Largest change of a free component \[m or m/s\].
    pub largest: f64,
    /// The coordinate that changed most.
    pub coordinate: usize,
    /// Newton iterations (one for velocities).
    pub iterations: u32,
    /// Largest residual left: scaled Φ for positions; |A q̇| \[m²/s or m/s\] for velocities.
    pub residual: f64,
}

/// Why a state cannot be made consistent.
#[derive(Clone, Debug, Error)]
pub enum ProjectionError {
    /// The projection's matrix is singular or not finite.
    #[error(
        "cannot project onto the constraints: trouble at {culprit} ({source}); give mass to what moves, remove redundant constraints, or leave the singular pose"
    )]
    Solver {
        /// Name of the coordinate or constraint.
        culprit: String,
        /// The solver's reason.
        source: SparseError,
    },
    /// Newton's method does not reach the constraints.
    #[error(
        "the coordinates are too far from the constraints: {constraint} is still violated by {residual:.3e} (scaled) after {iterations} iterations; start nearer to an assembled configuration"
    )]
    NotConverged {
        /// Name of the worst constraint.
        constraint: String,
        /// Its scaled residual.
        residual: f64,
        /// Iterations made.
        iterations: u32,
    },
}

impl ProjectionError {
    /// A solver's error, with the user's name of its equation.
    pub fn solver(mechanics: &dyn Mechanics, source: SparseError) -> Self {
        Self::Solver { culprit: Layout::new(mechanics).name(mechanics, &source), source }
    }
}

/// Projects states of one system; all buffers are made once.
pub struct Projector<'m> {
    mechanics: &'m dyn Mechanics,
    system: InertialSystem<'m>,
    inertia: Inertia,
    jacobian: Jacobian,
    unknowns: usize,
    phi: Vec<f64>,
    rhs: Vec<f64>,
    /// The first solution while it is refined.
    first: Vec<f64>,
}

impl<'m> Projector<'m> {
    /// A projector for a system.
    ///
    /// # Errors
    /// The pattern cannot be analysed.
    pub fn new(mechanics: &'m dyn Mechanics) -> Result<Self, ProjectionError> {
        let system =
            InertialSystem::new(mechanics).map_err(|source| ProjectionError::solver(mechanics, source))?;
        let sizes = mechanics.sizes();
        Ok(Self {
            inertia: Inertia::new(sizes.coordinates, mechanics.mass()),
            jacobian: Jacobian::new(mechanics),
            unknowns: system.layout().unknowns(),
            phi: vec![0.0; sizes.constraints],
            rhs: vec![0.0; system.size()],
            first: vec![0.0; system.size()],
            system,
            mechanics,
        })
    }

    /// Projects full velocities `v`, prescribed components kept, onto A(q) q̇ = 0.
    ///
    /// # Errors
    /// The matrix is singular or not finite.
    pub fn velocity(&mut self, q: &[f64], v: &mut [f64]) -> Result<Moved, ProjectionError> {
        self.factor(q)?;
        let n = self.unknowns;
        self.rhs[..n].fill(0.0);
        self.correct_velocity(v)
    }

    /// Velocities after an impulse on the free components \[N s\]: `v` becomes the velocity on A(q) q̇ = 0 nearest to
    /// v + M⁻¹ impulse in kinetic energy, prescribed components kept. `impulse` is given the values of A(q) and fills in
    /// one number per free component. The largest |A q̇| left.
    ///
    /// # Errors
    /// The matrix is singular or not finite.
    pub fn velocity_after_impulse(
        &mut self,
        q: &[f64],
        impulse: impl FnOnce(&[f64], &mut [f64]),
        v: &mut [f64],
    ) -> Result<f64, ProjectionError> {
        self.factor(q)?;
        impulse(self.system.jacobian(), &mut self.rhs);
        self.solve_for(v, None)
    }

    /// Accelerations and multipliers at a consistent state: `M q̈ - Aᵀ λ = F, A q̈ = -Ȧ q̇`, given the full force F and
    /// `rates = Ȧ q̇`. `a` holds the prescribed accelerations and receives the free ones.
    ///
    /// # Errors
    /// The matrix is singular or not finite.
    pub fn acceleration(
        &mut self,
        q: &[f64],
        force: &[f64],
        rates: &[f64],
        a: &mut [f64],
        lambda: &mut [f64],
    ) -> Result<(), ProjectionError> {
        self.factor(q)?;
        for (rhs, &i) in self.rhs.iter_mut().zip(self.mechanics.free()) {
            *rhs = force[i] - self.inertia.row(i, a);
        }
        self.solve_for(a, Some(rates))?;
        lambda.copy_from_slice(&self.rhs[self.unknowns..]);
        Ok(())
    }

    /// Multipliers ν of the last projection of velocities \[N s/m for dot products, N s for joints\]: its impulse is Aᵀ ν.
    pub fn multipliers(&self) -> &[f64] {
        &self.rhs[self.unknowns..]
    }

    /// The linear system, factored where the last projection was made.
    pub fn system(&mut self) -> &mut InertialSystem<'m> {
        &mut self.system
    }

    /// The system that states are projected for.
    pub fn mechanics(&self) -> &'m dyn Mechanics {
        self.mechanics
    }

    /// Moves the free components of `q` until Φ(q) = 0.
    ///
    /// # Errors
    /// The matrix is singular or not finite, or Newton's method does not converge.
    pub fn position(&mut self, q: &mut [f64]) -> Result<Moved, ProjectionError> {
        let start = q.to_vec();
        let n = self.unknowns;
        let (mut before, mut iterations) = (f64::INFINITY, 0);
        loop {
            let (worst, residual) = self.constraint_residual(q);
            let accepted = ACCEPTED.max(self.rounding(worst, q));
            if residual <= CONSISTENT || (residual <= accepted && residual >= 0.5 * before) {
                let (coordinate, largest) = largest_change(self.mechanics.free(), &start, q);
                return Ok(Moved { largest, coordinate, iterations, residual });
            }
            if iterations == MAX_ITERATIONS || !residual.is_finite() {
                let constraint = self.mechanics.constraint_name(worst);
                return Err(ProjectionError::NotConverged { constraint, residual, iterations });
            }
            before = residual;
            self.factor(q)?;
            self.rhs[..n].fill(0.0);
            for (rhs, phi) in self.rhs[n..].iter_mut().zip(&self.phi) {
                *rhs = -phi;
            }
            self.solve()?;
            for (&i, delta) in self.mechanics.free().iter().zip(&self.rhs) {
                q[i] += delta;
            }
            iterations += 1;
        }
    }

    /// Index and size of the largest scaled constraint residual at `q`.
    pub fn constraint_residual(&mut self, q: &[f64]) -> (usize, f64) {
        self.mechanics.constraints(q, &mut self.phi);
        let scaled = self.phi.iter().zip(self.mechanics.constraint_scales()).map(|(phi, s)| phi.abs() / s);
        scaled
            .enumerate()
            .fold((0, 0.0), |best, (j, r)| if r <= best.1 || best.1.is_nan() { best } else { (j, r) })
    }

    /// Scaled residual of a constraint that the rounding of its coordinates can leave, from the last Jacobian: large
    /// where a structure is small against its distance from the origin.
    fn rounding(&self, row: usize, q: &[f64]) -> f64 {
        let entries = self.mechanics.jacobian_pattern().iter().zip(self.system.jacobian());
        let sum: f64 = entries.filter(|((j, _), _)| *j == row).map(|(&(_, i), a)| (a * q[i]).abs()).sum();
        let scale = self.mechanics.constraint_scales().get(row).copied().unwrap_or(1.0);
        4.0 * f64::EPSILON * sum / scale
    }

    /// Systems that needed the pivoting factorisation so far.
    pub fn fallbacks(&self) -> u64 {
        self.system.fallbacks()
    }

    fn factor(&mut self, q: &[f64]) -> Result<(), ProjectionError> {
        let result = self.system.factor(q);
        self.named(result)
    }

    fn solve(&mut self) -> Result<bool, ProjectionError> {
        let result = self.system.solve(&mut self.rhs);
        self.named(result)
    }

    fn named<T>(&self, result: Result<T, SparseError>) -> Result<T, ProjectionError> {
        result.map_err(|source| ProjectionError::solver(self.mechanics, source))
    }

    /// Solves for the correction with the momentum part of the right-hand side in place.
    fn correct_velocity(&mut self, v: &mut [f64]) -> Result<Moved, ProjectionError> {
        let residual = self.solve_for(v, None)?;
        let mut moved = Moved { largest: 0.0, coordinate: 0, iterations: 1, residual };
        for (&i, delta) in self.mechanics.free().iter().zip(&self.rhs) {
            if delta.abs() > moved.largest {
                (moved.largest, moved.coordinate) = (delta.abs(), i);
            }
        }
        Ok(moved)
    }

    /// Corrects the free components of x so that A x = -rates, with the momentum part of the right-hand side in place,
    /// which is replaced by the correction and the multipliers. The largest |A x + rates| left.
    fn solve_for(&mut self, x: &mut [f64], rates: Option<&[f64]>) -> Result<f64, ProjectionError> {
        let n = self.unknowns;
        self.rate_left(x, rates);
        for (rhs, rate) in self.rhs[n..].iter_mut().zip(&self.phi) {
            *rhs = -rate;
        }
        let checked = self.solve()?;
        for &Run { coordinate, unknown, len } in self.system.layout().runs() {
            let changes = &self.rhs[unknown..unknown + len];
            x[coordinate..coordinate + len].iter_mut().zip(changes).for_each(|(x, change)| *x += change);
        }
        let (left, size) = self.rate_left(x, rates);
        if checked || left <= RATE_LEFT * size {
            return Ok(left);
        }
        self.refine(x, rates)
    }

    /// Once more for what a solve without checks left, by the same factors, then by factors with every check.
    #[cold]
    fn refine(&mut self, x: &mut [f64], rates: Option<&[f64]>) -> Result<f64, ProjectionError> {
        let n = self.unknowns;
        self.first.copy_from_slice(&self.rhs);
        let mut left = f64::INFINITY;
        for robust in [false, true] {
            if robust {
                let result = self.system.factor_robustly();
                self.named(result)?;
            }
            self.rhs[..n].fill(0.0);
            for (rhs, rate) in self.rhs[n..].iter_mut().zip(&self.phi) {
                *rhs = -rate;
            }
            self.solve()?;
            for (&i, delta) in self.mechanics.free().iter().zip(&self.rhs) {
                x[i] += delta;
            }
            self.first.iter_mut().zip(&self.rhs).for_each(|(sum, x)| *sum += x);
            let size;
            (left, size) = self.rate_left(x, rates);
            if left <= RATE_ACCEPTED * size {
                break;
            }
        }
        self.rhs.copy_from_slice(&self.first);
        Ok(left)
    }

    /// A x + rates into `phi`: the largest of them, and the largest sum of the magnitudes of its terms.
    fn rate_left(&mut self, x: &[f64], rates: Option<&[f64]>) -> (f64, f64) {
        let size = self.jacobian.product(self.system.jacobian(), x, &mut self.phi);
        let mut largest = 0.0_f64;
        if let Some(rates) = rates {
            self.phi.iter_mut().zip(rates).for_each(|(sum, rate)| *sum += rate);
        }
        for rate in &self.phi {
            largest = if rate.abs() > largest { rate.abs() } else { largest };
        }
        (largest, size)
    }
}

fn largest_change(free: &[usize], from: &[f64], to: &[f64]) -> (usize, f64) {
    free.iter().fold((0, 0.0), |best, &i| {
        let change = (to[i] - from[i]).abs();
        if change > best.1 { (i, change) } else { best }
    })
}
