//! What forward statics is asked for, and what it took.

/// Which equilibrium is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Seek {
    /// The one that Newton's method reaches, stable or not.
    #[default]
    Any,
    /// One without negative eigenvalue of the reduced Hessian.
    Stable,
}

/// Settings of forward statics.
#[derive(Clone, Copy, Debug)]
pub struct ForwardOptions {
    /// Residual force per largest force at which forces balance. Rounding leaves some 1e-15; 1e-12 is reached by every
    /// structure in the tests (docs/accuracy-and-speed.md, "Tolerance of forward statics").
    pub tolerance: f64,
    /// Newton iterations per load step. From near, three to eleven do; from far, relaxation takes over
    /// (docs/accuracy-and-speed.md, "Newton's method and relaxation").
    pub max_iterations: u32,
    /// Which equilibrium is wanted.
    pub seek: Seek,
    /// Whether dynamic relaxation may take over: it finds equilibria that Newton's method alone does not
    /// (docs/accuracy-and-speed.md, "Newton's method and relaxation").
    pub relax: bool,
    /// Load steps of [`crate::Forward::solve_from`].
    pub load_steps: u32,
}

impl Default for ForwardOptions {
    fn default() -> Self {
        Self { tolerance: 1e-12, max_iterations: 60, seek: Seek::Any, relax: true, load_steps: 1 }
    }
}

/// What it took to find an equilibrium.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ForwardReport {
    /// Newton iterations, all load steps together.
    pub iterations: u32,
    /// Load steps that were accepted.
    pub load_steps: u32,
    /// Steps of dynamic relaxation; zero where Newton's method sufficed.
    pub relaxation_steps: u32,
    /// Stops at peaks of kinetic energy.
    pub relaxation_stops: u32,
    /// Unstable equilibria that were left on the way to a stable one.
    pub left_unstable: u32,
    /// Rigid motions without stiffness, gauged.
    pub gauged: usize,
    /// Systems that needed the pivoting factorisation.
    pub fallbacks: u64,
    /// Residual force per largest force.
    pub residual: f64,
    /// Scaled violation of the constraints.
    pub constraint_residual: f64,
}
