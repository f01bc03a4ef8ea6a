//! A time stepping scheme with its numbers.

use serde::{Deserialize, Serialize};
use tg_integrate::{
    Composition, CompositionScheme, EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, RungeKutta,
    StartError, Stepper, Symplectic, Tolerances,
};
use tg_model::Mechanics;
use tg_scene::{RunSettings, Scheme};

/// A time stepping scheme with its numbers. A checkpoint keeps it, so that a run goes on as it began.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize, Serialize)]
pub struct Method {
    /// The scheme.
    pub scheme: Scheme,
    /// Step \[s\]; under error control the longest one.
    pub step: f64,
    /// Error control of a Runge–Kutta scheme, relative.
    pub tolerance: Option<f64>,
    /// Spectral radius of generalised-α at infinity.
    pub spectral_radius: f64,
}

impl Method {
    /// A scheme with a fixed step \[s\].
    pub fn fixed(scheme: Scheme, step: f64) -> Self {
        Self::of(&RunSettings { scheme, step: Some(step), ..RunSettings::new(step) })
    }

    /// What settings say; where they leave the step open, the longest one that they allow.
    pub fn of(settings: &RunSettings) -> Self {
        let &RunSettings { scheme, tolerance, spectral_radius, .. } = settings;
        Self { scheme, step: settings.longest_step(), tolerance, spectral_radius }
    }

    /// A stepper for a system.
    ///
    /// # Errors
    /// See the steppers.
    pub fn stepper<'m>(&self, mechanics: &'m dyn Mechanics) -> Result<Box<dyn Stepper + 'm>, StartError> {
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
}
