//! What is certified is true, what is not true is not certified.

use crate::support::{c, from_roots, katsura, unknowns};
use tg_homotopy::{
    CertifyOptions, Conjugation, Disc, HomotopyError, Realness, Rejection, SolveOptions, SystemBuilder,
    certify, solve,
};

#[test]
fn discs_hold_the_true_root() {
    let mut b = SystemBuilder::new();
    let x = b.unknown("x");
    b.equation(x.pow(2) - 2.0);
    let system = b.build().unwrap();
    let options = CertifyOptions { conjugation: Some(Conjugation::plain(&system)), ..Default::default() };
    let proved = certify(&system, &[], &[vec![c(std::f64::consts::SQRT_2 + 1e-10, 0.0)]], &options).unwrap();
    let certificate = &proved.certificates[0];
    assert_eq!(certificate.realness, Realness::Real);
    assert!(certificate.radius < 1e-28 && certificate.radius > 0.0);
    // The square of the disc holds 2.
    let disc = certificate.polydisc[0];
    assert!(!(disc * disc).is_disjoint(Disc::exact(c(2.0, 0.0).into())));
}

#[test]
fn points_that_are_no_solutions_are_rejected() {
    let system = from_roots(&[1.0, 2.0, 3.0]);
    let points = vec![vec![c(1.5, 0.0)], vec![c(1.0, 1e-4)], vec![c(2.0, 1e-9)], vec![c(2.0, 0.0)]];
    let proved = certify(&system, &[], &points, &CertifyOptions::default()).unwrap();
    assert_eq!(proved.count(), 1);
    assert!(matches!(proved.rejections[0], (0, Rejection::NotASolution { .. })));
    assert!(matches!(proved.rejections[1], (1, Rejection::NotASolution { .. })));
    assert_eq!(proved.rejections[2], (3, Rejection::Duplicate { other: 2 }));
}

#[test]
fn double_roots_are_rejected() {
    let system = from_roots(&[1.0, 1.0, 3.0]);
    for offset in [0.0, 1e-12, 1e-9, 1e-7] {
        let proved =
            certify(&system, &[], &[vec![c(1.0 + offset, 0.0)]], &CertifyOptions::default()).unwrap();
        assert_eq!(proved.count(), 0, "offset {offset}");
        let reason = proved.rejections[0].1;
        assert!(matches!(reason, Rejection::Singular | Rejection::NotContracting { .. }), "{reason}");
    }
}

#[test]
fn reality_is_decided_for_a_thin_pair() {
    // x² + ε²: ±iε, nearly real.
    for exponent in [5, 20, 40] {
        let mut b = SystemBuilder::new();
        let x = b.unknown("x");
        b.equation((&x - 1.0).pow(2) + 4.0_f64.powi(-exponent));
        let system = b.build().unwrap();
        let epsilon = 2.0_f64.powi(-exponent);
        let options = CertifyOptions { conjugation: Some(Conjugation::plain(&system)), ..Default::default() };
        let points = vec![vec![c(1.0, epsilon)], vec![c(1.0, -epsilon)]];
        let proved = certify(&system, &[], &points, &options).unwrap();
        // 4^-40 is lost beside 1: the system given is (x - 1)² then.
        let expected = if exponent < 27 { 2 } else { 0 };
        assert_eq!(proved.with(Realness::NotReal), expected, "2^-{exponent}");
        assert_eq!(proved.real(), 0);
    }
}

#[test]
fn real_means_fixed_by_the_given_conjugation() {
    // z z̄ = 1, z + z̄ = 2a: real (z̄ = conj z) if |a| ≤ 1.
    for (a, real) in [(0.3, 2), (1.5, 0)] {
        let mut b = SystemBuilder::new();
        let z = unknowns(&mut b, 2);
        b.equation(&z[0] * &z[1] - 1.0);
        b.equation(&z[0] + &z[1] - 2.0 * a);
        let system = b.build().unwrap();
        let report = solve(&system, &[], &SolveOptions::default()).unwrap();
        let exchange = Conjugation::exchanging(&system, &[(0, 1)], &[]).unwrap();
        let options = CertifyOptions { conjugation: Some(exchange), ..Default::default() };
        let proved = certify(&system, &[], &report.solutions(), &options).unwrap();
        assert_eq!((proved.count(), proved.real()), (2, real));
        assert_eq!(proved.with(Realness::Undecided), 0);
        // Plainly conjugated it is the other way round.
        let options = CertifyOptions { conjugation: Some(Conjugation::plain(&system)), ..Default::default() };
        let proved = certify(&system, &[], &report.solutions(), &options).unwrap();
        assert_eq!(proved.real(), 2 - real);
    }
}

#[test]
fn a_system_that_is_not_invariant_has_no_real_solutions_to_prove() {
    let system = katsura(2);
    let exchange = Conjugation::exchanging(&system, &[(0, 1)], &[]).unwrap();
    let options = CertifyOptions { conjugation: Some(exchange), ..Default::default() };
    assert_eq!(certify(&system, &[], &[], &options), Err(HomotopyError::NotInvariant { equation: 0 }));
}
