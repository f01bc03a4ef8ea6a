//! Solutions against dense elimination with complete pivoting.

use crate::support::lattice::{Bars, lattice};
use crate::support::{Problem, Random, chain, full_pivoting, largest};
use proptest::prelude::*;

/// Relative difference between the crate's solution and the dense one.
fn difference(problem: &Problem, seed: u64) -> f64 {
    let mut system = problem.system();
    let rhs = Random::new(seed).vector(problem.n + problem.m);
    let mut x = rhs.clone();
    system.factor().unwrap();
    let report = system.solve(&mut x).unwrap();
    assert!(report.residual <= 1e-10 && !report.fell_back, "{report:?}");
    let (rank, dense) = full_pivoting(problem.dense(), rhs, 1e-14);
    assert_eq!(rank, x.len());
    largest(x.iter().zip(&dense).map(|(a, b)| a - b)) / largest(dense)
}

#[test]
fn chains_and_rings() {
    for closed in [false, true] {
        for bodies in [1, 2, 3, 5, 12] {
            for seed in 1..4 {
                let problem = chain(bodies, 1 + seed as usize, closed, seed);
                let difference = difference(&problem, seed);
                assert!(difference < 1e-12, "{bodies} bodies, closed {closed}: {difference:e}");
            }
        }
    }
}

#[test]
fn lattices_with_fewer_bars_than_freedoms() {
    for counts in [&[2, 2][..], &[5, 5], &[8, 6], &[2, 2, 2], &[3, 3, 3], &[4, 3, 3]] {
        let difference = difference(&lattice(counts, Bars::Axes, 11), 5);
        assert!(difference < 1e-11, "{counts:?}: {difference:e}");
    }
}

#[test]
fn one_constraint_over_many_unknowns() {
    // Longer than the cliques of the ordering.
    let n = 300;
    let mut random = Random::new(2);
    let mut problem = Problem { n, m: 2, ..Problem::default() };
    let diagonal = (0..n).map(|i| Some((i, i))).collect();
    problem.leading = vec![(1.0, diagonal, (0..n).map(|_| 2.0 + random.value()).collect())];
    for j in 0..2 {
        problem.jacobian.extend((0..n).map(|i| Some((j, i))));
    }
    problem.upper = random.vector(2 * n);
    problem.lower = problem.upper.iter().map(|x| x + 0.01 * random.value()).collect();
    assert!(difference(&problem, 3) < 1e-11);
}

#[test]
fn jacobians_far_apart() {
    // A₁ is not close to A₀; the leading block has an unsymmetric part, as damping gives.
    let mut problem = chain(4, 2, true, 9);
    let mut random = Random::new(8);
    for value in &mut problem.lower {
        *value = 1.3 * *value + 0.1 * random.value();
    }
    let entries: Vec<_> = (0..problem.n - 1).map(|i| Some((i, i + 1))).collect();
    let values = random.vector(entries.len());
    problem.leading.push((0.2, entries, values));
    assert!(difference(&problem, 4) < 1e-11);
}

#[test]
fn units_do_not_matter() {
    // Masses of 1e-9 and lengths of 1e3 with forces and constraints of very different size.
    let mut problem = chain(5, 3, false, 6);
    for (factor, ..) in &mut problem.leading {
        *factor *= 1e-9;
    }
    problem.upper.iter_mut().chain(&mut problem.lower).for_each(|value| *value *= 1e3);
    let mut system = problem.system();
    system.factor().unwrap();
    let mut x = Random::new(4).vector(problem.n + problem.m);
    let report = system.solve(&mut x).unwrap();
    assert!(report.residual <= 1e-13 && !report.fell_back, "{report:?}");
}

#[test]
fn multiply_agrees_with_dense() {
    let problem = chain(3, 2, true, 3);
    let system = problem.system();
    let x = Random::new(1).vector(problem.n + problem.m);
    let mut product = vec![0.0; x.len()];
    system.multiply(&x, &mut product);
    for (row, value) in problem.dense().iter().zip(product) {
        let exact: f64 = row.iter().zip(&x).map(|(a, b)| a * b).sum();
        assert!((exact - value).abs() < 1e-13);
    }
}

#[test]
fn one_pattern_many_values() {
    let first = chain(4, 3, true, 1);
    let mut system = first.system();
    for seed in 2..6 {
        let problem = chain(4, 3, true, seed);
        problem.fill(&mut system);
        system.factor().unwrap();
        let rhs = Random::new(seed).vector(problem.n + problem.m);
        let mut x = rhs.clone();
        system.solve(&mut x).unwrap();
        let (_, dense) = full_pivoting(problem.dense(), rhs, 1e-14);
        assert!(largest(x.iter().zip(&dense).map(|(a, b)| a - b)) < 1e-12 * largest(dense));
    }
    assert_eq!(
        (system.counts().factorisations, system.counts().solves, system.counts().fallbacks),
        (4, 4, 0)
    );
}

fn any_problem() -> impl Strategy<Value = Problem> {
    (1_usize..14, 0_usize..8, any::<u64>()).prop_map(|(n, m, seed)| {
        let m = m.min(n);
        let mut random = Random::new(seed);
        let mut problem = Problem { n, m, ..Problem::default() };
        // Sum of outer products of short vectors, and a diagonal: definite, of random pattern.
        let (mut entries, mut values) = (Vec::new(), Vec::new());
        for i in 0..n {
            entries.push(Some((i, i)));
            values.push(0.5);
        }
        for _ in 0..n {
            let picks: Vec<_> = (0..3).map(|_| (random.index(n), random.value())).collect();
            for &(i, a) in &picks {
                for &(j, b) in &picks {
                    entries.push(Some((i, j)));
                    values.push(a * b);
                }
            }
        }
        problem.leading = vec![(1.0, entries, values)];
        for j in 0..m {
            for _ in 0..4 {
                problem.jacobian.push(Some((j, random.index(n))));
                let value = random.value();
                problem.upper.push(value);
                problem.lower.push(value + 0.05 * random.value());
            }
        }
        problem
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn random_blocks(problem in any_problem(), seed in any::<u64>()) {
        let rhs = Random::new(seed).vector(problem.n + problem.m);
        let (rank, dense) = full_pivoting(problem.dense(), rhs.clone(), 1e-4);
        let mut system = problem.system();
        let mut x = rhs.clone();
        let result = system.factor().and_then(|()| system.solve(&mut x));
        if rank == rhs.len() {
            let report = result.unwrap();
            let difference = largest(x.iter().zip(&dense).map(|(a, b)| a - b)) / largest(dense);
            prop_assert!(difference < 1e-9, "{difference:e}, {report:?}");
        } else if result.is_ok() {
            // Close to singular, yet solved: then by a true solution.
            let mut product = vec![0.0; x.len()];
            system.multiply(&x, &mut product);
            let scale = largest(x.iter().copied()) * largest(problem.triplets().iter().map(|t| t.2)) + 1.0;
            prop_assert!(largest(product.iter().zip(&rhs).map(|(a, b)| a - b)) < 1e-9 * scale);
        }
    }
}
