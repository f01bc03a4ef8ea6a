//! Which mode here is which mode there.
//!
//! ```text
//! MAC(φ, ψ) = (φᵀ M ψ)² / ((φᵀ M φ) (ψᵀ M ψ))
//! ```
//! Shapes of equal frequency are any basis of their space: they are compared as a group, by the part of a shape that
//! lies in the space, and then turned to follow the shapes before them (orthogonal Procrustes).

use tg_model::Mechanics;
use tg_tangent::TangentError;
use tg_tangent::dense;
use tg_tangent::faer::Mat;

use crate::assignment::assign;
use crate::modes::Modes;
use crate::shape::{dot, mass_product};

/// Modes at one parameter value.
pub(crate) struct Point {
    pub(crate) parameter: f64,
    pub(crate) omega_squared: Vec<f64>,
    pub(crate) shapes: Vec<Vec<f64>>,
    /// Group of each mode; modes of one group have equal ω².
    pub(crate) group: Vec<usize>,
    /// M times each shape.
    weighted: Vec<Vec<f64>>,
}

/// Tracked modes at the last accepted parameter value.
#[derive(Clone)]
pub(crate) struct Front {
    pub(crate) omega_squared: Vec<f64>,
    pub(crate) shapes: Vec<Vec<f64>>,
    /// Tracks of one bond have had equal ω² from the first parameter on, so that their shapes are still any basis.
    bond: Vec<usize>,
}

/// A front that follows another, and how well.
pub(crate) struct Step {
    pub(crate) front: Front,
    /// MAC of each track.
    pub(crate) mac: Vec<f64>,
}

impl Step {
    pub(crate) fn worst(&self) -> f64 {
        self.mac.iter().fold(1.0, |a, &b| a.min(b))
    }
}

impl Point {
    pub(crate) fn new(mechanics: &dyn Mechanics, parameter: f64, modes: Modes, cluster: f64) -> Self {
        let mut group = Vec::new();
        let mut last: Option<(f64, usize)> = None;
        for mode in &modes.list {
            let value = mode.omega_squared;
            let id = match last {
                Some((before, id)) if are_equal(before, value, cluster, modes.zero_limit) => id,
                Some((_, id)) => id + 1,
                None => 0,
            };
            last = Some((value, id));
            group.push(id);
        }
        let omega_squared = modes.list.iter().map(|mode| mode.omega_squared).collect();
        let shapes: Vec<Vec<f64>> = modes.list.into_iter().map(|mode| mode.shape).collect();
        let weighted = shapes.iter().map(|shape| mass_product(mechanics, shape)).collect();
        Self { parameter, omega_squared, shapes, group, weighted }
    }

    /// The first `count` modes, and what remains of the last group.
    pub(crate) fn first_front(&self, count: usize) -> Front {
        let mut count = count.min(self.shapes.len());
        while count > 0 && count < self.shapes.len() && self.group[count] == self.group[count - 1] {
            count += 1;
        }
        Front {
            omega_squared: self.omega_squared[..count].to_vec(),
            shapes: self.shapes[..count].to_vec(),
            bond: self.group[..count].to_vec(),
        }
    }
}

/// Neighbours within `cluster` of their size, or both zero.
fn are_equal(a: f64, b: f64, cluster: f64, zero_limit: f64) -> bool {
    (b - a).abs() <= cluster * a.abs().max(b.abs()) || (a.abs() <= zero_limit && b.abs() <= zero_limit)
}

impl Front {
    /// The modes of `point` that follow these tracks; `mechanics` is that of the point.
    pub(crate) fn follow(&self, mechanics: &dyn Mechanics, point: &Point) -> Result<Step, TangentError> {
        let mut overlap: Vec<Vec<f64>> = self
            .shapes
            .iter()
            .map(|old| {
                let norm = dot(old, &mass_product(mechanics, old)).sqrt();
                point.weighted.iter().map(|new| dot(old, new) / norm).collect()
            })
            .collect();
        let assigned = assign(&self.shares(&overlap, point));
        for tracks in groups(&self.bond) {
            let splits = tracks.iter().any(|&t| point.group[assigned[t]] != point.group[assigned[tracks[0]]]);
            if splits {
                let targets: Vec<usize> = tracks.iter().map(|&t| assigned[t]).collect();
                turn_rows(&mut overlap, &tracks, &targets)?;
            }
        }
        let tracks = self.shapes.len();
        let mut front = Front {
            omega_squared: vec![0.0; tracks],
            shapes: vec![Vec::new(); tracks],
            bond: self.bond_after(&assigned, point),
        };
        let mut mac = vec![0.0; tracks];
        let target_groups: Vec<usize> = assigned.iter().map(|&b| point.group[b]).collect();
        for followers in groups(&target_groups) {
            let members: Vec<usize> =
                (0..point.group.len()).filter(|&b| point.group[b] == target_groups[followers[0]]).collect();
            let x = Mat::from_fn(followers.len(), members.len(), |r, c| overlap[followers[r]][members[c]]);
            let turn = procrustes(&x)?;
            for (r, &t) in followers.iter().enumerate() {
                let mut shape = vec![0.0; point.shapes[members[0]].len()];
                let mut product = 0.0;
                for (c, &b) in members.iter().enumerate() {
                    let q = turn[(r, c)];
                    shape.iter_mut().zip(&point.shapes[b]).for_each(|(x, y)| *x += q * y);
                    front.omega_squared[t] += q * q * point.omega_squared[b];
                    product += q * overlap[t][b];
                }
                front.shapes[t] = shape;
                mac[t] = product * product;
            }
        }
        Ok(Step { front, mac })
    }

    /// For each track and mode the MAC, that of groups where either side is one.
    fn shares(&self, overlap: &[Vec<f64>], point: &Point) -> Vec<Vec<f64>> {
        let (tracks, modes) = (overlap.len(), point.group.len());
        let old = groups(&self.bond);
        let new = groups(&point.group);
        let mut shares = vec![vec![0.0; modes]; tracks];
        for a in &old {
            for b in &new {
                let squares = a.iter().flat_map(|&t| b.iter().map(move |&m| overlap[t][m] * overlap[t][m]));
                let share = squares.sum::<f64>() / a.len().min(b.len()) as f64;
                let share = if share.is_finite() { share } else { 0.0 };
                a.iter().for_each(|&t| b.iter().for_each(|&m| shares[t][m] = share));
            }
        }
        shares
    }

    /// Tracks stay bonded while they stay in one group.
    fn bond_after(&self, assigned: &[usize], point: &Point) -> Vec<usize> {
        let key = |t: usize| (self.bond[t], point.group[assigned[t]]);
        (0..assigned.len()).map(|t| (0..=t).find(|&first| key(first) == key(t)).unwrap_or(t)).collect()
    }
}

/// Indices with equal labels.
fn groups(labels: &[usize]) -> Vec<Vec<usize>> {
    let mut lists: Vec<(usize, Vec<usize>)> = Vec::new();
    for (k, &label) in labels.iter().enumerate() {
        match lists.iter_mut().find(|(l, _)| *l == label) {
            Some((_, list)) => list.push(k),
            None => lists.push((label, vec![k])),
        }
    }
    lists.into_iter().map(|(_, list)| list).collect()
}

/// The matrix with orthonormal rows that is nearest to x, which has no more rows than columns.
fn procrustes(x: &Mat<f64>) -> Result<Mat<f64>, TangentError> {
    let svd = dense::svd(x)?;
    let rows = x.nrows();
    Ok(&svd.left * svd.right.subcols(0, rows).transpose())
}

/// Turns rows of the overlap, an arbitrary basis, towards their targets.
fn turn_rows(overlap: &mut [Vec<f64>], tracks: &[usize], targets: &[usize]) -> Result<(), TangentError> {
    let k = tracks.len();
    // Row r of the turned basis is Σ_a q_ar old_a; the best q is the polar factor of ⟨old_a, target_r⟩.
    let q = procrustes(&Mat::from_fn(k, k, |a, r| overlap[tracks[a]][targets[r]]))?;
    let old: Vec<Vec<f64>> = tracks.iter().map(|&t| overlap[t].clone()).collect();
    for (r, &t) in tracks.iter().enumerate() {
        for (b, x) in overlap[t].iter_mut().enumerate() {
            *x = (0..k).map(|a| q[(a, r)] * old[a][b]).sum();
        }
    }
    Ok(())
}
