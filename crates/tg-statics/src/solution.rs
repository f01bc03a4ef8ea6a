//! What inverse statics gives: a set of solutions, and one of them.

use crate::cutting_list::CuttingRow;
use crate::rank::Rank;
use crate::request::{Goal, Unknown};

/// All values of the unknowns that hold the configuration: x = particular + Σ w_k null_space_k.
#[derive(Clone, Debug)]
pub struct SolutionSet {
    /// Which unknowns.
    pub unknown: Unknown,
    /// Rank of B_x over the unknowns that are not given, ties applied.
    pub rank: Rank,
    /// Solution of minimum norm among the unknowns that are not given, all cables.
    pub particular: Vec<f64>,
    /// Number of directions in which the solution may change, zero where it is unique.
    pub freedom: usize,
    /// Those directions, orthonormal, all cables. Their matrix is dense: for large structures
    /// [`InverseStatics::solve`](crate::InverseStatics::solve) does without and leaves it empty, as it does the singular
    /// values of the rank, which is then counted down to 1e-6 of the largest.
    pub null_space: Vec<Vec<f64>>,
    /// Largest residual force per largest force.
    pub residual: f64,
}

/// One choice of rest lengths, and what follows from it.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Tension f \[N\] of each cable, positive when it pulls.
    pub tensions: Vec<f64>,
    /// Force density γ = f/l \[N/m\] of each cable.
    pub force_densities: Vec<f64>,
    /// Rest length μ \[m\] of each cable: the inputs that hold the configuration.
    pub rest_lengths: Vec<f64>,
    /// Cables whose law only pulls and that would have to push: the configuration cannot be held so.
    pub pushing: Vec<usize>,
    /// The set that the answer was chosen from.
    pub set: SolutionSet,
    pub(crate) lengths: Vec<f64>,
    pub(crate) names: Vec<String>,
}

impl SolutionSet {
    /// Coordinates w of the solution that is nearest to a goal's values.
    pub(crate) fn nearest(&self, goal: &Goal) -> Vec<f64> {
        let Goal::Closest(values) = goal else { return vec![0.0; self.null_space.len()] };
        let along = |z: &Vec<f64>| {
            let apart = values.iter().zip(&self.particular).map(|(t, x)| t - x);
            z.iter().zip(apart).map(|(z, a)| z * a).sum()
        };
        self.null_space.iter().map(along).collect()
    }
}

impl Answer {
    /// What a workshop needs: each cable with its length, rest length, tension and strain.
    pub fn cutting_list(&self) -> Vec<CuttingRow> {
        let row = |c: usize| CuttingRow {
            cable: self.names[c].clone(),
            length: self.lengths[c],
            rest_length: self.rest_lengths[c],
            tension: self.tensions[c],
            strain: (self.lengths[c] - self.rest_lengths[c]) / self.rest_lengths[c],
        };
        (0..self.lengths.len()).map(row).collect()
    }

    /// The inputs that hold the configuration: these rest lengths, and the loads of `u`.
    pub fn inputs(&self, u: &[f64]) -> Vec<f64> {
        self.rest_lengths.iter().chain(&u[self.rest_lengths.len()..]).copied().collect()
    }
}
