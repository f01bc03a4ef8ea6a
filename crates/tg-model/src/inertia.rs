//! The constant mass matrix of a structure, `M = Σ T_Iᵀ M_I T_I` (Sec. 5.1), and its products.

use std::collections::BTreeMap;

use crate::mechanics::Entry;
use crate::placed::PlacedMember;

/// Sums the members' scalar mass matrices over shared nodes and expands them by the identity of the space.
pub(crate) fn assemble<const D: usize>(members: &[PlacedMember<D>]) -> Vec<Entry> {
    let mut scalar = BTreeMap::<(usize, usize), f64>::new();
    for placed in members {
        let mass = placed.member.mass_matrix();
        for (i, &a) in placed.nodes.iter().enumerate() {
            for (j, &b) in placed.nodes.iter().enumerate() {
                *scalar.entry((a, b)).or_default() += mass.get(i, j);
            }
        }
    }
    let nonzero = scalar.into_iter().filter(|&(_, value)| value != 0.0);
    nonzero
        .flat_map(|((a, b), value)| (0..D).map(move |d| Entry { row: a * D + d, col: b * D + d, value }))
        .collect()
}

/// The mass matrix as an operator. Of the models' matrices, which are a scalar pattern ⊗ I_D, only the pattern is kept.
#[derive(Clone, Debug)]
pub struct Inertia {
    /// D, or 1 for a matrix that is no such product.
    dimension: usize,
    /// One list of (first column, value) per D rows.
    start: Vec<u32>,
    entries: Vec<(u32, f64)>,
}

impl Inertia {
    /// Sorts the mass entries of a system of `n` coordinates by rows.
    pub fn new(n: usize, mass: &[Entry]) -> Self {
        let mut sorted = mass.to_vec();
        sorted.sort_by_key(|e| (e.row, e.col));
        let dimension = [3, 2].into_iter().find(|&d| is_product(n, &sorted, d)).unwrap_or(1);
        sorted.retain(|e| e.row % dimension == 0);
        let mut start = vec![0; n / dimension + 1];
        for entry in &sorted {
            start[entry.row / dimension + 1] += 1;
        }
        for i in 1..start.len() {
            start[i] += start[i - 1];
        }
        Self { dimension, start, entries: sorted.iter().map(|e| (e.col as u32, e.value)).collect() }
    }

    /// `out ← M x`.
    pub fn product(&self, x: &[f64], out: &mut [f64]) {
        match self.dimension {
            3 => self.blocks::<3>(x, out),
            2 => self.blocks::<2>(x, out),
            _ => self.blocks::<1>(x, out),
        }
    }

    fn blocks<const D: usize>(&self, x: &[f64], out: &mut [f64]) {
        let (mut entries, mut at) = (self.entries.as_slice(), 0);
        for (out, &end) in out.as_chunks_mut::<D>().0.iter_mut().zip(&self.start[1..]) {
            let (row, rest) = entries.split_at(end as usize - at);
            (entries, at) = (rest, end as usize);
            let mut sum = [0.0; D];
            for &(column, m) in row {
                let x = &x[column as usize..column as usize + D];
                for d in 0..D {
                    sum[d] += m * x[d];
                }
            }
            *out = sum;
        }
    }

    /// Row `i` of M x.
    pub fn row(&self, i: usize, x: &[f64]) -> f64 {
        let (block, component) = (i / self.dimension, i % self.dimension);
        let entries = &self.entries[self.start[block] as usize..self.start[block + 1] as usize];
        entries.iter().map(|&(j, m)| m * x[j as usize + component]).sum()
    }

    /// Kinetic energy ½ q̇ᵀ M q̇ \[J\] (17).
    pub fn kinetic_energy(&self, v: &[f64]) -> f64 {
        0.5 * (0..v.len()).map(|i| v[i] * self.row(i, v)).sum::<f64>()
    }
}

/// Whether entries sorted by rows are a pattern ⊗ I_d.
fn is_product(n: usize, sorted: &[Entry], d: usize) -> bool {
    let mut rows = sorted.chunk_by(|a, b| a.row == b.row);
    if !n.is_multiple_of(d) {
        return false;
    }
    while let Some(first) = rows.next() {
        let starts = first.iter().all(|e| e.row % d == 0 && e.col % d == 0);
        let follows = (1..d).all(|component| {
            rows.next().is_some_and(|row| {
                row.len() == first.len()
                    && row.iter().zip(first).all(|(a, b)| {
                        (a.row, a.col, a.value) == (b.row + component, b.col + component, b.value)
                    })
            })
        });
        if !(starts && follows) {
            return false;
        }
    }
    true
}
