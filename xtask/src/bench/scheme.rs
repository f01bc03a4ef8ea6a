//! The schemes that are measured: one entry each.

use tg_integrate::{
    EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, RungeKutta, StartError, State, StepError,
    Stepper, Symplectic, Tolerances,
};
use tg_model::Mechanics;

use super::scene::Scene;
use crate::TaskError;

/// Time between two samples of a trajectory \[s\]; a scheme makes whole steps within it.
pub(crate) const SAMPLE: f64 = 0.01;

/// How exact a scheme is asked to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Dial {
    /// Steps within a sample.
    Steps(u32),
    /// Tolerance of a scheme that chooses its own steps.
    Tolerance(f64),
}

impl Dial {
    /// The paper's step of 1 ms.
    pub(crate) const PAPER: Self = Self::Steps(10);

    /// Calls of `step` within a sample; a scheme that chooses its steps is called once.
    pub(crate) fn calls(self) -> u32 {
        match self {
            Self::Steps(steps) => steps,
            Self::Tolerance(_) => 1,
        }
    }

    /// What is passed to `step` \[s\].
    pub(crate) fn step(self) -> f64 {
        SAMPLE / f64::from(self.calls())
    }

    /// Goes on by a sample; Newton iterations or evaluations made.
    pub(crate) fn advance(self, stepper: &mut dyn Stepper, state: &mut State) -> Result<u64, StepError> {
        (0..self.calls())
            .try_fold(0, |sum, _| Ok(sum + u64::from(stepper.step(state, self.step())?.iterations)))
    }
}

/// Dials from coarse to fine.
const STEPS: &[Dial] = &[
    Dial::Steps(1),
    Dial::Steps(2),
    Dial::Steps(5),
    Dial::Steps(10),
    Dial::Steps(20),
    Dial::Steps(40),
    Dial::Steps(80),
];

/// Tolerances from coarse to fine.
const TOLERANCES: &[Dial] = &[
    Dial::Tolerance(1e-2),
    Dial::Tolerance(1e-3),
    Dial::Tolerance(1e-4),
    Dial::Tolerance(1e-5),
    Dial::Tolerance(1e-6),
    Dial::Tolerance(1e-8),
];

/// What a step counts, and what is compared with the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Counts {
    /// Newton iterations; steps are compared.
    Iterations,
    /// Evaluations of the accelerations, which are compared one by one: schemes differ in how many make a step.
    Evaluations,
}

impl Counts {
    /// The count of a step, as a row of a table.
    pub(crate) fn label(self) -> &'static str {
        match self {
            Self::Iterations => "· Newton iterations",
            Self::Evaluations => "· evaluations",
        }
    }
}

/// A scheme with its settings.
pub(crate) struct Scheme {
    pub(crate) name: &'static str,
    /// What its curve of error against time is drawn through.
    pub(crate) dials: &'static [Dial],
    /// Variant of the floor program that does the same.
    pub(crate) floor: Option<&'static str>,
    /// What a step counts.
    pub(crate) counts: Counts,
    pub(crate) make: Make,
}

type Make = for<'m> fn(&'m dyn Mechanics, Dial) -> Result<Box<dyn Stepper + 'm>, StartError>;

/// All schemes.
pub(crate) const SCHEMES: [Scheme; 6] = [
    Scheme {
        name: "symplectic",
        dials: STEPS,
        floor: Some("imp 10 kept, 1e-12"),
        counts: Counts::Iterations,
        make: |mechanics, _| Ok(Box::new(Symplectic::new(mechanics, NewtonOptions::default())?)),
    },
    Scheme {
        name: "symplectic, 1e-10",
        dials: STEPS,
        floor: Some("imp 10 kept, 1e-10"),
        counts: Counts::Iterations,
        make: |mechanics, _| {
            let options = NewtonOptions { tolerance: 1e-10, ..NewtonOptions::default() };
            Ok(Box::new(Symplectic::new(mechanics, options)?))
        },
    },
    Scheme {
        name: "generalised-α, 0.7",
        dials: STEPS,
        floor: None,
        counts: Counts::Iterations,
        make: |mechanics, _| Ok(Box::new(GeneralizedAlpha::new(mechanics, 0.7, NewtonOptions::default())?)),
    },
    Scheme {
        name: "leapfrog",
        dials: STEPS,
        floor: Some("shake, 2 iterations"),
        counts: Counts::Iterations,
        make: |mechanics, _| Ok(Box::new(Leapfrog::new(mechanics, NewtonOptions::default())?)),
    },
    Scheme {
        name: "Dormand–Prince 5",
        dials: TOLERANCES,
        floor: Some("exp, RK4"),
        counts: Counts::Evaluations,
        make: |mechanics, dial| explicit(mechanics, dial, EmbeddedPair::DormandPrince5),
    },
    Scheme {
        name: "Dormand–Prince 8",
        dials: TOLERANCES,
        floor: Some("exp, RK4"),
        counts: Counts::Evaluations,
        make: |mechanics, dial| explicit(mechanics, dial, EmbeddedPair::DormandPrince8),
    },
];

/// With fixed steps or under error control.
fn explicit<'m>(
    mechanics: &'m dyn Mechanics,
    dial: Dial,
    pair: EmbeddedPair,
) -> Result<Box<dyn Stepper + 'm>, StartError> {
    Ok(Box::new(match dial {
        Dial::Steps(_) => RungeKutta::fixed(mechanics, pair)?,
        Dial::Tolerance(tolerance) => RungeKutta::new(mechanics, pair, Tolerances::relative(tolerance))?,
    }))
}

impl Scheme {
    /// A stepper and its first state.
    pub(crate) fn start<'m>(
        &self,
        scene: &'m Scene,
        dial: Dial,
    ) -> Result<(Box<dyn Stepper + 'm>, State), TaskError> {
        let mut stepper = (self.make)(scene.mechanics.as_ref(), dial)?;
        let state = stepper.start(0.0, &scene.q, &scene.v)?;
        Ok((stepper, state))
    }
}
