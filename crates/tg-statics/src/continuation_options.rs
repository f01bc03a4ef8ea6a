//! Settings of a continuation.

/// Settings of a continuation.
#[derive(Clone, Copy, Debug)]
pub struct ContinuationOptions {
    /// First step of arclength; one is about the whole range, or a displacement by the structure's size
    /// (docs/accuracy-and-speed.md, "First step of continuation").
    pub step: f64,
    /// Longest step. Events closer together than it may hide each other: docs/accuracy-and-speed.md, "Longest step of
    /// continuation".
    pub longest: f64,
    /// Shortest step before the branch is lost (docs/accuracy-and-speed.md, "Shortest step of continuation").
    pub shortest: f64,
    /// Number of steps: a hundred times what a branch of the tests takes (docs/accuracy-and-speed.md, "Longest step of
    /// continuation").
    pub steps: u32,
    /// Residual force per largest force of a point. Newton's last step leaves less than any of these
    /// (docs/accuracy-and-speed.md, "Tolerance of continuation").
    pub tolerance: f64,
    /// How far behind its start the parameter may go, per range: a branch that folds back may come round again.
    pub behind: f64,
}

impl Default for ContinuationOptions {
    fn default() -> Self {
        Self { step: 0.02, longest: 0.05, shortest: 1e-6, steps: 2000, tolerance: 1e-11, behind: 0.0 }
    }
}
