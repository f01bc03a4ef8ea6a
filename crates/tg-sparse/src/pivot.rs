//! The check of pivots: when elimination in the static order has lost its digits.
//!
//! The pivot of row i is `u_ii = k_ii − Σ l_ik u_ki`. It is compared with
//! `s_i = |k_ii| + Σ |l_ik u_ki|`, the sum of the magnitudes that went into it: the ratio does not depend on the units
//! or the scaling of rows and columns, which differ between unknowns and multipliers. For a multiplier it is, up to a
//! factor of two, the squared sine of the angle (in the metric of `H⁻¹`) between its row of `A` and the rows before it.
//! Rounding leaves about `ε s_i` of a pivot that vanishes.

/// A pivot below this share of `s_i` has lost all digits but one or two (450 ε): trouble.
pub(crate) const PIVOT_LOST: f64 = 1e-13;

/// A pivot below this share of `s_i` has lost half of the digits. It may be the rounding error of a pivot that vanishes
/// where earlier pivots were lossy too; the caller has to probe it.
pub(crate) const PIVOT_DOUBTFUL: f64 = 1e-8;

/// A pivot below this share of `s_i` is not trusted where solutions are not checked: some ten digits are to be left.
pub(crate) const PIVOT_WEAK: f64 = 1e-6;

/// What to do with small pivots.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PivotRule<'a> {
    /// Stop at a lost pivot, note doubtful ones.
    Check,
    /// Take a row and column out of the system; its component of every solution is then zero.
    Drop {
        /// When its pivot is not above this, or
        below: f64,
        /// when its position is marked.
        also: &'a [bool],
    },
}

/// A pivot that vanishes or is not finite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PivotTrouble {
    pub(crate) position: usize,
    pub(crate) pivot: f64,
    pub(crate) scale: f64,
}
