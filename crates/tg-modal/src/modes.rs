//! Undamped modes about an equilibrium.
//!
//! ```text
//! (𝓚 - ω² 𝓜) ξ = 0,   δq = E N ξ,   δqᵀ M δq = 1          (44), (45)
//! ```

use std::f64::consts::PI;

use tg_model::Mechanics;
use tg_tangent::{Configuration, Counts, EigenOptions, Method, Metric, Sign, lowest};

use crate::balance;
use crate::error::ModalError;
use crate::shape;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct ModeOptions {
    /// Number of lowest modes; fewer come back from a structure with fewer degrees of freedom, so that `usize::MAX` asks
    /// for all.
    pub count: usize,
    /// How eigenpairs are found.
    pub method: Method,
    /// Part of the largest |ω²| up to which ω² counts as zero; see [`EigenOptions::zero`].
    pub zero: f64,
    /// Largest residual force per largest force, and largest constraint residual per size, that still is an equilibrium.
    /// How far an imbalance shifts ω²: docs/accuracy-and-speed.md, "Imbalance of an equilibrium"; 1e-8 is far above
    /// what Newton's method leaves (1e-12). Rest lengths copied from a table with six digits do not pass: find their
    /// equilibrium, or widen this knowingly.
    pub imbalance: f64,
}

impl ModeOptions {
    /// The `count` lowest modes with the default settings.
    pub fn new(count: usize) -> Self {
        let eigen = EigenOptions::new(count, Metric::Mass);
        Self { count, method: eigen.method, zero: eigen.zero, imbalance: 1e-8 }
    }

    /// All modes with the default settings.
    pub fn all() -> Self {
        Self::new(usize::MAX)
    }
}

/// What a mode does, told by the sign of ω².
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ModeKind {
    /// ω² > 0.
    Vibration {
        /// ω / 2π \[Hz\].
        frequency: f64,
    },
    /// ω² = 0 within [`Modes::zero_limit`]: a rigid motion, or a mechanism without stiffness.
    Zero,
    /// ω² < 0: the equilibrium is unstable, small motions grow as exp(rate · t).
    Unstable {
        /// √(-ω²) \[1/s\].
        rate: f64,
    },
}

/// One undamped mode.
#[derive(Clone, Debug)]
pub struct Mode {
    /// ω² \[1/s²\], negative for an unstable mode.
    pub omega_squared: f64,
    /// What the mode does.
    pub kind: ModeKind,
    /// δq over the full coordinates, zero at prescribed ones, mass-normalised: δqᵀ M δq = 1 (45), so that its unit is
    /// that of a coordinate times kg^-½. Its largest component is positive, the first one where several are equal.
    /// Within a multiple ω² the shapes are one orthonormal basis of many.
    pub shape: Vec<f64>,
    /// Size of the error that rounding of K leaves in ω² \[1/s²\]: an estimate.
    pub accuracy: f64,
}

/// The lowest modes of a structure about an equilibrium.
#[derive(Clone, Debug)]
pub struct Modes {
    /// Lowest modes, ω² ascending.
    pub list: Vec<Mode>,
    /// Numbers of negative, zero and positive ω² among all modes, listed or not.
    pub counts: Counts,
    /// |ω²| up to which it counts as zero \[1/s²\].
    pub zero_limit: f64,
    /// Largest |ω²| of all modes, or an estimate of it \[1/s²\].
    pub largest: f64,
    /// The method that was used.
    pub method: Method,
}

impl Modes {
    /// Whether every mode of the structure is listed, so that the shapes are a basis of all motions that the constraints
    /// allow.
    pub fn is_complete(&self) -> bool {
        self.list.len() == self.degrees_of_freedom()
    }

    /// Number of degrees of freedom of the structure.
    pub fn degrees_of_freedom(&self) -> usize {
        self.counts.negative + self.counts.zero + self.counts.positive
    }

    /// Frequencies \[Hz\] of the listed vibrations, ascending; zero and unstable modes have none.
    pub fn frequencies(&self) -> impl Iterator<Item = f64> {
        self.list.iter().filter_map(|mode| match mode.kind {
            ModeKind::Vibration { frequency } => Some(frequency),
            ModeKind::Zero | ModeKind::Unstable { .. } => None,
        })
    }
}

/// The lowest undamped modes about the equilibrium `at`.
///
/// # Errors
/// `at` violates a constraint or is no equilibrium, a motion has no mass, or no factorisation or convergence.
pub fn modes(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    options: &ModeOptions,
) -> Result<Modes, ModalError> {
    balance::check(mechanics, at, options.imbalance)?;
    let eigen = EigenOptions {
        count: options.count,
        metric: Metric::Mass,
        method: options.method,
        zero: options.zero,
    };
    let spectrum = lowest(mechanics, at, &eigen)?;
    let list = spectrum.pairs.into_iter().map(|pair| {
        let kind = match pair.sign {
            Sign::Positive => ModeKind::Vibration { frequency: pair.value.sqrt() / (2.0 * PI) },
            Sign::Zero => ModeKind::Zero,
            Sign::Negative => ModeKind::Unstable { rate: (-pair.value).sqrt() },
        };
        let mut shape = pair.shape;
        shape::orient(&mut shape);
        Mode { omega_squared: pair.value, kind, shape, accuracy: pair.accuracy }
    });
    Ok(Modes {
        list: list.collect(),
        counts: spectrum.counts,
        zero_limit: spectrum.zero_limit,
        largest: spectrum.largest,
        method: spectrum.method,
    })
}
