//! The compliant-mechanism paper's planar mechanism in its two angles γ1 (bar) and γ2 (top body).
//!
//! ```text
//! D_s = d_s² = A + Σ_i B_i cos(θ_i - φ_i),   θ = γ1, γ2, γ2 - γ1        squared length of spring s
//! V = Σ_s ½ k_s (d_s - L0_s)²
//! ∂V = Σ_s ½ k_s (1 - L0_s/d_s) ∂D_s = 0                                 (6) of the paper, as a gradient
//! ∂²V = Σ_s ½ k_s ((1 - L0_s/d_s) ∂²D_s + L0_s/(2 d_s³) ∂D_s ∂D_sᵀ)      stable where positive definite
//! ```
//! The paper's unknowns d_s may be negative, which a length is not: d_s = -√D_s with L0_s is d_s = √D_s with -L0_s, and
//! so a free length of either sign is allowed here and a *branch* is a choice of signs. Units: m, N/m, rad, J.
//!
//! - `search`: all equilibria of a branch, by an exhaustive interval search of the torus;
//! - `sweep`: folds of the equilibria as L01 varies;
//! - `cone`: points where a spring has no length and V no derivative;
//! - `number`, `interval`: what the formulas are evaluated in.

mod cone;
mod interval;
mod number;
mod search;
mod sweep;
#[cfg(test)]
mod tests;

use std::array::from_fn;

use nalgebra::{Matrix2, Vector2};

use super::ReferenceError;
use number::Number;

pub use cone::Cone;
pub use interval::Interval;
pub use search::Search;
pub use sweep::{Fold, Sweep};

const MOST_ITERATIONS: usize = 50;

/// The mechanism: bar 1-4 hinged at point 1, top body hinged to it at point 4, springs 2-6 and 3-5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model {
    /// Points 1, 2, 3 of the fixed body \[m\].
    pub fixed: [[f64; 2]; 3],
    /// Length L3 of the bar \[m\].
    pub bar: f64,
    /// Points 6 and 5 of the top body in its frame, where springs 1 and 2 end \[m\].
    pub body: [[f64; 2]; 2],
    /// k1, k2 \[N/m\].
    pub stiffness: [f64; 2],
    /// L01, L02 \[m\]; negative on a branch where d is.
    pub rest: [f64; 2],
}

/// An equilibrium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium {
    /// γ1, γ2 in (-π, π] \[rad\].
    pub angles: [f64; 2],
    /// d1, d2 \[m\], with the signs of the branch.
    pub lengths: [f64; 2],
    /// V \[J\].
    pub energy: f64,
    /// Number of negative eigenvalues of ∂²V: 0 stable, 1 saddle, 2 maximum.
    pub negative: usize,
}

impl Equilibrium {
    /// Whether V has a strict minimum there.
    pub fn stable(&self) -> bool {
        self.negative == 0
    }
}

/// Largest effect of the rounded coefficients of the harmonics, per A (the amplitudes sum to no more than 2A).
const ROUNDED: f64 = 16.0 * f64::EPSILON;

/// One term B cos(θ - φ) of a squared length, θ = a γ1 + b γ2.
#[derive(Clone, Copy, Debug)]
struct Harmonic {
    amplitude: f64,
    phase: f64,
    by: [f64; 2],
}

/// A spring's squared length as a function of the angles, in two forms: by harmonics, which an interval of angles widens
/// least, and by the spring's vector P, which loses no digits where the spring is short. The harmonics' coefficients are
/// rounded, by which their intervals are made longer.
#[derive(Clone, Copy, Debug)]
struct Squared {
    constant: f64,
    harmonics: [Harmonic; 3],
    /// P = w + L e(γ1) + R(γ2) b.
    w: Vector2<f64>,
    bar: f64,
    b: Vector2<f64>,
}

/// A squared length with its derivatives.
struct Jet<T> {
    value: T,
    gradient: [T; 2],
    /// By γ1γ1, γ1γ2, γ2γ2.
    hessian: [T; 3],
}

impl Squared {
    fn at<T: Number>(&self, angles: [T; 2]) -> Jet<T> {
        let (vector, harmonic) = (self.by_vector(angles), self.by_harmonics(angles));
        let both = |vector: T, harmonic: T| vector.sharpened(harmonic.blurred(ROUNDED * self.constant));
        Jet {
            value: both(vector.value, harmonic.value),
            gradient: from_fn(|i| both(vector.gradient[i], harmonic.gradient[i])),
            hessian: from_fn(|i| both(vector.hessian[i], harmonic.hessian[i])),
        }
    }

    fn by_harmonics<T: Number>(&self, angles: [T; 2]) -> Jet<T> {
        let zero = T::from(0.0);
        let mut jet = Jet { value: T::from(self.constant), gradient: [zero; 2], hessian: [zero; 3] };
        for Harmonic { amplitude, phase, by: [a, b] } in self.harmonics {
            let theta = match (a == 0.0, b == 0.0) {
                (false, true) => angles[0],
                (true, false) => angles[1],
                _ => angles[1] - angles[0],
            };
            let (sin, cos) = (theta - T::from(phase)).sin_cos();
            jet.value = jet.value + T::from(amplitude) * cos;
            for (i, by) in [a, b].into_iter().enumerate().filter(|(_, by)| *by != 0.0) {
                jet.gradient[i] = jet.gradient[i] - T::from(by * amplitude) * sin;
            }
            for (i, by) in [a * a, a * b, b * b].into_iter().enumerate().filter(|(_, by)| *by != 0.0) {
                jet.hessian[i] = jet.hessian[i] - T::from(by * amplitude) * cos;
            }
        }
        jet
    }

    fn by_vector<T: Number>(&self, angles: [T; 2]) -> Jet<T> {
        let [(s1, c1), (s2, c2)] = angles.map(Number::sin_cos);
        let (l, x, y, two) = (T::from(self.bar), T::from(self.b.x), T::from(self.b.y), T::from(2.0));
        let dot = |a: [T; 2], b: [T; 2]| two * (a[0] * b[0] + a[1] * b[1]);
        let (arm, end) = ([l * c1, l * s1], [c2 * x - s2 * y, s2 * x + c2 * y]);
        let p = [T::from(self.w.x) + arm[0] + end[0], T::from(self.w.y) + arm[1] + end[1]];
        let turned = |[x, y]: [T; 2]| [T::from(0.0) - y, x];
        let (p1, p2) = (turned(arm), turned(end));
        Jet {
            value: p[0].square() + p[1].square(),
            gradient: [dot(p, p1), dot(p, p2)],
            hessian: [dot(p1, p1) - dot(p, arm), dot(p1, p2), dot(p2, p2) - dot(p, end)],
        }
    }
}

impl Model {
    /// The branch on which d1 and d2 have these signs (±1).
    #[must_use]
    pub fn branch(&self, signs: [f64; 2]) -> Self {
        Self { rest: [signs[0] * self.rest[0], signs[1] * self.rest[1]], ..*self }
    }

    /// All branches by the signs of d1 and d2, the physical one first. The sign of a spring without free length means
    /// nothing and stays positive.
    pub fn branches(&self) -> Vec<([f64; 2], Self)> {
        let signs = |rest: f64| if rest == 0.0 { vec![1.0] } else { vec![1.0, -1.0] };
        let second = signs(self.rest[1]);
        let all = signs(self.rest[0]).into_iter().flat_map(|a| second.iter().map(move |&b| [a, b]));
        all.map(|signs| (signs, self.branch(signs))).collect()
    }

    /// V(γ1, γ2) \[J\], from the points' positions.
    pub fn potential(&self, angles: [f64; 2]) -> f64 {
        let stored = |s: usize| 0.5 * self.stiffness[s] * (self.lengths(angles)[s] - self.rest[s]).powi(2);
        stored(0) + stored(1)
    }

    /// Lengths of springs 1 and 2 \[m\], never negative.
    pub fn lengths(&self, angles: [f64; 2]) -> [f64; 2] {
        let [_, six, five] = self.points(angles);
        [(six - Vector2::from(self.fixed[1])).norm(), (five - Vector2::from(self.fixed[2])).norm()]
    }

    /// Points 4, 6, 5 \[m\].
    pub fn points(&self, [bar, top]: [f64; 2]) -> [Vector2<f64>; 3] {
        let ((s1, c1), (s2, c2)) = (bar.sin_cos(), top.sin_cos());
        let four = Vector2::from(self.fixed[0]) + Vector2::new(c1, s1) * self.bar;
        let placed = |[x, y]: [f64; 2]| four + Vector2::new(c2 * x - s2 * y, s2 * x + c2 * y);
        [four, placed(self.body[0]), placed(self.body[1])]
    }

    /// ∂V \[J/rad\].
    pub fn gradient(&self, angles: [f64; 2]) -> Vector2<f64> {
        self.derivatives(angles, self.rest).0.into()
    }

    /// ∂²V \[J/rad²\].
    pub fn hessian(&self, angles: [f64; 2]) -> Matrix2<f64> {
        let [a, b, c] = self.derivatives(angles, self.rest).1;
        Matrix2::new(a, b, b, c)
    }

    /// The equilibrium that Newton's method reaches from `start`.
    ///
    /// # Errors
    /// [`ReferenceError::Equilibrium`] where it does not converge.
    pub fn equilibrium(&self, start: [f64; 2]) -> Result<Equilibrium, ReferenceError> {
        let mut angles = Vector2::from(start);
        let mut last = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let gradient = self.gradient(angles.into());
            let Some(step) = self.hessian(angles.into()).lu().solve(&gradient) else { break };
            // Quadratic convergence has ended where a tiny step does not become smaller.
            if step.amax() < 1e-9 && step.amax() >= 0.5 * last || step.amax() == 0.0 {
                return Ok(self.describe(angles.into()));
            }
            angles -= step;
            last = step.amax();
        }
        Err(ReferenceError::Equilibrium { residual: self.gradient(angles.into()).amax() })
    }

    fn describe(&self, angles: [f64; 2]) -> Equilibrium {
        let lengths = self.lengths(angles);
        let signed = |s: usize| if self.rest[s] < 0.0 { -lengths[s] } else { lengths[s] };
        let values = self.hessian(angles).symmetric_eigenvalues();
        Equilibrium {
            angles: angles.map(wrapped),
            lengths: [signed(0), signed(1)],
            energy: self.potential(angles),
            negative: values.iter().filter(|&&v| v < 0.0).count(),
        }
    }

    fn squared(&self, s: usize) -> Squared {
        let w = Vector2::from(self.fixed[0]) - Vector2::from(self.fixed[s + 1]);
        let b = Vector2::from(self.body[s]);
        let (psi, beta) = (w.y.atan2(w.x), b.y.atan2(b.x));
        let harmonic = |amplitude, phase, by| Harmonic { amplitude, phase, by };
        Squared {
            constant: w.norm_squared() + self.bar * self.bar + b.norm_squared(),
            harmonics: [
                harmonic(2.0 * self.bar * w.norm(), psi, [1.0, 0.0]),
                harmonic(2.0 * w.norm() * b.norm(), psi - beta, [0.0, 1.0]),
                harmonic(2.0 * self.bar * b.norm(), -beta, [-1.0, 1.0]),
            ],
            w,
            bar: self.bar,
            b,
        }
    }

    /// ∂V and ∂²V (by γ1γ1, γ1γ2, γ2γ2) with free lengths that may carry derivatives of their own.
    fn derivatives<T: Number>(&self, angles: [T; 2], rest: [T; 2]) -> ([T; 2], [T; 3]) {
        let mut sum = ([T::from(0.0); 2], [T::from(0.0); 3]);
        for s in 0..2 {
            let (gradient, hessian) = self.spring(s, &self.squared(s).at(angles), rest[s]);
            for i in 0..2 {
                sum.0[i] = sum.0[i] + gradient[i];
            }
            for i in 0..3 {
                sum.1[i] = sum.1[i] + hessian[i];
            }
        }
        sum
    }

    /// One spring's part of ∂V and ∂²V.
    fn spring<T: Number>(&self, s: usize, d: &Jet<T>, rest: T) -> ([T; 2], [T; 3]) {
        let half = T::from(0.5 * self.stiffness[s]);
        // A spring that never has a free length is smooth even where it has no length.
        if self.rest[s] == 0.0 {
            return (d.gradient.map(|x| half * x), d.hessian.map(|x| half * x));
        }
        let ratio = rest / d.value.sqrt();
        let (factor, curve) = (half * (T::from(1.0) - ratio), half * T::from(0.5) * ratio / d.value);
        let [a, b] = d.gradient;
        let products = [a * a, a * b, b * b];
        let hessian = from_fn(|i| factor * d.hessian[i] + curve * products[i]);
        (d.gradient.map(|x| factor * x), hessian)
    }
}

/// The same angle in (-π, π].
pub fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    let rest = angle.rem_euclid(TAU);
    if rest > PI { rest - TAU } else { rest }
}
