//! Equilibrium of the cables of large structures: least-norm solutions and rank by sparse saddle-point systems, without a
//! basis of the null space of A.
//!
//! ```text
//! min |y|²,  B y - Aᵀλ = b   ⇔   y = Bᵀξ,   [B Bᵀ  -Aᵀ] [ξ]   [b]
//!                                           [A      0 ] [λ] = [0]        (normal equations of the second kind)
//! ```
//! B spreads the unknowns over the free coordinates. `B Bᵀ + σI` stands for `B Bᵀ`, and the system is solved again for
//! what it leaves of b (iterated Tikhonov regularisation, Golub 1965; Björck 1996, Sec. 2.7.4): mechanisms do no harm
//! then, and the digits that squaring B costs come back. `B Bᵀ` is augmented as the stiffness is
//! ([`tg_tangent::Augmentation`]).

use tg_model::{Layout, Tensioned};
use tg_sparse::{SaddlePattern, SaddleSystem};
use tg_tangent::{Augmentation, TangentError};

/// σ per bound on the largest eigenvalue of B Bᵀ: singular values down to 1e-6 of the largest converge by a digit a step.
const REGULARISATION: f64 = 1e-12;
/// Singular values below this part of the largest count as zero whatever the tolerance: B Bᵀ squares them.
pub(crate) const SMALLEST: f64 = 1e-6;
/// Change per size at which the solution has settled.
const SETTLED: f64 = 1e-14;
const MOST_STEPS: u32 = 20;

const NORMAL: usize = 0;
const AUGMENTATION: usize = 1;
const DIAGONAL: usize = 2;

/// A column of B: (free coordinate, value).
pub(crate) type Column = Vec<(usize, f64)>;

/// Factors for one B at one configuration.
pub(crate) struct SparseEquilibrium<'s> {
    structure: &'s dyn Tensioned,
    layout: Layout,
    columns: Vec<Column>,
    system: SaddleSystem,
    normal: Vec<f64>,
    augmented: Vec<f64>,
    /// Bound on the largest eigenvalue of B Bᵀ.
    largest: f64,
}

impl<'s> SparseEquilibrium<'s> {
    pub(crate) fn new(
        structure: &'s dyn Tensioned,
        q: &[f64],
        columns: Vec<Column>,
    ) -> Result<Self, TangentError> {
        let mechanics = structure.mechanics();
        let layout = Layout::new(mechanics);
        let n = layout.unknowns();
        let (mut places, mut normal, mut row_sums) = (Vec::new(), Vec::new(), vec![0.0; n]);
        for column in &columns {
            for &(r, a) in column {
                for &(c, b) in column {
                    places.push(Some((r, c)));
                    normal.push(a * b);
                    row_sums[r] += (a * b).abs();
                }
            }
        }
        let mut augmentation = Augmentation::new(mechanics);
        let augmented_places: Vec<_> =
            augmentation.pattern.iter().map(|&(r, c)| layout.unknown(r).zip(layout.unknown(c))).collect();
        let diagonal: Vec<_> = (0..n).map(|k| Some((k, k))).collect();
        let pattern = mechanics.jacobian_pattern();
        let places_of_a: Vec<_> =
            pattern.iter().map(|&(row, i)| layout.unknown(i).map(|k| (row, k))).collect();
        let groups: [&[_]; 3] = [&places, &augmented_places, &diagonal];
        let saddle = SaddlePattern::new(n, mechanics.sizes().constraints, &groups, &places_of_a);
        let saddle = saddle.map_err(|source| TangentError::sparse(DOING, &layout, mechanics, source))?;
        let mut system = SaddleSystem::new(saddle);
        let mut jacobian = vec![0.0; pattern.len()];
        mechanics.jacobian(q, &mut jacobian);
        system.set_jacobian(&jacobian, &jacobian);
        let largest = row_sums.into_iter().fold(f64::MIN_POSITIVE, f64::max);
        let mut augmented = Vec::new();
        augmentation.values(mechanics, &jacobian, largest, &mut augmented);
        Ok(Self { structure, layout, columns, system, normal, augmented, largest })
    }

    /// Rank of B on the null space of A: singular values above `tolerance` (at least [`SMALLEST`]) of the largest.
    pub(crate) fn rank(&mut self, tolerance: f64) -> Result<usize, TangentError> {
        let freedom = self.layout.unknowns() - self.structure.sizes().constraints;
        let limit = tolerance.max(SMALLEST).powi(2) * self.largest;
        // Where elimination without pivoting fails, it does so at isolated shifts.
        for factor in [1.0, 1.1, 0.9, 1.3] {
            self.factor(-factor * limit)?;
            if let Some(inertia) = self.system.inertia() {
                return Ok(freedom - inertia.negative.min(freedom));
            }
        }
        Err(TangentError::NoInertia { shift: limit })
    }

    /// The least y for which B y balances `b` up to constraint forces as well as it can.
    pub(crate) fn least(&mut self, b: &[f64]) -> Result<Vec<f64>, TangentError> {
        self.factor(REGULARISATION * self.largest)?;
        let mut y = vec![0.0; self.columns.len()];
        let mut rhs = vec![0.0; self.system.pattern().size()];
        let mut before = f64::INFINITY;
        for _ in 0..MOST_STEPS {
            rhs.fill(0.0);
            rhs[..b.len()].copy_from_slice(b);
            self.subtract(&y, &mut rhs);
            let result = self.system.solve(&mut rhs);
            result.map_err(|source| {
                TangentError::sparse(DOING, &self.layout, self.structure.mechanics(), source)
            })?;
            let (mut change, mut size) = (0.0_f64, 0.0_f64);
            for (y, column) in y.iter_mut().zip(&self.columns) {
                let step = column.iter().map(|&(k, a)| a * rhs[k]).sum::<f64>();
                *y += step;
                (change, size) = (change.max(step.abs()), size.max(y.abs()));
            }
            if change <= SETTLED * size || change > 0.9 * before {
                break;
            }
            before = change;
        }
        Ok(y)
    }

    /// `b -= B y` over the free coordinates.
    pub(crate) fn subtract(&self, y: &[f64], b: &mut [f64]) {
        for (y, column) in y.iter().zip(&self.columns) {
            column.iter().for_each(|&(k, a)| b[k] -= a * y);
        }
    }

    pub(crate) fn columns(&self) -> &[Column] {
        &self.columns
    }

    fn factor(&mut self, shift: f64) -> Result<(), TangentError> {
        self.system.clear_leading();
        self.system.add_leading(NORMAL, 1.0, &self.normal);
        self.system.add_leading(AUGMENTATION, 1.0, &self.augmented);
        self.system.add_leading(DIAGONAL, shift, &vec![1.0; self.layout.unknowns()]);
        let result = self.system.factor();
        result.map_err(|source| TangentError::sparse(DOING, &self.layout, self.structure.mechanics(), source))
    }
}

const DOING: &str = "solving for the tensions of cables";
