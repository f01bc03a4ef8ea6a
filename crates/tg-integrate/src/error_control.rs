//! Choice of the step from the estimated error: a proportional-integral controller.
//!
//! ```text
//! err = √( (1/2n) Σ (e_i / (absolute · S + relative · min(max(|y_i|, |ŷ_i|), S)))² ),   S = L for coordinates
//! h_{n+1} = h_n · 0.9 · err_n^(-1/p + 0.75 β) · err_{n-1}^β,   β = 0.2/p                     S = V for velocities
//! ```
//! L is the size of the structure and V its speed: the largest velocity so far, or √(f L/m) if that is more, which the largest
//! force f at the start gives the whole mass m over the distance L. So a tolerance means the same for a structure in
//! millimetres and in kilometres, near the origin and far from it.
//!
//! K. Gustafsson, ACM Trans. Math. Softw. 17 (1991) 533–554; E. Hairer, G. Wanner, Solving Ordinary Differential Equations II,
//! (2.43c) of Sec. IV.2.

use crate::error::StartError;

/// Least and largest factor between successive steps.
const RANGE: (f64, f64) = (0.2, 8.0);
const SAFETY: f64 = 0.9;
/// Error that a very small one counts as in the next step's choice.
const LEAST_ERROR: f64 = 1e-4;

/// How exact the explicit schemes are asked to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Error of a substep relative to each coordinate and velocity. Of the planar tower's lowest triangle the default 1e-6
    /// leaves 2e-9 m after 1 s, with slacking cables 1e-8 m, in 2200 and 2700 evaluations of order 5; 1e-4 leaves 3e-7 and
    /// 7e-7 m for half of that (docs/accuracy-and-speed.md, "Tolerance of the explicit pairs").
    pub relative: f64,
    /// Error of a substep that is allowed to any coordinate, per size of the structure, and to any velocity, per its speed, in
    /// the root mean square of all. The default is 1e-8, a hundredth of the relative one: coordinates and velocities near zero
    /// are not asked for more digits than the others. A larger share is less exact, a smaller one not more so
    /// (docs/accuracy-and-speed.md, "Absolute tolerance").
    pub absolute: f64,
    /// Substeps, accepted or not, after which a step is given up: an explicit scheme on a stiff structure would go on for
    /// very long. The default 100 000 is a second or more of computing for a small structure, and a hundred times what the
    /// tower takes for half a second at 1e-10 (docs/accuracy-and-speed.md, "Tolerance of the explicit pairs").
    pub most_substeps: u32,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self { relative: 1e-6, absolute: 1e-8, most_substeps: 100_000 }
    }
}

impl Tolerances {
    /// Tolerances that ask for a relative error and a hundredth of it as the absolute one.
    pub fn relative(relative: f64) -> Self {
        Self { relative, absolute: 1e-2 * relative, ..Self::default() }
    }

    /// # Errors
    /// A tolerance that is negative or not finite, an absolute one that is zero, or no substeps.
    pub(crate) fn check(&self) -> Result<(), StartError> {
        let refuse = |name, value, must| Err(StartError::Parameter { name, value, must });
        if !(self.relative.is_finite() && self.relative >= 0.0) {
            return refuse("relative tolerance", self.relative, "be finite and not negative");
        }
        if !(self.absolute.is_finite() && self.absolute > 0.0) {
            return refuse("absolute tolerance", self.absolute, "be finite and positive");
        }
        if self.most_substeps == 0 {
            return refuse("number of substeps", 0.0, "be at least 1");
        }
        Ok(())
    }

    /// Size by which an error of a component that goes from `a` to `b` is divided, `size` being L or V.
    pub(crate) fn scale(&self, a: f64, b: f64, size: f64) -> f64 {
        self.absolute * size + self.relative * a.abs().max(b.abs()).min(size)
    }
}

/// What the controller carries from substep to substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Controller {
    /// Substep to try next \[s\].
    pub(crate) proposal: f64,
    /// Error of the last accepted substep.
    pub(crate) last_error: f64,
    /// Whether the substep before was refused: the next one does not grow.
    refused: bool,
}

impl Controller {
    pub(crate) fn new(proposal: f64, last_error: f64) -> Self {
        Self { proposal, last_error, refused: false }
    }

    /// After a substep `h` that is accepted with an error of at most 1.
    pub(crate) fn accept(&mut self, h: f64, error: f64, order: i32) {
        let (alpha, beta) = exponents(order);
        let largest = if self.refused { 1.0 } else { RANGE.1 };
        let wanted = SAFETY * error.powf(-alpha) * self.last_error.powf(beta);
        let next = h * wanted.clamp(RANGE.0, largest);
        // A substep cut short by the end of the step says little about longer ones.
        let cut = h < self.proposal && wanted > largest;
        self.proposal = if cut { next.max(self.proposal) } else { next };
        self.last_error = error.max(LEAST_ERROR);
        self.refused = false;
    }

    /// After a substep `h` whose error is above 1, or not a number.
    pub(crate) fn refuse(&mut self, h: f64, error: f64, order: i32) {
        let (alpha, _) = exponents(order);
        let factor = SAFETY * error.powf(-alpha);
        self.proposal = h * if factor > RANGE.0 { factor.min(SAFETY) } else { RANGE.0 };
        self.refused = true;
    }
}

fn exponents(order: i32) -> (f64, f64) {
    let beta = 0.2 / f64::from(order);
    (1.0 / f64::from(order) - 0.75 * beta, beta)
}
