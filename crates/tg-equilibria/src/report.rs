//! What a search for all equilibria found, and what supports that it is all.

use std::fmt;

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

/// Where the paths began: what the number of solutions is held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// A start system with at least as many solutions as the polynomial form can have: if no path fails, none is missing.
    StartSystem,
    /// The generic solutions of a [`Family`](crate::Family): none is missing if none was missing there.
    Family,
}

/// All solutions, counted; the real ones in full.
///
/// What supports that they are all: [`EquilibriaReport::accounts_for_all`] for the paths, the sum of the indices, and for a
/// family [`Family::evidence`](crate::Family::evidence), which uses neither. Each solution has a proof; that there is no
/// other has none.
#[derive(Clone, Debug)]
pub struct EquilibriaReport {
    /// Where the paths began.
    pub origin: Origin,
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
    /// Paths that were followed again with tighter settings, since they had failed or met another one.
    pub retracked: usize,
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
    /// What [`EquilibriaReport::index_sum`] must be, where it is known: the Euler characteristic of the space of
    /// configurations, for a structure that is a tree of pivoted members with springs of zero free length.
    pub euler_characteristic: Option<i64>,
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

    /// Σ (-1)^negative over physical equilibria. A smooth potential on a space without boundary makes it the Euler
    /// characteristic (Poincaré and Hopf); where a spring with free length can have no length, the potential has a cone,
    /// and each cone that is a peak counts as a maximum that is missing here.
    pub fn index_sum(&self) -> i64 {
        self.physical().filter_map(|e| e.negative).map(|n| if n % 2 == 0 { 1 } else { -1 }).sum()
    }

    /// Whether every path is accounted for: none failed, every finite solution is certified and known to be real or not,
    /// and the indices add up where their sum is known.
    pub fn accounts_for_all(&self) -> bool {
        self.failed == 0
            && self.rejected == 0
            && self.undecided == 0
            && self.certified == self.finite
            && self.euler_characteristic.is_none_or(|expected| expected == self.index_sum())
    }
}

impl fmt::Display for EquilibriaReport {
    /// Counts and what supports them, then a line for each physical equilibrium.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { paths, at_infinity, failed, retracked, certified, undecided, rejected, .. } = self;
        let (singular, real) = (self.singular.len(), self.equilibria.len());
        let origin = match self.origin {
            Origin::StartSystem => "of a start system",
            Origin::Family => "from generic solutions",
        };
        writeln!(f, "{paths} paths {origin}, {retracked} of them followed again:")?;
        writeln!(f, "{at_infinity} to infinity, {failed} lost, {singular} singular ends")?;
        writeln!(
            f,
            "{certified} solutions certified, {undecided} of them perhaps real; {rejected} without proof"
        )?;
        let (physical, stable) = (self.physical().count(), self.stable().count());
        writeln!(f, "{real} real, {physical} physical, {stable} stable; index sum {}", self.index_sum())?;
        for e in self.physical() {
            let index = e.negative.map_or("no equilibrium".into(), |n| format!("{n} negative"));
            let kind = if e.stable { "stable" } else { &index };
            let taut = if e.taut { "" } else { ", a cable that only pulls is short" };
            writeln!(f, "  energy {:.12e} J  {kind}{taut}", e.energy)?;
        }
        Ok(())
    }
}
