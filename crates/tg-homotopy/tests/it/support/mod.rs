//! Systems that several tests and the bench use.

pub(crate) mod mechanism;

use tg_homotopy::{Complex64, Polynomial, PolynomialSystem, SystemBuilder};

pub(crate) fn c(re: f64, im: f64) -> Complex64 {
    Complex64::new(re, im)
}

/// n unknowns x0, x1, …
pub(crate) fn unknowns(builder: &mut SystemBuilder, n: usize) -> Vec<Polynomial> {
    (0..n).map(|i| builder.unknown(format!("x{i}"))).collect()
}

/// One polynomial in one unknown from its roots.
pub(crate) fn from_roots(roots: &[f64]) -> PolynomialSystem {
    let mut b = SystemBuilder::new();
    let x = b.unknown("x");
    let product = roots.iter().fold(Polynomial::constant(1.0), |p, &r| p * (&x - r));
    b.equation(product);
    b.build().unwrap()
}

/// Katsura's magnetism equations in n + 1 unknowns: 2^n solutions.
pub(crate) fn katsura(n: usize) -> PolynomialSystem {
    let mut b = SystemBuilder::new();
    let u = unknowns(&mut b, n + 1);
    let at = |i: i64| -> Polynomial {
        let k = i.unsigned_abs() as usize;
        if k <= n { u[k].clone() } else { Polynomial::default() }
    };
    let n = n as i64;
    for m in 0..n {
        let sum = Polynomial::sum((-n..=n).map(|i| at(i) * at(m - i)));
        b.equation(sum - at(m));
    }
    b.equation(Polynomial::sum((-n..=n).map(at)) - 1.0);
    b.build().unwrap()
}

/// The cyclic n-roots.
pub(crate) fn cyclic(n: usize) -> PolynomialSystem {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, n);
    for m in 1..=n {
        let term = |i: usize| (0..m).fold(Polynomial::constant(1.0), |p, k| p * &x[(i + k) % n]);
        if m < n {
            b.equation(Polynomial::sum((0..n).map(term)));
        } else {
            b.equation(term(0) - 1.0);
        }
    }
    b.build().unwrap()
}

/// Noonburg's neural network for n units.
pub(crate) fn noon(n: usize) -> PolynomialSystem {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, n);
    for i in 0..n {
        let others = Polynomial::sum((0..n).filter(|&j| j != i).map(|j| x[j].pow(2)));
        b.equation(&x[i] * &others - 1.1 * &x[i] + 1.0);
    }
    b.build().unwrap()
}

/// A v = λ v with the normalisation w·v = 1: n eigenpairs, total degree 2^n.
pub(crate) fn eigenproblem(n: usize) -> PolynomialSystem {
    let mut b = SystemBuilder::new();
    let v = unknowns(&mut b, n);
    let lambda = b.unknown("lambda");
    for i in 0..n {
        let row = Polynomial::sum((0..n).map(|j| {
            let entry = ((3 * i + 5 * j * j + 7 * i * j) % 11) as f64 - 4.0;
            entry * &v[j]
        }));
        b.equation(row - &lambda * &v[i]);
    }
    b.equation(Polynomial::sum((0..n).map(|j| (1.0 + j as f64) * &v[j])) - 1.0);
    b.build().unwrap()
}
