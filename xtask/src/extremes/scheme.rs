//! The time stepping schemes that axes are followed with.

use tg_integrate::{
    Composition, CompositionScheme, EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, Run, RungeKutta,
    StartError, State, StepReport, Stepper, Symplectic, Tolerances, Turning,
};
use tg_model::{Mechanics, Model};

use crate::TaskError;

/// An error beyond which a motion of size 1 is not followed at all.
const LOST: f64 = 0.05;

/// A scheme with its settings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scheme {
    Symplectic,
    GeneralizedAlpha,
    Leapfrog,
    Composition(CompositionScheme),
    Fixed(EmbeddedPair),
    /// Under error control, with this relative tolerance.
    Controlled(EmbeddedPair, f64),
}

impl Scheme {
    /// Every scheme with fixed steps, and both pairs under error control.
    pub(super) const ALL: [Self; 9] = [
        Self::Symplectic,
        Self::GeneralizedAlpha,
        Self::Leapfrog,
        Self::Composition(CompositionScheme::Suzuki4),
        Self::Composition(CompositionScheme::KahanLi6),
        Self::Fixed(EmbeddedPair::DormandPrince5),
        Self::Fixed(EmbeddedPair::DormandPrince8),
        Self::Controlled(EmbeddedPair::DormandPrince5, 1e-8),
        Self::Controlled(EmbeddedPair::DormandPrince8, 1e-10),
    ];

    /// Its name on the page.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Symplectic => "symplectic",
            Self::GeneralizedAlpha => "generalised-α",
            Self::Leapfrog => "leapfrog",
            Self::Composition(CompositionScheme::Suzuki4) => "composition 4",
            Self::Composition(CompositionScheme::KahanLi6) => "composition 6",
            Self::Fixed(EmbeddedPair::DormandPrince5) => "Runge–Kutta 5, fixed",
            Self::Fixed(EmbeddedPair::DormandPrince8) => "Runge–Kutta 8, fixed",
            Self::Controlled(EmbeddedPair::DormandPrince5, _) => "Runge–Kutta 5, controlled",
            Self::Controlled(EmbeddedPair::DormandPrince8, _) => "Runge–Kutta 8, controlled",
        }
    }

    /// Order of the error of a fixed step.
    pub(super) fn order(self) -> i32 {
        match self {
            Self::Symplectic | Self::GeneralizedAlpha | Self::Leapfrog => 2,
            Self::Composition(CompositionScheme::Suzuki4) => 4,
            Self::Composition(CompositionScheme::KahanLi6) => 6,
            Self::Fixed(EmbeddedPair::DormandPrince5) | Self::Controlled(EmbeddedPair::DormandPrince5, _) => {
                5
            }
            Self::Fixed(EmbeddedPair::DormandPrince8) | Self::Controlled(EmbeddedPair::DormandPrince8, _) => {
                8
            }
        }
    }

    /// Error that a motion of circular frequency `omega` may have after `end` seconds in steps of `h`, per size: the order's
    /// (hω)^p ωt, but at most [`LOST`], and rounding of 4ε a step; under error control ten times the tolerance and, since an
    /// error of the energy changes the frequency, a tenth of it times (ωt)².
    pub(super) fn bound(self, omega: f64, (h, end): (f64, f64)) -> f64 {
        let rounding = 4.0 * f64::EPSILON * (1.0 + end / h);
        rounding
            + match self {
                Self::Controlled(_, tolerance) => {
                    let angle = omega * end;
                    tolerance * (10.0 * (1.0 + angle) + 0.1 * angle * angle)
                }
                _ => ((h * omega).powi(self.order()) * omega * end).min(LOST),
            }
    }

    /// A stepper for a system.
    pub(super) fn stepper<'m>(
        self,
        mechanics: &'m dyn Mechanics,
    ) -> Result<Box<dyn Stepper + 'm>, StartError> {
        let options = NewtonOptions::default();
        Ok(match self {
            Self::Symplectic => Box::new(Symplectic::new(mechanics, options)?),
            Self::GeneralizedAlpha => Box::new(GeneralizedAlpha::new(mechanics, 0.7, options)?),
            Self::Leapfrog => Box::new(Leapfrog::new(mechanics, options)?),
            Self::Composition(scheme) => Box::new(Composition::new(mechanics, scheme, options)?),
            Self::Fixed(pair) => Box::new(RungeKutta::fixed(mechanics, pair)?),
            Self::Controlled(pair, tolerance) => {
                Box::new(RungeKutta::new(mechanics, pair, Tolerances::relative(tolerance))?)
            }
        })
    }

    /// A run from the initial configuration with full velocities `v`: the largest of what `off` says of every state, and how the
    /// acceleration turned in fixed steps.
    pub(super) fn follow<const D: usize>(
        self,
        model: &Model<D>,
        v: &[f64],
        (step, end): (f64, f64),
        mut off: impl FnMut(&State) -> f64,
    ) -> Result<(f64, Turning), TaskError> {
        let mut stepper = self.stepper(model)?;
        let mut state = stepper.start(0.0, &model.initial_coordinates(), v)?;
        let mut worst = 0.0;
        let mut watch = |state: &State, _: &StepReport| worst = worse(off(state), worst);
        let mut turning = Turning::default();
        let run = Run::new(step, end).observe(&mut watch).observe(&mut turning);
        run.go(stepper.as_mut(), &mut state)?;
        let controlled = matches!(self, Self::Controlled(..));
        Ok((worst, if controlled { Turning::default() } else { turning }))
    }
}

/// The larger of two errors; NaN stays, from either.
pub(super) fn worse(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
