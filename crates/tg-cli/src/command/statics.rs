//! `tg statics`: equilibrium, inverse statics, the shape that holds itself.

mod report;

use serde_json::{Value, json};
use tg_model::Tensioned;
use tg_report::{Kind, Shape};
use tg_scene::Structure;
use tg_statics::{
    Configuration, Forward, ForwardOptions, InverseStatics, Request, Seek, SelfStress, Unknown, Verdict,
    stability,
};

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::{GoalName, Statics, UnknownName};
use crate::loading::{Loaded, remarks};
use crate::picture::Painter;
use crate::results::{manifest, told, write};

/// Residual force per largest force up to which a shape counts as in equilibrium, as in modal analysis.
pub(crate) const BALANCED: f64 = 1e-8;

pub(crate) fn statics(arguments: &Statics) -> Result<Answer, Failure> {
    let loaded = Loaded::new(&arguments.scene)?;
    with_structure!(&loaded.built, structure => answer(&loaded, structure, arguments))
}

fn answer<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    arguments: &Statics,
) -> Result<Answer, Failure> {
    let model = &structure.model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let mut document = json!({ "scene": loaded.file.name });
    let mut text = format!("{}\n", loaded.title());
    let (q, u) = if arguments.inverse {
        inverse(structure, arguments, (&q, &u), &mut document, &mut text)?
    } else if arguments.solve || arguments.relax {
        let found = solve(structure, arguments.relax, (&q, &u), &mut document, &mut text)?;
        (found.q, found.u)
    } else {
        (q, u)
    };
    let at = report::equilibrium(structure, &q, &u, &mut document, &mut text)?;
    let balanced = at.imbalance().0 <= BALANCED;
    self_stress(structure, &at, arguments.rank_tolerance, &mut document, &mut text)?;
    let stable = if balanced { Some(verdict(structure, &at, &mut document, &mut text)?) } else { None };
    let painter = Painter::new(structure)?;
    let settings = json!({
        "command": "statics",
        "solve": arguments.solve,
        "relax": arguments.relax,
        "inverse": arguments.inverse,
    });
    let manifest = manifest(Kind::Statics, loaded, painter.outline(), settings);
    let folder = write(&arguments.output, manifest, &document, |writer| {
        let energy = Some(model.mechanics().potential(&q, &u));
        let label = if balanced { "equilibrium" } else { "shape as built" };
        let frame = painter.frame(0.0, &q, &u)?;
        Ok(writer.document("shapes", &[Shape { label: label.into(), stable, energy, frame }])?)
    })?;
    text += &told(folder.as_ref());
    let mut answer = Answer::new(document, text).warn(remarks(structure));
    if !balanced {
        answer.warnings.push(
            "the shape is no equilibrium with these rest lengths; --relax finds one, --inverse the rest lengths that hold \
             this shape"
                .into(),
        );
    }
    Ok(answer)
}

fn inverse<const D: usize>(
    structure: &Structure<D>,
    arguments: &Statics,
    (q, u): (&[f64], &[f64]),
    document: &mut Value,
    text: &mut String,
) -> Result<(Vec<f64>, Vec<f64>), Failure> {
    let model = &structure.model;
    let mut request = Request::new(match arguments.unknown {
        UnknownName::Tension => Unknown::Tension,
        UnknownName::ForceDensity => Unknown::ForceDensity,
        UnknownName::RestLength => Unknown::RestLength,
    });
    if arguments.least_tension.is_some() || arguments.greatest_tension.is_some() {
        let least = arguments.least_tension.unwrap_or(f64::NEG_INFINITY);
        request = request.tension_between(least, arguments.greatest_tension.unwrap_or(f64::INFINITY));
    }
    request = match arguments.goal {
        GoalName::Closest => request.closest_to(&present(structure, arguments.unknown, q, u)),
        GoalName::MinimumNorm => request,
        GoalName::LeastTotalTension => request.least_total_tension(),
    };
    if let Some(tolerance) = arguments.rank_tolerance {
        request = request.rank_tolerance(tolerance);
    }
    if arguments.tie_groups {
        for cables in groups(structure) {
            request = request.tie(&cables);
        }
    }
    let solver = InverseStatics::new(model, q, u).map_err(Failure::analysis)?;
    let found = solver.solve(&request).map_err(Failure::analysis)?;
    let rows = found.cutting_list();
    let width = rows.iter().map(|row| row.cable.chars().count()).max().unwrap_or(0).max(5);
    *text += &format!(
        "cutting list\n  {:width$}  {:>14}  {:>14}  {:>14}  {:>10}\n",
        "cable", "length [m]", "rest [m]", "tension [N]", "strain [1]"
    );
    for row in &rows {
        *text += &format!(
            "  {:width$}  {:14.9}  {:14.9}  {:14.6}  {:10.6}\n",
            row.cable, row.length, row.rest_length, row.tension, row.strain
        );
    }
    let free = found.set.freedom;
    *text += &format!("rank {}, {free} states of self-stress to choose from\n", found.set.rank.rank);
    if !found.pushing.is_empty() {
        let names: Vec<String> =
            found.pushing.iter().map(|&cable| Tensioned::cable_name(model, cable).to_string()).collect();
        *text += &format!("cables that would have to push: {}; ask for --least-tension\n", names.join(", "));
    }
    let uncut: Vec<&str> =
        rows.iter().filter(|row| row.rest_length <= 0.0).map(|row| row.cable.as_str()).collect();
    if !uncut.is_empty() {
        *text += &format!(
            "no cable is that short: {}; they need a greater stiffness, or a bound by --greatest-tension\n",
            uncut.join(", ")
        );
    }
    document["cutting_list"] = rows
        .iter()
        .map(|row| {
            json!({
                "cable": row.cable,
                "length": row.length,
                "rest_length": row.rest_length,
                "tension": row.tension,
                "strain": row.strain,
            })
        })
        .collect();
    document["force_densities"] = json!(found.force_densities);
    document["rank"] = json!(found.set.rank.rank);
    document["freedom_of_choice"] = json!(free);
    Ok((q.to_vec(), found.inputs(u)))
}

/// The unknowns as the scene has them, one for each cable.
fn present<const D: usize>(structure: &Structure<D>, unknown: UnknownName, q: &[f64], u: &[f64]) -> Vec<f64> {
    let (model, rest) = (&structure.model, vec![0.0; q.len()]);
    let cables = model.cables().map(|cable| model.cable(cable, q, &rest, u));
    let value = |cable: tg_model::CableState| match unknown {
        UnknownName::Tension => cable.tension,
        UnknownName::ForceDensity => cable.tension / cable.length,
        UnknownName::RestLength => cable.rest,
    };
    cables.map(value).collect()
}

/// Cables of each named group.
fn groups<const D: usize>(structure: &Structure<D>) -> Vec<Vec<usize>> {
    let mut groups: Vec<(&str, Vec<usize>)> = Vec::new();
    for (cable, group) in structure.groups.iter().enumerate() {
        let Some(name) = group else { continue };
        match groups.iter_mut().find(|(known, _)| known == name) {
            Some((_, cables)) => cables.push(cable),
            None => groups.push((name, vec![cable])),
        }
    }
    groups.into_iter().map(|(_, cables)| cables).filter(|cables| cables.len() > 1).collect()
}

fn solve<const D: usize>(
    structure: &Structure<D>,
    relax: bool,
    (q, u): (&[f64], &[f64]),
    document: &mut Value,
    text: &mut String,
) -> Result<Configuration, Failure> {
    let seek = if relax { Seek::Stable } else { Seek::Any };
    let options = ForwardOptions { seek, relax, ..ForwardOptions::default() };
    let found = Forward::new(&structure.model, options).solve(q, u).map_err(Failure::analysis)?;
    let report = &found.report;
    *text += &format!(
        "found after {} Newton iterations and {} steps of relaxation\n",
        report.iterations, report.relaxation_steps
    );
    document["solution"] = json!({
        "iterations": report.iterations,
        "relaxation_steps": report.relaxation_steps,
        "left_unstable": report.left_unstable,
        "residual": report.residual,
    });
    Ok(found.configuration)
}

fn self_stress<const D: usize>(
    structure: &Structure<D>,
    at: &Configuration,
    tolerance: Option<f64>,
    document: &mut Value,
    text: &mut String,
) -> Result<(), Failure> {
    let found = match tolerance {
        Some(tolerance) => SelfStress::with_tolerance(&structure.model, at, tolerance),
        None => SelfStress::new(&structure.model, at),
    };
    let found = found.map_err(Failure::analysis)?;
    *text += &format!(
        "{} states of self-stress, {} internal mechanisms, {} rigid motions\n",
        found.states.len(),
        found.mechanisms.len(),
        found.rigid_motions.len()
    );
    let (least, greatest) = found.rank.gap();
    document["self_stress"] = json!({
        "rank": found.rank.rank,
        "singular_value_gap": [least, greatest],
        "states": found.states,
        "mechanisms": found.mechanisms.len(),
        "rigid_motions": found.rigid_motions.len(),
        "degrees_of_freedom": found.degrees_of_freedom,
    });
    Ok(())
}

/// Whether the equilibrium is stable.
fn verdict<const D: usize>(
    structure: &Structure<D>,
    at: &Configuration,
    document: &mut Value,
    text: &mut String,
) -> Result<bool, Failure> {
    // One more than a free structure has rigid motions.
    let found = stability(&structure.model, at, 7).map_err(Failure::analysis)?;
    let word = match found.verdict {
        Verdict::Stable => "stable",
        Verdict::Neutral => "neutral",
        Verdict::Unstable => "unstable",
    };
    let counts = |value: &f64| value.abs() > found.zero_limit;
    let lowest = found.lowest.iter().map(|pair| pair.value).find(counts);
    *text += &format!("{word}: {} negative, {} zero", found.counts.negative, found.counts.zero);
    *text += &format!(" and {} positive eigenvalues of the stiffness", found.counts.positive);
    *text += &lowest
        .map_or_else(|| "\n".into(), |lowest| format!(", the lowest but for zeros {lowest:.6e} N/m\n"));
    document["stability"] = json!({
        "verdict": word,
        "negative": found.counts.negative,
        "zero": found.counts.zero,
        "positive": found.counts.positive,
        "rigid_motions": found.rigid_motions,
        "lowest_eigenvalue": lowest,
    });
    Ok(found.verdict == Verdict::Stable)
}
