//! Systems with a constant symmetric leading block against dense elimination with complete pivoting.

use crate::support::lattice::{Bars, lattice};
use crate::support::{Problem, Random, chain, full_pivoting, largest};
use allocation_counter::measure;
use tg_sparse::{Row, SparseError, SymmetricSystem};

/// The problem with H replaced by its symmetric part and A₁ by A₀.
fn symmetric(mut problem: Problem) -> Problem {
    for (_, entries, values) in &mut problem.leading {
        let mirrored: Vec<_> = entries.iter().map(|entry| entry.map(|(i, j)| (j, i))).collect();
        entries.extend(mirrored);
        values.iter_mut().for_each(|value| *value *= 0.5);
        values.extend_from_within(..);
    }
    problem.lower = problem.upper.clone();
    problem
}

fn system(problem: &Problem) -> SymmetricSystem {
    let scaled: Vec<Vec<f64>> =
        problem.leading.iter().map(|(factor, _, v)| v.iter().map(|v| factor * v).collect()).collect();
    let leading: Vec<&[f64]> = scaled.iter().map(Vec::as_slice).collect();
    SymmetricSystem::new(problem.pattern(), &leading)
}

fn difference(problem: Problem, seed: u64) -> f64 {
    let problem = symmetric(problem);
    let mut system = system(&problem);
    let rhs = Random::new(seed).vector(problem.n + problem.m);
    // The second factorisation starts from M again.
    system.factor(&Random::new(seed).vector(problem.jacobian.len())).unwrap();
    system.factor(&problem.upper).unwrap();
    let mut x = rhs.clone();
    system.solve(&mut x);
    let (rank, dense) = full_pivoting(problem.dense(), rhs, 1e-14);
    assert_eq!(rank, x.len());
    largest(x.iter().zip(&dense).map(|(a, b)| a - b)) / largest(dense)
}

#[test]
fn chains_and_rings() {
    for closed in [false, true] {
        for bodies in [1, 2, 3, 5, 12] {
            for cables in [0, 1, 3] {
                let difference = difference(chain(bodies, cables, closed, 4), 2);
                assert!(
                    difference < 1e-12,
                    "{bodies} bodies, {cables} cables, closed {closed}: {difference:e}"
                );
            }
        }
    }
}

/// Problems that have nothing to do with each other, as one.
fn beside(problems: impl IntoIterator<Item = Problem>) -> Problem {
    let mut all = Problem::default();
    for problem in problems {
        let (n, m) = (all.n, all.m);
        all.n += problem.n;
        all.m += problem.m;
        all.leading.extend(problem.leading.into_iter().map(|(factor, entries, values)| {
            (factor, entries.into_iter().map(|e| e.map(|(i, j)| (i + n, j + n))).collect(), values)
        }));
        all.jacobian.extend(problem.jacobian.iter().map(|e| e.map(|(j, i)| (j + m, i + n))));
        all.upper.extend(problem.upper);
        all.lower.extend(problem.lower);
    }
    all
}

#[test]
fn chains_side_by_side() {
    for lengths in [&[1, 1, 1, 1, 1][..], &[4, 4, 4], &[6, 2, 6, 3, 6, 6, 1], &[9, 3, 3, 3, 3, 3, 3]] {
        let chains = lengths.iter().zip(1..).map(|(&bodies, seed)| chain(bodies, 0, false, seed));
        let difference = difference(beside(chains), 3);
        assert!(difference < 1e-12, "{lengths:?}: {difference:e}");
    }
}

#[test]
fn lattices() {
    for counts in [&[2, 2][..], &[5, 5], &[8, 6], &[2, 2, 2], &[3, 3, 3], &[4, 3, 3]] {
        let difference = difference(lattice(counts, Bars::Axes, 11), 5);
        assert!(difference < 1e-11, "{counts:?}: {difference:e}");
    }
}

#[test]
fn entries_outside_and_repeated() {
    // A particle of 2 kg and one of 0 kg held by its constraint's twin entries: x₁ = g.
    let leading = [Some((0, 0)), None];
    let jacobian = [Some((0, 0)), None, Some((0, 0))];
    let pattern = tg_sparse::SaddlePattern::new(1, 1, &[&leading], &jacobian).unwrap();
    let mut system = SymmetricSystem::new(pattern, &[&[2.0, 7.0]]);
    system.factor(&[0.25, 9.0, 0.25]).unwrap();
    let mut x = [3.0, 1.5];
    system.solve(&mut x);
    // 0.5 x = 1.5, 2 x − 0.5 y = 3.
    assert!((x[0] - 3.0).abs() < 1e-15 && (x[1] - 6.0).abs() < 1e-14, "{x:?}");
}

#[test]
fn dependent_constraints_are_refused_by_name() {
    let leading = [Some((0, 0)), Some((1, 1))];
    let jacobian = [Some((0, 0)), Some((0, 1)), Some((1, 0)), Some((1, 1))];
    let pattern = tg_sparse::SaddlePattern::new(2, 2, &[&leading], &jacobian).unwrap();
    let mut system = SymmetricSystem::new(pattern, &[&[1.0, 1.0]]);
    for jacobian in [[0.1, 0.2, 0.3, 0.6 + 1e-12], [0.1, 0.2, f64::NAN, 0.6]] {
        let error = system.factor(&jacobian).unwrap_err();
        assert!(matches!(error, SparseError::Pivot { row: Row::Multiplier(_), .. }), "{error:?}");
    }
}

#[test]
fn nothing_is_allocated() {
    let problem = symmetric(chain(8, 0, false, 3));
    let mut system = system(&problem);
    let mut x = Random::new(1).vector(problem.n + problem.m);
    let count = measure(|| {
        for _ in 0..3 {
            system.factor(&problem.upper).unwrap();
            system.solve(&mut x);
        }
    });
    assert_eq!(count.count_total, 0);
}
