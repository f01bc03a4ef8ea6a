//! How a run is stepped: as the scene says, or as trial runs choose.

use serde::{Deserialize, Serialize};
use serde_json::Value;
use tg_integrate::{
    Composition, CompositionScheme, EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, RungeKutta,
    StartError, Stepper, Symplectic, Tolerances,
};
use tg_model::Mechanics;
use tg_scene::{RunSettings, Scheme, Structure};

use super::{accuracy, tolerance};
use crate::answer::Failure;

/// A time stepping scheme with its numbers. Checkpoints keep it, so that a run goes on as it began.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
pub(crate) struct Method {
    pub(crate) scheme: Scheme,
    /// Step \[s\]; under error control the longest one.
    pub(crate) step: f64,
    /// Error control of a Runge–Kutta scheme.
    pub(crate) tolerance: Option<f64>,
    pub(crate) spectral_radius: f64,
}

impl Method {
    /// The method of a run, and what it was chosen by.
    pub(crate) fn of<const D: usize>(
        structure: &Structure<D>,
        settings: &RunSettings,
    ) -> Result<(Self, Value), Failure> {
        let &RunSettings { scheme, step, accuracy, tolerance, spectral_radius, .. } = settings;
        let method = Self { scheme, step: settings.longest_step(), tolerance, spectral_radius };
        match (accuracy, step) {
            (Some(accuracy), _) if scheme.controls_error() => {
                tolerance::choose(structure, settings.duration, accuracy, method)
            }
            (Some(accuracy), _) => accuracy::choose(structure, settings.duration, accuracy, method),
            (None, _) if tolerance.is_some() => Ok((method, Value::Null)),
            (None, Some(step)) => Ok((Self { step, ..method }, Value::Null)),
            (None, None) => Err(Failure::Usage("the run has no step; give --step or --accuracy".into())),
        }
    }

    /// A stepper for a system.
    pub(crate) fn stepper<'m>(
        &self,
        mechanics: &'m dyn Mechanics,
    ) -> Result<Box<dyn Stepper + 'm>, StartError> {
        let options = NewtonOptions::default();
        let composition = |scheme| Composition::new(mechanics, scheme, options);
        let runge_kutta = |pair| match self.tolerance {
            Some(tolerance) => RungeKutta::new(mechanics, pair, Tolerances::relative(tolerance)),
            None => RungeKutta::fixed(mechanics, pair),
        };
        Ok(match self.scheme {
            Scheme::Symplectic => Box::new(Symplectic::new(mechanics, options)?),
            Scheme::GeneralizedAlpha => {
                Box::new(GeneralizedAlpha::new(mechanics, self.spectral_radius, options)?)
            }
            Scheme::Leapfrog => Box::new(Leapfrog::new(mechanics, options)?),
            Scheme::Composition4 => Box::new(composition(CompositionScheme::Suzuki4)?),
            Scheme::Composition6 => Box::new(composition(CompositionScheme::KahanLi6)?),
            Scheme::RungeKutta5 => Box::new(runge_kutta(EmbeddedPair::DormandPrince5)?),
            Scheme::RungeKutta8 => Box::new(runge_kutta(EmbeddedPair::DormandPrince8)?),
        })
    }

    /// In words, for people.
    pub(crate) fn words(&self) -> String {
        match self.tolerance {
            None => format!("{} s", self.step),
            Some(tolerance) => format!("at most {} s, tolerance {tolerance:e},", self.step),
        }
    }
}
