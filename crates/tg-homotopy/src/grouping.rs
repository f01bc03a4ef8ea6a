//! Partitions of the unknowns and their Bézout numbers.
//!
//! ```text
//! B = coefficient of Π_g α_g^n_g in Π_i Σ_g d_ig α_g          Morgan & Sommese (Appl. Math. Comput. 24, 1987)
//! ```
//!
//! with n_g unknowns in group g and d_ig the degree of equation i in them. B bounds the number of isolated finite
//! solutions, and is the number of paths of a linear-product start system. One group gives the total degree Π d_i.

use std::collections::BTreeMap;

use crate::error::HomotopyError;
use crate::system::PolynomialSystem;

/// A partition of the unknowns into groups, each of which gets its own projective space.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grouping {
    group_of: Vec<usize>,
    groups: usize,
}

impl Grouping {
    /// All `unknowns` in one group: the total-degree homotopy.
    pub fn single(unknowns: usize) -> Self {
        Self { group_of: vec![0; unknowns], groups: 1 }
    }

    /// Groups given as lists of unknowns.
    pub fn new(unknowns: usize, groups: &[&[usize]]) -> Result<Self, HomotopyError> {
        let mut times = vec![0; unknowns];
        let mut group_of = vec![0; unknowns];
        for (g, group) in groups.iter().enumerate() {
            for &unknown in *group {
                let Some(count) = times.get_mut(unknown) else {
                    return Err(HomotopyError::Grouping { unknown, times: 1 });
                };
                *count += 1;
                group_of[unknown] = g;
            }
        }
        match times.iter().position(|&t| t != 1) {
            Some(unknown) => Err(HomotopyError::Grouping { unknown, times: times[unknown] }),
            None => Ok(Self { group_of, groups: groups.len() }),
        }
    }

    /// Number of groups.
    pub fn groups(&self) -> usize {
        self.groups
    }

    /// The group of each unknown.
    pub fn group_of(&self) -> &[usize] {
        &self.group_of
    }

    pub(crate) fn check(&self, system: &PolynomialSystem) -> Result<(), HomotopyError> {
        crate::error::check_length("grouping", system.unknowns(), self.group_of.len())
    }

    /// d_ig: degree of equation `i` in group `g`.
    pub fn degree(&self, system: &PolynomialSystem, i: usize, g: usize) -> u32 {
        system.degree(i, |v| self.group_of[v] == g)
    }

    /// The multihomogeneous Bézout number, saturating.
    pub fn bezout(&self, system: &PolynomialSystem) -> Result<u64, HomotopyError> {
        self.check(system)?;
        let mut room = vec![0u32; self.groups];
        for &g in &self.group_of {
            room[g] += 1;
        }
        // Partial products as a map from what is left of each exponent to the coefficient.
        let mut partial: BTreeMap<Vec<u32>, u64> = BTreeMap::from([(room, 1)]);
        for i in 0..system.equations() {
            let degrees: Vec<u32> = (0..self.groups).map(|g| self.degree(system, i, g)).collect();
            let mut next: BTreeMap<Vec<u32>, u64> = BTreeMap::new();
            for (room, count) in partial {
                for (g, &d) in degrees.iter().enumerate() {
                    if d > 0 && room[g] > 0 {
                        let mut left = room.clone();
                        left[g] -= 1;
                        let sum = next.entry(left).or_insert(0);
                        *sum = sum.saturating_add(count.saturating_mul(u64::from(d)));
                    }
                }
            }
            partial = next;
        }
        Ok(partial.values().copied().sum())
    }

    /// The grouping with the smallest Bézout number among those given, the first of equals, and that number.
    pub fn best(system: &PolynomialSystem, choices: &[Self]) -> Result<(Self, u64), HomotopyError> {
        let mut best: Option<(Self, u64)> = None;
        for choice in choices {
            let count = choice.bezout(system)?;
            if best.as_ref().is_none_or(|b| count < b.1) {
                best = Some((choice.clone(), count));
            }
        }
        best.ok_or(HomotopyError::NoGrouping)
    }
}
