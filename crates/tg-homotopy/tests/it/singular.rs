//! Multiple solutions, and nearly multiple ones that need more digits than a double has.

use crate::support::{from_roots, unknowns};
use tg_homotopy::{CertifyOptions, SolveOptions, SolveReport, SystemBuilder, certify, solve};

fn report(system: &tg_homotopy::PolynomialSystem) -> SolveReport {
    let report = solve(system, &[], &SolveOptions::default()).unwrap();
    assert_eq!(report.failures().count(), 0);
    report
}

#[test]
fn multiple_roots_have_their_multiplicity_as_winding_number() {
    for (roots, multiplicity) in
        [(&[1.0, 1.0, 3.0][..], 2), (&[1.0, 1.0, 1.0, -2.0], 3), (&[0.5, 0.5, 0.5, 0.5, 2.0], 4)]
    {
        let report = report(&from_roots(roots));
        let singular = report.singular();
        assert_eq!((singular.len(), report.solutions().len()), (1, 1));
        assert_eq!(singular[0].multiplicity, multiplicity);
        assert_eq!(singular[0].windings, [multiplicity]);
        assert!((singular[0].point[0] - roots[0]).norm() < 1e-9, "{}", singular[0].point[0]);
    }
}

/// A parabola that touches a line, and Griewank & Osborne's multiplicity 3 where Newton's method diverges.
#[test]
fn multiple_points_in_the_plane() {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation(&x[1] - &x[0].pow(2));
    b.equation(&x[1] - 2.0 * &x[0] + 1.0);
    let touching = report(&b.build().unwrap());
    assert_eq!((touching.singular()[0].multiplicity, touching.singular()[0].windings.clone()), (2, vec![2]));
    assert!((touching.singular()[0].point[0] - 1.0).norm() < 1e-9);

    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation(29.0 / 16.0 * &x[0].pow(3) - 2.0 * (&x[0] * &x[1]));
    b.equation(&x[1] - &x[0].pow(2));
    let diverging = report(&b.build().unwrap());
    assert_eq!(diverging.singular().len(), 1);
    assert_eq!(
        (diverging.singular()[0].multiplicity, diverging.singular()[0].windings.clone()),
        (3, vec![3])
    );
    assert!(diverging.singular()[0].point.iter().all(|z| z.norm() < 1e-9));
}

/// (1, 1) with multiplicity 4 and full corank: the multiplicity is the sum of the cycles.
#[test]
fn a_point_of_corank_two() {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation((&x[0] - 1.0).pow(2));
    b.equation((&x[1] - 1.0).pow(2) + (&x[0] - 1.0) * (&x[1] - 1.0));
    let report = report(&b.build().unwrap());
    let singular = report.singular();
    assert_eq!((singular.len(), singular[0].multiplicity), (1, 4));
    assert_eq!(singular[0].windings.iter().sum::<usize>(), 4);
}

/// Roots 1 and 1 + δ: doubles resolve δ ≳ 1e-7 of the polynomial with rounded coefficients; here it is written so that
/// the coefficients are exact.
#[test]
fn nearly_double_roots_are_told_apart_in_double_double() {
    // (x - 1)² = δ², δ a power of two, as two equations with exact coefficients.
    for exponent in [10, 20, 26, 36] {
        let delta = 2.0_f64.powi(-exponent);
        let mut b = SystemBuilder::new();
        let x = unknowns(&mut b, 2);
        b.equation(&x[0].pow(2) - 2.0 * &x[0] + 1.0 - delta * &x[1]);
        b.equation(&x[1].pow(2) + &x[1] - delta * (delta + 1.0) - 0.5 * (&x[1] - delta));
        let system = b.build().unwrap();
        let report = report(&system);
        let proved = certify(&system, &[], &report.solutions(), &CertifyOptions::default()).unwrap();
        assert_eq!(
            (proved.count(), report.singular().len()),
            (4, 0),
            "2^-{exponent}: {:?}",
            proved.rejections
        );
        let worst = proved.certificates.iter().map(|p| p.condition).fold(0.0, f64::max);
        println!("2^-{exponent}: condition {worst:e}, radius {:e}", proved.largest_radius());
        if exponent >= 26 {
            assert!(report.paths.iter().any(|p| p.counts.extended > 0));
        }
    }
}

/// x = 0 is a line of solutions; (1, 0) is isolated.
#[test]
fn points_of_a_line_are_not_called_regular() {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    b.equation(&x[0] * &x[1]);
    b.equation(&x[0] * (&x[0] - 1.0));
    let report = report(&b.build().unwrap());
    let regular = report.solutions();
    assert_eq!(regular.len(), 1);
    assert!((regular[0][0] - 1.0).norm() < 1e-15 && regular[0][1].norm() < 1e-15);
    assert!(report.singular().iter().all(|s| s.point[0].norm() < 1e-9));
}
