//! Mass matrix and constraints as one linear system: what projections and explicit steps solve.
//!
//! ```text
//! [M -Aᵀ] [x]   [f]
//! [A   0] [y] = [g]        M constant, A = A(q), free components
//! ```

use tg_sparse::{Row, SaddlePattern, SaddleSystem, SparseError, SymmetricSystem};

use crate::layout::Layout;
use crate::mechanics::Mechanics;

/// Part of its gradient by which a constraint must differ from the others: some √ε. Branches that meet in a singular pose are as far
/// apart as it is away; nearer than this rounding decides along which of them the structure goes on.
const SINGULAR: f64 = 1e-7;

/// `[M -Aᵀ; A 0]` of a system, its factors and buffers; factored at one configuration after another.
pub struct InertialSystem<'m> {
    mechanics: &'m dyn Mechanics,
    layout: Layout,
    system: SymmetricSystem,
    /// Takes over where M is singular or A nearly rank deficient; made when that first happens.
    robust: Option<Box<SaddleSystem>>,
    /// Whether the present factors are those of the robust system.
    is_robust: bool,
    pattern: SaddlePattern,
    mass: Vec<f64>,
    jacobian: Vec<f64>,
}

impl<'m> InertialSystem<'m> {
    /// The system of a structure.
    ///
    /// # Errors
    /// The pattern cannot be analysed.
    pub fn new(mechanics: &'m dyn Mechanics) -> Result<Self, SparseError> {
        let layout = Layout::new(mechanics);
        let pattern: Vec<_> = mechanics.mass().iter().map(|e| (e.row, e.col)).collect();
        let pattern = layout.saddle(mechanics, &[&pattern])?;
        let mass: Vec<f64> = mechanics.mass().iter().map(|e| e.value).collect();
        Ok(Self {
            system: SymmetricSystem::new(pattern.clone(), &[&mass]),
            robust: None,
            is_robust: false,
            pattern,
            jacobian: vec![0.0; mechanics.jacobian_pattern().len()],
            mass,
            layout,
            mechanics,
        })
    }

    /// The structure.
    pub fn mechanics(&self) -> &'m dyn Mechanics {
        self.mechanics
    }

    /// The numbering of the unknowns x; the multipliers y follow them.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Number of unknowns and multipliers.
    pub fn size(&self) -> usize {
        self.pattern.size()
    }

    /// Values of A where it was factored last, in the order of [`Mechanics::jacobian_pattern`].
    pub fn jacobian(&self) -> &[f64] {
        &self.jacobian
    }

    /// Solved with pivoting so far.
    pub fn fallbacks(&self) -> u64 {
        self.robust.as_ref().map_or(0, |robust| robust.counts().fallbacks)
    }

    /// Factors at full coordinates `q`.
    ///
    /// # Errors
    /// The matrix is singular or not finite, or all but singular: a pose in which constraints lose their rank.
    pub fn factor(&mut self, q: &[f64]) -> Result<(), SparseError> {
        self.mechanics.jacobian(q, &mut self.jacobian);
        self.is_robust = false;
        match self.system.factor(&self.jacobian) {
            Ok(()) => Ok(()),
            Err(weak) => {
                self.factor_robustly()?;
                match weak.row() {
                    Some(row @ Row::Multiplier(_)) => self.check_rank(row),
                    _ => Ok(()),
                }
            }
        }
    }

    /// Refuses a pose in which a displacement of size one changes no constraint by more than [`SINGULAR`], all else being held.
    /// `row` is where elimination first lost digits.
    #[cold]
    fn check_rank(&mut self, row: Row) -> Result<(), SparseError> {
        let n = self.layout.unknowns();
        let mut changes = vec![0.0; self.size()];
        for (&(constraint, coordinate), a) in self.mechanics.jacobian_pattern().iter().zip(&self.jacobian) {
            if self.layout.unknown(coordinate).is_some() {
                changes[n + constraint] += a * a;
            }
        }
        // Each by the size of its gradient, with irregular shares: no symmetry is to hide the weak direction.
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        for (j, change) in changes[n..].iter_mut().enumerate() {
            *change = change.sqrt() * (0.5 + (golden * j as f64).fract());
        }
        self.solve(&mut changes)?;
        let largest = changes[..n].iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        if largest * SINGULAR < 1.0 { Ok(()) } else { Err(SparseError::Singular { row }) }
    }

    /// Factors where [`InertialSystem::factor`] did last, with every check and with pivoting if need be.
    ///
    /// # Errors
    /// The matrix is singular or not finite.
    pub fn factor_robustly(&mut self) -> Result<(), SparseError> {
        let robust = self.robust.get_or_insert_with(|| Box::new(SaddleSystem::new(self.pattern.clone())));
        robust.clear_leading();
        robust.add_leading(0, 1.0, &self.mass);
        robust.set_jacobian(&self.jacobian, &self.jacobian);
        self.is_robust = true;
        robust.factor()
    }

    /// Replaces `[f; g]` by `[x; y]`. Away from singular configurations the solution is not checked: see that A x = g.
    /// Whether it was.
    ///
    /// # Errors
    /// The matrix is singular.
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<bool, SparseError> {
        match &mut self.robust {
            Some(robust) if self.is_robust => robust.solve(rhs).map(|_| true),
            _ => {
                self.system.solve(rhs);
                Ok(false)
            }
        }
    }
}
