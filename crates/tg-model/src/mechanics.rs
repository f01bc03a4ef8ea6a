//! The narrow waist between structures and solvers.
//!
//! ```text
//! M q̈ - F(q, q̇, u) - A(q)ᵀ λ = 0      on the free coordinates     (38a)
//! Φ(q) = 0,   A = ∂Φ/∂q                                            (38b)
//! ```
//! Everything is written in the *full* coordinates q (free and prescribed together); [`Mechanics::free`] says which
//! are unknown. Time enters only through the prescribed coordinates and through the inputs u (rest lengths, then
//! the components of loads), so that a solver may drive either by time or by any other parameter. Patterns and constant
//! matrices are given once; evaluation fills flat slices in that fixed order and allocates nothing.

/// Sizes of a mechanical system.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Number of coordinates, free and prescribed.
    pub coordinates: usize,
    /// Number of constraints Φ.
    pub constraints: usize,
    /// Number of inputs u.
    pub inputs: usize,
    /// Number of switches: force laws with a slack branch.
    pub switches: usize,
}

/// What a system contains; a solver leaves out the work for what it does not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Features {
    /// Some force depends on velocity: the damping tangent is not empty.
    pub damping: bool,
    /// Some prescribed coordinate moves.
    pub moving_supports: bool,
    /// Some input changes with time.
    pub driven_inputs: bool,
}

/// A matrix entry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Row.
    pub row: usize,
    /// Column.
    pub col: usize,
    /// Value.
    pub value: f64,
}

/// One entry of the constant second derivative ∂²Φ_c/∂q_row ∂q_col.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HessianEntry {
    /// Constraint c.
    pub constraint: usize,
    /// First coordinate.
    pub row: usize,
    /// Second coordinate.
    pub col: usize,
    /// Value, dimensionless for dot-product constraints.
    pub value: f64,
}

/// Where a system is evaluated.
#[derive(Clone, Copy, Debug)]
pub struct At<'a> {
    /// Coordinates q, full.
    pub q: &'a [f64],
    /// Velocities q̇, full.
    pub v: &'a [f64],
    /// Inputs u.
    pub u: &'a [f64],
    /// The active set to use, one flag per switch (taut or slack); `None` lets each law decide.
    pub taut: Option<&'a [bool]>,
}

/// A constrained mechanical system as the solvers see it: flat slices in fixed entry orders.
///
/// Slices have the lengths that [`Mechanics::sizes`] and the patterns give; a wrong length may panic.
pub trait Mechanics: Send + Sync {
    /// Sizes.
    fn sizes(&self) -> Sizes;
    /// What the system contains.
    fn features(&self) -> Features;
    /// Indices of the free coordinates, ascending.
    fn free(&self) -> &[usize];
    /// Mass matrix M over the full coordinates, constant, symmetric; entries do not repeat.
    fn mass(&self) -> &[Entry];
    /// Entries (row, column) of -∂F/∂q; entries may repeat and are summed. At least all of free × free.
    fn stiffness_pattern(&self) -> &[(usize, usize)];
    /// Entries (row, column) of -∂F/∂q̇, empty without damping; may repeat. At least all of free × free.
    fn damping_pattern(&self) -> &[(usize, usize)];
    /// Entries (constraint, coordinate) of A over the full coordinates; may repeat.
    fn jacobian_pattern(&self) -> &[(usize, usize)];
    /// The constant second derivatives of Φ over the full coordinates; may repeat.
    fn constraint_hessian(&self) -> &[HessianEntry];
    /// Size of each constraint (squared or plain length of its member) by which residuals are scaled.
    fn constraint_scales(&self) -> &[f64];
    /// Size of the structure \[m\], wherever it stands: what displacements are small or large against.
    fn size(&self) -> f64;
    /// A unit of length near the size \[m\]: a power of 1024, so that scaling by it rounds nothing, and exactly 1 m for structures
    /// of some centimetres to some ten metres.
    fn unit(&self) -> f64 {
        (10.0 * (self.size().log2() / 10.0).round()).exp2()
    }

    /// Overwrites the prescribed components of q and q̇ by their values at time `t`.
    fn prescribe(&self, t: f64, q: &mut [f64], v: &mut [f64]);
    /// Overwrites the prescribed components of q̈ by their values at time `t`.
    fn prescribed_acceleration(&self, t: f64, a: &mut [f64]);
    /// Inputs at time `t`.
    fn inputs(&self, t: f64, u: &mut [f64]);
    /// Generalised force F over the full coordinates \[N\].
    fn force(&self, at: At<'_>, f: &mut [f64]);
    /// Values of -∂F/∂q in the order of [`Mechanics::stiffness_pattern`].
    fn stiffness(&self, at: At<'_>, values: &mut [f64]);
    /// Values of -∂F/∂q̇ in the order of [`Mechanics::damping_pattern`].
    fn damping(&self, at: At<'_>, values: &mut [f64]);
    /// Constraints Φ(q).
    fn constraints(&self, q: &[f64], phi: &mut [f64]);
    /// Values of A(q) in the order of [`Mechanics::jacobian_pattern`].
    fn jacobian(&self, q: &[f64], values: &mut [f64]);
    /// The active set that the laws choose: one flag per switch, true where taut.
    fn active_set(&self, at: At<'_>, taut: &mut [bool]);
    /// Potential energy of the conservative forces \[J\].
    fn potential(&self, q: &[f64], u: &[f64]) -> f64;

    /// Size \[N\] of the largest single force that F sums (a tension, a weight, a load): what residual forces are held
    /// against, since F itself vanishes where forces balance. A cable counts at least with a force that the rounding of
    /// its length leaves some digits of, so that residuals of stress-free states mean something.
    fn force_scale(&self, at: At<'_>) -> f64;

    /// Name of a coordinate for messages.
    fn coordinate_name(&self, coordinate: usize) -> String {
        format!("coordinate {coordinate}")
    }
    /// Name of a constraint for messages.
    fn constraint_name(&self, constraint: usize) -> String {
        format!("constraint {constraint}")
    }
    /// Name of a switch (a slacking cable) for messages.
    fn switch_name(&self, switch: usize) -> String {
        format!("switch {switch}")
    }
    /// Names of the cables that act on a coordinate, for messages.
    fn cables_at(&self, coordinate: usize) -> Vec<String> {
        let _ = coordinate;
        Vec::new()
    }
}
