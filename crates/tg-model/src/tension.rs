//! Laws as the loops over cables see them: linear ones with compile-time flags, and users' ones.

use std::sync::Arc;

use crate::law::{Tension, TensionLaw};

/// A law as the loops see it.
pub(crate) trait Law {
    /// Whether a set of this law has a velocity tangent at all.
    fn damped(laws: &[Self]) -> bool
    where
        Self: Sized;
    fn tension(&self, length: f64, rate: f64, rest: f64, taut: Option<bool>) -> Tension;
    fn energy(&self, length: f64, rest: f64) -> f64;
    /// Law (30)'s choice of branch.
    fn taut(&self, length: f64, rate: f64, rest: f64) -> bool {
        let _ = (length, rate, rest);
        true
    }
}

/// κ and η; the two flags leave out what a set does not have.
#[derive(Clone, Debug)]
pub(crate) struct LinearLaw<const SLACKING: bool, const DAMPED: bool> {
    pub(crate) stiffness: f64,
    pub(crate) damping: f64,
}

impl<const SLACKING: bool, const DAMPED: bool> LinearLaw<SLACKING, DAMPED> {
    fn taut_tension(&self, length: f64, rate: f64, rest: f64) -> f64 {
        let elastic = self.stiffness * (length - rest);
        if DAMPED { elastic + self.damping * rate } else { elastic }
    }
}

impl<const SLACKING: bool, const DAMPED: bool> Law for LinearLaw<SLACKING, DAMPED> {
    fn damped(laws: &[Self]) -> bool {
        DAMPED && !laws.is_empty()
    }

    fn tension(&self, length: f64, rate: f64, rest: f64, taut: Option<bool>) -> Tension {
        if SLACKING && !taut.unwrap_or_else(|| self.taut(length, rate, rest)) {
            return Tension::default();
        }
        Tension {
            force: self.taut_tension(length, rate, rest),
            by_length: self.stiffness,
            by_rate: if DAMPED { self.damping } else { 0.0 },
        }
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        let stretch = length - rest;
        if SLACKING && stretch < 0.0 { 0.0 } else { 0.5 * self.stiffness * stretch * stretch }
    }

    fn taut(&self, length: f64, rate: f64, rest: f64) -> bool {
        // What is no number counts as taut, so that the force shows it.
        let slack = length < rest || (DAMPED && self.taut_tension(length, rate, rest) < 0.0);
        !slack
    }
}

/// A user's law behind the same interface.
#[derive(Clone)]
pub(crate) struct UserLaw(pub(crate) Arc<dyn TensionLaw>);

impl std::fmt::Debug for UserLaw {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("UserLaw")
    }
}

impl Law for UserLaw {
    fn damped(laws: &[Self]) -> bool {
        laws.iter().any(|law| law.0.damped())
    }

    fn tension(&self, length: f64, rate: f64, rest: f64, _taut: Option<bool>) -> Tension {
        self.0.tension(length, rate, rest)
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        self.0.energy(length, rest)
    }
}
