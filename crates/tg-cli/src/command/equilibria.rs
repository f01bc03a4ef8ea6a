//! `tg equilibria`: all equilibria of a small structure.

use serde_json::{Value, json};
use tg_equilibria::{EquilibriaOptions, EquilibriaReport, all_equilibria};
use tg_report::{Kind, Shape};
use tg_scene::Structure;

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::Equilibria;
use crate::loading::{Loaded, remarks};
use crate::picture::Painter;
use crate::progress::spinner;
use crate::results::{manifest, told, write};

pub(crate) fn equilibria(arguments: &Equilibria) -> Result<Answer, Failure> {
    let loaded = Loaded::new(&arguments.scene)?;
    with_structure!(&loaded.built, structure => answer(&loaded, structure, arguments))
}

fn answer<const D: usize>(
    loaded: &Loaded,
    structure: &Structure<D>,
    arguments: &Equilibria,
) -> Result<Answer, Failure> {
    let model = &structure.model;
    let options = EquilibriaOptions {
        max_paths: arguments.max_paths,
        seed: arguments.seed,
        ..EquilibriaOptions::default()
    };
    let waiting = spinner("following all paths");
    let found = all_equilibria(model, &model.inputs_at(0.0), &options);
    waiting.finish_and_clear();
    let report = found.map_err(Failure::analysis)?;
    let document = describe(loaded, &report);
    let painter = Painter::new(structure)?;
    let settings =
        json!({ "command": "equilibria", "max_paths": arguments.max_paths, "seed": arguments.seed });
    let manifest = manifest(Kind::Equilibria, loaded, painter.outline(), settings);
    let folder = write(&arguments.output, manifest, &document, |writer| {
        let shapes = (1..).zip(report.physical()).map(|(k, equilibrium)| {
            Ok(Shape {
                label: format!("equilibrium {k}"),
                stable: Some(equilibrium.stable),
                energy: Some(equilibrium.energy),
                frame: painter.frame(0.0, &equilibrium.configuration.q, &equilibrium.configuration.u)?,
            })
        });
        Ok(writer.document("shapes", &shapes.collect::<Result<Vec<_>, Failure>>()?)?)
    })?;
    let text = format!("{}\n{report}{}", loaded.title(), told(folder.as_ref()));
    let mut answer = Answer::new(document, text).warn(remarks(structure));
    if !report.accounts_for_all() {
        answer.failed = Some("not every path is accounted for: equilibria may be missing".into());
    }
    Ok(answer)
}

fn describe(loaded: &Loaded, report: &EquilibriaReport) -> Value {
    let equilibria = report.equilibria.iter().map(|equilibrium| {
        json!({
            "physical": equilibrium.physical,
            "stable": equilibrium.stable,
            "taut": equilibrium.taut,
            "energy": equilibrium.energy,
            "negative_eigenvalues": equilibrium.negative,
            "lengths": equilibrium.lengths,
            "coordinates": equilibrium.configuration.q,
            "certified_radius": equilibrium.radius,
        })
    });
    json!({
        "scene": loaded.file.name,
        "paths": report.paths,
        "at_infinity": report.at_infinity,
        "failed": report.failed,
        "certified": report.certified,
        "undecided": report.undecided,
        "rejected": report.rejected,
        "real": report.equilibria.len(),
        "physical": report.physical().count(),
        "stable": report.stable().count(),
        "index_sum": report.index_sum(),
        "accounts_for_all": report.accounts_for_all(),
        "equilibria": equilibria.collect::<Vec<_>>(),
    })
}
