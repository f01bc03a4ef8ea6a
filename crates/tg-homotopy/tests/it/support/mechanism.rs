//! The planar compliant mechanism in isotropic coordinates: z = e^(iγ), z̄ with z z̄ = 1, and u = 1/d of each spring that
//! has a free length.
//!
//! ```text
//! e₁ = 9 z₁ + 4.25 z₂ - 3.19,   e₂ = 9 z₁ + (-0.3 - 3.45i) z₂ - (-2.55 + 4.93i),   d² = e ē
//! V = Σ ½ k (d - L)²,   ∂V/∂γ_j = Σ k (1 - L u) (i/2) (z_j ∂/∂z_j - z̄_j ∂/∂z̄_j) d² = 0,   u² d² = 1
//! ```

use super::c;
use tg_homotopy::{Complex64, Conjugation, Grouping, Polynomial, PolynomialSystem, SystemBuilder};

/// Stiffness of both springs.
pub(crate) const K: f64 = 2.81;
const BAR: f64 = 9.0;

pub(crate) struct Mechanism {
    pub(crate) system: PolynomialSystem,
    pub(crate) conjugation: Conjugation,
    pub(crate) grouping: Grouping,
    /// Which springs have an unknown u.
    lengths: [bool; 2],
}

/// One real configuration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Position {
    /// Degrees.
    pub(crate) gamma: [f64; 2],
    /// Signed lengths; unsigned for springs without free length.
    pub(crate) d: [f64; 2],
}

/// End of the spring on the body, and on the ground.
fn geometry() -> [(Complex64, Complex64); 2] {
    [(c(4.25, 0.0), c(3.19, 0.0)), (c(-0.3, -3.45), c(-2.55, 4.93))]
}

impl Mechanism {
    /// With free lengths as parameters for the springs marked.
    pub(crate) fn new(lengths: [bool; 2]) -> Self {
        let mut b = SystemBuilder::new();
        let z = [b.unknown("z1"), b.unknown("z2")];
        let zb = [b.unknown("z1b"), b.unknown("z2b")];
        let mut balance = [Polynomial::default(), Polynomial::default()];
        let mut inverse = vec![];
        for (spring, (on_body, on_ground)) in geometry().into_iter().enumerate() {
            // e = a₁ z₁ + a₂ z₂ - p
            let arm = [c(BAR, 0.0), on_body];
            let e = arm[0] * &z[0] + arm[1] * &z[1] - on_ground;
            let eb = arm[0].conj() * &zb[0] + arm[1].conj() * &zb[1] - on_ground.conj();
            let mut force = Polynomial::constant(K);
            if lengths[spring] {
                let u = b.unknown(format!("u{}", spring + 1));
                let length = b.parameter(format!("L0{}", spring + 1));
                force = force - K * (&length * &u);
                inverse.push(&u * &u * &e * &eb - 1.0);
            }
            for j in 0..2 {
                let turn = arm[j] * &z[j] * &eb - arm[j].conj() * &zb[j] * &e;
                balance[j] = &balance[j] + &force * turn;
            }
        }
        for (j, balance) in balance.into_iter().enumerate() {
            b.equation(balance);
            b.equation(&z[j] * &zb[j] - 1.0);
        }
        let springs = inverse.len();
        for equation in inverse {
            b.equation(equation);
        }
        let raw = b.build().unwrap();
        let conjugation = Conjugation::exchanging(&raw, &[(0, 2), (1, 3)], &[]).unwrap();
        let system = raw.symmetrized(&conjugation).unwrap();
        let u: Vec<usize> = (4..4 + springs).collect();
        let groups: &[&[usize]] = if springs == 0 { &[&[0, 1], &[2, 3]] } else { &[&[0, 1], &[2, 3], &u] };
        let grouping = Grouping::new(4 + springs, groups).unwrap();
        Self { system, conjugation, grouping, lengths }
    }

    /// Angles and lengths of a real solution.
    pub(crate) fn position(&self, x: &[Complex64]) -> Position {
        let mut d = [0.0; 2];
        let mut next = 4;
        for (spring, (on_body, on_ground)) in geometry().into_iter().enumerate() {
            d[spring] = (BAR * x[0] + on_body * x[1] - on_ground).norm();
            if self.lengths[spring] {
                d[spring] = 1.0 / x[next].re;
                next += 1;
            }
        }
        Position { gamma: [x[0].arg().to_degrees(), x[1].arg().to_degrees()], d }
    }
}

/// V of signed lengths.
pub(crate) fn energy(d: [f64; 2], free: [f64; 2]) -> f64 {
    (0..2).map(|s| 0.5 * K * (d[s] - free[s]).powi(2)).sum()
}

/// The difference of two angles in degrees, in [-180, 180).
pub(crate) fn turn(a: f64, b: f64) -> f64 {
    (a - b + 180.0).rem_euclid(360.0) - 180.0
}

/// Lowest eigenvalue of the Hessian of V by the two angles (given in degrees), from differences of second order; positive is stable.
pub(crate) fn lowest_curvature(gamma: [f64; 2], signs: [f64; 2], free: [f64; 2]) -> f64 {
    let v = |a: f64, b: f64| {
        let z = [Complex64::from_polar(1.0, a), Complex64::from_polar(1.0, b)];
        let mut d = [0.0; 2];
        for (s, (on_body, on_ground)) in geometry().into_iter().enumerate() {
            d[s] = signs[s] * (BAR * z[0] + on_body * z[1] - on_ground).norm();
        }
        energy(d, free)
    };
    let (a, b, h) = (gamma[0].to_radians(), gamma[1].to_radians(), 1e-4);
    let aa = (v(a + h, b) - 2.0 * v(a, b) + v(a - h, b)) / (h * h);
    let bb = (v(a, b + h) - 2.0 * v(a, b) + v(a, b - h)) / (h * h);
    let ab = (v(a + h, b + h) - v(a + h, b - h) - v(a - h, b + h) + v(a - h, b - h)) / (4.0 * h * h);
    let mean = 0.5 * (aa + bb);
    mean - (0.25 * (aa - bb).powi(2) + ab * ab).sqrt()
}
