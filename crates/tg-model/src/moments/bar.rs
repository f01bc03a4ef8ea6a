//! Moments on bars of space, as forces on the bar's direction u.
//!
//! ```text
//! fixed in space     Q_u = M × u / |u|²
//! universal joint    Q_u = M_ε ∂ε/∂u + M_β ∂β/∂u,   ρ² = u_y² + u_z²
//!                    ∂ε/∂u = (0, -u_z, u_y)/ρ²,   ∂β/∂u = (ρ², -u_x u_y, -u_x u_z)/(ρ |u|²)
//! Q_a = w_a Q_u,   -∂Q_a/∂q_b = w_a w_b (-∂Q_u/∂u)                   u = Σ_a w_a q_a, of length one where rigid
//! ```

use std::marker::PhantomData;

use nalgebra::{Matrix3, Vector3};

use super::{block_pattern, pairs, write_block};
use crate::form::{add_to_node, node};
use crate::mechanics::At;

/// A load on the direction of a bar.
pub(super) trait OnDirection {
    /// Number of inputs.
    const INPUTS: usize;
    /// Q_u for these inputs.
    fn pull(u: &Vector3<f64>, moments: &[f64]) -> Vector3<f64>;
    /// ∂Q_u/∂u.
    fn tangent(u: &Vector3<f64>, moments: &[f64]) -> Matrix3<f64>;
    /// Potential \[J\], zero where there is none.
    fn energy(u: &Vector3<f64>, moments: &[f64]) -> f64;
}

/// A moment fixed in space.
#[derive(Clone, Copy, Debug)]
pub(super) struct SpatialMoment;

impl OnDirection for SpatialMoment {
    const INPUTS: usize = 3;

    fn pull(u: &Vector3<f64>, moments: &[f64]) -> Vector3<f64> {
        Vector3::from_column_slice(moments).cross(u) / u.norm_squared()
    }

    fn tangent(u: &Vector3<f64>, moments: &[f64]) -> Matrix3<f64> {
        let turn = Vector3::from_column_slice(moments).cross_matrix();
        let square = u.norm_squared();
        (turn - (turn * u) * u.transpose() * (2.0 / square)) / square
    }

    fn energy(_: &Vector3<f64>, _: &[f64]) -> f64 {
        0.0
    }
}

/// Moments about the axes of a universal joint.
#[derive(Clone, Copy, Debug)]
pub(super) struct UniversalJoint;

impl OnDirection for UniversalJoint {
    const INPUTS: usize = 2;

    fn pull(u: &Vector3<f64>, moments: &[f64]) -> Vector3<f64> {
        let square = u.y * u.y + u.z * u.z;
        let rho = square.sqrt();
        let about_x = Vector3::new(0.0, -u.z, u.y) / square;
        let about_y = Vector3::new(square, -u.x * u.y, -u.x * u.z) / (rho * u.norm_squared());
        about_x * moments[0] + about_y * moments[1]
    }

    fn tangent(u: &Vector3<f64>, moments: &[f64]) -> Matrix3<f64> {
        let (y, z) = (u.y, u.z);
        let square = y * y + z * z;
        let (rho, norm) = (square.sqrt(), u.norm_squared());
        let (cross, difference) = (2.0 * y * z, z * z - y * y);
        let eps =
            Matrix3::new(0.0, 0.0, 0.0, 0.0, cross, difference, 0.0, difference, -cross) / (square * square);
        // β = atan2(u_x, ρ) as a function of u_x and ρ, and ρ of u_y and u_z.
        let along = Vector3::new(0.0, y / rho, z / rho);
        let (by_rho, mixed, pure) =
            (-u.x / norm, (u.x * u.x - square) / (norm * norm), 2.0 * u.x * rho / (norm * norm));
        let axis = Vector3::x();
        let curvature =
            (Matrix3::from_diagonal(&Vector3::new(0.0, 1.0, 1.0)) - along * along.transpose()) / rho;
        let beta = (along * along.transpose() - axis * axis.transpose()) * pure
            + (axis * along.transpose() + along * axis.transpose()) * mixed
            + curvature * by_rho;
        eps * moments[0] + beta * moments[1]
    }

    fn energy(u: &Vector3<f64>, moments: &[f64]) -> f64 {
        let rho = u.y.hypot(u.z);
        -(moments[0] * (-u.y).atan2(u.z) + moments[1] * u.x.atan2(rho))
    }
}

#[derive(Clone, Debug)]
pub(super) struct BarMoments<K> {
    loads: Vec<BarMoment>,
    kind: PhantomData<K>,
}

impl<K> Default for BarMoments<K> {
    fn default() -> Self {
        Self { loads: Vec::new(), kind: PhantomData }
    }
}

#[derive(Clone, Debug)]
struct BarMoment {
    input: usize,
    /// Nodes with the weight of u.
    nodes: Vec<(usize, f64)>,
    pairs: Vec<(usize, usize)>,
}

impl BarMoment {
    fn direction(&self, q: &[f64]) -> Vector3<f64> {
        self.nodes.iter().map(|&(n, w)| node::<3>(q, n) * w).sum()
    }
}

impl<K: OnDirection> BarMoments<K> {
    pub(super) fn push(&mut self, input: usize, nodes: Vec<(usize, f64)>, moves: impl Fn(usize) -> bool) {
        let pairs = pairs(&nodes, moves);
        self.loads.push(BarMoment { input, nodes, pairs });
    }

    fn pull(load: &BarMoment, at: At<'_>) -> Vector3<f64> {
        K::pull(&load.direction(at.q), &at.u[load.input..load.input + K::INPUTS])
    }

    pub(super) fn force(&self, at: At<'_>, f: &mut [f64]) {
        for load in &self.loads {
            let pull = Self::pull(load, at);
            load.nodes.iter().for_each(|&(node, w)| add_to_node(f, node, &(pull * w)));
        }
    }

    pub(super) fn stiffness(&self, at: At<'_>, values: &mut std::slice::IterMut<'_, f64>) {
        for load in &self.loads {
            let moments = &at.u[load.input..load.input + K::INPUTS];
            let tangent = K::tangent(&load.direction(at.q), moments);
            for &(a, b) in &load.pairs {
                write_block(&(tangent * (-load.nodes[a].1 * load.nodes[b].1)), values);
            }
        }
    }

    pub(super) fn pattern(&self, pattern: &mut Vec<(usize, usize)>) {
        for load in &self.loads {
            block_pattern::<3>(load.pairs.iter().map(|&(a, b)| (load.nodes[a].0, load.nodes[b].0)), pattern);
        }
    }

    pub(super) fn energy(&self, q: &[f64], u: &[f64]) -> f64 {
        let of = |load: &BarMoment| K::energy(&load.direction(q), &u[load.input..load.input + K::INPUTS]);
        self.loads.iter().map(of).sum()
    }

    pub(super) fn largest_force(&self, at: At<'_>) -> f64 {
        let of = |load: &BarMoment| {
            let weight = load.nodes.iter().map(|(_, w)| w.abs()).fold(0.0, f64::max);
            Self::pull(load, at).amax() * weight
        };
        self.loads.iter().map(of).fold(0.0, f64::max)
    }
}
