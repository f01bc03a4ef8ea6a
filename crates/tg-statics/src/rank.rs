//! Rank of a matrix with the evidence for it.

/// Singular values below this part of the largest count as zero unless the caller says otherwise. Coordinates known to
/// machine precision leave zeros below 1e-14; those of published structures, rounded, leave them at 1e-4 and need a
/// looser tolerance: the gap tells.
pub(crate) const TOLERANCE: f64 = 1e-9;

/// Rank of a matrix by its singular values.
#[derive(Clone, Debug, PartialEq)]
pub struct Rank {
    /// The rank: singular values above the tolerance.
    pub rank: usize,
    /// All singular values, descending, dimensionless where the matrix is.
    pub singular_values: Vec<f64>,
    /// Part of the largest singular value below which the others count as zero.
    pub tolerance: f64,
}

impl Rank {
    pub(crate) fn new(singular_values: Vec<f64>, tolerance: f64) -> Self {
        let limit = tolerance * singular_values.first().copied().unwrap_or(0.0);
        let rank = singular_values.iter().filter(|&&s| s > limit).count();
        Self { rank, singular_values, tolerance }
    }

    /// The smallest singular value that counts and the largest that does not, each per the largest of all: the wider
    /// this gap, the surer the rank. `None` for a value that does not exist.
    pub fn gap(&self) -> (Option<f64>, Option<f64>) {
        let share = |k: usize| Some(self.singular_values.get(k)? / self.singular_values.first()?);
        (self.rank.checked_sub(1).and_then(share), share(self.rank))
    }
}
