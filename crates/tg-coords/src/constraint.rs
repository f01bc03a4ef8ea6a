//! Intrinsic constraints: the member keeps the lengths and angles of its base vectors.
//!
//! ```text
//! Φ_ab(q) = a(q)·b(q) - ā·b̄ = 0,   a, b ∈ {u, v, w}                   (5), (10), (13)
//! ∂Φ/∂q   = wₐᵀ ⊗ bᵀ + w_bᵀ ⊗ aᵀ                (one D-vector per node)
//! ∂²Φ/∂q² = (wₐ w_bᵀ + w_b wₐᵀ) ⊗ I_D           (constant)
//! ```
//!
//! Order of the paper: u·u, v·v, w·w, v·w, u·w, u·v, those that exist. (Eq. 5 prints u·w twice; the
//! sixth is u·v.)

use nalgebra::SVector;

use crate::basis::Basis;
use crate::{CoordType, NodeMatrix, Weights};

const PAIRS: [(usize, usize, &str); 6] =
    [(0, 0, "u·u"), (1, 1, "v·v"), (2, 2, "w·w"), (1, 2, "v·w"), (0, 2, "u·w"), (0, 1, "u·v")];

/// Intrinsic constraint Φ = a(q)·b(q) − ā·b̄ \[m²\] of one member.
#[derive(Clone, Debug, PartialEq)]
pub struct DotConstraint {
    a: Weights,
    b: Weights,
    value: f64,
    scale: f64,
    label: &'static str,
}

impl DotConstraint {
    /// All constraints of a member.
    pub(crate) fn of<const D: usize>(coord_type: CoordType, basis: &Basis<D>) -> Vec<Self> {
        let y = coord_type.conversion();
        let local = basis.vectors();
        PAIRS
            .into_iter()
            .filter(|&(a, b, _)| a.max(b) < local.len())
            .map(|(a, b, label)| Self {
                a: Weights::from_slice(y.row(a + 1)),
                b: Weights::from_slice(y.row(b + 1)),
                value: local[a].dot(&local[b]),
                scale: local[a].norm() * local[b].norm(),
                label,
            })
            .collect()
    }

    /// Form of the first base vector.
    pub fn a(&self) -> &Weights {
        &self.a
    }

    /// Form of the second base vector, equal to the first for a length.
    pub fn b(&self) -> &Weights {
        &self.b
    }

    /// Constant dot product ā·b̄ in the local frame \[m²\].
    pub fn value(&self) -> f64 {
        self.value
    }

    /// |ā| |b̄| \[m²\], the size against which a residual is small or large.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Name after its base vectors, such as `u·v`.
    pub fn label(&self) -> &'static str {
        self.label
    }

    /// Φ(q) \[m²\].
    ///
    /// # Panics
    /// If there is not one vector per node.
    #[track_caller]
    pub fn residual<const D: usize>(&self, nodes: &[SVector<f64, D>]) -> f64 {
        self.a.apply(nodes).dot(&self.b.apply(nodes)) - self.value
    }

    /// ∂Φ/∂q_n = a_n b(q) + b_n a(q) \[m\], one D-vector per node, written to `out`.
    ///
    /// # Panics
    /// If a list has not one vector per node.
    #[track_caller]
    pub fn gradient_into<const D: usize>(&self, nodes: &[SVector<f64, D>], out: &mut [SVector<f64, D>]) {
        out.fill(SVector::zeros());
        self.a.spread(&self.b.apply(nodes), out);
        self.b.spread(&self.a.apply(nodes), out);
    }

    /// [`gradient_into`](Self::gradient_into) a new list.
    ///
    /// # Panics
    /// If there is not one vector per node.
    #[track_caller]
    pub fn gradient<const D: usize>(&self, nodes: &[SVector<f64, D>]) -> Vec<SVector<f64, D>> {
        let mut gradient = vec![SVector::zeros(); nodes.len()];
        self.gradient_into(nodes, &mut gradient);
        gradient
    }

    /// Constant scalar Hessian `a bᵀ + b aᵀ`; over coordinates it is this ⊗ I_D.
    pub fn hessian(&self) -> NodeMatrix {
        let (a, b) = (self.a.as_slice(), self.b.as_slice());
        NodeMatrix::from_fn(a.len(), |i, j| a[i] * b[j] + b[i] * a[j])
    }
}
