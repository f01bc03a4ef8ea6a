//! Constraints of a structure in flat lists.
//!
//! ```text
//! Φ = a(q)·b(q) - c        intrinsic: a, b linear forms over nodes      (5), (10), (13)
//! ∂Φ/∂q_n = w_a[n] b + w_b[n] a,   ∂²Φ/∂q_n∂q_m = w_a[n] w_b[m] + w_b[n] w_a[m]   (⊗ I)
//! Φ = Σ w_n q_n            extrinsic, one component: Jacobian constant   (19)
//! ```

use nalgebra::SVector;

use crate::form::{Form, NodePairs, node};
use crate::mechanics::HessianEntry;
use crate::parts::MemberId;

/// Intrinsic constraints (dot products), then extrinsic ones (linear), in the order of the rows of Φ.
#[derive(Clone, Debug)]
pub(crate) struct Constraints {
    /// Of all dot products, those that fix a distance of two nodes: every bar, most of a type RR…R.
    distances: Vec<Distance>,
    /// Row of each other dot product.
    dot_rows: Vec<u32>,
    dot_start: Vec<u32>,
    dot_terms: Vec<DotTerm>,
    dot_values: Vec<f64>,
    linear_start: Vec<u32>,
    linear_terms: Vec<(u32, f64)>,
    scales: Vec<f64>,
}

/// Φ = |q_b - q_a|² - c.
#[derive(Clone, Copy, Debug)]
struct Distance {
    row: u32,
    nodes: [u32; 2],
    value: f64,
}

/// Weights of one node in the two forms.
#[derive(Clone, Copy, Debug)]
struct DotTerm {
    node: u32,
    a: f64,
    b: f64,
}

/// One constraint before it is flattened.
#[derive(Clone, Debug)]
pub(crate) enum Constraint<const D: usize> {
    Dot { a: Form<D>, b: Form<D>, value: f64, scale: f64 },
    Linear { terms: Vec<(usize, f64)>, scale: f64 },
}

impl<const D: usize> Constraint<D> {
    /// One component of a form that is to vanish.
    pub(crate) fn component(form: &Form<D>, axis: usize, scale: f64) -> Self {
        Self::Linear { terms: form.terms().iter().map(|&(n, w)| (n * D + axis, w)).collect(), scale }
    }

    /// Every coordinate that the constraint contains.
    pub(crate) fn coordinates(&self) -> Vec<usize> {
        match self {
            Self::Dot { a, b, .. } => {
                let nodes = a.terms().iter().chain(b.terms()).map(|&(node, _)| node);
                nodes.flat_map(|node| node * D..node * D + D).collect()
            }
            Self::Linear { terms, .. } => terms.iter().map(|&(coordinate, _)| coordinate).collect(),
        }
    }

    pub(crate) fn residual(&self, q: &[f64]) -> f64 {
        match self {
            Self::Dot { a, b, value, .. } => a.eval(q).dot(&b.eval(q)) - value,
            Self::Linear { terms, .. } => terms.iter().map(|&(i, w)| w * q[i]).sum(),
        }
    }

    pub(crate) fn scale(&self) -> f64 {
        match self {
            Self::Dot { scale, .. } | Self::Linear { scale, .. } => *scale,
        }
    }

    /// The scale as a length \[m\].
    pub(crate) fn length(&self) -> f64 {
        match self {
            Self::Dot { scale, .. } => scale.sqrt(),
            Self::Linear { scale, .. } => *scale,
        }
    }
}

/// What a constraint belongs to: what its multiplier is the force of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ConstraintSource {
    /// An intrinsic constraint of a member (5).
    Rigidity(MemberId),
    /// One component of a joint by constraints (19).
    Joint {
        /// The joint's name.
        name: String,
        /// The place that is held to the joint's first one.
        at: String,
        /// The component.
        axis: usize,
    },
    /// One component of a support at a material point.
    Support {
        /// The support's name.
        name: String,
        /// The component.
        axis: usize,
    },
}

/// A constraint and the words for it.
pub(crate) struct Named<const D: usize> {
    pub(crate) name: String,
    pub(crate) source: ConstraintSource,
    pub(crate) constraint: Constraint<D>,
}

impl Constraints {
    /// Flattens; dot products must come before linear constraints.
    pub(crate) fn new<const D: usize>(list: &[Constraint<D>]) -> Self {
        let mut all = Self {
            distances: Vec::new(),
            dot_rows: Vec::new(),
            dot_start: vec![0],
            dot_terms: Vec::new(),
            dot_values: Vec::new(),
            linear_start: vec![0],
            linear_terms: Vec::new(),
            scales: list.iter().map(Constraint::scale).collect(),
        };
        for (row, constraint) in list.iter().enumerate() {
            match constraint {
                Constraint::Dot { a, b, value, .. } => all.push_dot(row, a, b, *value),
                Constraint::Linear { terms, .. } => {
                    all.linear_terms.extend(terms.iter().map(|&(i, w)| (i as u32, w)));
                    all.linear_start.push(all.linear_terms.len() as u32);
                }
            }
        }
        all
    }

    fn push_dot<const D: usize>(&mut self, row: usize, a: &Form<D>, b: &Form<D>, value: f64) {
        let row = row as u32;
        if let (Some(nodes), true) = (NodePairs::ends(a), a == b) {
            let nodes = nodes.map(|node| node as u32);
            self.distances.push(Distance { row, nodes, value });
            return;
        }
        self.dot_rows.push(row);
        let weight =
            |form: &Form<D>, n| form.terms().iter().find(|&&(node, _)| node == n).map_or(0.0, |&(_, w)| w);
        let union = Form::<D>::new(a.terms().iter().chain(b.terms()).map(|&(node, _)| (node, 1.0)));
        for &(node, _) in union.terms() {
            self.dot_terms.push(DotTerm { node: node as u32, a: weight(a, node), b: weight(b, node) });
        }
        self.dot_start.push(self.dot_terms.len() as u32);
        self.dot_values.push(value);
    }

    pub(crate) fn len(&self) -> usize {
        self.scales.len()
    }

    pub(crate) fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn dots(&self) -> impl Iterator<Item = &[DotTerm]> {
        self.dot_start.windows(2).map(|w| &self.dot_terms[w[0] as usize..w[1] as usize])
    }

    fn linears(&self) -> impl Iterator<Item = &[(u32, f64)]> {
        self.linear_start.windows(2).map(|w| &self.linear_terms[w[0] as usize..w[1] as usize])
    }

    pub(crate) fn residual<const D: usize>(&self, q: &[f64], phi: &mut [f64]) {
        for distance in &self.distances {
            let d = distance.vector::<D>(q);
            phi[distance.row as usize] = d.dot(&d) - distance.value;
        }
        for ((&row, terms), value) in self.dot_rows.iter().zip(self.dots()).zip(&self.dot_values) {
            let (a, b) = forms::<D>(terms, q);
            phi[row as usize] = a.dot(&b) - value;
        }
        for (phi, terms) in phi[self.dot_count()..].iter_mut().zip(self.linears()) {
            *phi = terms.iter().map(|&(i, w)| w * q[i as usize]).sum();
        }
    }

    pub(crate) fn jacobian<const D: usize>(&self, q: &[f64], values: &mut [f64]) {
        let (at_distances, values) = values.split_at_mut(2 * D * self.distances.len());
        for (distance, values) in self.distances.iter().zip(at_distances.chunks_exact_mut(2 * D)) {
            let gradient = distance.vector::<D>(q) * 2.0;
            let (from, to) = values.split_at_mut(D);
            from.copy_from_slice((-gradient).as_slice());
            to.copy_from_slice(gradient.as_slice());
        }
        let mut values = values.iter_mut();
        for terms in self.dots() {
            let (a, b) = forms::<D>(terms, q);
            for term in terms {
                let gradient = b * term.a + a * term.b;
                for (gradient, value) in gradient.iter().zip(&mut values) {
                    *value = *gradient;
                }
            }
        }
        for ((_, w), value) in self.linear_terms.iter().zip(values) {
            *value = *w;
        }
    }

    pub(crate) fn jacobian_pattern<const D: usize>(&self) -> Vec<(usize, usize)> {
        let mut pattern = Vec::new();
        for distance in &self.distances {
            for node in distance.nodes {
                pattern.extend((0..D).map(|d| (distance.row as usize, node as usize * D + d)));
            }
        }
        for (&row, terms) in self.dot_rows.iter().zip(self.dots()) {
            for term in terms {
                pattern.extend((0..D).map(|d| (row as usize, term.node as usize * D + d)));
            }
        }
        for (row, terms) in self.linears().enumerate() {
            pattern.extend(terms.iter().map(|&(i, _)| (row + self.dot_count(), i as usize)));
        }
        pattern
    }

    pub(crate) fn hessian<const D: usize>(&self) -> Vec<HessianEntry> {
        let mut entries = Vec::new();
        let mut push = |constraint: u32, m: u32, n: u32, value: f64| {
            if value != 0.0 {
                entries.extend((0..D).map(|d| {
                    let (row, col) = (m as usize * D + d, n as usize * D + d);
                    HessianEntry { constraint: constraint as usize, row, col, value }
                }));
            }
        };
        for &Distance { row, nodes: [a, b], .. } in &self.distances {
            for (m, n, value) in [(a, a, 2.0), (a, b, -2.0), (b, a, -2.0), (b, b, 2.0)] {
                push(row, m, n, value);
            }
        }
        for (&row, terms) in self.dot_rows.iter().zip(self.dots()) {
            for m in terms {
                for n in terms {
                    push(row, m.node, n.node, m.a * n.b + m.b * n.a);
                }
            }
        }
        entries
    }

    /// Number of dot products, which come before the linear constraints.
    fn dot_count(&self) -> usize {
        self.distances.len() + self.dot_rows.len()
    }
}

impl Distance {
    #[inline(always)]
    fn vector<const D: usize>(&self, q: &[f64]) -> SVector<f64, D> {
        let [a, b] = self.nodes.map(|node| node as usize);
        node::<D>(q, b) - node::<D>(q, a)
    }
}

fn forms<const D: usize>(terms: &[DotTerm], q: &[f64]) -> (SVector<f64, D>, SVector<f64, D>) {
    let (mut a, mut b) = (SVector::zeros(), SVector::zeros());
    for term in terms {
        let x = node::<D>(q, term.node as usize);
        a += x * term.a;
        b += x * term.b;
    }
    (a, b)
}
