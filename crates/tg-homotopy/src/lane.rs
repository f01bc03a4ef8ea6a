//! One predictor-corrector step, for one kind of number.
//!
//! ```text
//! J ẋ = -∂H/∂t                                   Davidenko; Runge-Kutta 5(4) of Cash & Karp (ACM TOMS 16, 1990)
//! J Δ = -H,  x ← x + Δ                           Newton
//! ```

use num_complex::Complex64;

use crate::homotopy::{Homotopy, Rows};
use crate::lu::Lu;
use crate::scalar::{Field, norm};

const NODES: [f64; 6] = [0.0, 0.2, 0.3, 0.6, 1.0, 0.875];
const WEIGHTS: [[f64; 5]; 6] = [
    [0.0; 5],
    [0.2, 0.0, 0.0, 0.0, 0.0],
    [3.0 / 40.0, 9.0 / 40.0, 0.0, 0.0, 0.0],
    [0.3, -0.9, 1.2, 0.0, 0.0],
    [-11.0 / 54.0, 2.5, -70.0 / 27.0, 35.0 / 27.0, 0.0],
    [1631.0 / 55296.0, 175.0 / 512.0, 575.0 / 13824.0, 44275.0 / 110_592.0, 253.0 / 4096.0],
];
const FIFTH: [f64; 6] = [37.0 / 378.0, 0.0, 250.0 / 621.0, 125.0 / 594.0, 0.0, 512.0 / 1771.0];
const FOURTH: [f64; 6] = [2825.0 / 27648.0, 0.0, 18575.0 / 48384.0, 13525.0 / 55296.0, 277.0 / 14336.0, 0.25];

/// g δ of a step δ that has reached a simple zero.
const SIMPLE: f64 = 1e-3;
/// ε g² above which rounding hides whether a zero is simple.
const UNDECIDABLE: f64 = 0.1;

/// What became of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    /// `trial` holds the new point.
    Accepted { error: f64, growth: f64 },
    /// The predictor's error estimate exceeds its tolerance.
    TooLong { error: f64 },
    /// Newton's steps did not shrink fast enough.
    NoContraction,
    /// Newton's steps shrank and then stayed above the tolerance: rounding.
    Stagnation,
    /// The Jacobian is singular to working precision.
    Singular,
}

/// Limits of one step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Limits {
    pub(crate) predictor: f64,
    pub(crate) corrector: f64,
    pub(crate) corrections: usize,
}

/// Newton's method to the end of what the precision gives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Polish {
    /// First step relative to ‖x‖.
    pub(crate) first: f64,
    /// Whether every step was at most a hundredth of the one before, down to rounding.
    pub(crate) quadratic: bool,
    /// Longest step.
    pub(crate) longest: f64,
}

/// Point and buffers.
#[derive(Clone, Debug)]
pub(crate) struct Lane<S> {
    pub(crate) x: Vec<S>,
    /// The new point of a step; after [`Lane::accept`] the point before it.
    pub(crate) trial: Vec<S>,
    stages: Vec<Vec<S>>,
    rows: Rows<S>,
    lu: Lu<S>,
    delta: Vec<S>,
}

impl<S: Field> Lane<S> {
    pub(crate) fn new(homotopy: &Homotopy) -> Self {
        let n = homotopy.unknowns();
        let zeros = vec![S::zero(); n];
        Self {
            x: zeros.clone(),
            trial: zeros.clone(),
            stages: vec![zeros.clone(); 6],
            rows: homotopy.rows(),
            lu: Lu::new(n),
            delta: zeros,
        }
    }

    /// Takes the trial point.
    pub(crate) fn accept(&mut self) {
        std::mem::swap(&mut self.x, &mut self.trial);
    }

    /// ẋ at the trial point into stage `k`.
    fn tangent(&mut self, homotopy: &Homotopy, patch: &[Complex64], t: Complex64, k: usize) -> bool {
        homotopy.evaluate(&self.trial, t, patch, &mut self.rows);
        if !self.lu.factor(&self.rows.jacobian) {
            return false;
        }
        for (s, &r) in self.stages[k].iter_mut().zip(&self.rows.rate) {
            *s = -r;
        }
        self.lu.solve(&mut self.stages[k]);
        true
    }

    /// x(t + dt) into `trial`; the error estimate relative to ‖x‖.
    pub(crate) fn predict(
        &mut self,
        homotopy: &Homotopy,
        patch: &[Complex64],
        t: Complex64,
        dt: Complex64,
    ) -> Option<f64> {
        let step = S::from_c64(dt);
        for k in 0..6 {
            for i in 0..self.x.len() {
                let mut sum = S::zero();
                for (j, &w) in WEIGHTS[k].iter().enumerate().take(k) {
                    if w != 0.0 {
                        sum = sum + self.stages[j][i].times(w);
                    }
                }
                self.trial[i] = self.x[i] + step * sum;
            }
            if !self.tangent(homotopy, patch, t + dt * NODES[k], k) {
                return None;
            }
        }
        let mut error: f64 = 0.0;
        for i in 0..self.x.len() {
            let (mut fifth, mut difference) = (S::zero(), S::zero());
            for k in 0..6 {
                fifth = fifth + self.stages[k][i].times(FIFTH[k]);
                difference = difference + self.stages[k][i].times(FIFTH[k] - FOURTH[k]);
            }
            self.trial[i] = self.x[i] + step * fifth;
            let size = (step * difference).size();
            error = if size > error || size.is_nan() { size } else { error };
        }
        Some(error / norm(&self.x))
    }

    /// One Newton step on `trial`; its length relative to ‖x‖.
    fn newton(&mut self, homotopy: &Homotopy, patch: &[Complex64], t: Complex64) -> Option<f64> {
        homotopy.evaluate(&self.trial, t, patch, &mut self.rows);
        if !self.lu.factor(&self.rows.jacobian) {
            return None;
        }
        self.delta.copy_from_slice(&self.rows.h);
        self.lu.solve(&mut self.delta);
        for (x, &d) in self.trial.iter_mut().zip(&self.delta) {
            *x = *x - d;
        }
        Some(norm(&self.delta) / norm(&self.trial))
    }

    /// From (x, t) to `trial` at t + dt = `to`.
    pub(crate) fn step(
        &mut self,
        homotopy: &Homotopy,
        patch: &[Complex64],
        t: Complex64,
        to: Complex64,
        limits: Limits,
    ) -> Step {
        match self.predict(homotopy, patch, t, to - t) {
            Some(error) => self.correct(homotopy, patch, to, limits, error),
            None => Step::Singular,
        }
    }

    /// From the predicted point in `trial`, whose estimated error is `error`, to the path.
    pub(crate) fn correct(
        &mut self,
        homotopy: &Homotopy,
        patch: &[Complex64],
        to: Complex64,
        limits: Limits,
        error: f64,
    ) -> Step {
        // Also true for NaN.
        if !(error <= limits.predictor) {
            return Step::TooLong { error };
        }
        let mut previous = f64::INFINITY;
        for k in 0..limits.corrections {
            let Some(length) = self.newton(homotopy, patch, to) else {
                return Step::Singular;
            };
            if length <= limits.corrector {
                let growth = self.lu.growth(None, &mut self.delta);
                return Step::Accepted { error, growth };
            }
            if !(length <= 0.1 * previous) {
                let stuck = k > 0 && length < limits.corrector.sqrt();
                return if stuck { Step::Stagnation } else { Step::NoContraction };
            }
            // The first correction repairs the predictor's error; a much longer one leaves the path.
            if k == 0 && !(length <= 100.0 * limits.predictor) {
                return Step::NoContraction;
            }
            previous = length;
        }
        Step::NoContraction
    }

    /// Newton's method from x at fixed t into `trial`: at most `steps` steps, fewer if they reach rounding.
    ///
    /// With g = ‖J⁻¹‖, equations scaled to unit coefficients: rounding leaves steps of ε g, the next singular Jacobian is
    /// about 1/g away, so a step δ has reached a simple zero if δ ≤ 100 ε g and g δ ≪ 1. At a multiple zero g δ ~ 1.
    pub(crate) fn polish(
        &mut self,
        homotopy: &Homotopy,
        patch: &[Complex64],
        t: Complex64,
        steps: usize,
    ) -> Option<Polish> {
        self.trial.copy_from_slice(&self.x);
        let first = self.newton(homotopy, patch, t)?;
        let (mut previous, mut quadratic, mut longest) = (first, true, first);
        for _ in 1..steps {
            let growth = self.lu.growth(Some(homotopy.row_sizes()), &mut self.delta).max(1.0);
            if growth * growth * S::EPSILON > UNDECIDABLE {
                break;
            }
            if previous <= 1e2 * S::EPSILON * growth && previous * growth <= SIMPLE {
                return Some(Polish { first, quadratic, longest });
            }
            let length = self.newton(homotopy, patch, t)?;
            quadratic &= length <= 1e-2 * previous || length <= 1e2 * S::EPSILON * growth;
            previous = length;
            // Also keeps NaN.
            longest = if length <= longest { longest } else { length };
        }
        Some(Polish { first, quadratic: false, longest })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::complex_dd::ComplexDd;
    use crate::system::SystemBuilder;

    /// x² = p from p = 1 to p = 2i, with both values of p.
    #[allow(clippy::unwrap_used)]
    fn square_root() -> (Homotopy, Complex64, Complex64) {
        let mut b = SystemBuilder::new();
        let (x, p) = (b.unknown("x"), b.parameter("p"));
        b.equation(x.pow(2) - p);
        let system = b.build().unwrap();
        let (one, end) = (Complex64::new(1.0, 0.0), Complex64::new(0.0, 2.0));
        let homotopy = Homotopy::between(&system, &[one], &[end], None).unwrap();
        (homotopy, one, end)
    }

    /// x² = p followed from p = 1 to p = 2i: the predictor's error is of order h⁶, its estimate of order h⁵.
    #[test]
    #[allow(clippy::unwrap_used)]
    fn the_predictor_has_order_five() {
        let (homotopy, one, end) = square_root();
        let mut lane: Lane<ComplexDd> = Lane::new(&homotopy);
        let errors: Vec<(f64, f64)> = [0.1, 0.05, 0.025]
            .into_iter()
            .map(|h| {
                lane.x[0] = one.into();
                let estimate = lane.predict(&homotopy, &[], one, Complex64::new(-h, 0.0)).unwrap();
                let exact = (one * (1.0 - h) + end * h).sqrt();
                ((lane.trial[0].to_c64() - exact).norm(), estimate)
            })
            .collect();
        for pair in errors.windows(2) {
            let order = (pair[0].0 / pair[1].0).log2();
            let estimated = (pair[0].1 / pair[1].1).log2();
            assert!(order > 5.5 && estimated > 4.5, "{order} {estimated}");
        }
    }

    #[test]
    fn a_step_does_not_allocate() {
        let (homotopy, one, _) = square_root();
        let mut lane: Lane<Complex64> = Lane::new(&homotopy);
        lane.x[0] = one;
        let limits = Limits { predictor: 1e-5, corrector: 1e-9, corrections: 3 };
        let count = allocation_counter::measure(|| {
            let step = lane.step(&homotopy, &[], one, Complex64::new(0.95, 0.0), limits);
            assert!(matches!(step, Step::Accepted { .. }));
        });
        assert_eq!(count.count_total, 0);
    }
}
