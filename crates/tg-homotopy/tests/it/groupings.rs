//! Multi-homogeneous Bézout numbers and start systems.

use crate::support::{eigenproblem, katsura};
use tg_homotopy::{CertifyOptions, Grouping, SolveOptions, Start, certify, solve};

#[test]
fn an_eigenvalue_problem_needs_n_paths() {
    for n in [3, 6, 9] {
        let system = eigenproblem(n);
        let vectors: Vec<usize> = (0..n).collect();
        let choices = vec![Grouping::single(n + 1), Grouping::new(n + 1, &[&vectors, &[n]]).unwrap()];
        assert_eq!(choices[0].bezout(&system).unwrap(), 1 << n);
        assert_eq!(choices[1].bezout(&system).unwrap(), n as u64);
        let start = Start::Best(choices.clone());
        assert_eq!(start.estimate(&system).unwrap(), (choices[1].clone(), n as u64));
        let report = solve(&system, &[], &SolveOptions { start, ..Default::default() }).unwrap();
        let proved = certify(&system, &[], &report.solutions(), &CertifyOptions::default()).unwrap();
        assert_eq!((report.paths.len(), proved.count()), (n, n));
        // The eigenvalues add up to the trace.
        let trace: f64 = (0..n).map(|i| ((3 * i + 12 * i * i) % 11) as f64 - 4.0).sum();
        let sum: tg_homotopy::Complex64 = report.solutions().iter().map(|x| x[n]).sum();
        assert!((sum - trace).norm() < 1e-11, "{sum} {trace}");
    }
}

#[test]
fn total_degree_finds_the_same_and_sends_the_rest_to_infinity() {
    let system = eigenproblem(4);
    let report = solve(&system, &[], &SolveOptions::default()).unwrap();
    assert_eq!((report.paths.len(), report.solutions().len(), report.failures().count()), (16, 4, 0));
    assert_eq!(report.at_infinity(), 12);
}

#[test]
fn one_group_is_the_total_degree() {
    assert_eq!(Grouping::single(7).bezout(&katsura(6)).unwrap(), 64);
}
