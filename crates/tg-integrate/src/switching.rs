//! Switches of slacking cables within an explicit step: whether one matters, and when it happens.
//!
//! Within a substep the active set S is the one of its start, so that the right-hand side is smooth. Where the laws have another
//! set S' in its course, the accelerations differ by
//!
//! ```text
//! [M -Aᵀ] [δq̈]   [F(S') - F(S)]
//! [A   0] [δλ] = [      0     ]
//! ```
//! and the velocity misses at most h δq̈. If that is within the tolerance, the switch is passed; else its time is found by
//! bisection on the Hermite interpolant, and the substep is made again to end just behind it. The interpolant is exact at its
//! ends, so that two or three repetitions lead to the switch of the method's own solution. (Event location: E. Hairer, S. P.
//! Nørsett, G. Wanner, Solving Ordinary Differential Equations I, Sec. II.6.)

use tg_sparse::SparseError;

use crate::error_control::Tolerances;
use crate::hermite::interpolate;
use crate::stepper::StepReport;
use crate::substep::Substep;

/// Part of the tolerance that a missed change of the accelerations may move the velocity by.
const MISSED: f64 = 0.1;
/// Where in a substep the active set is looked at.
const LOOKS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Bisections of a switch: to the rounding of θ.
const BISECTIONS: u32 = 50;

/// What a substep meets.
pub(crate) enum Switch {
    /// Nothing that matters.
    None,
    /// A switch just before its end.
    AtEnd,
    /// A switch at the part `at` of it, `taut_then` being the laws' set behind; a substep that ends at `behind` has passed it
    /// for certain and misses little.
    Within { at: f64, behind: f64 },
}

impl Substep<'_> {
    /// Looks for a switch in a substep that the error control accepts.
    pub(crate) fn switch(&mut self, t: f64, h: f64) -> Result<Switch, SparseError> {
        let Some(tolerances) = self.tolerances else { return Ok(Switch::None) };
        if self.taut.is_empty() {
            return Ok(Switch::None);
        }
        let mut before = 0.0;
        for look in LOOKS {
            if !self.switched(t, h, look) {
                before = look;
                continue;
            }
            let missed = h * self.missed(&tolerances)?;
            if missed <= MISSED {
                continue;
            }
            let (mut low, mut high) = (before, look);
            for _ in 0..BISECTIONS {
                let middle = 0.5 * (low + high);
                if middle <= low || middle >= high {
                    break;
                }
                if self.switched(t, h, middle) {
                    high = middle;
                } else {
                    low = middle;
                }
            }
            if look >= 1.0 && (1.0 - high) * missed <= MISSED {
                return Ok(Switch::AtEnd);
            }
            self.switched(t, h, high);
            return Ok(Switch::Within { at: high, behind: (high + 0.5 * MISSED / missed).min(look) });
        }
        Ok(Switch::None)
    }

    /// Places the equations at a part of the substep; whether the laws have another active set there.
    fn switched(&mut self, t: f64, h: f64, theta: f64) -> bool {
        if theta < 1.0 {
            let size = self.start.len();
            let (first, last) = (&self.rates[..size], &self.rates[self.rates.len() - size..]);
            interpolate(theta, h, (&self.start, first), (&self.end, last), &mut self.stage);
            self.equations.place(t + theta * h, &self.stage);
        } else {
            self.equations.place(t + h, &self.end);
        }
        self.equations.active_set(&mut self.taut_then);
        self.taut != self.taut_then
    }

    /// δq̈ against the tolerance of the velocities, where the equations are placed, by the factors of the end.
    fn missed(&mut self, tolerances: &Tolerances) -> Result<f64, SparseError> {
        self.equations.jump(&self.taut, &self.taut_then, &mut self.jump)?;
        let (n, speed) = (self.jump.len(), self.speed());
        let mut sum = 0.0;
        for i in 0..n {
            sum += (self.jump[i] / tolerances.scale(self.start[n + i], self.end[n + i], speed)).powi(2);
        }
        Ok((sum / n as f64).sqrt())
    }

    /// Begins the substep once more with the active set behind a switch at its very start.
    pub(crate) fn reopen(&mut self, t: f64, report: &mut StepReport) -> Result<(), SparseError> {
        self.taut.copy_from_slice(&self.taut_then);
        self.stage.copy_from_slice(&self.start);
        self.evaluate(t, 0, report)
    }
}
