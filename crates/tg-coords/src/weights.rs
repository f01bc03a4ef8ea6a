//! Scalar linear forms over the nodes of a member.
//!
//! ```text
//! r = C q,   C = wᵀ ⊗ I_D,   r = Σ_a w_a q_a                                  (14)-(16)
//! ```
//!
//! A material point has the standard weights `[1, cᵀ]`, a vector fixed in the member `[0, cᵀ]`; those
//! of any other type follow by `wᵀ ← wᵀ y` (eq. 15).

use nalgebra::SVector;

use crate::NodeMatrix;
use crate::coord_type::MAX_NODES;

/// Linear form `Σ w_a q_a` over the nodes of one member, dimensionless, one weight per node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weights {
    values: [f64; MAX_NODES],
    len: usize,
}

impl Weights {
    /// The form that picks `node` out of `len` nodes.
    ///
    /// # Panics
    /// Unless `node < len ≤` [`MAX_NODES`].
    #[track_caller]
    pub fn unit(node: usize, len: usize) -> Self {
        assert!(node < len && len <= MAX_NODES, "node {node} of {len}");
        let mut values = [0.0; MAX_NODES];
        values[node] = 1.0;
        Self { values, len }
    }

    /// The form with the given weights.
    ///
    /// # Panics
    /// If there are more than [`MAX_NODES`].
    #[track_caller]
    pub fn from_slice(weights: &[f64]) -> Self {
        assert!(weights.len() <= MAX_NODES, "{} weights", weights.len());
        let mut values = [0.0; MAX_NODES];
        values[..weights.len()].copy_from_slice(weights);
        Self { values, len: weights.len() }
    }

    /// One weight per node, in the order of the nodes.
    pub fn as_slice(&self) -> &[f64] {
        &self.values[..self.len]
    }

    /// Value `Σ w_a q_a`: a position \[m\] of positions, a velocity \[m/s\] of velocities.
    ///
    /// # Panics
    /// If there is not one node per weight.
    #[track_caller]
    pub fn apply<const D: usize>(&self, nodes: &[SVector<f64, D>]) -> SVector<f64, D> {
        assert_eq!(nodes.len(), self.len, "nodes against weights");
        self.as_slice().iter().zip(nodes).fold(SVector::zeros(), |sum, (&weight, node)| sum + node * weight)
    }

    /// Adds the generalised force `Cᵀ f` of a force f at the point: `forces[a] += w_a f`.
    ///
    /// # Panics
    /// If there is not one force per weight.
    #[track_caller]
    pub fn spread<const D: usize>(&self, force: &SVector<f64, D>, forces: &mut [SVector<f64, D>]) {
        assert_eq!(forces.len(), self.len, "forces against weights");
        for (&weight, sum) in self.as_slice().iter().zip(forces) {
            *sum += force * weight;
        }
    }

    /// `wᵀ y`: the same form over other nodes, of which the present ones are `y` (eq. 15).
    pub(crate) fn times(&self, y: &NodeMatrix) -> Self {
        let mut values = [0.0; MAX_NODES];
        for (row, &weight) in self.as_slice().iter().enumerate() {
            for (sum, &entry) in values.iter_mut().zip(y.row(row)) {
                *sum += weight * entry;
            }
        }
        Self { values, len: self.len }
    }
}
