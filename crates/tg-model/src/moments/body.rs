//! Moments on bodies of space, fixed in space or following the body.
//!
//! ```text
//! δW = ½ Σ_k M·(e_k × δe_k) = M·δφ    for δe_k = δφ × e_k,   e_k = Σ_a w_ak q_a the body's axes
//! Q_a = ½ M × E_a,   E_a = Σ_b (w_a·w_b) q_b
//! -∂Q_a/∂q_b = -½ (w_a·w_b) [M]×                            M fixed in space
//!              -½ (w_a·w_b) [M]× + ½ (m·w_b) [E_a]×         M = Σ_k m_k e_k
//! ```
//! The first is skew: a constant moment has no potential.

use nalgebra::{Matrix3, Vector3};

use super::{block_pattern, pairs, write_block};
use crate::form::{add_to_node, node};
use crate::mechanics::At;

/// With `FOLLOWS` the inputs are m, else M.
#[derive(Clone, Debug, Default)]
pub(super) struct BodyMoments<const FOLLOWS: bool> {
    loads: Vec<BodyMoment>,
}

#[derive(Clone, Debug)]
struct BodyMoment {
    input: usize,
    /// Nodes with w.
    nodes: Vec<(usize, [f64; 3])>,
    pairs: Vec<(usize, usize)>,
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl BodyMoment {
    fn components(&self, u: &[f64]) -> [f64; 3] {
        [u[self.input], u[self.input + 1], u[self.input + 2]]
    }

    /// E of one of the nodes.
    fn arm(&self, q: &[f64], w: &[f64; 3]) -> Vector3<f64> {
        self.nodes.iter().map(|(n, v)| node::<3>(q, *n) * dot(w, v)).sum()
    }
}

impl<const FOLLOWS: bool> BodyMoments<FOLLOWS> {
    pub(super) fn push(
        &mut self,
        input: usize,
        nodes: Vec<(usize, [f64; 3])>,
        moves: impl Fn(usize) -> bool,
    ) {
        let pairs = pairs(&nodes, moves);
        self.loads.push(BodyMoment { input, nodes, pairs });
    }

    /// M along the axes of space.
    fn moment(load: &BodyMoment, at: At<'_>) -> Vector3<f64> {
        let m = load.components(at.u);
        if FOLLOWS {
            load.nodes.iter().map(|(n, w)| node::<3>(at.q, *n) * dot(&m, w)).sum()
        } else {
            m.into()
        }
    }

    pub(super) fn force(&self, at: At<'_>, f: &mut [f64]) {
        for load in &self.loads {
            let half = Self::moment(load, at) * 0.5;
            load.nodes.iter().for_each(|(node, w)| add_to_node(f, *node, &half.cross(&load.arm(at.q, w))));
        }
    }

    pub(super) fn stiffness(&self, at: At<'_>, values: &mut std::slice::IterMut<'_, f64>) {
        for load in &self.loads {
            let half = Self::moment(load, at).cross_matrix() * 0.5;
            let m = load.components(at.u);
            for &(a, b) in &load.pairs {
                let (wa, wb) = (&load.nodes[a].1, &load.nodes[b].1);
                let mut block: Matrix3<f64> = half * -dot(wa, wb);
                if FOLLOWS {
                    block += load.arm(at.q, wa).cross_matrix() * (0.5 * dot(&m, wb));
                }
                write_block(&block, values);
            }
        }
    }

    pub(super) fn pattern(&self, pattern: &mut Vec<(usize, usize)>) {
        for load in &self.loads {
            block_pattern::<3>(load.pairs.iter().map(|&(a, b)| (load.nodes[a].0, load.nodes[b].0)), pattern);
        }
    }

    pub(super) fn largest_force(&self, at: At<'_>) -> f64 {
        let of = |load: &BodyMoment| {
            let half = Self::moment(load, at) * 0.5;
            let on = |(_, w): &(usize, [f64; 3])| half.cross(&load.arm(at.q, w)).amax();
            load.nodes.iter().map(on).fold(0.0, f64::max)
        };
        self.loads.iter().map(of).fold(0.0, f64::max)
    }
}
