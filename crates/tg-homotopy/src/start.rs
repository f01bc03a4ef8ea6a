//! Start systems G whose equations are products of linear forms, and all their solutions.
//!
//! ```text
//! G_i(X) = Π_g Π_{k=1..d_ig} ℓ_igk(X_g)                 Morgan & Sommese 1987; Sommese & Wampler 2005, ch. 8
//! one group:  G_i(X) = X_i^d_i - c_i X_0^d_i = Π_k (X_i - e^(i(φ_i + 2πk/d_i)) X_0)
//! ```
//!
//! A solution makes one factor of every equation vanish, n_g of them in group g: a linear system for each group.

use num_complex::Complex64;

use crate::grouping::Grouping;
use crate::lu::Lu;
use crate::random::Random;
use crate::scalar::{Field, Scalar};
use crate::system::PolynomialSystem;

/// A linear form in the homogeneous unknowns of one group.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    group: usize,
    terms: Vec<(usize, Complex64)>,
}

/// A linear-product start system in homogeneous unknowns.
#[derive(Clone, Debug)]
pub(crate) struct StartSystem {
    forms: Vec<Vec<Form>>,
    unknowns: usize,
    group_of: Vec<usize>,
    groups: usize,
    /// Longest product.
    pub(crate) longest: usize,
}

impl StartSystem {
    pub(crate) fn new(system: &PolynomialSystem, grouping: &Grouping, random: &mut Random) -> Self {
        let n = system.unknowns();
        let group_of = grouping.group_of().to_vec();
        let groups = grouping.groups();
        let forms: Vec<Vec<Form>> = (0..n)
            .map(|i| {
                let mut product = vec![];
                // Roots of unity themselves are too often roots of the target as well.
                let turn = std::f64::consts::TAU * random.uniform();
                for g in 0..groups {
                    let degree = grouping.degree(system, i, g);
                    for k in 0..degree {
                        let terms = if groups == 1 {
                            let angle = turn + std::f64::consts::TAU * f64::from(k) / f64::from(degree);
                            vec![(i, Complex64::one()), (n, -Complex64::from_polar(1.0, angle))]
                        } else {
                            let members = (0..n).filter(|&v| group_of[v] == g).chain([n + g]);
                            members.map(|v| (v, random.unit())).collect()
                        };
                        product.push(Form { group: g, terms });
                    }
                }
                product
            })
            .collect();
        let longest = forms.iter().map(Vec::len).max().unwrap_or(0);
        Self { forms, unknowns: n, group_of, groups, longest }
    }

    /// All solutions with homogenising unknowns 1, in a fixed order.
    pub(crate) fn solutions(&self) -> Vec<Vec<Complex64>> {
        let mut room = vec![0usize; self.groups];
        for &g in &self.group_of {
            room[g] += 1;
        }
        let mut found = vec![];
        self.choose(&mut vec![], &mut room, &mut found);
        found
    }

    fn choose(&self, chosen: &mut Vec<usize>, room: &mut [usize], found: &mut Vec<Vec<Complex64>>) {
        let i = chosen.len();
        if i == self.forms.len() {
            found.extend(self.intersect(chosen));
            return;
        }
        for (k, form) in self.forms[i].iter().enumerate() {
            if room[form.group] == 0 {
                continue;
            }
            room[form.group] -= 1;
            chosen.push(k);
            self.choose(chosen, room, found);
            chosen.pop();
            room[form.group] += 1;
        }
    }

    /// The common zero of one form of each equation; none if forms happen to be dependent.
    fn intersect(&self, chosen: &[usize]) -> Option<Vec<Complex64>> {
        let mut solution = vec![Complex64::one(); self.unknowns + self.groups];
        for g in 0..self.groups {
            let members: Vec<usize> = (0..self.unknowns).filter(|&v| self.group_of[v] == g).collect();
            let size = members.len();
            let mut matrix = vec![Complex64::zero(); size * size];
            let mut rhs = vec![Complex64::zero(); size];
            let picked = self.forms.iter().zip(chosen).map(|(p, &k)| &p[k]).filter(|f| f.group == g);
            for (row, form) in picked.enumerate() {
                for &(v, c) in &form.terms {
                    match members.iter().position(|&m| m == v) {
                        Some(column) => matrix[row * size + column] = c,
                        None => rhs[row] = -c,
                    }
                }
            }
            let mut lu = Lu::new(size);
            if !lu.factor(&matrix) {
                return None;
            }
            lu.solve(&mut rhs);
            for (&v, &x) in members.iter().zip(&rhs) {
                solution[v] = x;
            }
        }
        Some(solution)
    }

    /// Adds `factor` G to `values` and `factor` ∂G/∂X to the rows of `jacobian`; writes G to `g`. `forms` and `products`
    /// are buffers of `longest` numbers.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn add_to<S: Field>(
        &self,
        factor: S,
        x: &[S],
        g: &mut [S],
        values: &mut [S],
        jacobian: &mut [S],
        stride: usize,
        buffers: &mut (Vec<S>, Vec<S>),
    ) {
        let (forms, products) = buffers;
        for (i, product) in self.forms.iter().enumerate() {
            let mut before = S::one();
            for (k, form) in product.iter().enumerate() {
                let value = form.terms.iter().fold(S::zero(), |sum, &(v, c)| sum + S::from_c64(c) * x[v]);
                forms[k] = value;
                products[k] = before;
                before = before * value;
            }
            g[i] = before;
            values[i] = values[i] + factor * before;
            let mut after = factor;
            for (k, form) in product.iter().enumerate().rev() {
                let others = products[k] * after;
                for &(v, c) in &form.terms {
                    let entry = &mut jacobian[i * stride + v];
                    *entry = *entry + others * S::from_c64(c);
                }
                after = after * forms[k];
            }
        }
    }
}
