//! What inverse statics and the analysis of self-stress ask of a structure beyond [`Mechanics`]: its cables one by one
//! and its motions as a rigid whole.
//!
//! ```text
//! F_cables = -Σ_j f_j ∂l_j/∂qᵀ,   ∂l_j/∂q = l̂_jᵀ J_j          (28): linear in the tensions f_j = γ_j l_j
//! ```

use nalgebra::SVector;

use crate::form::add_to_node;
use crate::mechanics::{At, Mechanics};
use crate::model::Model;

/// A system with cables. Inputs 0.. are their rest lengths, one per cable in the user's order; slices over cables have
/// that order too.
pub trait Tensioned: Mechanics {
    /// This system as the other solvers see it.
    fn mechanics(&self) -> &dyn Mechanics;
    /// Number of cables.
    fn cable_count(&self) -> usize;
    /// The user's name of a cable.
    fn cable_name(&self, cable: usize) -> String;
    /// Entries (cable, coordinate) of ∂l/∂q over the full coordinates; they do not repeat.
    fn length_pattern(&self) -> Vec<(usize, usize)>;
    /// Lengths l \[m\] of all cables and the values of ∂l/∂q in the order of [`Tensioned::length_pattern`].
    fn lengths(&self, q: &[f64], lengths: &mut [f64], gradients: &mut [f64]);
    /// Tension f \[N\] of a cable at rest, by its law, at a length and rest length \[m\].
    fn static_tension(&self, cable: usize, length: f64, rest: f64) -> f64;
    /// κ \[N/m\] where the law is f = κ (l - μ) when taut; `None` for a user's law.
    fn linear_stiffness(&self, cable: usize) -> Option<f64>;
    /// Whether the cable can only pull.
    fn only_pulls(&self, cable: usize) -> bool;
    /// Values of -∂F/∂q, in the order of [`Mechanics::stiffness_pattern`], of cables that keep the given tensions:
    /// the geometric stiffness Jᵀ (f/l)(I - l̂ l̂ᵀ) J. Loads are left out: their entries are zero.
    fn geometric_stiffness(&self, q: &[f64], tension: &[f64], values: &mut [f64]);
    /// Full velocities of the motions as a rigid whole at q: D translations, then D(D-1)/2 rotations about the origin.
    fn rigid_motions(&self, q: &[f64]) -> Vec<Vec<f64>>;
}

impl<const D: usize> Tensioned for Model<D> {
    fn mechanics(&self) -> &dyn Mechanics {
        self
    }

    fn cable_count(&self) -> usize {
        self.cables.len()
    }

    fn cable_name(&self, cable: usize) -> String {
        self.cables[cable].name.clone()
    }

    fn length_pattern(&self) -> Vec<(usize, usize)> {
        let terms = self
            .cables
            .iter()
            .enumerate()
            .flat_map(|(id, cable)| cable.form.terms().iter().map(move |t| (id, t.0)));
        terms.flat_map(|(id, node)| (node * D..node * D + D).map(move |i| (id, i))).collect()
    }

    fn lengths(&self, q: &[f64], lengths: &mut [f64], gradients: &mut [f64]) {
        let mut gradients = gradients.iter_mut();
        for (cable, length) in self.cables.iter().zip(lengths) {
            let l = cable.form.eval(q);
            *length = l.norm();
            let direction = l / *length;
            for &(_, w) in cable.form.terms() {
                for (component, gradient) in direction.iter().zip(&mut gradients) {
                    *gradient = w * component;
                }
            }
        }
    }

    fn static_tension(&self, cable: usize, length: f64, rest: f64) -> f64 {
        self.cables[cable].law.static_tension(length, rest)
    }

    fn linear_stiffness(&self, cable: usize) -> Option<f64> {
        self.cables[cable].law.linear_stiffness()
    }

    fn only_pulls(&self, cable: usize) -> bool {
        matches!(self.cables[cable].law, crate::law::CableLaw::Slacking { .. })
    }

    fn geometric_stiffness(&self, q: &[f64], tension: &[f64], values: &mut [f64]) {
        let (cables, moments) = values.split_at_mut(self.cable_entries);
        self.in_equations.geometric_stiffness::<D>(At { q, v: &[], u: &[], taut: None }, tension, cables);
        moments.fill(0.0);
    }

    fn rigid_motions(&self, q: &[f64]) -> Vec<Vec<f64>> {
        let nodes = q.len() / D;
        let mut is_point = vec![true; nodes];
        for placed in &self.members {
            let points = placed.member.coord_type().points();
            placed.nodes[points..].iter().for_each(|&node| is_point[node] = false);
        }
        let translation = |axis: usize| {
            let mut v = vec![0.0; q.len()];
            (0..nodes).filter(|&node| is_point[node]).for_each(|node| v[node * D + axis] = 1.0);
            v
        };
        let rotation = |(a, b): (usize, usize)| {
            let mut v = vec![0.0; q.len()];
            for node in 0..nodes {
                let mut velocity = SVector::<f64, D>::zeros();
                (velocity[a], velocity[b]) = (-q[node * D + b], q[node * D + a]);
                add_to_node(&mut v, node, &velocity);
            }
            v
        };
        let planes = (0..D).flat_map(|a| (a + 1..D).map(move |b| (a, b)));
        (0..D).map(translation).chain(planes.map(rotation)).collect()
    }
}
