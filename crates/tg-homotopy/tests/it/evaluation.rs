//! Values, Jacobian and parameter derivative of compiled systems.

use crate::support::{c, unknowns};
use tg_homotopy::{Complex64, ComplexDd, Disc, Evaluator, Field, Random, Scalar, SystemBuilder};

/// Two equations with powers, shared monomials and parameters in products and powers.
fn system() -> tg_homotopy::PolynomialSystem {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    let (p, q) = (b.parameter("p"), b.parameter("q"));
    b.equation(&p * &q * &x[0].pow(3) * &x[1] - 2.0 * &q.pow(2) * &x[1] + 1.0);
    b.equation(c(0.0, 1.0) * &x[0].pow(3) * &x[1] + &p * &x[0].pow(2) * &x[1].pow(2) - &x[0]);
    b.build().unwrap()
}

fn by_hand(
    x: Complex64,
    y: Complex64,
    p: Complex64,
    q: Complex64,
) -> ([Complex64; 2], [Complex64; 4], [Complex64; 4]) {
    let i = c(0.0, 1.0);
    let x3 = x * x * x;
    let values = [p * q * x3 * y - 2.0 * q * q * y + 1.0, i * x3 * y + p * x * x * y * y - x];
    let jacobian = [
        3.0 * p * q * x * x * y,
        p * q * x3 - 2.0 * q * q,
        3.0 * i * x * x * y + 2.0 * p * x * y * y - 1.0,
        i * x3 + 2.0 * p * x * x * y,
    ];
    // By p, then by q.
    let parameters = [q * x3 * y, x * x * y * y, p * x3 * y - 4.0 * q * y, c(0.0, 0.0)];
    (values, jacobian, parameters)
}

#[test]
fn values_and_derivatives_are_those_by_hand() {
    let system = system();
    let mut random = Random::new(1);
    for _ in 0..50 {
        let (x, p) = ([random.normal(), random.normal()], [random.normal(), random.normal()]);
        let (values, jacobian, parameters) = by_hand(x[0], x[1], p[0], p[1]);
        let near = |a: &[Complex64], b: &[Complex64]| {
            a.iter().zip(b).all(|(a, b)| (a - b).norm() <= 1e-13 * (1.0 + b.norm()))
        };
        assert!(near(&system.values(&x, &p), &values));
        assert!(near(&system.jacobian(&x, &p), &jacobian));
        assert!(near(&system.parameter_jacobian(&x, &p), &parameters));
    }
}

#[test]
fn all_kinds_of_numbers_agree() {
    let system = system();
    let mut random = Random::new(2);
    let (x, p) = ([random.normal(), random.normal()], [random.normal(), random.normal()]);
    let extended = |z: &[Complex64]| z.iter().map(|&z| ComplexDd::from(z)).collect::<Vec<_>>();
    let discs = |z: &[Complex64]| z.iter().map(|&z| Disc::from_c64(z)).collect::<Vec<_>>();
    let double = system.jacobian(&x, &p);
    let precise = system.jacobian(&extended(&x), &extended(&p));
    let enclosed = system.jacobian(&discs(&x), &discs(&p));
    for ((d, e), s) in double.iter().zip(&precise).zip(&enclosed) {
        assert!((ComplexDd::from(*d) - *e).size() <= 1e-13);
        assert!((s.mid - *e).size() <= s.radius && s.radius <= 1e-28);
    }
}

#[test]
fn evaluation_does_not_allocate() {
    let system = system();
    let (x, p) = ([c(0.3, 0.1), c(-0.2, 0.7)], [c(1.0, 0.5), c(0.2, -0.4)]);
    let mut evaluator = Evaluator::new(&system);
    let (mut values, mut jacobian, mut rates) = ([c(0.0, 0.0); 2], [c(0.0, 0.0); 4], [c(0.0, 0.0); 2]);
    let count = allocation_counter::measure(|| {
        evaluator.set_parameters_and_rates(&system, &p, &x);
        evaluator.values_and_jacobian(&system, &x, &mut values, &mut jacobian, 2);
        evaluator.rates(&system, &mut rates);
        evaluator.values(&system, &x, &mut values);
    });
    assert_eq!(count.count_total, 0);
}
