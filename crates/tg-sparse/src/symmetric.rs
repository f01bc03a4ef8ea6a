//! Symmetric saddle-point systems with a constant leading block: one new Jacobian, one factorisation, a few solves.
//!
//! ```text
//! [ M  −Aᵀ ] [x]   [f]          [  M  −Aᵀ ]
//! [ A   0  ] [y] = [g]    as    [ −A   0  ] = L D Lᵀ,   second rows negated
//! ```
//!
//! Projections onto constraints and explicit time steps solve this system at every step: M never changes, and both
//! Jacobian blocks are the same. Against [`SaddleSystem`](crate::SaddleSystem) half of the arithmetic and all of the
//! bookkeeping is saved: M is kept where the factorisation wants it, and a solve checks nothing. Whoever uses it must
//! look at a residual of his own.

use crate::error::SparseError;
use crate::ldlt::{Ldlt, LdltLayout};
use crate::pattern::SaddlePattern;

/// `[M, −Aᵀ; A, 0]` with a constant symmetric M: values, factors and every buffer. Made once, then factored and solved
/// again and again without allocation.
#[derive(Clone, Debug)]
pub struct SymmetricSystem {
    pattern: SaddlePattern,
    layout: LdltLayout,
    /// Where each entry of A goes; the last slot of all takes the entries outside of the system.
    slots: Vec<u32>,
    /// Fronts that hold M and nothing else.
    constant: Vec<f64>,
    ldlt: Ldlt,
    work: Vec<f64>,
}

impl SymmetricSystem {
    /// A system of this pattern with the values of M, one slice for each leading group of the pattern in its order of
    /// entries. Only the upper triangle of M is read.
    ///
    /// # Panics
    /// When a group has another number of entries.
    #[must_use]
    #[track_caller]
    pub fn new(pattern: SaddlePattern, leading: &[&[f64]]) -> Self {
        let layout = LdltLayout::new(&pattern.symbolic);
        let places = layout.places(&pattern);
        let mut constant = vec![0.0; layout.len() + 1];
        assert_eq!(leading.len(), pattern.slots.leading.len(), "leading groups");
        for (values, slots) in leading.iter().zip(&pattern.slots.leading) {
            assert_eq!(values.len(), slots.len(), "values of a leading group");
            for (value, &slot) in values.iter().zip(slots) {
                constant[places[slot as usize] as usize] += value;
            }
        }
        // Entries below the diagonal went into the last place too.
        constant[layout.len()] = 0.0;
        let above = |(&upper, &lower): (&u32, &u32)| {
            let outside = layout.len() as u32;
            if places[upper as usize] == outside { places[lower as usize] } else { places[upper as usize] }
        };
        let slots = pattern.slots.upper.iter().zip(&pattern.slots.lower).map(above).collect();
        Self { ldlt: Ldlt::new(&layout), work: vec![0.0; pattern.size()], slots, constant, layout, pattern }
    }

    /// Factors with these values of A, one for each entry of the pattern's Jacobian.
    ///
    /// # Errors
    /// [`SparseError::Pivot`] for a pivot that is not finite or has lost six of its digits: M is singular, A close to
    /// rank deficient. [`SaddleSystem`](crate::SaddleSystem) may still solve it.
    ///
    /// # Panics
    /// When the slice has another length.
    #[track_caller]
    pub fn factor(&mut self, jacobian: &[f64]) -> Result<(), SparseError> {
        assert_eq!(jacobian.len(), self.slots.len(), "values of the Jacobian");
        let panels = self.ldlt.start(&self.constant);
        for (&slot, value) in self.slots.iter().zip(jacobian) {
            panels[slot as usize] -= value;
        }
        self.ldlt.factor(&self.pattern.symbolic, &self.layout).map_err(|trouble| SparseError::Pivot {
            row: self.pattern.row_at(trouble.position),
            pivot: trouble.pivot,
            scale: trouble.scale,
        })
    }

    /// Solves with the present factors: `rhs` holds `[f; g]` on entry and `[x; y]` on return. Nothing is checked.
    ///
    /// # Panics
    /// When the slice has another length than n + m.
    #[track_caller]
    pub fn solve(&mut self, rhs: &mut [f64]) {
        assert_eq!(rhs.len(), self.pattern.size(), "length of the right-hand side");
        let (n, order) = (self.pattern.n, &self.pattern.symbolic.order);
        for (x, &variable) in self.work.iter_mut().zip(order) {
            let value = rhs[variable as usize];
            *x = if (variable as usize) < n { value } else { -value };
        }
        self.ldlt.solve(&self.pattern.symbolic, &self.layout, &mut self.work);
        for (x, &variable) in self.work.iter().zip(order) {
            rhs[variable as usize] = *x;
        }
    }
}
