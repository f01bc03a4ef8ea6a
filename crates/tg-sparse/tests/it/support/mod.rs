//! Test systems and dense algebra that shares nothing with the crate.

pub(crate) mod lattice;

use tg_sparse::{SaddlePattern, SaddleSystem};

pub(crate) type Entry = Option<(usize, usize)>;

/// Reproducible numbers in −1..1.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)
    }

    pub(crate) fn value(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn index(&mut self, below: usize) -> usize {
        (((self.value() + 1.0) / 2.0 * below as f64) as usize).min(below - 1)
    }

    pub(crate) fn vector(&mut self, length: usize) -> Vec<f64> {
        (0..length).map(|_| self.value()).collect()
    }
}

/// A saddle-point system as entry lists and values.
#[derive(Clone, Default, Debug)]
pub(crate) struct Problem {
    pub(crate) n: usize,
    pub(crate) m: usize,
    /// Groups of leading entries with factor and values.
    pub(crate) leading: Vec<(f64, Vec<Entry>, Vec<f64>)>,
    pub(crate) jacobian: Vec<Entry>,
    pub(crate) upper: Vec<f64>,
    pub(crate) lower: Vec<f64>,
}

impl Problem {
    pub(crate) fn pattern(&self) -> SaddlePattern {
        let leading: Vec<&[Entry]> = self.leading.iter().map(|(_, entries, _)| entries.as_slice()).collect();
        SaddlePattern::new(self.n, self.m, &leading, &self.jacobian).unwrap()
    }

    pub(crate) fn fill(&self, system: &mut SaddleSystem) {
        system.clear_leading();
        for (group, (factor, _, values)) in self.leading.iter().enumerate() {
            system.add_leading(group, *factor, values);
        }
        system.set_jacobian(&self.upper, &self.lower);
    }

    pub(crate) fn system(&self) -> SaddleSystem {
        let mut system = SaddleSystem::new(self.pattern());
        self.fill(&mut system);
        system
    }

    /// (row, column, value) of the whole matrix, repeated entries kept.
    pub(crate) fn triplets(&self) -> Vec<(usize, usize, f64)> {
        let mut result = Vec::new();
        for (factor, entries, values) in &self.leading {
            for (entry, value) in entries.iter().zip(values) {
                if let Some((i, j)) = entry {
                    result.push((*i, *j, factor * value));
                }
            }
        }
        for ((entry, upper), lower) in self.jacobian.iter().zip(&self.upper).zip(&self.lower) {
            if let Some((j, i)) = entry {
                result.push((*i, self.n + j, -upper));
                result.push((self.n + j, *i, *lower));
            }
        }
        result
    }

    pub(crate) fn dense(&self) -> Vec<Vec<f64>> {
        let size = self.n + self.m;
        let mut dense = vec![vec![0.0; size]; size];
        for (i, j, value) in self.triplets() {
            dense[i][j] += value;
        }
        dense
    }

    pub(crate) fn dense_jacobian(&self) -> Vec<Vec<f64>> {
        let mut dense = vec![vec![0.0; self.n]; self.m];
        for (entry, value) in self.jacobian.iter().zip(&self.lower) {
            if let Some((j, i)) = entry {
                dense[*j][*i] += value;
            }
        }
        dense
    }
}

/// Gaussian elimination with complete pivoting: rank to a relative tolerance, and the solution if regular.
pub(crate) fn full_pivoting(mut a: Vec<Vec<f64>>, mut b: Vec<f64>, tolerance: f64) -> (usize, Vec<f64>) {
    let rows = a.len();
    let columns = a.first().map_or(0, Vec::len);
    let mut order: Vec<usize> = (0..columns).collect();
    let mut largest = 0.0;
    let mut rank = 0;
    for k in 0..rows.min(columns) {
        let (mut p, mut q, mut best) = (k, k, 0.0);
        for (i, row) in a.iter().enumerate().skip(k) {
            for (j, value) in row.iter().enumerate().skip(k) {
                if value.abs() > best {
                    (p, q, best) = (i, j, value.abs());
                }
            }
        }
        if k == 0 {
            largest = best;
        }
        if best <= tolerance * largest {
            break;
        }
        rank += 1;
        a.swap(k, p);
        b.swap(k, p);
        order.swap(k, q);
        for row in &mut a {
            row.swap(k, q);
        }
        let pivot = a[k].clone();
        for i in k + 1..rows {
            let l = a[i][k] / pivot[k];
            for (value, p) in a[i].iter_mut().zip(&pivot) {
                *value -= l * p;
            }
            b[i] -= l * b[k];
        }
    }
    let mut x = vec![0.0; columns];
    if rank == rows && rank == columns {
        for k in (0..rows).rev() {
            let sum: f64 = (k + 1..columns).map(|j| a[k][j] * x[order[j]]).sum();
            x[order[k]] = (b[k] - sum) / a[k][k];
        }
    }
    (rank, x)
}

pub(crate) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |a, x| if x.abs() > a || x.is_nan() { x.abs() } else { a })
}

/// A chain of rigid bodies in natural coordinates with one point and three base vectors (RUVW): a scalar 4 × 4 mass
/// ⊗ I₃, six dot constraints on pairs of base vectors, cables that couple nodes of neighbours by 3 × 3 blocks. Closed: the
/// last body is the neighbour of the first. A₀ and A₁ belong to nearby configurations.
pub(crate) fn chain(bodies: usize, cables: usize, closed: bool, seed: u64) -> Problem {
    let mut random = Random::new(seed);
    let mut p = Problem { n: 12 * bodies, m: 6 * bodies, ..Problem::default() };
    let (mut mass, mut mass_values) = (Vec::new(), Vec::new());
    let (mut stiffness, mut stiffness_values) = (Vec::new(), Vec::new());
    let unknown = |body: usize, node: usize, axis: usize| 12 * body + 3 * node + axis;
    for body in 0..bodies {
        let spread = 0.1 * random.value();
        for a in 0..4 {
            for b in 0..4 {
                let value = if a == b { 2.0 + a as f64 } else { 0.3 + spread };
                for axis in 0..3 {
                    mass.push(Some((unknown(body, a, axis), unknown(body, b, axis))));
                    mass_values.push(value);
                }
            }
        }
        let base: Vec<f64> =
            (0..9).map(|k| if k % 4 == 0 { 1.0 } else { 0.0 } + 0.3 * random.value()).collect();
        let turned: Vec<f64> = base.iter().map(|x| x + 0.02 * random.value()).collect();
        for (j, (a, b)) in [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].into_iter().enumerate() {
            for (node, other) in [(a, b), (b, a)] {
                for axis in 0..3 {
                    p.jacobian.push(Some((6 * body + j, unknown(body, 1 + node, axis))));
                    p.upper.push(base[3 * other + axis]);
                    p.lower.push(turned[3 * other + axis]);
                }
                if a == b {
                    break;
                }
            }
        }
        let next = if body + 1 < bodies {
            body + 1
        } else if closed && bodies > 1 {
            0
        } else {
            continue;
        };
        for cable in 0..cables {
            let ends = [(body, 1 + cable % 3), (next, cable % 4)];
            let direction = random.vector(3);
            for (sign, (i, a), (j, b)) in [
                (1.0, ends[0], ends[0]),
                (-1.0, ends[0], ends[1]),
                (-1.0, ends[1], ends[0]),
                (1.0, ends[1], ends[1]),
            ] {
                for r in 0..3 {
                    for c in 0..3 {
                        stiffness.push(Some((unknown(i, a, r), unknown(j, b, c))));
                        let isotropic = if r == c { 0.5 } else { 0.0 };
                        stiffness_values.push(sign * (direction[r] * direction[c] + isotropic));
                    }
                }
            }
        }
    }
    p.leading = vec![(1.0, mass, mass_values), (0.05, stiffness, stiffness_values)];
    p
}
