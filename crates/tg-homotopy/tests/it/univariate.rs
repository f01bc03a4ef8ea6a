//! One unknown: where every root is known.

use crate::support::{c, from_roots};
use tg_homotopy::{
    CertifyOptions, Complex64, Conjugation, Polynomial, SolveOptions, SystemBuilder, certify, solve,
};

#[test]
fn roots_of_unity() {
    for degree in [1, 2, 5, 12, 30] {
        let mut b = SystemBuilder::new();
        let x = b.unknown("x");
        b.equation(x.pow(degree) - 1.0);
        let system = b.build().unwrap();
        let report = solve(&system, &[], &SolveOptions::default()).unwrap();
        assert_eq!(report.solutions().len(), degree as usize);
        let mut angles: Vec<f64> = report
            .solutions()
            .iter()
            .map(|z| {
                assert!((z[0].norm() - 1.0).abs() < 1e-15);
                (z[0].arg() / std::f64::consts::TAU * f64::from(degree)).rem_euclid(f64::from(degree))
            })
            .map(|a| if a > f64::from(degree) - 0.5 { 0.0 } else { a })
            .collect();
        angles.sort_by(f64::total_cmp);
        for (k, angle) in angles.iter().enumerate() {
            assert!((angle - k as f64).abs() < 1e-12, "root {k} of {degree} at {angle}");
        }
    }
}

/// (x - 1)(x - 2)…(x - 12); the coefficients, up to some 1e9, are exact in doubles.
#[test]
fn wilkinson() {
    let roots: Vec<f64> = (1..=12).map(f64::from).collect();
    let system = from_roots(&roots);
    let report = solve(&system, &[], &SolveOptions::default()).unwrap();
    let options = CertifyOptions { conjugation: Some(Conjugation::plain(&system)), ..Default::default() };
    let proved = certify(&system, &[], &report.solutions(), &options).unwrap();
    assert_eq!((proved.count(), proved.real()), (12, 12), "{:?}", proved.rejections);
    let mut found: Vec<f64> = proved.certificates.iter().map(|p| p.solution[0].re).collect();
    found.sort_by(f64::total_cmp);
    for (found, root) in found.iter().zip(&roots) {
        assert!((found - root).abs() <= 1e-15 * root);
    }
    assert!(proved.largest_radius() < 1e-15);
}

#[test]
fn complex_coefficients() {
    let mut b = SystemBuilder::new();
    let x = b.unknown("x");
    let roots = [c(1.0, 2.0), c(-0.5, 0.25), c(3.0, -1.0)];
    b.equation(roots.iter().fold(Polynomial::constant(c(0.0, 2.0)), |p, &r| p * (&x - r)));
    let report = solve(&b.build().unwrap(), &[], &SolveOptions::default()).unwrap();
    let near = |r: &Complex64| report.solutions().iter().any(|z| (z[0] - r).norm() < 1e-14);
    assert!(report.solutions().len() == 3 && roots.iter().all(near));
}
