//! `tg modes`: frequencies and mode shapes.

use serde_json::{Value, json};
use tg_modal::{DampedKind, ModeKind, ModeOptions, damped, modes as find_modes};
use tg_report::{Kind, ModeSet};
use tg_scene::Structure;
use tg_statics::{Configuration, Forward, ForwardOptions};

use super::statics::BALANCED;
use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::Modes;
use crate::loading::{Loaded, remarks};
use crate::picture::Painter;
use crate::results::{manifest, told, write};

pub(crate) fn modes(arguments: &Modes) -> Result<Answer, Failure> {
    let loaded = Loaded::new(&arguments.scene)?;
    with_structure!(&loaded.built, structure => answer(&loaded, structure, arguments))
}

/// The shape as built where it is an equilibrium, else the one that is found from it; and whether it was found.
pub(crate) fn equilibrium<const D: usize>(
    structure: &Structure<D>,
) -> Result<(Configuration, bool), Failure> {
    let model = &structure.model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let built = Configuration::at(model, &q, &u).map_err(Failure::analysis)?;
    if built.imbalance().0 <= BALANCED {
        return Ok((built, false));
    }
    let found = Forward::new(model, ForwardOptions::default()).solve(&q, &u).map_err(Failure::analysis)?;
    Ok((found.configuration, true))
}

fn answer<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    arguments: &Modes,
) -> Result<Answer, Failure> {
    let (model, (at, found)) = (&structure.model, equilibrium(structure)?);
    let options = if arguments.all { ModeOptions::all() } else { ModeOptions::new(arguments.count) };
    let modes = find_modes(model, &at, &options).map_err(Failure::analysis)?;
    let painter = Painter::new(structure)?;
    let mut text = format!("{}\n", loaded.title());
    if found {
        text += "about the equilibrium found from the shape as built\n";
    }
    text += &format!("{} degrees of freedom\n  mode  frequency [Hz]\n", modes.degrees_of_freedom());
    let (mut list, mut shapes) = (Vec::new(), Vec::new());
    for (k, mode) in (1..).zip(&modes.list) {
        let (kind, frequency, line) = match mode.kind {
            ModeKind::Vibration { frequency } => ("vibration", Some(frequency), format!("{frequency:.9}")),
            ModeKind::Zero => ("zero", None, "0: moves without stiffness".into()),
            ModeKind::Unstable { rate } => ("unstable", None, format!("unstable: grows with {rate:.6}/s")),
        };
        text += &format!("  {k:4}  {line}\n");
        list.push(json!({
            "mode": k,
            "kind": kind,
            "frequency": frequency,
            "omega_squared": mode.omega_squared,
            "accuracy": mode.accuracy,
        }));
        shapes.push(painter.mode(&format!("mode {k}"), frequency, None, &mode.shape));
    }
    let mut document = json!({
        "scene": loaded.file.name,
        "equilibrium": if found { "found" } else { "as built" },
        "degrees_of_freedom": modes.degrees_of_freedom(),
        "negative": modes.counts.negative,
        "zero": modes.counts.zero,
        "modes": list,
    });
    if arguments.damped {
        document["damped_modes"] = damped_modes(structure, &at, &modes, &mut text)?;
    }
    let settings =
        json!({ "command": "modes", "count": if arguments.all { None } else { Some(arguments.count) } });
    let manifest = manifest(Kind::Modes, loaded, painter.outline(), settings);
    let folder = write(&arguments.output, manifest, &document, |writer| {
        let reference = painter.frame(0.0, &at.q, &at.u)?;
        Ok(writer.document("modes", &ModeSet { reference, list: shapes })?)
    })?;
    text += &told(folder.as_ref());
    Ok(Answer::new(document, text).warn(remarks(structure)))
}

fn damped_modes<const D: usize>(
    structure: &Structure<D>,
    at: &Configuration,
    undamped: &tg_modal::Modes,
    text: &mut String,
) -> Result<Value, Failure> {
    let modes = damped(&structure.model, at, undamped).map_err(Failure::analysis)?;
    *text += "  damped mode  frequency [Hz]  damping ratio\n";
    let mut list = Vec::new();
    for (k, mode) in (1..).zip(&modes) {
        let kind = match mode.kind {
            DampedKind::Oscillating => "oscillating",
            DampedKind::Overdamped => "overdamped",
            DampedKind::Zero => "zero",
            DampedKind::Unstable => "unstable",
        };
        *text += &format!("  {k:11}  {:14.9}  {:13.6}  {kind}\n", mode.damped_frequency, mode.damping_ratio);
        list.push(json!({
            "mode": k,
            "kind": kind,
            "eigenvalue": [mode.eigenvalue.re, mode.eigenvalue.im],
            "frequency": mode.frequency,
            "damped_frequency": mode.damped_frequency,
            "damping_ratio": mode.damping_ratio,
        }));
    }
    Ok(Value::Array(list))
}
