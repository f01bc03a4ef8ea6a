//! All equilibria against a parameter of the scene, sample by sample, or against a cable's rest length, with the curves that
//! they lie on and the folds where they meet.

use serde_json::{Value, json};
use tg_equilibria::{EquilibriaOptions, EquilibriaReport, Family, all_equilibria};
use tg_report::{Axis, Kind, Plot, PlotKind, Series};
use tg_scene::Structure;

use super::{Dimensioned, at, values};
use crate::answer::{Answer, Failure};
use crate::args::Sweep;
use crate::loading::{Loaded, remarks};
use crate::picture::Painter;
use crate::progress::{bar, spinner};
use crate::results::{manifest, told, write};

/// What was found, in any of the two ways.
struct Found {
    samples: Vec<(f64, EquilibriaReport)>,
    folds: Option<Value>,
    series: Vec<Series>,
    remarks: Vec<String>,
}

pub(super) fn answer<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    arguments: &Sweep,
    is_parameter: bool,
) -> Result<Answer, Failure>
where
    Structure<D>: Dimensioned,
{
    let values = values(arguments);
    let found = if is_parameter {
        by_parameter::<D>(loaded, arguments, &values)?
    } else {
        by_rest_length(structure, arguments, &values)?
    };
    let name = &arguments.parameter;
    let mut text = format!("{}\n{:>14}  equilibria  stable\n", loaded.title(), name);
    for (value, report) in &found.samples {
        text += &format!("{value:14.9}  {:10}  {:6}\n", report.physical().count(), report.stable().count());
    }
    if let Some(folds) = &found.folds {
        for fold in folds.as_array().into_iter().flatten() {
            text += &format!("two equilibria meet at {name} = {}\n", fold);
        }
    }
    let samples = found.samples.iter().map(|(value, report)| {
        let energies: Vec<Value> = report
            .physical()
            .map(|e| json!({ "energy": e.energy, "stable": e.stable, "negative_eigenvalues": e.negative }))
            .collect();
        json!({
            "value": value,
            "accounts_for_all": report.accounts_for_all(),
            "certified": report.certified,
            "equilibria": energies,
        })
    });
    let document = json!({
        "scene": loaded.file.name,
        "parameter": name,
        "samples": samples.collect::<Vec<_>>(),
        "folds": found.folds,
    });
    let plot = Plot {
        title: "Energies of the equilibria".into(),
        kind: if found.folds.is_some() { PlotKind::Lines } else { PlotKind::Points },
        x: Axis::new(name.clone(), if is_parameter { "" } else { "m" }),
        y: Axis::new("potential energy", "J"),
        time: false,
        at: values,
        series: found.series,
    };
    let settings = json!({ "command": "sweep", "what": "equilibria", "parameter": name });
    let manifest = manifest(Kind::Sweep, loaded, Painter::new(structure)?.outline(), settings);
    let folder =
        write(&arguments.output, manifest, &document, |writer| Ok(writer.document("plots", &[plot])?))?;
    text += &told(folder.as_ref());
    let mut answer = Answer::new(document, text).warn(remarks(structure)).warn(found.remarks);
    if found.samples.iter().any(|(_, report)| !report.accounts_for_all()) {
        answer.failed =
            Some("not every path is accounted for at some values: equilibria may be missing".into());
    }
    Ok(answer)
}

fn by_parameter<const D: usize>(loaded: &Loaded, arguments: &Sweep, values: &[f64]) -> Result<Found, Failure>
where
    Structure<D>: Dimensioned,
{
    let progress = bar(values.len() as u64, "{wide_bar} {pos} of {len} values");
    let mut samples = Vec::new();
    for &value in values {
        let structure: Structure<D> = at(loaded, arguments, value)?;
        let u = structure.model.inputs_at(0.0);
        let report = all_equilibria(&structure.model, &u, &EquilibriaOptions::default());
        samples.push((value, report.map_err(Failure::analysis)?));
        progress.inc(1);
    }
    progress.finish_and_clear();
    // The k-th lowest stable and the k-th lowest other equilibrium.
    let most = |stable: bool| samples.iter().map(|(_, r)| of(r, stable).len()).max().unwrap_or(0);
    let series = [true, false].into_iter().flat_map(|stable| (0..most(stable)).map(move |k| (stable, k)));
    let series = series.map(|(stable, k)| {
        let values = samples.iter().map(|(_, r)| of(r, stable).get(k).copied().unwrap_or(f64::NAN));
        Series::new(format!("{} {}", if stable { "stable" } else { "unstable" }, k + 1), values.collect())
    });
    let series = series.collect();
    Ok(Found { samples, folds: None, series, remarks: Vec::new() })
}

/// Energies \[J\] of the stable or the other equilibria, ascending.
fn of(report: &EquilibriaReport, stable: bool) -> Vec<f64> {
    report.physical().filter(|e| e.stable == stable).map(|e| e.energy).collect()
}

fn by_rest_length<const D: usize>(
    structure: &Structure<D>,
    arguments: &Sweep,
    values: &[f64],
) -> Result<Found, Failure> {
    let model = &structure.model;
    let input = model.cables().position(|cable| model.cable_name(cable) == arguments.parameter);
    let input = input.ok_or_else(|| {
        Failure::Usage(format!("the scene has neither a parameter nor a cable \"{}\"", arguments.parameter))
    })?;
    let u = model.inputs_at(0.0);
    let waiting = spinner("following all equilibria");
    let swept = Family::new(model, &u, &EquilibriaOptions::default())
        .and_then(|family| family.sweep(&u, input, values));
    waiting.finish_and_clear();
    let swept = swept.map_err(Failure::analysis)?;
    let series = (1..).zip(&swept.curves).map(|(k, curve)| {
        let mut energies = vec![f64::NAN; values.len()];
        for &point in &curve.points {
            energies[point.sample] = swept.at(point).energy;
        }
        let kind = if curve.stable { "stable" } else { "unstable" };
        Series::new(format!("{kind} {k}"), energies)
    });
    let series = series.collect();
    let mut remarks = Vec::new();
    if !swept.loose_ends.is_empty() {
        remarks.push(format!("{} ends of curves were not followed to a fold", swept.loose_ends.len()));
    }
    let folds = Some(swept.folds.iter().map(|fold| json!(fold.value)).collect());
    Ok(Found { samples: swept.samples, folds, series, remarks })
}
