//! Linear forms over nodes: the only way in which points enter.
//!
//! ```text
//! r = Σ_a w_a q_a           (16), (22)
//! l = r_b - r_a = J q       (26)
//! ```
//! A node is one D-vector of the coordinates (a basic point or a base vector); node `a` holds the full coordinates
//! `a·D .. a·D + D`.

use nalgebra::SVector;

/// The D-vector of a node.
#[inline(always)]
pub(crate) fn node<const D: usize>(x: &[f64], node: usize) -> SVector<f64, D> {
    SVector::from_column_slice(&x[node * D..node * D + D])
}

/// Adds a D-vector to a node.
#[inline(always)]
pub(crate) fn add_to_node<const D: usize>(x: &mut [f64], node: usize, value: &SVector<f64, D>) {
    for (x, v) in x[node * D..node * D + D].iter_mut().zip(value.iter()) {
        *x += v;
    }
}

/// A scalar-weighted sum of nodes: a point or a vector of a structure as a function of its coordinates.
///
/// Made by `Model::form`; evaluates positions from q, velocities from q̇.
#[derive(Clone, Debug, PartialEq)]
pub struct Form<const D: usize> {
    terms: Vec<(usize, f64)>,
}

impl<const D: usize> Form<D> {
    /// Sums the weights of repeated nodes and drops zeros.
    pub(crate) fn new(terms: impl IntoIterator<Item = (usize, f64)>) -> Self {
        let mut sum: Vec<(usize, f64)> = Vec::new();
        for (node, weight) in terms {
            match sum.iter_mut().find(|(n, _)| *n == node) {
                Some((_, w)) => *w += weight,
                None => sum.push((node, weight)),
            }
        }
        sum.retain(|&(_, w)| w != 0.0);
        sum.sort_unstable_by_key(|&(node, _)| node);
        Self { terms: sum }
    }

    /// `self - other`.
    pub(crate) fn minus(&self, other: &Self) -> Self {
        Self::new(self.terms.iter().copied().chain(other.terms.iter().map(|&(node, w)| (node, -w))))
    }

    /// Nodes and weights, nodes ascending and not repeated.
    pub fn terms(&self) -> &[(usize, f64)] {
        &self.terms
    }

    /// The form's value on full coordinates (or velocities) `x`.
    pub fn eval(&self, x: &[f64]) -> SVector<f64, D> {
        self.terms.iter().map(|&(a, w)| node(x, a) * w).sum()
    }
}

/// Many forms in one flat list, in the layout of the hot loops.
pub(crate) trait Forms: Default {
    fn push<const D: usize>(&mut self, form: &Form<D>);
    fn eval<const D: usize>(&self, i: usize, x: &[f64]) -> SVector<f64, D>;
    /// `x += wᵀ ⊗ value`: the transpose of [`Forms::eval`].
    fn spread<const D: usize>(&self, i: usize, value: &SVector<f64, D>, x: &mut [f64]);
}

/// Forms of any weights.
#[derive(Clone, Debug, Default)]
pub(crate) struct FormList {
    end: Vec<u32>,
    terms: Vec<(u32, f64)>,
}

impl FormList {
    fn terms(&self, i: usize) -> &[(u32, f64)] {
        let start = if i == 0 { 0 } else { self.end[i - 1] as usize };
        &self.terms[start..self.end[i] as usize]
    }
}

impl Forms for FormList {
    fn push<const D: usize>(&mut self, form: &Form<D>) {
        self.terms.extend(form.terms().iter().map(|&(node, w)| (node as u32, w)));
        self.end.push(self.terms.len() as u32);
    }

    #[inline(always)]
    fn eval<const D: usize>(&self, i: usize, x: &[f64]) -> SVector<f64, D> {
        let mut sum = SVector::zeros();
        for &(a, w) in self.terms(i) {
            sum += node::<D>(x, a as usize) * w;
        }
        sum
    }

    #[inline(always)]
    fn spread<const D: usize>(&self, i: usize, value: &SVector<f64, D>, x: &mut [f64]) {
        for &(a, w) in self.terms(i) {
            add_to_node(x, a as usize, &(value * w));
        }
    }
}

/// Forms from one node to another, `q_b - q_a`: most cables, and all bars.
#[derive(Clone, Debug, Default)]
pub(crate) struct NodePairs(Vec<[u32; 2]>);

impl NodePairs {
    /// The nodes from and to which a form leads, if it is of this kind.
    pub(crate) fn ends<const D: usize>(form: &Form<D>) -> Option<[usize; 2]> {
        match *form.terms() {
            [(a, -1.0), (b, 1.0)] | [(b, 1.0), (a, -1.0)] => Some([a, b]),
            _ => None,
        }
    }
}

impl Forms for NodePairs {
    /// Only for forms with [`NodePairs::ends`].
    fn push<const D: usize>(&mut self, form: &Form<D>) {
        self.0.extend(Self::ends(form).map(|ends| ends.map(|node| node as u32)));
    }

    #[inline(always)]
    fn eval<const D: usize>(&self, i: usize, x: &[f64]) -> SVector<f64, D> {
        let [a, b] = self.0[i].map(|node| node as usize);
        node::<D>(x, b) - node::<D>(x, a)
    }

    #[inline(always)]
    fn spread<const D: usize>(&self, i: usize, value: &SVector<f64, D>, x: &mut [f64]) {
        let [a, b] = self.0[i].map(|node| node as usize);
        add_to_node(x, b, value);
        add_to_node(x, a, &-value);
    }
}
