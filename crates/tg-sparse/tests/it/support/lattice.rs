//! Grids of particles with bars as constraints.

use super::{Problem, Random};

/// Which bars a grid has.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Bars {
    /// Along the axes: fewer than the degrees of freedom.
    Axes,
    /// Along the axes and all diagonals of faces: rigid and over-constrained.
    Braced,
}

/// Grid of `counts` particles in `counts.len()` dimensions at perturbed (generic) positions, mass at each, springs
/// across faces. Each bar is the constraint that its squared half length stays: row (p − q, q − p).
pub(crate) fn lattice(counts: &[usize], bars: Bars, seed: u64) -> Problem {
    let mut random = Random::new(seed);
    let d = counts.len();
    let particles: usize = counts.iter().product();
    let at = |index: &[usize]| index.iter().zip(counts).rev().fold(0, |sum, (i, count)| sum * count + i);
    let index_of = |mut p: usize| -> Vec<usize> {
        counts
            .iter()
            .map(|count| {
                let i = p % count;
                p /= count;
                i
            })
            .collect()
    };
    let positions: Vec<Vec<f64>> = (0..particles)
        .map(|p| index_of(p).iter().map(|&i| i as f64 + 0.25 * random.value()).collect())
        .collect();
    let turned: Vec<Vec<f64>> =
        positions.iter().map(|p| p.iter().map(|x| x + 0.01 * random.value()).collect()).collect();
    let mut pairs = Vec::new();
    let mut springs = Vec::new();
    for p in 0..particles {
        let index = index_of(p);
        for a in 0..d {
            let mut along = index.clone();
            along[a] += 1;
            if along[a] == counts[a] {
                continue;
            }
            pairs.push((p, at(&along)));
            for b in a + 1..d {
                let mut across = along.clone();
                across[b] += 1;
                if across[b] == counts[b] {
                    continue;
                }
                let mut beside = index.clone();
                beside[b] += 1;
                springs.push((p, at(&across)));
                if bars == Bars::Braced {
                    pairs.push((p, at(&across)));
                    pairs.push((at(&along), at(&beside)));
                }
            }
        }
    }
    let mut problem = Problem { n: d * particles, m: pairs.len(), ..Problem::default() };
    let mass = (0..d * particles).map(|i| Some((i, i))).collect();
    let masses = (0..d * particles).map(|_| 1.5 + random.value()).collect();
    let (mut entries, mut values) = (Vec::new(), Vec::new());
    for (p, q) in springs {
        let stiffness = 1.0 + 0.5 * random.value();
        for (sign, i, j) in [(1.0, p, p), (1.0, q, q), (-1.0, p, q), (-1.0, q, p)] {
            for axis in 0..d {
                entries.push(Some((d * i + axis, d * j + axis)));
                values.push(sign * stiffness);
            }
        }
    }
    problem.leading = vec![(1.0, mass, masses), (0.1, entries, values)];
    for (j, (p, q)) in pairs.into_iter().enumerate() {
        for axis in 0..d {
            let upper = positions[p][axis] - positions[q][axis];
            let lower = turned[p][axis] - turned[q][axis];
            for (sign, particle) in [(1.0, p), (-1.0, q)] {
                problem.jacobian.push(Some((j, d * particle + axis)));
                problem.upper.push(sign * upper);
                problem.lower.push(sign * lower);
            }
        }
    }
    problem
}
