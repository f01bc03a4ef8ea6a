//! Constitutive laws of cables.
//!
//! ```text
//! f⁺ = κ (l - μ) + η l̇                                  linear, two-way
//! f  = f⁺ if f⁺ ≥ 0 and l ≥ μ, else 0     (30)           linear, slacking
//! ```
//! l length, μ rest length, l̇ rate of length; tension is positive. With η > 0 law (30) jumps by η l̇ when a cable
//! re-tensions; the time steppers know.

use std::fmt;
use std::sync::Arc;

use crate::error::BuildError;

/// How a cable answers to its length and rate of length.
#[derive(Clone)]
pub enum CableLaw {
    /// Two-way spring (and damper): pulls when long, pushes when short (setups UN and DN of the framework paper).
    Linear {
        /// Stiffness κ \[N/m\], not negative.
        stiffness: f64,
        /// Damping η \[N s/m\], not negative.
        damping: f64,
    },
    /// A cable that goes slack instead of pushing, eq. (30).
    Slacking {
        /// Stiffness κ \[N/m\], not negative.
        stiffness: f64,
        /// Damping η \[N s/m\], not negative.
        damping: f64,
    },
    /// A user's law.
    User(Arc<dyn TensionLaw>),
}

/// A user's tension law `f(l, l̇, μ)`; smooth, or the time steppers lose their order where it is not.
pub trait TensionLaw: Send + Sync {
    /// Tension and its derivatives at length `l` \[m\], rate `rate` \[m/s\] and rest length `rest` \[m\].
    fn tension(&self, length: f64, rate: f64, rest: f64) -> Tension;
    /// Stored energy \[J\], the integral of the rate-free tension over the length.
    fn energy(&self, length: f64, rest: f64) -> f64;
    /// Whether the tension depends on the rate of length; if not, no velocity tangent is kept.
    fn damped(&self) -> bool;
}

/// Tension and its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Tension {
    /// Tension f \[N\], positive when the cable pulls.
    pub force: f64,
    /// ∂f/∂l \[N/m\].
    pub by_length: f64,
    /// ∂f/∂l̇ \[N s/m\].
    pub by_rate: f64,
}

impl CableLaw {
    /// Two-way law without damping.
    pub fn linear(stiffness: f64) -> Self {
        Self::Linear { stiffness, damping: 0.0 }
    }

    /// Slacking law without damping.
    pub fn slacking(stiffness: f64) -> Self {
        Self::Slacking { stiffness, damping: 0.0 }
    }

    /// Refuses κ or η that is negative or not finite.
    pub(crate) fn check(&self, cable: &str) -> Result<(), BuildError> {
        if let Self::Linear { stiffness, damping } | Self::Slacking { stiffness, damping } = *self {
            not_negative(cable, "stiffness", stiffness)?;
            not_negative(cable, "damping", damping)?;
        }
        Ok(())
    }

    /// Static tension at a length and rest length \[m\], taut or not as the law has it.
    pub(crate) fn static_tension(&self, length: f64, rest: f64) -> f64 {
        match self {
            Self::Linear { stiffness, .. } => stiffness * (length - rest),
            Self::Slacking { stiffness, .. } => (stiffness * (length - rest)).max(0.0),
            Self::User(law) => law.tension(length, 0.0, rest).force,
        }
    }

    /// κ of the linear laws \[N/m\].
    pub(crate) fn linear_stiffness(&self) -> Option<f64> {
        match *self {
            Self::Linear { stiffness, .. } | Self::Slacking { stiffness, .. } => Some(stiffness),
            Self::User(_) => None,
        }
    }

    /// The same law with damping η \[N s/m\]; a user's law keeps its own.
    #[must_use]
    pub fn with_damping(self, damping: f64) -> Self {
        match self {
            Self::Linear { stiffness, .. } => Self::Linear { stiffness, damping },
            Self::Slacking { stiffness, .. } => Self::Slacking { stiffness, damping },
            Self::User(law) => Self::User(law),
        }
    }
}

/// Refuses a property of a cable that is negative or not finite.
pub(crate) fn not_negative(name: &str, what: &'static str, value: f64) -> Result<(), BuildError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else if value.is_finite() {
        Err(BuildError::OutOfRange { kind: "cable", name: name.into(), what, value, must: "not be negative" })
    } else {
        Err(BuildError::NotFinite { kind: "cable", name: name.into(), what })
    }
}

impl fmt::Debug for CableLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Linear { stiffness, damping } => write!(f, "Linear(κ = {stiffness}, η = {damping})"),
            Self::Slacking { stiffness, damping } => write!(f, "Slacking(κ = {stiffness}, η = {damping})"),
            Self::User(_) => write!(f, "User(..)"),
        }
    }
}
