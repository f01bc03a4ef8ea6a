//! The Krawczyk test in circular complex arithmetic.
//!
//! ```text
//! K(X) = m - Y F(m) + (I - Y F'(X)) (X - m)                 Krawczyk (Computing 4, 1969); Moore (1977)
//! K(X) ⊂ int X  ⇒  exactly one zero of F in X, and it is simple, and it lies in K(X)
//! ```
//!
//! X is a polydisc with midpoint m, Y an approximate inverse of F'(m). F is holomorphic and X convex, so F(x) - F(m) =
//! A (x - m) with A the mean of F' on the segment, which the disc matrix F'(X) holds. K(X) ⊂ int X makes ‖I - Y A‖ < 1 in
//! the maximum norm weighted by the radii, hence Y and all A regular. Radii come from ε-inflation (Rump, Acta Numerica 19,
//! 2010, sec. 10).

use num_complex::Complex64;

use crate::complex_dd::ComplexDd;
use crate::disc::{Disc, add_up, modulus_up};
use crate::evaluate::Evaluator;
use crate::lu::Lu;
use crate::scalar::Scalar;
use crate::system::PolynomialSystem;

/// Inflations of a polydisc before the test is given up.
const INFLATIONS: usize = 12;
/// Smallest radius relative to the midpoint: some units of double-double.
const FLOOR: f64 = 1e-30;

/// Steps below this are refined to the end: the next one is rounding.
const REFINED: f64 = 1e-29;
/// Ratio of steps below which doubles are good enough to refine with.
const SHRINKING: f64 = 1e-3;

/// Why the test did not succeed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Miss {
    /// The Jacobian at the midpoint is singular in double-double.
    Singular,
    /// The image stayed outside; the largest ratio of radii seen last.
    NotContracting { ratio: f64 },
}

/// The test for one system at fixed parameters.
#[derive(Debug)]
pub(crate) struct Krawczyk<'a> {
    system: &'a PolynomialSystem,
    discs: Evaluator<Disc>,
    numbers: Evaluator<ComplexDd>,
    lu: Lu<ComplexDd>,
    /// Any matrix near the inverse serves: that of doubles does for all but very ill-conditioned points.
    rounded: Lu<Complex64>,
}

impl<'a> Krawczyk<'a> {
    pub(crate) fn new(system: &'a PolynomialSystem, parameters: &[Complex64]) -> Self {
        let mut discs = Evaluator::new(system);
        let exact: Vec<Disc> = parameters.iter().map(|&p| Disc::from_c64(p)).collect();
        discs.set_parameters(system, &exact);
        let mut numbers = Evaluator::new(system);
        let rounded: Vec<ComplexDd> = parameters.iter().map(|&p| p.into()).collect();
        numbers.set_parameters(system, &rounded);
        let n = system.unknowns();
        Self { system, discs, numbers, lu: Lu::new(n), rounded: Lu::new(n) }
    }

    fn linearize(&mut self, x: &[ComplexDd]) -> (Vec<ComplexDd>, Vec<ComplexDd>) {
        let n = x.len();
        let mut values = vec![ComplexDd::zero(); n];
        let mut jacobian = vec![ComplexDd::zero(); n * n];
        self.numbers.values_and_jacobian(self.system, x, &mut values, &mut jacobian, n);
        (values, jacobian)
    }

    /// Newton's method in double-double until the steps no longer shrink; none if the Jacobian becomes singular.
    pub(crate) fn refine(&mut self, x: &[ComplexDd]) -> Option<Vec<ComplexDd>> {
        let mut refined = x.to_vec();
        if self.refine_with_doubles(&mut refined) {
            return Some(refined);
        }
        let mut x = x.to_vec();
        let mut previous = f64::INFINITY;
        for _ in 0..60 {
            let (mut delta, jacobian) = self.linearize(&x);
            if !self.lu.factor(&jacobian) {
                return None;
            }
            self.lu.solve(&mut delta);
            let length = relative(&delta, &x);
            if !(length < previous) {
                break;
            }
            for (x, &d) in x.iter_mut().zip(&delta) {
                *x = *x - d;
            }
            previous = length;
        }
        previous.is_finite().then_some(x)
    }

    /// Values in double-double, one Jacobian in doubles: whether each step shrank the last one far, down to rounding.
    fn refine_with_doubles(&mut self, x: &mut [ComplexDd]) -> bool {
        let (mut values, jacobian) = self.linearize(x);
        let jacobian: Vec<Complex64> = jacobian.iter().map(|z| z.to_c64()).collect();
        if !self.rounded.factor(&jacobian) {
            return false;
        }
        let mut previous = f64::INFINITY;
        loop {
            let mut delta: Vec<Complex64> = values.iter().map(|z| z.to_c64()).collect();
            self.rounded.solve(&mut delta);
            let delta: Vec<ComplexDd> = delta.into_iter().map(ComplexDd::from).collect();
            for (x, &d) in x.iter_mut().zip(&delta) {
                *x = *x - d;
            }
            let length = relative(&delta, x);
            if length <= REFINED {
                return true;
            }
            if !(length <= SHRINKING * previous) {
                return false;
            }
            previous = length;
            self.numbers.values(self.system, x, &mut values);
        }
    }

    /// A polydisc round `m` with exactly one zero. `tie` makes radii symmetric.
    pub(crate) fn enclose(&mut self, m: &[ComplexDd], tie: impl Fn(&mut [f64])) -> Result<Vec<Disc>, Miss> {
        let (_, jacobian) = self.linearize(m);
        let rounded: Vec<Complex64> = jacobian.iter().map(|z| z.to_c64()).collect();
        if self.rounded.factor(&rounded) {
            let inverse: Vec<Disc> = self.rounded.inverse().into_iter().map(Disc::from_c64).collect();
            if let Ok(polydisc) = self.enclose_with(&inverse, m, &tie) {
                return Ok(polydisc);
            }
        }
        if !self.lu.factor(&jacobian) {
            return Err(Miss::Singular);
        }
        let inverse: Vec<Disc> = self.lu.inverse().into_iter().map(Disc::exact).collect();
        self.enclose_with(&inverse, m, &tie)
    }

    fn enclose_with(
        &mut self,
        inverse: &[Disc],
        m: &[ComplexDd],
        tie: &impl Fn(&mut [f64]),
    ) -> Result<Vec<Disc>, Miss> {
        let n = m.len();
        let midpoint: Vec<Disc> = m.iter().map(|&z| Disc::exact(z)).collect();
        let mut values = vec![Disc::zero(); n];
        self.discs.values(self.system, &midpoint, &mut values);
        // m - Y F(m), and Y F(m) for the first radii.
        let newton: Vec<Disc> = (0..n).map(|i| dot(&inverse[i * n..(i + 1) * n], |k| values[k])).collect();
        let floor: Vec<f64> = m.iter().map(|&z| (FLOOR * modulus_up(z)).max(FLOOR * FLOOR)).collect();
        let mut radii: Vec<f64> =
            newton.iter().zip(&floor).map(|(d, f)| (2.0 * d.magnitude()).max(*f)).collect();
        let mut derivative = vec![Disc::zero(); n * n];
        let mut ratio = f64::INFINITY;
        for _ in 0..INFLATIONS {
            tie(&mut radii);
            let domain: Vec<Disc> = m.iter().zip(&radii).map(|(&z, &r)| Disc::new(z, r)).collect();
            self.discs.values_and_jacobian(self.system, &domain, &mut values, &mut derivative, n);
            let image: Vec<Disc> = (0..n)
                .map(|i| {
                    let row = &inverse[i * n..(i + 1) * n];
                    let mut spread = 0.0;
                    for j in 0..n {
                        let unit = if i == j { Disc::one() } else { Disc::zero() };
                        let rest = unit - dot(row, |k| derivative[k * n + j]);
                        spread = add_up(spread, (rest.magnitude() * radii[j]).next_up());
                    }
                    let centre = midpoint[i] - newton[i];
                    Disc::new(centre.mid, add_up(centre.radius, spread))
                })
                .collect();
            if image.iter().zip(&domain).all(|(k, x)| k.is_interior_to(*x)) {
                return Ok(domain);
            }
            ratio = 0.0;
            for ((k, z), r) in image.iter().zip(m).zip(&mut radii) {
                let reach = (Disc::exact(k.mid) - Disc::exact(*z)).magnitude() + k.radius;
                if !reach.is_finite() {
                    return Err(Miss::NotContracting { ratio: f64::INFINITY });
                }
                ratio = ratio.max(reach / *r);
                *r = r.max(2.0 * reach);
            }
        }
        Err(Miss::NotContracting { ratio })
    }

    /// κ∞ at x, rows equilibrated and unknowns scaled by their moduli.
    pub(crate) fn condition(&mut self, x: &[ComplexDd]) -> f64 {
        crate::lu::condition(&self.linearize(x).1, x)
    }
}

fn relative(delta: &[ComplexDd], x: &[ComplexDd]) -> f64 {
    crate::scalar::norm(delta) / crate::scalar::norm(x).max(f64::MIN_POSITIVE)
}

fn dot(row: &[Disc], column: impl Fn(usize) -> Disc) -> Disc {
    row.iter().enumerate().fold(Disc::zero(), |sum, (k, &y)| sum + y * column(k))
}
