//! What the motion at one value of the parameter comes to.

use serde::Serialize;
use tg_integrate::{Run as Integration, Turning};
use tg_scene::{RunSettings, Structure};
use tg_trade::Method;

use super::super::{Dimensioned, at, parameters};
use super::extremes::{Extreme, Extremes};
use crate::answer::Failure;
use crate::args::Sweep;
use crate::command::run::{doubts, ended, method};
use crate::loading::Loaded;
use crate::progress::INTERRUPTED;

/// A row of the sweep. Of a motion that failed it holds what was seen until then.
#[derive(Debug, Serialize)]
pub(super) struct Outcome {
    pub(super) value: f64,
    /// Why the motion does not reach its end.
    pub(super) failure: Option<String>,
    #[serde(flatten)]
    pub(super) seen: Option<Seen>,
    #[serde(skip)]
    pub(super) doubts: Vec<String>,
}

/// What was seen of a motion; nothing if it did not begin.
#[derive(Debug, Serialize)]
pub(super) struct Seen {
    /// Time reached \[s\].
    pub(super) end: f64,
    steps: u64,
    method: Method,
    /// \[N\]
    pub(super) largest_tension: Option<Extreme>,
    /// \[N\]
    pub(super) smallest_tension: Option<Extreme>,
    /// Part of the time with a slack cable.
    pub(super) slack_share: Option<f64>,
    /// Of a vertex from where it started \[m\].
    pub(super) largest_displacement: Option<Extreme>,
    /// Total energy at the end \[J\].
    pub(super) energy_at_end: f64,
}

impl Outcome {
    /// Simulates the scene's run section at a value of the parameter.
    pub(super) fn at<const D: usize>(loaded: &Loaded, arguments: &Sweep, value: f64) -> Self
    where
        Structure<D>: Dimensioned,
    {
        let simulated = || {
            let (structure, settings): (Structure<D>, _) = scene_at(loaded, arguments, value)?;
            simulate(&structure, &settings)
        };
        match simulated() {
            Ok((seen, failure, doubts)) => Self { value, failure, seen: Some(seen), doubts },
            Err(failure) => {
                Self { value, failure: Some(failure.to_string()), seen: None, doubts: Vec::new() }
            }
        }
    }

    /// The row of the table: parameter, tensions, slackness, displacement, energy; gaps for a motion that failed.
    pub(super) fn row(&self) -> [f64; 6] {
        let number = |of: &dyn Fn(&Seen) -> Option<f64>| {
            let complete = self.seen.as_ref().filter(|_| self.failure.is_none());
            complete.and_then(of).unwrap_or(f64::NAN)
        };
        let size = |extreme: &Option<Extreme>| extreme.as_ref().map(|extreme| extreme.value);
        [
            self.value,
            number(&|seen| size(&seen.largest_tension)),
            number(&|seen| size(&seen.smallest_tension)),
            number(&|seen| seen.slack_share),
            number(&|seen| size(&seen.largest_displacement)),
            number(&|seen| Some(seen.energy_at_end)),
        ]
    }
}

fn scene_at<const D: usize>(
    loaded: &Loaded,
    arguments: &Sweep,
    value: f64,
) -> Result<(Structure<D>, RunSettings), Failure>
where
    Structure<D>: Dimensioned,
{
    let settings = loaded.file.run(&parameters(loaded, arguments, value))?;
    let settings = settings.ok_or_else(|| Failure::Usage("the scene has no [run] section".into()))?;
    Ok((at(loaded, arguments, value)?, settings))
}

/// What was seen, why the motion ended early, and what is doubtful.
fn simulate<const D: usize>(
    structure: &Structure<D>,
    settings: &RunSettings,
) -> Result<(Seen, Option<String>, Vec<String>), Failure> {
    let model = &structure.model;
    let (method, _) = method(structure, settings)?;
    let mut stepper = method.stepper(model).map_err(Failure::analysis)?;
    let start = stepper.start(0.0, &model.initial_coordinates(), &structure.velocities);
    let mut state = start.map_err(Failure::analysis)?;
    let mut extremes = Extremes::new(structure).map_err(Failure::analysis)?;
    let mut turning = Turning::default();
    let outcome = Integration::new(method.step, settings.duration)
        .observe(&mut extremes)
        .observe(&mut turning)
        .cancel_on(&INTERRUPTED)
        .go(stepper.as_mut(), &mut state);
    let (summary, failure) = ended(outcome);
    let seen = Seen {
        end: state.t,
        steps: summary.steps,
        method,
        largest_tension: extremes.largest_tension(),
        smallest_tension: extremes.smallest_tension(),
        slack_share: extremes.slack_share(),
        largest_displacement: extremes.largest_displacement(),
        energy_at_end: model.energy(&state.q, &state.v, &model.inputs_at(state.t)).total(),
    };
    Ok((seen, failure, doubts(&summary, &turning, &method)))
}
