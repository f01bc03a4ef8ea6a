//! What can be wrong with a request, where, and what mends it.

use thiserror::Error;

/// A request that cannot be carried out.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HomotopyError {
    /// Isolated solutions need as many equations as unknowns.
    #[error("{equations} equations in {unknowns} unknowns; a homotopy needs as many equations as unknowns")]
    NotSquare {
        /// Equations given.
        equations: usize,
        /// Unknowns declared.
        unknowns: usize,
    },
    /// An equation without unknowns has no or all solutions.
    #[error("equation {equation} contains no unknown; remove it together with one unknown")]
    ConstantEquation {
        /// The equation, from 0.
        equation: usize,
    },
    /// A polynomial uses an unknown or parameter that this builder did not make.
    #[error(
        "equation {equation} uses {kind} {index}, which the builder did not declare; build it from this builder's variables"
    )]
    Undeclared {
        /// The equation, from 0.
        equation: usize,
        /// "unknown" or "parameter".
        kind: &'static str,
        /// The index used.
        index: usize,
    },
    /// A coefficient, a parameter or a solution is infinite or not a number.
    #[error("{what} {index} is not finite; every number given must be finite")]
    NotFinite {
        /// What the number is.
        what: &'static str,
        /// Which one.
        index: usize,
    },
    /// A list has the wrong length.
    #[error("{what} has {found} entries, expected {expected}")]
    Length {
        /// What the list is.
        what: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
    /// A grouping names an unknown twice, not at all, or one that does not exist.
    #[error("unknown {unknown} stands in {times} groups; each unknown of the system belongs in exactly one")]
    Grouping {
        /// The unknown.
        unknown: usize,
        /// How often it was named.
        times: usize,
    },
    /// No start system was offered.
    #[error("the list of groupings is empty; offer at least one, for instance Grouping::single")]
    NoGrouping,
    /// The multihomogeneous Bézout number is zero: the system has no isolated finite solutions for generic coefficients.
    #[error(
        "the Bézout number of this grouping is zero: no isolated finite solutions for generic coefficients"
    )]
    NoPaths,
    /// More paths than the options allow.
    #[error(
        "{paths} paths, more than the {limit} allowed; a better grouping needs fewer, or raise `max_paths`"
    )]
    TooManyPaths {
        /// The Bézout number.
        paths: u64,
        /// The limit in the options.
        limit: u64,
    },
    /// Monodromy and trace test need something to start from.
    #[error(
        "no start solution solves the system at the start parameters (best relative Newton step {step:e}); give seeds"
    )]
    NoSeed {
        /// The smallest Newton step seen.
        step: f64,
    },
    /// The system is not mapped to itself by the conjugation.
    #[error(
        "equation {equation} is not mapped to ± an equation of the system by the conjugation; check the permutation, or call `symmetrized` to remove rounding errors of the coefficients"
    )]
    NotInvariant {
        /// The equation, from 0.
        equation: usize,
    },
    /// The parameters are not mapped to themselves by the conjugation.
    #[error(
        "parameter {parameter} is not the conjugate of its partner; real solutions need conjugation-invariant parameters"
    )]
    ParameterNotInvariant {
        /// The parameter, from 0.
        parameter: usize,
    },
    /// A permutation of unknowns or parameters is not an involution.
    #[error("the permutation of {what} maps {index} elsewhere than back; a conjugation is an involution")]
    NotInvolution {
        /// "unknowns" or "parameters".
        what: &'static str,
        /// The index.
        index: usize,
    },
}

/// Checks a length.
pub(crate) fn check_length(what: &'static str, expected: usize, found: usize) -> Result<(), HomotopyError> {
    if expected == found { Ok(()) } else { Err(HomotopyError::Length { what, expected, found }) }
}

/// Checks that all numbers are finite.
pub(crate) fn check_finite(
    what: &'static str,
    numbers: &[num_complex::Complex64],
) -> Result<(), HomotopyError> {
    match numbers.iter().position(|z| !(z.re.is_finite() && z.im.is_finite())) {
        None => Ok(()),
        Some(index) => Err(HomotopyError::NotFinite { what, index }),
    }
}
