//! A saddle-point system with its values, factors and buffers.
//!
//! ```text
//! [ H   −A₀ᵀ ] [x]   [f]
//! [ A₁    0  ] [y] = [g]
//! ```
//!
//! The linear system of each Newton step on eq. (54) with the Jacobian (55): `H = M̌ − h²/2 ∂F̌/∂q̌`, `A₀ = Ǎ(q_k)`,
//! `A₁ = Ǎ(q_{k+1})`.

use crate::block_inverse::BlockInverse;
use crate::error::SparseError;
use crate::inertia::{Inertia, from_pivots};
use crate::pattern::SaddlePattern;
use crate::pivot::{PivotRule, PivotTrouble};
#[cfg(feature = "pivoting")]
use crate::pivoting::PivotingLu;
use crate::refinement::{Outcome, Vectors, stands_probe};
use crate::static_lu::StaticLu;

/// What a solve did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolveReport {
    /// Componentwise backward error `max_i |b − K x|_i / (|K| |x| + |b|)_i` of the solution returned.
    pub residual: f64,
    /// Steps of iterative refinement.
    pub refinements: u32,
    /// True when the pivoting fallback gave the solution.
    pub fell_back: bool,
}

/// What a system did since it was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Factorisations in the static order.
    pub factorisations: u64,
    /// Calls of `solve` that gave a solution.
    pub solves: u64,
    /// Steps of iterative refinement.
    pub refinements: u64,
    /// Factorisations by the pivoting fallback.
    pub fallbacks: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Factors {
    None,
    Static,
    #[cfg_attr(not(feature = "pivoting"), allow(dead_code))]
    Pivoting,
}

/// A saddle-point system `K [x; y] = [f; g]`, `K = [H, −A₀ᵀ; A₁, 0]`: values, factors and every buffer. Made once, then
/// filled, factored and solved again and again without allocation (the pivoting fallback, rare and counted, allocates).
#[derive(Debug)]
pub struct SaddleSystem {
    pattern: SaddlePattern,
    values: Vec<f64>,
    lu: StaticLu,
    /// The factors in the form that [`SaddleSystem::apply`] wants, made when it is first called.
    blocks: Option<Box<BlockInverse>>,
    /// Whether these are of the present factors.
    has_blocks: bool,
    factors: Factors,
    /// Whether the values are those that were factored.
    is_current: bool,
    counts: Counts,
    vectors: Vectors,
    #[cfg(feature = "pivoting")]
    pivoting: Option<Box<PivotingLu>>,
}

impl SaddleSystem {
    /// A system of this pattern with all values zero.
    #[must_use]
    pub fn new(pattern: SaddlePattern) -> Self {
        let size = pattern.size();
        Self {
            values: vec![0.0; pattern.entries() + 1],
            lu: StaticLu::new(&pattern.symbolic),
            blocks: None,
            has_blocks: false,
            factors: Factors::None,
            is_current: false,
            counts: Counts::default(),
            vectors: Vectors::new(size),
            #[cfg(feature = "pivoting")]
            pivoting: None,
            pattern,
        }
    }

    /// The pattern that the system was made from.
    #[must_use]
    pub fn pattern(&self) -> &SaddlePattern {
        &self.pattern
    }

    /// What the system did since it was made.
    #[must_use]
    pub fn counts(&self) -> &Counts {
        &self.counts
    }

    /// `H ← 0`.
    pub fn clear_leading(&mut self) {
        self.is_current = false;
        for &slot in &self.pattern.slots.leading_slots {
            self.values[slot as usize] = 0.0;
        }
    }

    /// `H ← H + factor · values`, one value for each entry of the group in the pattern's order.
    ///
    /// # Panics
    /// When the pattern has no such group or another number of entries.
    #[track_caller]
    pub fn add_leading(&mut self, group: usize, factor: f64, values: &[f64]) {
        let groups = &self.pattern.slots.leading;
        assert!(group < groups.len(), "leading group {group} of {}", groups.len());
        let slots = &groups[group];
        assert_eq!(values.len(), slots.len(), "values of leading group {group}");
        self.is_current = false;
        for (&slot, value) in slots.iter().zip(values) {
            self.values[slot as usize] += factor * value;
        }
    }

    /// Sets both Jacobian blocks: `upper` = values of `A₀`, which enters as `−A₀ᵀ`, `lower` = values of `A₁`, one for
    /// each entry in the pattern's order.
    ///
    /// # Panics
    /// When a slice has another length than the pattern's Jacobian list.
    #[track_caller]
    pub fn set_jacobian(&mut self, upper: &[f64], lower: &[f64]) {
        let slots = &self.pattern.slots;
        assert_eq!(upper.len(), slots.upper.len(), "values of the upper Jacobian");
        assert_eq!(lower.len(), slots.lower.len(), "values of the lower Jacobian");
        self.is_current = false;
        if slots.jacobian_repeats {
            for &slot in slots.upper.iter().chain(&slots.lower) {
                self.values[slot as usize] = 0.0;
            }
            for (&slot, value) in slots.upper.iter().zip(upper) {
                self.values[slot as usize] -= value;
            }
            for (&slot, value) in slots.lower.iter().zip(lower) {
                self.values[slot as usize] += value;
            }
        } else {
            for (&slot, value) in slots.upper.iter().zip(upper) {
                self.values[slot as usize] = -value;
            }
            for (&slot, &value) in slots.lower.iter().zip(lower) {
                self.values[slot as usize] = value;
            }
        }
    }

    /// `out = K x` with the present values; `x = [x; y]` and `out = [f; g]` in the caller's order.
    ///
    /// # Panics
    /// When a slice has another length than n + m.
    #[track_caller]
    pub fn multiply(&self, x: &[f64], out: &mut [f64]) {
        assert_eq!(x.len(), self.pattern.size(), "length of x");
        assert_eq!(out.len(), self.pattern.size(), "length of out");
        let rows = &self.pattern.slots.rows;
        let order = &self.pattern.symbolic.order;
        for (bounds, &variable) in rows.start().windows(2).zip(order) {
            let columns = &rows.column()[bounds[0]..bounds[1]];
            let values = &self.values[bounds[0]..bounds[1]];
            out[variable as usize] =
                columns.iter().zip(values).map(|(&c, v)| v * x[order[c as usize] as usize]).sum();
        }
    }

    /// Factors the present values in the static order. When a pivot vanishes or is not finite, or is doubtful and does
    /// not stand a probe, the pivoting fallback factors them (feature `pivoting`).
    ///
    /// # Errors
    /// [`SparseError::Singular`] with the fallback, [`SparseError::Pivot`] without it: for a multiplier, its constraint
    /// depends on others. [`SparseError::NonFiniteMatrix`].
    pub fn factor(&mut self) -> Result<(), SparseError> {
        self.counts.factorisations += 1;
        self.factors = Factors::None;
        self.is_current = true;
        self.has_blocks = false;
        let trouble = match self.lu.factor(&self.pattern, &self.values, PivotRule::Check) {
            Ok(()) => self.probe(),
            Err(trouble) => Some(trouble),
        };
        match trouble {
            None => self.factors = Factors::Static,
            Some(PivotTrouble { position, pivot, scale }) => {
                let row = self.pattern.row_at(position);
                self.fall_back(position, SparseError::Pivot { row, pivot, scale })?;
            }
        }
        Ok(())
    }

    /// Solves `K [x; y] = [f; g]` with the present factors: `rhs` holds `[f; g]` on entry and `[x; y]` on return. The
    /// residual is checked and refined. When it stays large, the pivoting fallback takes over (feature `pivoting`)
    /// until the next [`factor`](Self::factor).
    ///
    /// # Errors
    /// [`SparseError::NotFactored`], [`SparseError::NonFiniteVector`], [`SparseError::NonFiniteMatrix`]; a residual that
    /// stays large: [`SparseError::Residual`] without the fallback, [`SparseError::Singular`] with it. `rhs` is unchanged
    /// then.
    ///
    /// # Panics
    /// When `rhs` has another length than n + m.
    #[track_caller]
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<SolveReport, SparseError> {
        assert_eq!(rhs.len(), self.pattern.size(), "length of the right-hand side");
        let mut steps = 0;
        let mut outcome = match self.factors {
            factors if factors != Factors::None && self.is_current => self.refine(factors, rhs),
            _ => return Err(SparseError::NotFactored),
        };
        if !outcome.is_good() {
            if let Some(position) = self.vectors.right.iter().position(|b| !b.is_finite()) {
                return Err(SparseError::NonFiniteVector { row: self.pattern.row_at(position) });
            }
            let row = self.pattern.row_at(outcome.worst);
            if self.factors == Factors::Static {
                steps = outcome.steps;
                self.fall_back(outcome.worst, SparseError::Residual { row, residual: outcome.error })?;
                outcome = self.refine(Factors::Pivoting, rhs);
            }
            if !outcome.is_good() {
                return Err(SparseError::Singular { row: self.pattern.row_at(outcome.worst) });
            }
        }
        for (x, &variable) in self.vectors.solution.iter().zip(&self.pattern.symbolic.order) {
            rhs[variable as usize] = *x;
        }
        let refinements = steps + outcome.steps;
        self.counts.solves += 1;
        self.counts.refinements += u64::from(refinements);
        let fell_back = self.factors == Factors::Pivoting;
        Ok(SolveReport { residual: outcome.error, refinements, fell_back })
    }

    /// Applies the factors of the last [`factor`](Self::factor) as they are, whatever values were set since, and checks
    /// nothing: the correction of an iteration that looks at its own residual, exact to some six digits. The first call after a factorisation does
    /// that work once more, the others take a third of a [`solve`](Self::solve). `rhs` holds `[f; g]` on entry and
    /// `[x; y]` on return.
    ///
    /// # Errors
    /// [`SparseError::NotFactored`]; the pivoting factors fail.
    ///
    /// # Panics
    /// When `rhs` has another length than n + m.
    #[track_caller]
    pub fn apply(&mut self, rhs: &mut [f64]) -> Result<(), SparseError> {
        assert_eq!(rhs.len(), self.pattern.size(), "length of the right-hand side");
        let Self { pattern, lu, vectors, blocks, has_blocks, .. } = self;
        let (order, x) = (&pattern.symbolic.order, &mut vectors.solution);
        let largest = rhs.iter().fold(0.0, |a: f64, b| if b.abs() > a { b.abs() } else { a });
        if largest == 0.0 {
            return if self.factors == Factors::None { Err(SparseError::NotFactored) } else { Ok(()) };
        }
        for (x, &variable) in x.iter_mut().zip(order) {
            *x = rhs[variable as usize] / largest;
        }
        match self.factors {
            Factors::None => return Err(SparseError::NotFactored),
            Factors::Static => {
                let blocks = blocks.get_or_insert_with(|| Box::new(BlockInverse::new(&pattern.symbolic)));
                if !std::mem::replace(has_blocks, true) {
                    blocks.set(&pattern.symbolic, lu.factored());
                }
                blocks.apply(&pattern.symbolic, x);
            }
            #[cfg(feature = "pivoting")]
            Factors::Pivoting => {
                if let Some(pivoting) = &mut self.pivoting {
                    pivoting.solve(x);
                }
            }
            #[cfg(not(feature = "pivoting"))]
            Factors::Pivoting => return Err(SparseError::NotFactored),
        }
        for (x, &variable) in x.iter().zip(order) {
            rhs[variable as usize] = largest * x;
        }
        self.counts.solves += 1;
        Ok(())
    }

    /// Signs of the eigenvalues of `H` on the null space of `A`, from the pivots of the last
    /// [`factor`](Self::factor), if the values are still the same. Meant for symmetric `H` and `A₀ = A₁` of full rank, which is not checked. `None` without
    /// factors, or with those of the pivoting fallback, whose pivots do not tell.
    #[must_use]
    pub fn inertia(&self) -> Option<Inertia> {
        match self.factors {
            Factors::Static if self.is_current => from_pivots(&self.pattern, self.lu.reciprocal_pivots()),
            _ => None,
        }
    }

    /// Solves and refines; the solution stays in `vectors`.
    fn refine(&mut self, factors: Factors, rhs: &[f64]) -> Outcome {
        let Self { pattern, values, lu, vectors, .. } = self;
        for (b, &variable) in vectors.right.iter_mut().zip(&pattern.symbolic.order) {
            *b = rhs[variable as usize];
        }
        #[cfg(feature = "pivoting")]
        if let (Factors::Pivoting, Some(pivoting)) = (factors, &mut self.pivoting) {
            return vectors.refine(pattern, values, |x| pivoting.solve(x));
        }
        let _ = factors;
        vectors.refine(pattern, values, |x| lu.solve(&pattern.symbolic, x))
    }

    /// Where pivots are doubtful: are the factors good enough to determine those components? Rounding error in place of
    /// a pivot that vanishes makes the solution in that direction arbitrary; solving for the residual tells.
    fn probe(&mut self) -> Option<PivotTrouble> {
        let Self { pattern, values, lu, vectors, .. } = self;
        if lu.doubtful.is_empty() {
            return None;
        }
        vectors.right.fill(0.0);
        for &position in &lu.doubtful {
            vectors.right[position as usize] = 1.0;
        }
        let (solution, correction) =
            vectors.solve_and_correct(pattern, values, |x| lu.solve(&pattern.symbolic, x));
        let mut doubtful = lu.doubtful.iter().map(|&position| position as usize);
        let position = doubtful.find(|&position| !stands_probe(solution[position], correction[position]))?;
        Some(lu.pivot(position))
    }

    /// Factors by the pivoting fallback; `position` is where the static order failed.
    #[cfg(feature = "pivoting")]
    fn fall_back(&mut self, position: usize, _failure: SparseError) -> Result<(), SparseError> {
        let Self { pattern, values, vectors, .. } = self;
        self.factors = Factors::None;
        if let Some(row) = pattern.slots.non_finite_row(values) {
            return Err(SparseError::NonFiniteMatrix { row: pattern.row_at(row) });
        }
        self.counts.fallbacks += 1;
        let singular = |position| SparseError::Singular { row: pattern.row_at(position) };
        let pivoting = match &mut self.pivoting {
            Some(pivoting) => pivoting,
            none => none.insert(Box::new(PivotingLu::new(&pattern.slots).ok_or_else(|| singular(position))?)),
        };
        match pivoting.factor(pattern, values, vectors, position) {
            Ok(()) => {
                self.factors = Factors::Pivoting;
                Ok(())
            }
            Err(position) => Err(singular(position)),
        }
    }

    /// Without the fallback, the failure of the static order is the answer.
    #[cfg(not(feature = "pivoting"))]
    fn fall_back(&mut self, _position: usize, failure: SparseError) -> Result<(), SparseError> {
        self.factors = Factors::None;
        match self.pattern.slots.non_finite_row(&self.values) {
            Some(row) => Err(SparseError::NonFiniteMatrix { row: self.pattern.row_at(row) }),
            None => Err(failure),
        }
    }
}
