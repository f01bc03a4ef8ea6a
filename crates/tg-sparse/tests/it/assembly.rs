//! Entry lists: repeated and skipped entries, errors, empty blocks; sprs as oracle.

use crate::support::{Entry, Problem, Random, chain, largest};
use sprs::{CsMat, TriMat};
use tg_sparse::{EntryList, Row, SaddlePattern, SaddleSystem, SparseError};

fn with_sprs(problem: &Problem) -> CsMat<f64> {
    let size = problem.n + problem.m;
    let mut triplets = TriMat::new((size, size));
    for (i, j, value) in problem.triplets() {
        triplets.add_triplet(i, j, value);
    }
    triplets.to_csr()
}

fn product(matrix: &CsMat<f64>, x: &[f64]) -> Vec<f64> {
    matrix.outer_iterator().map(|row| row.iter().map(|(j, value)| value * x[j]).sum()).collect()
}

/// A problem with entries repeated and skipped in every list.
fn ragged() -> Problem {
    let mut problem = chain(3, 2, false, 4);
    let mut random = Random::new(5);
    for (_, entries, values) in &mut problem.leading {
        for at in (0..entries.len()).step_by(5) {
            entries.push(entries[at]);
            values.push(0.1 * random.value());
            entries.insert(at, None);
            values.insert(at, f64::NAN);
        }
    }
    for at in (0..problem.jacobian.len()).step_by(3) {
        problem.jacobian.push(problem.jacobian[at]);
        problem.upper.push(0.1 * random.value());
        problem.lower.push(0.1 * random.value());
        problem.jacobian.insert(at, None);
        problem.upper.insert(at, f64::INFINITY);
        problem.lower.insert(at, 1e300);
    }
    problem
}

#[test]
fn assembly_agrees_with_sprs() {
    for problem in [ragged(), chain(4, 3, true, 8)] {
        let mut system = problem.system();
        // Twice: old values must not shine through.
        problem.fill(&mut system);
        let oracle = with_sprs(&problem);
        let x = Random::new(2).vector(problem.n + problem.m);
        let mut ours = vec![0.0; x.len()];
        system.multiply(&x, &mut ours);
        assert!(largest(ours.iter().zip(product(&oracle, &x)).map(|(a, b)| a - b)) < 1e-13);

        system.factor().unwrap();
        let mut solution = x.clone();
        system.solve(&mut solution).unwrap();
        assert!(largest(product(&oracle, &solution).iter().zip(&x).map(|(a, b)| a - b)) < 1e-11);
    }
}

#[test]
fn matrix_market_round_trip() {
    let problem = chain(3, 2, true, 8);
    let file = std::env::temp_dir().join(format!("tg-sparse-{}.mtx", std::process::id()));
    sprs::io::write_matrix_market(&file, &with_sprs(&problem)).unwrap();
    let read: TriMat<f64> = sprs::io::read_matrix_market(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    // The file's matrix, taken apart into blocks, is the same system.
    let n = problem.n;
    let mut copy = Problem { n, m: problem.m, ..Problem::default() };
    let (mut entries, mut values) = (Vec::new(), Vec::new());
    for (value, (i, j)) in &read {
        match (i < n, j < n) {
            (true, true) => {
                entries.push(Some((i, j)));
                values.push(*value);
            }
            (false, true) => {
                copy.jacobian.push(Some((i - n, j)));
                copy.lower.push(*value);
                copy.upper.push(0.0);
            }
            (true, false) => {
                copy.jacobian.push(Some((j - n, i)));
                copy.lower.push(0.0);
                copy.upper.push(-*value);
            }
            (false, false) => assert_eq!(*value, 0.0),
        }
    }
    copy.leading = vec![(1.0, entries, values)];
    let rhs = Random::new(6).vector(n + problem.m);
    let solve = |problem: &Problem| {
        let mut system = problem.system();
        let mut x = rhs.clone();
        system.factor().unwrap();
        system.solve(&mut x).unwrap();
        x
    };
    let (ours, theirs) = (solve(&problem), solve(&copy));
    assert!(largest(ours.iter().zip(&theirs).map(|(a, b)| a - b)) < 1e-12 * largest(ours.iter().copied()));
}

#[test]
fn entries_outside_are_named() {
    let group: &[Entry] = &[Some((0, 0)), Some((1, 2))];
    assert_eq!(
        SaddlePattern::new(2, 0, &[&[], group], &[]).unwrap_err(),
        SparseError::EntryOutside {
            list: EntryList::Leading(1),
            entry: 1,
            row: 1,
            column: 2,
            rows: 2,
            columns: 2
        }
    );
    let error = SaddlePattern::new(2, 1, &[], &[None, Some((1, 0))]).unwrap_err();
    assert!(matches!(error, SparseError::EntryOutside { list: EntryList::Jacobian, entry: 1, .. }));
    assert!(error.to_string().contains("the Jacobian"));
}

#[test]
fn a_multiplier_without_unknowns_is_named() {
    let error = SaddlePattern::new(2, 3, &[], &[Some((0, 0)), None, Some((2, 1))]).unwrap_err();
    assert_eq!(error, SparseError::FreeMultiplier { multiplier: 1 });
    assert_eq!(error.row(), Some(Row::Multiplier(1)));
    assert_eq!(
        SaddlePattern::new(0, 1, &[], &[]).unwrap_err(),
        SparseError::FreeMultiplier { multiplier: 0 }
    );
}

#[test]
fn too_many_unknowns_are_an_error() {
    let error = SaddlePattern::new(usize::MAX, 1, &[], &[]).unwrap_err();
    assert!(matches!(error, SparseError::TooLarge { .. }));
}

#[test]
fn empty_blocks() {
    // n = m = 0.
    let mut empty = SaddleSystem::new(SaddlePattern::new(0, 0, &[], &[]).unwrap());
    empty.factor().unwrap();
    assert_eq!(empty.solve(&mut []).unwrap().residual, 0.0);

    // m = 0: a definite system.
    let entries: Vec<Entry> = vec![Some((0, 0)), Some((1, 1)), Some((0, 1)), Some((1, 0))];
    let mut definite = SaddleSystem::new(SaddlePattern::new(2, 0, &[&entries], &[]).unwrap());
    definite.add_leading(0, 2.0, &[1.0, 2.0, 0.5, 0.5]);
    definite.set_jacobian(&[], &[]);
    definite.factor().unwrap();
    let mut x = [3.0, 5.0];
    definite.solve(&mut x).unwrap();
    assert!((2.0 * x[0] + x[1] - 3.0).abs() < 1e-15 && (x[0] + 4.0 * x[1] - 5.0).abs() < 1e-15);
}

#[test]
fn sizes_are_reported() {
    let pattern = ragged().pattern();
    assert_eq!((pattern.unknowns(), pattern.multipliers(), pattern.size()), (36, 18, 54));
    assert_eq!(pattern.entries(), with_sprs(&ragged()).nnz());
    assert!(pattern.factor_entries() >= pattern.entries());
    assert!(pattern.factor_multiplications() > 0.0);
}

#[test]
fn new_values_need_a_new_factorisation() {
    let problem = chain(1, 0, false, 1);
    let mut system = problem.system();
    let mut x = vec![1.0; 18];
    assert_eq!(system.solve(&mut x), Err(SparseError::NotFactored));
    system.factor().unwrap();
    assert!(system.solve(&mut x).is_ok());
    system.clear_leading();
    assert_eq!(system.solve(&mut x), Err(SparseError::NotFactored));
}

#[test]
fn values_that_are_not_finite_are_named() {
    let problem = chain(2, 1, false, 1);
    let mut system = problem.system();
    system.factor().unwrap();
    let mut rhs = vec![1.0; 36];
    rhs[30] = f64::NAN;
    assert_eq!(system.solve(&mut rhs), Err(SparseError::NonFiniteVector { row: Row::Multiplier(6) }));

    let mut lower = problem.lower.clone();
    lower[0] = f64::INFINITY;
    system.set_jacobian(&problem.upper, &lower);
    let result = system.factor().and_then(|()| system.solve(&mut vec![1.0; 36]));
    assert_eq!(result, Err(SparseError::NonFiniteMatrix { row: Row::Multiplier(0) }));
}
