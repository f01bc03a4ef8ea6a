//! What became of one path.

use num_complex::Complex64;

use crate::complex_dd::ComplexDd;

/// How a path ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ReturnCode {
    /// At a regular finite solution.
    Success,
    /// At a finite solution with singular Jacobian.
    Singular,
    /// At infinity.
    AtInfinity,
    /// Not at an end.
    Failed(FailureReason),
}

/// Why a path was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FailureReason {
    /// Steps below the smallest one, in double-double.
    #[error("the step became too small in double-double precision")]
    StepTooSmall,
    /// More steps than allowed.
    #[error("the path took more steps than allowed")]
    TooManySteps,
    /// The endgame's estimates did not settle.
    #[error("the endgame did not settle before the smallest radius")]
    EndgameUnsettled,
    /// Two paths kept ending at one regular solution, or a number of paths that is no sum of winding numbers at a singular one.
    #[error("path crossing: the end is shared although it is regular, also with tightened settings")]
    Crossing,
}

/// What a path cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PathCounts {
    /// Steps taken.
    pub accepted: usize,
    /// Steps refused.
    pub rejected: usize,
    /// Steps taken in double-double.
    pub extended: usize,
    /// How often precision was raised.
    pub raised: usize,
    /// Turns round t = 0.
    pub turns: usize,
}

impl PathCounts {
    /// All attempted steps.
    pub fn steps(&self) -> usize {
        self.accepted + self.rejected
    }
}

/// One path of a homotopy.
#[derive(Clone, Debug)]
pub struct PathResult {
    /// Number of the start solution.
    pub index: usize,
    /// How it ended.
    pub code: ReturnCode,
    /// The end; empty unless it is finite.
    pub solution: Vec<Complex64>,
    /// The end in double-double, for ends that are regular.
    pub extended: Vec<ComplexDd>,
    /// Sheets that meet at the end, as far as the endgame went round it; 1 for a regular end.
    pub winding: usize,
    /// Paths that end at the same singular point; 1 for a regular end, 0 if the end is not finite.
    pub multiplicity: usize,
    /// κ∞ of the Jacobian with rows equilibrated and unknowns scaled by their moduli; infinite if singular, NaN without end.
    pub condition: f64,
    /// |t| at which the end was computed; 0 for a regular end.
    pub radius: f64,
    /// How often it was tracked again with tighter settings.
    pub retracked: u32,
    /// Cost.
    pub counts: PathCounts,
}

impl PathResult {
    /// Whether it ended at a regular finite solution.
    pub fn is_success(&self) -> bool {
        self.code == ReturnCode::Success
    }
}
