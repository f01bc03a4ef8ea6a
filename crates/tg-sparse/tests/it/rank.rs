//! Dependent rows against dense elimination with complete pivoting and closed counts.

use crate::support::lattice::{Bars, lattice};
use crate::support::{Entry, Problem, chain, full_pivoting, largest};
use tg_sparse::{DependentRow, SparseError, dependent_rows};

fn dependents(problem: &Problem) -> Vec<DependentRow> {
    dependent_rows(problem.n, problem.m, &problem.jacobian, &problem.lower, 1e-8).unwrap()
}

/// Checks a result completely: the count, the rank of the rows left, and each combination.
fn check(problem: &Problem) -> usize {
    let dense = problem.dense_jacobian();
    let (rank, _) = full_pivoting(dense.clone(), vec![0.0; problem.m], 1e-10);
    let found = dependents(problem);
    assert_eq!(found.len(), problem.m - rank);
    let left: Vec<_> =
        (0..problem.m).filter(|j| found.iter().all(|d| d.row != *j)).map(|j| dense[j].clone()).collect();
    let count = left.len();
    assert_eq!(full_pivoting(left, vec![0.0; count], 1e-10).0, rank);
    for dependent in &found {
        assert!(dependent.sine < 1e-10, "{dependent:?}");
        let mut rest = dense[dependent.row].clone();
        for &(k, coefficient) in &dependent.combination {
            assert!(found.iter().all(|d| d.row != k));
            rest.iter_mut().zip(&dense[k]).for_each(|(x, a)| *x -= coefficient * a);
        }
        let norm = largest(dense[dependent.row].iter().copied());
        assert!(largest(rest) < 1e-7 * norm, "{dependent:?}");
    }
    found.len()
}

#[test]
fn regular_structures_have_none() {
    assert_eq!(check(&chain(5, 2, true, 1)), 0);
    for counts in [&[6, 5][..], &[3, 3, 3]] {
        assert_eq!(check(&lattice(counts, Bars::Axes, 1)), 0);
    }
}

#[test]
fn braced_lattices() {
    // A braced grid in general position is rigid: rank = freedoms − rigid motions.
    for (counts, motions) in [(&[2, 2][..], 3), (&[3, 3], 3), (&[7, 5], 3), (&[2, 2, 2], 6), (&[3, 4, 3], 6)]
    {
        for seed in 1..4 {
            let problem = lattice(counts, Bars::Braced, seed);
            assert_eq!(check(&problem), problem.m + motions - problem.n, "{counts:?}");
        }
    }
}

#[test]
fn tens_of_thousands_of_rows() {
    // A grid of bars along the axes is independent in general position; each further row is the sum of two others.
    let mut problem = lattice(&[110, 110], Bars::Axes, 1);
    let rows = problem.m;
    for k in 0..40 {
        let first = 500 * k + 7;
        for at in 4 * first..4 * (first + 2) {
            let Some((_, unknown)) = problem.jacobian[at] else { continue };
            problem.jacobian.push(Some((problem.m, unknown)));
            problem.upper.push(problem.upper[at]);
            problem.lower.push(problem.lower[at]);
        }
        problem.m += 1;
    }
    assert!(rows > 20_000);
    let found = dependents(&problem);
    assert_eq!(found.len(), 40);
    for dependent in found {
        assert!(dependent.sine < 1e-11);
        // Two bars and their sum: any two give the third.
        assert_eq!(dependent.combination.len(), 2, "{dependent:?}");
        assert!(dependent.combination.iter().all(|(_, coefficient)| (coefficient.abs() - 1.0).abs() < 1e-9));
    }
}

#[test]
fn a_lattice_with_half_of_its_bars_redundant() {
    let problem = lattice(&[24, 24], Bars::Braced, 1);
    let found = dependents(&problem);
    assert_eq!(found.len(), problem.m + 3 - problem.n);
    assert!(found.iter().all(|dependent| dependent.sine < 1e-9));
}

#[test]
fn sines_and_tolerance() {
    let entries: Vec<Entry> = (0..3).flat_map(|j| [Some((j, 0)), Some((j, 1)), Some((j, 2))]).collect();
    for angle in [1e-3_f64, 1e-5, 3e-6, 1e-7, 1e-9] {
        // The second row at a small angle to the first, the third orthogonal to both; lengths differ.
        let values = [2.0, 0.0, 0.0, 7.0 * angle.cos(), 7.0 * angle.sin(), 0.0, 0.0, 0.0, 5.0];
        let found = dependent_rows(3, 3, &entries, &values, 2.0 * angle).unwrap();
        assert_eq!(found.len(), 1);
        assert!(found[0].row < 2, "{found:?}");
        assert!((found[0].sine - angle.sin()).abs() < 1e-9 * angle + 1e-15, "{found:?}");
        let ratio = if found[0].row == 1 { 3.5 } else { 1.0 / 3.5 };
        assert_eq!(found[0].combination.len(), 1);
        assert!((found[0].combination[0].1 / ratio - 1.0).abs() < angle);
        assert_eq!(dependent_rows(3, 3, &entries, &values, 0.5 * angle).unwrap(), vec![]);
    }
}

#[test]
fn small_angles_that_repeat() {
    // Three rows in a plane at angles of 1e-7: two are independent by the tolerance, the third depends on both.
    let entries: Vec<Entry> = (0..3).flat_map(|j| [Some((j, 0)), Some((j, 1))]).collect();
    let values = [1.0, 0.0, 1.0, 1e-7, 1.0, -2e-7];
    let found = dependent_rows(2, 3, &entries, &values, 1e-9).unwrap();
    assert_eq!(found.len(), 1);
    assert!(found[0].sine < 1e-13);
    let row = |j: usize| [values[2 * j], values[2 * j + 1]];
    let mut rest = row(found[0].row);
    for &(k, coefficient) in &found[0].combination {
        rest.iter_mut().zip(row(k)).for_each(|(x, a)| *x -= coefficient * a);
    }
    assert!(largest(rest) < 1e-14, "{found:?}");
}

#[test]
fn repeated_skipped_and_empty_rows() {
    let entries: [Entry; 7] =
        [Some((0, 0)), Some((0, 0)), None, Some((2, 1)), Some((2, 1)), Some((3, 0)), Some((3, 1))];
    // Row 0 = 3 e₀, row 1 without entries, row 2 cancels to zero, row 3 = e₀ (its second entry is zero).
    let values = [1.0, 2.0, f64::NAN, 5.0, -5.0, 1.0, 0.0];
    let found = dependent_rows(2, 4, &entries, &values, 1e-10).unwrap();
    assert_eq!(found.iter().map(|d| d.row).collect::<Vec<_>>(), vec![1, 2, 3]);
    assert!(found[0].combination.is_empty() && found[1].combination.is_empty());
    assert_eq!(found[2].combination.len(), 1);
    assert_eq!(found[2].combination[0].0, 0);
    assert!((found[2].combination[0].1 - 1.0 / 3.0).abs() < 1e-15);
}

#[test]
fn among_equal_rows_the_earlier_is_kept() {
    let entries: Vec<Entry> = (0..4).flat_map(|j| [Some((j, 0)), Some((j, 1))]).collect();
    let values = [1.0, 2.0, 2.0, 4.0, 1.0, -1.0, -1.0, -2.0];
    let found = dependent_rows(2, 4, &entries, &values, 1e-10).unwrap();
    assert_eq!(found.iter().map(|d| d.row).collect::<Vec<_>>(), vec![1, 3]);
}

#[test]
fn scale_does_not_matter() {
    let mut problem = lattice(&[4, 4], Bars::Braced, 3);
    let expected: Vec<usize> = dependents(&problem).iter().map(|d| d.row).collect();
    for (entry, value) in problem.jacobian.iter().zip(&mut problem.lower) {
        *value *= if entry.unwrap().0 % 2 == 0 { 1e200 } else { 1e-200 };
    }
    assert_eq!(dependents(&problem).iter().map(|d| d.row).collect::<Vec<_>>(), expected);
}

#[test]
fn empty_and_wrong_input() {
    assert_eq!(dependent_rows(0, 0, &[], &[], 1e-10).unwrap(), vec![]);
    assert_eq!(dependent_rows(3, 0, &[], &[], 1e-10).unwrap(), vec![]);
    assert_eq!(dependent_rows(0, 2, &[], &[], 1e-10).unwrap().len(), 2);
    assert!(matches!(
        dependent_rows(1, 1, &[Some((0, 1))], &[1.0], 1e-10),
        Err(SparseError::EntryOutside { entry: 0, .. })
    ));
    assert!(matches!(
        dependent_rows(1, 1, &[Some((0, 0))], &[f64::NAN], 1e-10),
        Err(SparseError::NonFiniteMatrix { .. })
    ));
}
