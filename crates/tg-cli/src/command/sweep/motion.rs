//! The motion against a parameter of the scene: extreme tensions, slackness, displacements and energies of its runs, which are
//! made side by side.

mod extremes;
mod outcome;

use serde_json::json;
use tg_report::{Channel, Kind};
use tg_scene::Structure;

use super::{Dimensioned, side_by_side, values};
use crate::answer::{Answer, Failure};
use crate::args::Sweep;
use crate::loading::{Loaded, remarks};
use crate::picture::Painter;
use crate::progress::{bar, watch_for_interrupts};
use crate::results::{manifest, told, write};
use outcome::{Outcome, Seen};

pub(super) fn answer<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    arguments: &Sweep,
) -> Result<Answer, Failure>
where
    Structure<D>: Dimensioned,
{
    if loaded.file.scene.run.is_none() {
        return Err(Failure::Usage("the scene has no [run] section; say there what is simulated".into()));
    }
    watch_for_interrupts()?;
    let values = values(arguments);
    let progress = bar(values.len() as u64, "{wide_bar} {pos} of {len} values");
    let outcomes = side_by_side(&values, |value| {
        let outcome = Outcome::at::<D>(loaded, arguments, value);
        progress.inc(1);
        outcome
    });
    progress.finish_and_clear();
    let name = &arguments.parameter;
    let document = json!({ "scene": loaded.file.name, "parameter": name, "samples": outcomes });
    let settings = json!({ "command": "sweep", "what": "motion", "parameter": name });
    let mut manifest = manifest(Kind::Sweep, loaded, Painter::new(structure)?.outline(), settings);
    manifest.channels = channels(name);
    let folder = write(&arguments.output, manifest, &document, |writer| {
        Ok(outcomes.iter().try_for_each(|outcome| writer.row(&outcome.row()))?)
    })?;
    let text = format!("{}\n{}{}", loaded.title(), table(name, &outcomes), told(folder.as_ref()));
    let doubts = outcomes.iter().flat_map(|outcome| {
        outcome.doubts.iter().map(move |doubt| format!("at {name} = {}: {doubt}", outcome.value))
    });
    let mut answer = Answer::new(document, text).warn(remarks(structure)).warn(doubts.collect());
    let failed = outcomes.iter().filter(|outcome| outcome.failure.is_some()).count();
    if failed > 0 {
        answer.failed = Some(format!("{failed} of {} runs failed", outcomes.len()));
    }
    Ok(answer)
}

fn channels(parameter: &str) -> Vec<Channel> {
    vec![
        Channel::new(parameter, "", "parameter"),
        Channel::new("largest tension", "N", "tension"),
        Channel::new("smallest tension", "N", "tension"),
        Channel::new("share of time with a slack cable", "", "share of time"),
        Channel::new("largest displacement", "m", "displacement"),
        Channel::new("energy at the end", "J", "energy"),
    ]
}

/// The table for people.
fn table(parameter: &str, outcomes: &[Outcome]) -> String {
    let mut text = format!(
        "{parameter:>14}  {:>13}  {:>12}  {:>10}  {:>16}  {:>14}  cable with the largest tension\n",
        "T largest [N]", "smallest [N]", "slack time", "displacement [m]", "energy end [J]"
    );
    for outcome in outcomes {
        text += &match (&outcome.failure, &outcome.seen) {
            (None, Some(Seen { largest_tension, .. })) => {
                let [value, largest, smallest, slack, displacement, energy] = outcome.row();
                let cable = largest_tension.as_ref().map_or("none", |extreme| &extreme.of);
                format!(
                    "{value:14.9}  {largest:13.6}  {smallest:12.6}  {:8.3} %  {displacement:16.9}  {energy:14.6}  {cable}\n",
                    100.0 * slack
                )
            }
            (failure, _) => {
                format!("{:14.9}  failed: {}\n", outcome.value, failure.as_deref().unwrap_or_default())
            }
        };
    }
    text
}
