//! Which unknown each coordinate is, and the saddle-point pattern that follows.

use tg_sparse::{Row, SaddlePattern, SparseError};

use crate::mechanics::Mechanics;

/// The numbering of free coordinates as unknowns of the solvers' systems.
#[derive(Clone, Debug)]
pub struct Layout {
    unknown: Vec<Option<usize>>,
    free: Vec<usize>,
    runs: Vec<Run>,
    constraints: usize,
}

/// Free coordinates that follow each other.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The first coordinate.
    pub coordinate: usize,
    /// The unknown that it is.
    pub unknown: usize,
    /// How many.
    pub len: usize,
}

impl Layout {
    /// Numbers the free coordinates of a system in their order.
    pub fn new(mechanics: &dyn Mechanics) -> Self {
        let sizes = mechanics.sizes();
        let mut unknown = vec![None; sizes.coordinates];
        for (k, &i) in mechanics.free().iter().enumerate() {
            unknown[i] = Some(k);
        }
        let mut runs: Vec<Run> = Vec::new();
        for (unknown, &coordinate) in mechanics.free().iter().enumerate() {
            match runs.last_mut() {
                Some(run) if run.coordinate + run.len == coordinate => run.len += 1,
                _ => runs.push(Run { coordinate, unknown, len: 1 }),
            }
        }
        Self { unknown, free: mechanics.free().to_vec(), runs, constraints: sizes.constraints }
    }

    /// The free coordinates in runs: loops over runs of two slices need no index.
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// The unknown that a coordinate is; `None` for prescribed ones.
    pub fn unknown(&self, coordinate: usize) -> Option<usize> {
        self.unknown[coordinate]
    }

    /// Number of unknown coordinates.
    pub fn unknowns(&self) -> usize {
        self.free.len()
    }

    /// Pattern of `[H -Aᵀ; A 0]` whose leading block sums the groups of (row, column) entries, all in full
    /// coordinates; entries of prescribed coordinates fall out.
    ///
    /// # Errors
    /// A constraint without free coordinate, or a size beyond 32 bits.
    pub fn saddle(
        &self,
        mechanics: &dyn Mechanics,
        groups: &[&[(usize, usize)]],
    ) -> Result<SaddlePattern, SparseError> {
        let leading: Vec<Vec<_>> = groups
            .iter()
            .map(|group| group.iter().map(|&(r, c)| self.unknown[r].zip(self.unknown[c])).collect())
            .collect();
        let leading: Vec<&[_]> = leading.iter().map(Vec::as_slice).collect();
        let jacobian: Vec<_> =
            mechanics.jacobian_pattern().iter().map(|&(row, c)| self.unknown[c].map(|k| (row, k))).collect();
        SaddlePattern::new(self.unknowns(), self.constraints, &leading, &jacobian)
    }

    /// The user's name of the equation that a solver's error is about.
    pub fn name(&self, mechanics: &dyn Mechanics, error: &SparseError) -> String {
        match error.row() {
            Some(Row::Unknown(k)) => mechanics.coordinate_name(self.free[k]),
            Some(Row::Multiplier(j)) => mechanics.constraint_name(j),
            None => "the structure as a whole".into(),
        }
    }
}
