//! Moments on members of the plane: the gradient of M θ.
//!
//! ```text
//! z = Σ_a P_a q_a,   P_a = w_a1 I - w_a2 J,   θ = atan2(z_y, z_x)
//! Q_a = M P_aᵀ ∂θ/∂z,   -∂Q_a/∂q_b = -M P_aᵀ (∂²θ/∂z²) P_b
//! ```
//! with J = \[0 -1; 1 0\]; z = e_1 - J e_2 of a body's two axes is twice its rotation as a complex number, and that of the
//! best fitting one where the coordinates are not rigid. A bar has e_1 only.

use nalgebra::{Matrix2, Vector2};

use super::{Axes, block_pattern, pairs, write_block};
use crate::form::{add_to_node, node};
use crate::mechanics::At;

#[derive(Clone, Debug, Default)]
pub(super) struct PlaneMoments {
    loads: Vec<PlaneMoment>,
}

#[derive(Clone, Debug)]
struct PlaneMoment {
    input: usize,
    /// Nodes with P.
    nodes: Vec<(usize, Matrix2<f64>)>,
    pairs: Vec<(usize, usize)>,
    /// z as built, from which θ counts in the potential.
    initial: Vector2<f64>,
}

impl PlaneMoment {
    fn z(&self, q: &[f64]) -> Vector2<f64> {
        self.nodes.iter().map(|(n, p)| p * node::<2>(q, *n)).sum()
    }

    /// M ∂θ/∂z.
    fn pull(&self, at: At<'_>) -> Vector2<f64> {
        let z = self.z(at.q);
        Vector2::new(-z.y, z.x) * (at.u[self.input] / z.norm_squared())
    }
}

impl PlaneMoments {
    pub(super) fn push(&mut self, input: usize, axes: &Axes, q: &[f64], moves: impl Fn(usize) -> bool) {
        let turned = Matrix2::new(0.0, 1.0, -1.0, 0.0);
        let p = |w: &[f64; 3]| Matrix2::identity() * w[0] + turned * w[1];
        let nodes: Vec<_> = axes.nodes.iter().map(|(node, w)| (*node, p(w))).collect();
        let pairs = pairs(&nodes, moves);
        let mut load = PlaneMoment { input, nodes, pairs, initial: Vector2::zeros() };
        load.initial = load.z(q);
        self.loads.push(load);
    }

    pub(super) fn force(&self, at: At<'_>, f: &mut [f64]) {
        for load in &self.loads {
            let pull = load.pull(at);
            load.nodes.iter().for_each(|(node, p)| add_to_node(f, *node, &p.tr_mul(&pull)));
        }
    }

    pub(super) fn stiffness(&self, at: At<'_>, values: &mut std::slice::IterMut<'_, f64>) {
        for load in &self.loads {
            let z = load.z(at.q);
            let scale = at.u[load.input] / z.norm_squared().powi(2);
            let (cross, square) = (2.0 * z.x * z.y, z.y * z.y - z.x * z.x);
            let hessian = Matrix2::new(cross, square, square, -cross) * -scale;
            for &(a, b) in &load.pairs {
                write_block(&(load.nodes[a].1.tr_mul(&hessian) * load.nodes[b].1), values);
            }
        }
    }

    pub(super) fn pattern(&self, pattern: &mut Vec<(usize, usize)>) {
        for load in &self.loads {
            block_pattern::<2>(load.pairs.iter().map(|&(a, b)| (load.nodes[a].0, load.nodes[b].0)), pattern);
        }
    }

    pub(super) fn energy(&self, q: &[f64], u: &[f64]) -> f64 {
        let angle = |load: &PlaneMoment| {
            let z = load.z(q);
            load.initial.perp(&z).atan2(load.initial.dot(&z))
        };
        -self.loads.iter().map(|load| u[load.input] * angle(load)).sum::<f64>()
    }

    pub(super) fn largest_force(&self, at: At<'_>) -> f64 {
        let of = |load: &PlaneMoment| {
            let pull = load.pull(at);
            load.nodes.iter().map(|(_, p)| p.tr_mul(&pull).amax()).fold(0.0, f64::max)
        };
        self.loads.iter().map(of).fold(0.0, f64::max)
    }
}
