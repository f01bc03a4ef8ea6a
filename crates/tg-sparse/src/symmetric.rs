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

use bytemuck::{cast_slice, cast_slice_mut};

use crate::error::SparseError;
use crate::kernels::LANES;
use crate::ldlt::{Lanes, Ldlt, LdltLayout, Matrix};
use crate::pattern::SaddlePattern;

/// `[M, −Aᵀ; A, 0]` with a constant symmetric M: values, factors and every buffer. Made once, then factored and solved
/// again and again without allocation.
#[derive(Clone, Debug)]
pub struct SymmetricSystem {
    pattern: SaddlePattern,
    layout: LdltLayout,
    /// Where entries of A go, ascending, and which; the last slots of all take the entries outside of the system.
    slots: Vec<(u32, u32)>,
    /// Fronts that hold M and nothing else.
    constant: Vec<Lanes>,
    /// Magnitudes on their diagonal.
    diagonal: Vec<Lanes>,
    ldlt: Ldlt,
    /// Where each unknown, then each multiplier stands in `work`.
    places: Vec<u32>,
    work: Vec<Lanes>,
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
        let panel_slots = layout.slots(&pattern);
        let outside = layout.outside();
        let mut panels = vec![Lanes::ZERO; layout.panels_len() / LANES];
        let constant: &mut [f64] = cast_slice_mut(&mut panels);
        assert_eq!(leading.len(), pattern.slots.leading.len(), "leading groups");
        for (values, slots) in leading.iter().zip(&pattern.slots.leading) {
            assert_eq!(values.len(), slots.len(), "values of a leading group");
            for (value, &slot) in values.iter().zip(slots) {
                constant[panel_slots[slot as usize] as usize] += value;
            }
        }
        // Entries below the diagonal went there too.
        constant[outside as usize] = 0.0;
        let mut diagonal = vec![Lanes::ZERO; layout.vector_len() / LANES];
        let magnitudes: &mut [f64] = cast_slice_mut(&mut diagonal);
        for (place, at) in layout.diagonal().into_iter().enumerate() {
            let entry = &mut constant[at as usize];
            if layout.is_idle(place) {
                *entry = 1.0;
            }
            magnitudes[place] = entry.abs();
        }
        let above = |(&upper, &lower): (&u32, &u32)| {
            let (upper, lower) = (panel_slots[upper as usize], panel_slots[lower as usize]);
            if upper == outside { lower } else { upper }
        };
        let slots = pattern.slots.upper.iter().zip(&pattern.slots.lower).map(above);
        let mut slots: Vec<(u32, u32)> = slots.zip(0..).collect();
        slots.sort_unstable();
        Self {
            ldlt: Ldlt::new(&layout),
            places: layout.variables(&pattern.symbolic),
            work: vec![Lanes::ZERO; layout.vector_len() / LANES],
            slots,
            constant: panels,
            diagonal,
            layout,
            pattern,
        }
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
        let matrix = Matrix::new(&self.constant, &self.diagonal, &self.slots, jacobian);
        self.ldlt.factor(matrix, &self.pattern.symbolic, &self.layout).map_err(|trouble| SparseError::Pivot {
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
        // Second rows are negated.
        let (unknowns, multipliers) = self.places.split_at(self.pattern.n);
        let work: &mut [f64] = cast_slice_mut(&mut self.work);
        for (&place, &value) in unknowns.iter().zip(&*rhs) {
            work[place as usize] = value;
        }
        for (&place, &value) in multipliers.iter().zip(&rhs[self.pattern.n..]) {
            work[place as usize] = -value;
        }
        self.ldlt.solve(&self.layout, &mut self.work);
        let work: &[f64] = cast_slice(&self.work);
        for (&place, value) in self.places.iter().zip(rhs) {
            *value = work[place as usize];
        }
    }
}
