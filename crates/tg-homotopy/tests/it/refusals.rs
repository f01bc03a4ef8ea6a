//! Requests that make no sense are refused with what, where and what mends it.

use crate::support::{c, from_roots, unknowns};
use tg_homotopy::{
    Conjugation, Grouping, HomotopyError, Polynomial, SolveOptions, Start, SystemBuilder, solve,
};

#[test]
fn systems_are_checked() {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation(&x[0] - 1.0);
    let error = b.clone().build().unwrap_err();
    assert_eq!(error, HomotopyError::NotSquare { equations: 1, unknowns: 2 });
    b.equation(Polynomial::constant(2.0));
    assert_eq!(b.build().unwrap_err(), HomotopyError::ConstantEquation { equation: 1 });

    let mut other = SystemBuilder::new();
    other.unknown("y");
    other.equation(&x[1] - 1.0);
    let error = other.build().unwrap_err();
    assert_eq!(error, HomotopyError::Undeclared { equation: 0, kind: "unknown", index: 1 });

    let mut b = SystemBuilder::new();
    let x = b.unknown("x");
    b.equation(f64::NAN * &x);
    assert!(matches!(b.build().unwrap_err(), HomotopyError::NotFinite { index: 0, .. }));
}

#[test]
fn groupings_are_partitions() {
    assert_eq!(Grouping::new(3, &[&[0, 1], &[1, 2]]), Err(HomotopyError::Grouping { unknown: 1, times: 2 }));
    assert_eq!(Grouping::new(3, &[&[0], &[2]]), Err(HomotopyError::Grouping { unknown: 1, times: 0 }));
    assert!(Grouping::new(2, &[&[0], &[2]]).is_err());
}

#[test]
fn path_counts_are_known_before_tracking() {
    let system = from_roots(&[1.0, 2.0, 3.0]);
    let options = SolveOptions { max_paths: 2, ..Default::default() };
    assert_eq!(
        solve(&system, &[], &options).unwrap_err(),
        HomotopyError::TooManyPaths { paths: 3, limit: 2 }
    );
    let options = SolveOptions { start: Start::Best(vec![]), ..Default::default() };
    assert_eq!(solve(&system, &[], &options).unwrap_err(), HomotopyError::NoGrouping);
    assert!(matches!(
        solve(&system, &[c(1.0, 0.0)], &SolveOptions::default()),
        Err(HomotopyError::Length { .. })
    ));
    // x appears in both equations, y in none.
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation(x[0].pow(2) - 1.0);
    b.equation(&x[0] - 1.0);
    let groups = Grouping::new(2, &[&[0], &[1]]).unwrap();
    let options = SolveOptions { start: Start::Grouped(groups), ..Default::default() };
    assert_eq!(solve(&b.build().unwrap(), &[], &options).unwrap_err(), HomotopyError::NoPaths);
}

#[test]
fn conjugations_are_involutions() {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 3);
    for x in &x {
        b.equation(x.pow(2) - c(1.0, 1.0));
    }
    let system = b.build().unwrap();
    assert!(Conjugation::exchanging(&system, &[(0, 1), (1, 2)], &[]).is_err());
    // Complex coefficients are no real system.
    let plain = Conjugation::plain(&system);
    assert_eq!(system.symmetrized(&plain).unwrap_err(), HomotopyError::NotInvariant { equation: 0 });
}
