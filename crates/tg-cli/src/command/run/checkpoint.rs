//! What `--resume` goes on with.

use std::path::Path;

use serde::{Deserialize, Serialize};
use serde_json::Value;
use tg_integrate::{Ended, State, Summary};
use tg_model::Sizes;
use tg_report::{Results, Table};
use tg_scene::Structure;

use crate::answer::Failure;
use crate::args::Run;
use crate::loading::Loaded;
use crate::results::{hash, set};
use tg_trade::Method;

/// A moment of a run.
#[derive(Deserialize, Serialize)]
pub(super) struct Checkpoint {
    /// How the run is stepped.
    pub(super) method: Method,
    /// Where it is.
    pub(super) state: State,
    /// What it has counted.
    #[serde(with = "Totals")]
    pub(super) totals: Summary,
}

/// A summary in a file.
#[derive(Deserialize, Serialize)]
#[serde(remote = "Summary")]
struct Totals {
    #[serde(skip)]
    ended: Ended,
    steps: u64,
    iterations: u64,
    divided: u64,
    frozen: u64,
    forced: u64,
    fallbacks: u64,
    rejected: u64,
    residual: f64,
}

/// What a folder has for a run to go on with.
pub(super) enum Earlier {
    /// No results, or none that were computed: the program was ended as soon as it had begun.
    Nothing {
        /// Whether there is a folder of results to be replaced.
        folder: bool,
    },
    /// A checkpoint.
    At(Box<Checkpoint>),
}

impl Earlier {
    /// Looks into a folder; refuses results of something else, and a checkpoint that does not fit.
    pub(super) fn find<const D: usize>(
        loaded: &Loaded,
        structure: &Structure<D>,
        folder: &Path,
        arguments: &Run,
    ) -> Result<Self, Failure> {
        if !folder.join("run.json").exists() {
            return Ok(Self::Nothing { folder: false });
        }
        let results = Results::open(folder)?;
        let earlier = results.manifest.scene.as_ref().map(|scene| scene.hash.as_str());
        let earlier_set = results.manifest.settings.get("set").unwrap_or(&Value::Null);
        let refuse = |why: String| Err(Failure::Usage(format!("{}: {why}", folder.display())));
        if earlier != Some(hash(loaded).as_str()) || *earlier_set != set(loaded) {
            return refuse(
                "these results are of another scene or other parameters, or it has changed since".into(),
            );
        }
        let Some(checkpoint): Option<Checkpoint> = results.checkpoint()? else {
            // The row of the start comes before the first checkpoint.
            return match results.table().as_ref().map_or(0, Table::rows) {
                0 | 1 => Ok(Self::Nothing { folder: true }),
                rows => refuse(format!(
                    "{rows} rows are there, but no checkpoint to go on from; begin anew with --force"
                )),
            };
        };
        let Method { scheme, tolerance, .. } = checkpoint.method;
        if arguments.scheme.is_some_and(|given| given != scheme) {
            return refuse(format!(
                "this run was begun with the scheme {scheme}; go on with it, or use --force"
            ));
        }
        if arguments.tolerance.is_some() && arguments.tolerance != tolerance {
            return refuse("this run was begun with another tolerance; go on with it, or use --force".into());
        }
        match misfit(&checkpoint, structure.model.mechanics().sizes()) {
            Some(why) => {
                refuse(format!("checkpoint.json does not fit the scene: {why}; begin anew with --force"))
            }
            None => Ok(Self::At(Box::new(checkpoint))),
        }
    }
}

/// Why a checkpoint is none of this structure. The steppers check the length of their memory.
fn misfit(checkpoint: &Checkpoint, sizes: Sizes) -> Option<String> {
    let Checkpoint { method, state, .. } = checkpoint;
    let lengths = [
        ("coordinates", state.q.len(), sizes.coordinates),
        ("velocities", state.v.len(), sizes.coordinates),
        ("multipliers", state.lambda.len(), sizes.constraints),
    ];
    if let Some((what, got, expected)) = lengths.into_iter().find(|(_, got, expected)| got != expected) {
        return Some(format!("it has {got} {what}, the structure {expected}"));
    }
    let numbers = [&state.q, &state.v, &state.lambda, &state.memory];
    if !numbers.into_iter().flatten().chain([&state.t, &state.t_rest]).all(|x| x.is_finite()) {
        return Some("it holds a number that is not finite".into());
    }
    if state.t < 0.0 {
        return Some(format!("its time is {} s", state.t));
    }
    let positive = |x: f64| x.is_finite() && x > 0.0;
    if !positive(method.step) || !method.tolerance.is_none_or(positive) {
        return Some(format!("its step is {} s, its tolerance {:?}", method.step, method.tolerance));
    }
    None
}
