//! `tg sweep`: frequencies, equilibria or the motion against a parameter.

mod equilibria;
mod motion;

use rayon::prelude::*;
use serde_json::json;
use tg_modal::{SweepOptions, sweep as follow};
use tg_model::Model;
use tg_report::{Channel, Kind};
use tg_scene::{Built, Structure};
use tg_statics::Configuration;

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::{Sweep, SweepWhat};
use crate::loading::{Loaded, remarks};
use crate::picture::Painter;
use crate::progress::bar;
use crate::results::{manifest, told, write};

pub(crate) fn sweep(arguments: &Sweep) -> Result<Answer, Failure> {
    let mut loaded = Loaded::read(&arguments.scene.scene, &arguments.scene.set)?;
    let is_parameter =
        loaded.file.parameters(&loaded.set)?.iter().any(|(name, _)| *name == arguments.parameter);
    if is_parameter {
        loaded.set.retain(|(name, _)| *name != arguments.parameter);
    }
    match arguments.what {
        SweepWhat::Modes | SweepWhat::Motion if !is_parameter => Err(Failure::Usage(format!(
            "the scene has no parameter `{}`; give what changes a name under [parameters]",
            arguments.parameter
        ))),
        SweepWhat::Modes => with_structure!(&loaded.built, structure => modes(&loaded, structure, arguments)),
        SweepWhat::Motion => {
            with_structure!(&loaded.built, structure => motion::answer(&loaded, structure, arguments))
        }
        SweepWhat::Equilibria => {
            with_structure!(&loaded.built, structure => {
                equilibria::answer(&loaded, structure, arguments, is_parameter)
            })
        }
    }
}

/// The values of the parameter.
fn values(arguments: &Sweep) -> Vec<f64> {
    let last = (arguments.samples - 1) as f64;
    (0..arguments.samples)
        .map(|k| arguments.from + (arguments.to - arguments.from) * k as f64 / last)
        .collect()
}

/// What is found at each value, in their order. One value at a time for each thread: some take much longer than others.
fn side_by_side<T: Send>(values: &[f64], find: impl Fn(f64) -> T + Sync) -> Vec<T> {
    values.par_iter().with_max_len(1).map(|&value| find(value)).collect()
}

/// The structure of a scene in the dimension of another of its structures.
trait Dimensioned: Sized {
    fn take(built: Built) -> Option<Self>;
}

impl Dimensioned for Structure<2> {
    fn take(built: Built) -> Option<Self> {
        if let Built::Plane(structure) = built { Some(*structure) } else { None }
    }
}

impl Dimensioned for Structure<3> {
    fn take(built: Built) -> Option<Self> {
        if let Built::Space(structure) = built { Some(*structure) } else { None }
    }
}

/// All parameters that are set, the swept one to this value.
fn parameters(loaded: &Loaded, arguments: &Sweep, value: f64) -> Vec<(String, f64)> {
    let mut set = loaded.set.clone();
    set.push((arguments.parameter.clone(), value));
    set
}

/// The structure at a value of the parameter.
fn at<const D: usize>(loaded: &Loaded, arguments: &Sweep, value: f64) -> Result<Structure<D>, Failure>
where
    Structure<D>: Dimensioned,
{
    let built = loaded.file.build(&parameters(loaded, arguments, value))?;
    Dimensioned::take(built).ok_or_else(|| Failure::Usage("the scene changes its dimension".into()))
}

fn modes<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    arguments: &Sweep,
) -> Result<Answer, Failure>
where
    Structure<D>: Dimensioned,
{
    let values = values(arguments);
    let progress = bar(values.len() as u64, "{wide_bar} {pos} of {len} values");
    // Equilibria do not depend on each other, and those that have to be found take as long as the modes; modes are matched
    // with those before.
    let mut ready = side_by_side(&values, |value| Some(balanced::<D>(loaded, arguments, value)));
    let mut broken = None;
    let found = follow(&values, &SweepOptions::new(arguments.count), |value| {
        progress.inc(1);
        let taken = values.iter().zip(&mut ready).find(|(at, found)| **at == value && found.is_some());
        let found = taken.and_then(|(_, found)| found.take());
        found.unwrap_or_else(|| balanced::<D>(loaded, arguments, value)).map_err(|failure| {
            broken = Some(failure);
            std::io::Error::other("no structure or no equilibrium")
        })
    });
    progress.finish_and_clear();
    if let Some(failure) = broken {
        return Err(failure);
    }
    let found = found.map_err(Failure::analysis)?;
    let frequency = |omega_squared: f64| {
        if omega_squared >= 0.0 { omega_squared.sqrt() / std::f64::consts::TAU } else { f64::NAN }
    };
    let name = &arguments.parameter;
    let mut text = format!("{}\n{:>14}  frequencies [Hz]\n", loaded.title(), name);
    let mut channels = vec![Channel::new(name.clone(), "", "parameter")];
    channels.extend(
        (1..=found.tracks.len()).map(|k| Channel::new(format!("mode {k}.frequency"), "Hz", "frequency")),
    );
    let row = |k: usize| {
        let mut row = vec![found.parameters[k]];
        row.extend(found.tracks.iter().map(|track| frequency(track.omega_squared[k])));
        row
    };
    let rows: Vec<Vec<f64>> = (0..found.parameters.len()).map(row).collect();
    for (row, _) in rows.iter().zip(&found.requested).filter(|(_, requested)| **requested) {
        let frequencies: Vec<String> = row[1..].iter().map(|f| format!("{f:12.6}")).collect();
        text += &format!("{:14.9}  {}\n", row[0], frequencies.join("  "));
    }
    let document = json!({
        "scene": loaded.file.name,
        "parameter": name,
        "values": found.parameters,
        "requested": found.requested,
        "omega_squared": found.tracks.iter().map(|track| &track.omega_squared).collect::<Vec<_>>(),
        "ambiguous": found.ambiguous,
    });
    let settings =
        json!({ "command": "sweep", "what": "modes", "parameter": name, "count": arguments.count });
    let mut manifest = manifest(Kind::Sweep, loaded, Painter::new(structure)?.outline(), settings);
    manifest.channels = channels;
    let folder = write(&arguments.output, manifest, &document, |writer| {
        Ok(rows.iter().try_for_each(|row| writer.row(row))?)
    })?;
    text += &told(folder.as_ref());
    let mut answer = Answer::new(document, text).warn(remarks(structure));
    if !found.ambiguous.is_empty() {
        answer.warnings.push("modes could not be told apart at some values; take more samples there".into());
    }
    Ok(answer)
}

/// Model and equilibrium at a value of the parameter.
fn balanced<const D: usize>(
    loaded: &Loaded,
    arguments: &Sweep,
    value: f64,
) -> Result<(Box<Model<D>>, Configuration), Failure>
where
    Structure<D>: Dimensioned,
{
    let structure: Structure<D> = at(loaded, arguments, value)?;
    let (at, _) = super::modes::equilibrium(&structure)?;
    Ok((Box::new(structure.model), at))
}
