//! Solutions at infinity, regular and singular.

use crate::support::unknowns;
use tg_homotopy::{ReturnCode, SolveOptions, SystemBuilder, solve};

/// Two circles: two points are finite, the other two are the circular points at infinity.
#[test]
fn circles_meet_at_the_circular_points() {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation(&x[0].pow(2) + &x[1].pow(2) - 1.0);
    b.equation((&x[0] - 1.0).pow(2) + &x[1].pow(2) - 1.0);
    let report = solve(&b.build().unwrap(), &[], &SolveOptions::default()).unwrap();
    assert_eq!((report.solutions().len(), report.at_infinity(), report.failures().count()), (2, 2, 0));
    for x in report.solutions() {
        assert!((x[0] - 0.5).norm() < 1e-15 && (x[1].norm() - 0.75_f64.sqrt()).abs() < 1e-15);
    }
}

/// Concentric circles touch at the circular points: two double ends, winding number 2.
#[test]
fn concentric_circles_touch_at_infinity() {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation(&x[0].pow(2) + &x[1].pow(2) - 1.0);
    b.equation(&x[0].pow(2) + &x[1].pow(2) - 4.0);
    let report = solve(&b.build().unwrap(), &[], &SolveOptions::default()).unwrap();
    assert_eq!((report.at_infinity(), report.failures().count()), (4, 0));
    assert!(report.paths.iter().all(|p| p.code == ReturnCode::AtInfinity && p.winding == 2));
}

/// x y = 1, x² = ε x: the solution (ε, 1/ε) is far but finite.
#[test]
fn far_solutions_are_finite() {
    for epsilon in [1e-2, 1e-3, 1e-4] {
        let mut b = SystemBuilder::new();
        let x = unknowns(&mut b, 2);
        b.equation(&x[0] * &x[1] - 1.0);
        b.equation(&x[0].pow(2) - epsilon * &x[0]);
        let report = solve(&b.build().unwrap(), &[], &SolveOptions::default()).unwrap();
        let solutions = report.solutions();
        assert_eq!((solutions.len(), report.failures().count()), (1, 0), "{epsilon}");
        assert!((solutions[0][1] * epsilon - 1.0).norm() < 1e-12);
    }
}
