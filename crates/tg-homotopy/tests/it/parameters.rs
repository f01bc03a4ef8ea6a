//! Queries from a stored generic instance.

use crate::support::{c, unknowns};
use tg_homotopy::{
    GenericInstance, Grouping, ParameterSolver, PathOptions, PolynomialSystem, SolveOptions, SystemBuilder,
    solve,
};

/// A conic a x² + b y² = 1 and a line y = m x + c.
fn conic() -> PolynomialSystem {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    let p: Vec<_> = ["a", "b", "m", "c"].into_iter().map(|n| b.parameter(n)).collect();
    b.equation(&p[0] * &x[0].pow(2) + &p[1] * &x[1].pow(2) - 1.0);
    b.equation(&x[1] - &p[2] * &x[0] - &p[3]);
    b.build().unwrap()
}

fn instance(system: &PolynomialSystem) -> GenericInstance {
    let parameters = vec![c(0.7, 0.4), c(-0.3, 1.1), c(0.9, -0.6), c(0.2, 0.8)];
    let solutions = solve(system, &parameters, &SolveOptions::default()).unwrap().solutions();
    GenericInstance { parameters, solutions }
}

#[test]
fn a_query_follows_each_solution_once() {
    let system = conic();
    let stored = serde_json::to_string(&instance(&system)).unwrap();
    let instance: GenericInstance = serde_json::from_str(&stored).unwrap();
    assert_eq!(instance.solutions.len(), 2);
    for grouping in [None, Some(Grouping::single(2))] {
        let solver =
            ParameterSolver::new(&system, instance.clone(), grouping, PathOptions::default()).unwrap();
        // The unit circle and the line y = x.
        let report = solver.query(&[c(1.0, 0.0), c(1.0, 0.0), c(1.0, 0.0), c(0.0, 0.0)]).unwrap();
        let mut x: Vec<f64> = report.solutions().iter().map(|x| x[0].re).collect();
        x.sort_by(f64::total_cmp);
        let half = 0.5_f64.sqrt();
        assert!(x.len() == 2 && (x[0] + half).abs() < 1e-15 && (x[1] - half).abs() < 1e-15);
        // A tangent: y = √2 - x needs rounding, y = 1 does not.
        let report = solver.query(&[c(1.0, 0.0), c(1.0, 0.0), c(0.0, 0.0), c(1.0, 0.0)]).unwrap();
        assert_eq!(report.singular()[0].multiplicity, 2);
        assert_eq!(report.singular()[0].windings, [2]);
    }
}

#[test]
fn solutions_at_infinity_of_a_special_target() {
    let system = conic();
    let solver =
        ParameterSolver::new(&system, instance(&system), Some(Grouping::single(2)), PathOptions::default())
            .unwrap();
    // A hyperbola and a line parallel to its asymptote: one finite solution.
    let report = solver.query(&[c(1.0, 0.0), c(-1.0, 0.0), c(1.0, 0.0), c(1.0, 0.0)]).unwrap();
    assert_eq!((report.solutions().len(), report.at_infinity(), report.failures().count()), (1, 1, 0));
    assert!((report.solutions()[0][0] + 1.0).norm() < 1e-15);
}

#[test]
fn degenerate_at_both_ends() {
    let system = conic();
    let solver = ParameterSolver::new(&system, instance(&system), None, PathOptions::default()).unwrap();
    let report = solver.query(&[c(1.0, 0.0), c(-1.0, 0.0), c(1.0, 0.0), c(1.0, 0.0)]).unwrap();
    assert_eq!((report.solutions().len(), report.at_infinity()), (1, 1));
}
