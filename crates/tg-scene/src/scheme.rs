//! Time stepping schemes by their names.

use std::fmt;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::de::IntoDeserializer;
use serde::{Deserialize, Serialize};

use crate::error::ReadError;

/// Time stepping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// The modified symplectic scheme of the framework paper: second order, no numerical damping.
    // Why it is the default: docs/accuracy-and-speed.md, "Schemes".
    #[default]
    Symplectic,
    /// Generalised-α (Arnold, Brüls 2007): second order, damps high frequencies.
    GeneralizedAlpha,
    /// Leapfrog with exact constraints (RATTLE, Andersen 1983): second order, explicit, the cheapest step.
    Leapfrog,
    /// Five symplectic steps (Suzuki 1990): fourth order, no numerical damping.
    #[serde(rename = "composition-4")]
    Composition4,
    /// Nine symplectic steps (Kahan, Li 1997): sixth order, no numerical damping.
    #[serde(rename = "composition-6")]
    Composition6,
    /// Explicit pair of order 5(4) (Dormand, Prince 1980): fixed steps, or error control by `tolerance`.
    #[serde(rename = "runge-kutta-5")]
    RungeKutta5,
    /// Explicit pair of order 8(5,3) (Dormand, Prince; DOP853): as the other, for tolerances of 1e-7 and finer.
    #[serde(rename = "runge-kutta-8")]
    RungeKutta8,
}

impl Scheme {
    /// All schemes, the default first.
    pub const ALL: [Self; 7] = [
        Self::Symplectic,
        Self::GeneralizedAlpha,
        Self::Leapfrog,
        Self::Composition4,
        Self::Composition6,
        Self::RungeKutta5,
        Self::RungeKutta8,
    ];

    /// Order of the error of a fixed step, where no cable goes slack.
    pub fn order(self) -> i32 {
        match self {
            Self::Symplectic | Self::GeneralizedAlpha | Self::Leapfrog => 2,
            Self::Composition4 => 4,
            Self::RungeKutta5 => 5,
            Self::Composition6 => 6,
            Self::RungeKutta8 => 8,
        }
    }

    /// Whether it can choose its steps by a tolerance.
    pub fn controls_error(self) -> bool {
        matches!(self, Self::RungeKutta5 | Self::RungeKutta8)
    }
}

/// The name in scene files.
impl fmt::Display for Scheme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.serialize(f)
    }
}

/// There is no scheme of that name; the message says which is meant, or all.
#[derive(Clone, Debug, thiserror::Error)]
#[error("{0}")]
pub struct UnknownScheme(String);

impl FromStr for Scheme {
    type Err = UnknownScheme;

    fn from_str(name: &str) -> Result<Self, UnknownScheme> {
        Self::deserialize(name.into_deserializer()).map_err(|error: ReadError| {
            UnknownScheme(match &error.help {
                Some(help) => format!("{error}; {help}"),
                None => error.to_string(),
            })
        })
    }
}
