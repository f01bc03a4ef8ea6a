//! Systems that the static order cannot factor: the pivoting fallback, or a typed error that names the equation.

use crate::support::lattice::{Bars, lattice};
use crate::support::{Problem, Random, chain, full_pivoting, largest};
use tg_sparse::{Row, SaddleSystem, SparseError};

/// Appends the combination of two rows of A as a further constraint.
fn with_redundant_row(mut problem: Problem, first: usize, second: usize) -> Problem {
    for at in 0..problem.jacobian.len() {
        let Some((j, i)) = problem.jacobian[at] else { continue };
        let factor = if j == first {
            0.5
        } else if j == second {
            -2.0
        } else {
            continue;
        };
        problem.jacobian.push(Some((problem.m, i)));
        problem.upper.push(factor * problem.upper[at]);
        problem.lower.push(factor * problem.lower[at]);
    }
    problem.m += 1;
    problem
}

fn singular_row(error: &SparseError) -> Row {
    let expected = if cfg!(feature = "pivoting") {
        matches!(error, SparseError::Singular { .. })
    } else {
        matches!(error, SparseError::Pivot { .. })
    };
    assert!(expected, "{error:?}");
    error.row().unwrap()
}

#[test]
fn a_redundant_constraint_is_an_error_that_names_it() {
    for (bodies, first, second) in [(1, 0, 1), (2, 3, 4), (6, 7, 11), (6, 2, 20), (40, 10, 230)] {
        let problem = with_redundant_row(chain(bodies, 3, true, 3), first, second);
        let mut system = problem.system();
        let row = singular_row(&system.factor().unwrap_err());
        let redundant = [first, second, problem.m - 1].map(Row::Multiplier);
        assert!(redundant.contains(&row), "{bodies} bodies: {row:?} is not of {redundant:?}");
        assert_eq!(system.solve(&mut vec![0.0; problem.n + problem.m]), Err(SparseError::NotFactored));
        assert_eq!(system.counts().fallbacks, u64::from(cfg!(feature = "pivoting")));
    }
}

#[test]
fn a_redundant_constraint_among_badly_conditioned_ones() {
    // Rows at angles of 1e-5 to each other leave pivots of 1e-10; rounding hides the redundant one behind them.
    for angle in [1e-3, 1e-4, 1e-5, 1e-6] {
        let mut random = Random::new(12);
        let n = 30;
        let mut problem = Problem { n, m: 8, ..Problem::default() };
        problem.leading = vec![(1.0, (0..n).map(|i| Some((i, i))).collect(), vec![1.0; n])];
        let base = random.vector(n);
        for j in 0..8 {
            for (i, x) in base.iter().enumerate() {
                problem.jacobian.push(Some((j, i)));
                problem.upper.push(x + angle * random.value());
            }
        }
        problem.lower = problem.upper.clone();
        let regular = problem.system().factor();
        assert!(regular.is_ok() || angle < 1e-5, "{angle:e}: {regular:?}");
        let problem = with_redundant_row(problem, 2, 5);
        let mut system = problem.system();
        let error = system.factor().unwrap_err();
        assert!(matches!(singular_row(&error), Row::Multiplier(_)), "{angle:e}: {error:?}");
    }
}

#[test]
fn an_over_constrained_lattice_is_an_error() {
    for counts in [&[3, 3][..], &[6, 5], &[3, 3, 3]] {
        let mut system = lattice(counts, Bars::Braced, 2).system();
        assert!(matches!(singular_row(&system.factor().unwrap_err()), Row::Multiplier(_)));
    }
}

#[test]
fn an_unknown_without_inertia_is_named() {
    let mut problem = chain(2, 1, false, 3);
    // A further unknown that nothing holds.
    problem.leading[0].1.push(Some((problem.n, problem.n)));
    problem.leading[0].2.push(0.0);
    problem.n += 1;
    let mut system = problem.system();
    assert_eq!(singular_row(&system.factor().unwrap_err()), Row::Unknown(problem.n - 1));
}

/// H indefinite, but definite where A x = 0: regular, yet not for the static order.
fn indefinite(bodies: usize) -> Problem {
    let mut problem = chain(bodies, 3, true, 5);
    // −γ A₀ᵀ A₁ added to H makes it indefinite and changes nothing on null(A).
    let (mut entries, mut values) = (Vec::new(), Vec::new());
    let jacobian: Vec<_> = problem.jacobian.iter().map(|entry| entry.unwrap()).collect();
    for (&(j, i), upper) in jacobian.iter().zip(&problem.upper) {
        for (&(l, k), lower) in jacobian.iter().zip(&problem.lower) {
            if j == l {
                entries.push(Some((i, k)));
                values.push(upper * lower);
            }
        }
    }
    problem.leading.push((-3.0, entries, values));
    problem
}

/// The smallest: the first pivot is exactly zero.
fn zero_pivot() -> SaddleSystem {
    let mut system = Problem {
        n: 2,
        m: 1,
        leading: vec![(1.0, vec![Some((0, 0)), Some((1, 1))], vec![0.0, 1.0])],
        jacobian: vec![Some((0, 0))],
        upper: vec![2.0],
        lower: vec![4.0],
    }
    .system();
    system.clear_leading();
    system.add_leading(0, 1.0, &[0.0, 1.0]);
    system
}

#[test]
#[cfg(not(feature = "pivoting"))]
fn without_the_fallback_a_zero_pivot_is_an_error() {
    let error = zero_pivot().factor().unwrap_err();
    assert_eq!(error.row(), Some(Row::Unknown(0)));
}

#[test]
#[cfg(feature = "pivoting")]
fn the_fallback_solves_a_zero_pivot() {
    let mut system = zero_pivot();
    system.factor().unwrap();
    // −2 y = 6, x₁ = 5, 4 x₀ = 8.
    let mut x = [6.0, 5.0, 8.0];
    let report = system.solve(&mut x).unwrap();
    assert!(report.fell_back && report.residual < 1e-15);
    assert_eq!(x, [2.0, 5.0, -3.0]);
    assert_eq!((system.counts().fallbacks, system.counts().solves), (1, 1));

    // With definite values the static order takes over again.
    system.clear_leading();
    system.add_leading(0, 1.0, &[1.0, 1.0]);
    system.factor().unwrap();
    let mut x = [6.0, 5.0, 8.0];
    assert!(!system.solve(&mut x).unwrap().fell_back);
    assert_eq!(x, [2.0, 5.0, -2.0]);
    assert_eq!((system.counts().fallbacks, system.counts().factorisations), (1, 2));
}

#[test]
#[cfg(feature = "pivoting")]
fn indefinite_but_definite_on_the_constraints() {
    for bodies in [1, 2, 7] {
        let problem = indefinite(bodies);
        let rhs = Random::new(9).vector(problem.n + problem.m);
        let mut x = rhs.clone();
        let mut system = problem.system();
        system.factor().unwrap();
        let report = system.solve(&mut x).unwrap();
        let difference = relative_difference(&problem, rhs, &x);
        assert!(difference < 1e-10, "{bodies} bodies: {difference:e}, {report:?}");
    }
}

/// The first pivot is not small against what it is made of, yet elimination with it destroys the digits of the rest.
fn small_first_pivot(pivot: f64) -> (Problem, Vec<f64>) {
    let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 0), (1, 2), (2, 1)];
    let problem = Problem {
        n: 3,
        m: 1,
        leading: vec![(1.0, pairs.map(Some).to_vec(), vec![pivot, 1.0, 3.0, 1.0, 1.0, 0.7, 0.4])],
        jacobian: vec![Some((0, 0)), Some((0, 1)), Some((0, 2))],
        upper: vec![1.0, 0.3, -0.4],
        lower: vec![1.1, 0.3, -0.2],
    };
    (problem, vec![1.0, 2.0, 3.0, 4.0])
}

fn relative_difference(problem: &Problem, rhs: Vec<f64>, x: &[f64]) -> f64 {
    let (rank, dense) = full_pivoting(problem.dense(), rhs, 1e-14);
    assert_eq!(rank, x.len());
    largest(x.iter().zip(&dense).map(|(a, b)| a - b)) / largest(dense)
}

#[test]
fn refinement_recovers_lost_digits() {
    let (problem, rhs) = small_first_pivot(1e-9);
    let mut system = problem.system();
    system.factor().unwrap();
    let mut x = rhs.clone();
    let report = system.solve(&mut x).unwrap();
    assert!(report.refinements > 0 && !report.fell_back && report.residual < 1e-13, "{report:?}");
    assert_eq!(system.counts().refinements, u64::from(report.refinements));
    assert!(relative_difference(&problem, rhs, &x) < 1e-12);
}

/// After Wilkinson: each elimination triples the last column, 3⁷⁹ in the end, while all pivots look good
/// and the matrix is regular.
fn growth() -> Problem {
    let n = 80;
    let mut random = Random::new(5);
    let (mut entries, mut values) = (Vec::new(), Vec::new());
    for i in 0..n {
        for j in 0..n {
            let size = 1.0 - 0.02 * random.value().abs();
            entries.push(Some((i, j)));
            values.push(match (i, j) {
                _ if j == n - 1 || i == j => size,
                _ if j < i => -2.0 * size,
                _ => 0.0,
            });
        }
    }
    Problem { n, leading: vec![(1.0, entries, values)], ..Problem::default() }
}

#[test]
fn a_residual_that_does_not_fall_sends_the_system_to_the_fallback() {
    let problem = growth();
    let rhs = Random::new(1).vector(problem.n);
    let mut system = problem.system();
    system.factor().unwrap();
    assert_eq!(system.counts().fallbacks, 0);
    let mut x = rhs.clone();
    let result = system.solve(&mut x);
    if cfg!(feature = "pivoting") {
        let report = result.unwrap();
        assert!(report.fell_back && report.residual < 1e-13, "{report:?}");
        assert!(relative_difference(&problem, rhs.clone(), &x) < 1e-12);
        // The factors of the fallback serve until the next factorisation.
        let mut again = rhs;
        assert!(system.solve(&mut again).unwrap().fell_back);
        assert_eq!(again, x);
        assert_eq!(system.counts().fallbacks, 1);
    } else {
        assert!(matches!(result, Err(SparseError::Residual { .. })), "{result:?}");
        assert_eq!(x, rhs);
    }
}

#[test]
fn nothing_wrong_is_returned_for_indefinite_systems() {
    // Whatever the feature: a solution is right, or there is an error.
    let problem = indefinite(3);
    let rhs = Random::new(9).vector(problem.n + problem.m);
    let mut system = problem.system();
    let mut x = rhs.clone();
    if let Ok(report) = system.factor().and_then(|()| system.solve(&mut x)) {
        let mut product = vec![0.0; x.len()];
        system.multiply(&x, &mut product);
        assert!(largest(product.iter().zip(&rhs).map(|(a, b)| a - b)) < 1e-9, "{report:?}");
    } else {
        assert_eq!(x, rhs);
    }
}
