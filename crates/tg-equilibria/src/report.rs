//! What a search for all equilibria found, and what supports that it is all.

use tg_homotopy::SingularSolution;
use tg_statics::Configuration;

/// A real solution of the polynomial form.
#[derive(Clone, Debug)]
pub struct RealEquilibrium {
    /// Coordinates, inputs, multipliers and residual.
    pub configuration: Configuration,
    /// Length of each cable \[m\], negative where the solution takes the root -d for the distance d: such a solution is
    /// real, but no equilibrium.
    pub lengths: Vec<f64>,
    /// All lengths are positive: an equilibrium of two-way springs.
    pub physical: bool,
    /// Physical, and no cable that only pulls is shorter than its rest length.
    pub taut: bool,
    /// Potential energy \[J\] with distances as they are.
    pub energy: f64,
    /// Negative eigenvalues of the reduced Hessian of a physical equilibrium.
    pub negative: Option<usize>,
    /// Physical, and the Hessian is positive definite.
    pub stable: bool,
    /// Relative radius of the certified disc around the solution.
    pub radius: f64,
}

/// All solutions, counted; the real ones in full.
#[derive(Clone, Debug)]
pub struct EquilibriaReport {
    /// Paths that were followed: the start system's count, or the generic instance's.
    pub paths: usize,
    /// Regular finite complex solutions.
    pub finite: usize,
    /// Singular finite solutions.
    pub singular: Vec<SingularSolution>,
    /// Paths that ended at infinity.
    pub at_infinity: usize,
    /// Paths that failed: while there is one, a solution may be missing.
    pub failed: usize,
    /// Solutions with a proof of existence and uniqueness in their disc, pairwise different.
    pub certified: usize,
    /// Certified solutions that are neither proved real nor proved complex.
    pub undecided: usize,
    /// Solutions without proof.
    pub rejected: usize,
    /// Largest relative radius of a certified disc.
    pub largest_radius: f64,
    /// Real solutions, energy ascending.
    pub equilibria: Vec<RealEquilibrium>,
}

impl EquilibriaReport {
    /// Equilibria with positive lengths.
    pub fn physical(&self) -> impl Iterator<Item = &RealEquilibrium> {
        self.equilibria.iter().filter(|e| e.physical)
    }

    /// Stable equilibria.
    pub fn stable(&self) -> impl Iterator<Item = &RealEquilibrium> {
        self.equilibria.iter().filter(|e| e.stable)
    }

    /// Σ (-1)^negative over physical equilibria: the Euler characteristic of the space of configurations where the energy is
    /// smooth (zero for the angles of planar linkages without loops), a check that costs nothing.
    pub fn index_sum(&self) -> i64 {
        self.physical().filter_map(|e| e.negative).map(|n| if n % 2 == 0 { 1 } else { -1 }).sum()
    }

    /// Whether every path is accounted for: none failed, every finite solution is certified and known to be real or not.
    pub fn is_complete(&self) -> bool {
        self.failed == 0 && self.rejected == 0 && self.undecided == 0 && self.certified == self.finite
    }
}
