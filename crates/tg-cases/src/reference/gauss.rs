//! One step of Gauss collocation.
//!
//! For `ẏ = f(t, y)` the collocation polynomial of degree S satisfies the equation at the Gauss nodes c_i of the step:
//! ```text
//! f(t + c h) ≈ Σ_n f̂_n P_n(c),   f̂_n = (2n+1) Σ_j b_j P_n(c_j) f_j,   f_j = f(t + c_j h, Y_j)
//! Y_i = y + h Σ_n f̂_n ∫_0^{c_i} P_n = y + h Σ_j a_ij f_j,   y(t + h) = y + h Σ_j b_j f_j
//! ```
//! P_n are Legendre's polynomials on \[0, 1\]. The end point has order 2S = 16, the polynomial inside the step order S + 1.
//! The stage equations are solved by fixed-point iteration to rounding; increments are added with compensation, because a
//! chaotic motion multiplies every rounding error.

/// Number of stages.
pub(super) const STAGES: usize = 8;
/// A stage iteration whose change is below this fraction of the state may stop when it no longer shrinks.
const STALL: f64 = 1e-12;
const MAX_ITERATIONS: usize = 60;

/// A vector with its accumulated rounding error: the value is `hi + lo`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sum<const N: usize> {
    pub(super) hi: [f64; N],
    lo: [f64; N],
}

impl<const N: usize> Sum<N> {
    pub(super) fn new(hi: [f64; N]) -> Self {
        Self { hi, lo: [0.0; N] }
    }

    /// Adds `d`, carrying the rounding error along (Møller, Knuth).
    fn plus(&self, d: &[f64; N]) -> Self {
        let mut sum = *self;
        for i in 0..N {
            let b = self.lo[i] + d[i];
            let s = self.hi[i] + b;
            let virtual_b = s - self.hi[i];
            sum.hi[i] = s;
            sum.lo[i] = (self.hi[i] - (s - virtual_b)) + (b - virtual_b);
        }
        sum
    }
}

/// A step taken: the collocation polynomial and the end state.
#[derive(Clone, Debug)]
pub(super) struct Step<const N: usize> {
    start: Sum<N>,
    h: f64,
    /// Legendre coefficients f̂_n of the rate.
    rate: [[f64; N]; STAGES],
    pub(super) end: Sum<N>,
}

impl<const N: usize> Step<N> {
    /// State at the fraction `c` of the step, from the polynomial.
    pub(super) fn state(&self, c: f64) -> [f64; N] {
        let p = legendre(c);
        let mut d = [0.0; N];
        for (n, coefficient) in self.rate.iter().enumerate() {
            let weight = self.h * legendre_integral(&p, c, n);
            for i in 0..N {
                d[i] += weight * coefficient[i];
            }
        }
        self.start.plus(&d).hi
    }

    /// Rate at the fraction `c` of the step, from the polynomial.
    fn rate(&self, c: f64) -> [f64; N] {
        let p = legendre(c);
        let mut f = [0.0; N];
        for (n, coefficient) in self.rate.iter().enumerate() {
            for i in 0..N {
                f[i] += p[n] * coefficient[i];
            }
        }
        f
    }

    /// Size of the last Legendre coefficient, h |f̂_{S-1}| against 1e-3 + |y|, largest component: how well the
    /// polynomial resolves the motion. The floor keeps rounding at rest from counting as motion.
    pub(super) fn tail(&self) -> f64 {
        let last = &self.rate[STAGES - 1];
        let size = |i: usize| self.h * last[i].abs() / (1e-3 + self.end.hi[i].abs());
        (0..N).map(size).fold(0.0, f64::max)
    }
}

/// Coefficients of the method.
#[derive(Clone, Debug)]
pub(super) struct Gauss {
    c: [f64; STAGES],
    b: [f64; STAGES],
    a: [[f64; STAGES]; STAGES],
    /// Rows n: (2n+1) b_j P_n(c_j).
    projection: [[f64; STAGES]; STAGES],
}

impl Gauss {
    pub(super) fn new() -> Self {
        let (mut c, mut b) = ([0.0; STAGES], [0.0; STAGES]);
        for i in 0..STAGES / 2 {
            // Newton's iteration for the roots of P_S from the usual cosine estimate; the roots are symmetric.
            let mut x = 0.5 - 0.5 * (std::f64::consts::PI * (i as f64 + 0.75) / (STAGES as f64 + 0.5)).cos();
            for _ in 0..8 {
                x -= legendre(x)[STAGES] / legendre_slope(x);
            }
            let slope = legendre_slope(x);
            let weight = 1.0 / (x * (1.0 - x) * slope * slope);
            (c[i], b[i]) = (x, weight);
            (c[STAGES - 1 - i], b[STAGES - 1 - i]) = (1.0 - x, weight);
        }
        let (mut a, mut projection) = ([[0.0; STAGES]; STAGES], [[0.0; STAGES]; STAGES]);
        for j in 0..STAGES {
            let p = legendre(c[j]);
            for n in 0..STAGES {
                projection[n][j] = (2 * n + 1) as f64 * b[j] * p[n];
            }
        }
        for i in 0..STAGES {
            let p = legendre(c[i]);
            for j in 0..STAGES {
                a[i][j] = (0..STAGES).map(|n| legendre_integral(&p, c[i], n) * projection[n][j]).sum();
            }
        }
        Self { c, b, a, projection }
    }

    /// Steps `y` from `t` to `t + h`. `guess` is a polynomial on a step with the same start that supplies the first
    /// stage rates. `None` if the stage equations do not converge.
    pub(super) fn step<const N: usize>(
        &self,
        rate: impl Fn(f64, &[f64; N]) -> [f64; N],
        t: f64,
        y: &Sum<N>,
        h: f64,
        guess: Option<&Step<N>>,
    ) -> Option<Step<N>> {
        let mut f = match guess {
            Some(step) => self.c.map(|c| step.rate(c * h / step.h)),
            None => [rate(t, &y.hi); STAGES],
        };
        let mut previous = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let mut change = 0.0_f64;
            for i in 0..STAGES {
                let stage = y.plus(&combine(h, &self.a[i], &f)).hi;
                let new = rate(t + self.c[i] * h, &stage);
                for k in 0..N {
                    let relative = h * (new[k] - f[i][k]).abs() / (1.0 + y.hi[k].abs());
                    // f64::max would drop a NaN.
                    change = if relative > change || relative.is_nan() { relative } else { change };
                }
                f[i] = new;
            }
            if change <= 1e-17 || (change >= previous && change < STALL) {
                let mut coefficients = [[0.0; N]; STAGES];
                for n in 0..STAGES {
                    coefficients[n] = combine(1.0, &self.projection[n], &f);
                }
                let end = y.plus(&combine(h, &self.b, &f));
                return Some(Step { start: *y, h, rate: coefficients, end });
            }
            if !change.is_finite() {
                return None;
            }
            previous = change;
        }
        None
    }
}

/// scale Σ_j w_j f_j.
fn combine<const N: usize>(scale: f64, weights: &[f64; STAGES], f: &[[f64; N]; STAGES]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (w, fj) in weights.iter().zip(f) {
        for i in 0..N {
            sum[i] += w * fj[i];
        }
    }
    sum.map(|s| scale * s)
}

/// P_0 … P_S on \[0, 1\] at c.
fn legendre(c: f64) -> [f64; STAGES + 1] {
    let x = 2.0 * c - 1.0;
    let mut p = [1.0; STAGES + 1];
    p[1] = x;
    for n in 1..STAGES {
        let k = n as f64;
        p[n + 1] = ((2.0 * k + 1.0) * x * p[n] - k * p[n - 1]) / (k + 1.0);
    }
    p
}

/// dP_S/dc, for 0 < c < 1.
fn legendre_slope(c: f64) -> f64 {
    let p = legendre(c);
    let s = STAGES as f64;
    s * ((2.0 * c - 1.0) * p[STAGES] - p[STAGES - 1]) / (2.0 * c * (c - 1.0))
}

/// ∫_0^c P_n, with p = `legendre(c)`.
fn legendre_integral(p: &[f64; STAGES + 1], c: f64, n: usize) -> f64 {
    match n {
        0 => c,
        _ => (p[n + 1] - p[n - 1]) / (2.0 * (2 * n + 1) as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quadrature_is_exact_to_degree_fifteen_and_no_further() {
        let g = Gauss::new();
        let moment = |k: i32| (0..STAGES).map(|j| g.b[j] * g.c[j].powi(k)).sum::<f64>();
        for k in 0..16 {
            assert!((moment(k) - 1.0 / f64::from(k + 1)).abs() < 2e-16, "degree {k}");
        }
        assert!((moment(16) - 1.0 / 17.0).abs() > 1e-11);
    }

    #[test]
    fn stage_weights_integrate_polynomials_to_the_nodes() {
        let g = Gauss::new();
        for i in 0..STAGES {
            for k in 0..8 {
                let s: f64 = (0..STAGES).map(|j| g.a[i][j] * g.c[j].powi(k)).sum();
                assert!((s - g.c[i].powi(k + 1) / f64::from(k + 1)).abs() < 5e-16);
            }
        }
    }

    /// y' = y: the method is the (8, 8) Padé approximant of exp, whose first error term is known.
    #[test]
    fn the_order_is_sixteen() {
        let g = Gauss::new();
        let error = |h: f64| {
            let step = g.step(|_, y: &[f64; 1]| [y[0]], 0.0, &Sum::new([1.0]), h, None);
            step.map_or(f64::NAN, |s| (s.end.hi[0] + s.end.lo[0] - h.exp()).abs() / h.exp())
        };
        // (8!)² / (16! 17!) h^17 = 2.18e-19 h^17: visible only for a large step.
        for h in [2.0_f64, 2.5] {
            let expected = 40320.0_f64.powi(2) / (20922789888000.0 * 355687428096000.0) * h.powi(17);
            assert!((error(h) / expected - 1.0).abs() < 0.15, "{h} {} {expected}", error(h));
        }
        assert!(error(0.5) < 1e-16);
    }

    #[test]
    fn polynomial_joins_start_and_end() -> Result<(), String> {
        let g = Gauss::new();
        let rate = |t: f64, y: &[f64; 2]| [y[1], -y[0] + t];
        let step = g.step(rate, 0.3, &Sum::new([1.0, 0.2]), 0.4, None).ok_or("no step")?;
        for i in 0..2 {
            assert!((step.state(0.0)[i] - [1.0, 0.2][i]).abs() < 1e-16);
            assert!((step.state(1.0)[i] - step.end.hi[i]).abs() < 1e-15);
        }
        // y = t + A cos(t - 0.3) + B sin(t - 0.3), A = 0.7, B = -0.8.
        let (s, c) = 0.2_f64.sin_cos();
        assert!((step.state(0.5)[0] - (0.5 + 0.7 * c - 0.8 * s)).abs() < 1e-12);
        Ok(())
    }

    #[test]
    fn a_rate_that_is_not_finite_gives_no_step() {
        assert!(Gauss::new().step(|_, _: &[f64; 1]| [f64::NAN], 0.0, &Sum::new([1.0]), 0.1, None).is_none());
    }
}
