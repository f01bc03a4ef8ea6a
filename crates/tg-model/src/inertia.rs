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

/// The mass matrix as an operator, row by row.
#[derive(Clone, Debug)]
pub struct Inertia {
    start: Vec<u32>,
    entries: Vec<(u32, f64)>,
}

impl Inertia {
    /// Sorts the mass entries of a system of `n` coordinates by rows.
    pub fn new(n: usize, mass: &[Entry]) -> Self {
        let mut sorted = mass.to_vec();
        sorted.sort_by_key(|e| (e.row, e.col));
        let mut start = vec![0; n + 1];
        for entry in &sorted {
            start[entry.row + 1] += 1;
        }
        for i in 0..n {
            start[i + 1] += start[i];
        }
        Self { start, entries: sorted.iter().map(|e| (e.col as u32, e.value)).collect() }
    }

    /// Row `i` of M x.
    pub fn row(&self, i: usize, x: &[f64]) -> f64 {
        let entries = &self.entries[self.start[i] as usize..self.start[i + 1] as usize];
        entries.iter().map(|&(j, m)| m * x[j as usize]).sum()
    }

    /// Kinetic energy ½ q̇ᵀ M q̇ \[J\] (17).
    pub fn kinetic_energy(&self, v: &[f64]) -> f64 {
        0.5 * (0..v.len()).map(|i| v[i] * self.row(i, v)).sum::<f64>()
    }
}
