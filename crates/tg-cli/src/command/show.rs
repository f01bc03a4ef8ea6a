//! `tg view`, `tg plot`, `tg export`: results as pictures and files.

use std::path::{Path, PathBuf};

use serde_json::json;
use tg_report::{
    Kind, Picture, Plot, Projection, Results, Shape, View, evenly, strip_png, strip_svg, write_file,
    write_glb, write_vtk,
};

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::{self, ExportForm, PlotWhat};
use crate::loading::Loaded;
use crate::picture::Painter;
use crate::results::write_view;

/// Size of plots \[px\].
const SIZE: [f64; 2] = [960.0, 540.0];
/// Pixels of a PNG per pixel of that size.
const FINENESS: f64 = 2.0;
/// Pictures in a strip of snapshots.
const SNAPSHOTS: usize = 6;

pub(crate) fn view(arguments: &args::View) -> Result<Answer, Failure> {
    let path = &arguments.result;
    let file = if path.is_dir() {
        let file = arguments.output.clone().unwrap_or_else(|| path.join("view.html"));
        write_view(path, &file)?;
        file
    } else {
        let loaded = Loaded::read(path, &[])?;
        let html = with_structure!(&loaded.built, structure => {
            let (model, painter) = (&structure.model, Painter::new(structure)?);
            let frame = painter.frame(0.0, &model.initial_coordinates(), &model.inputs_at(0.0))?;
            let mut view = View::new(&loaded.title(), painter.outline());
            view.subtitle = "as built".into();
            view.shapes = vec![Shape { label: "as built".into(), stable: None, energy: None, frame }];
            view.html()?
        });
        let file = arguments.output.clone().unwrap_or_else(|| path.with_extension("html"));
        write_file(&file, html.as_bytes())?;
        file
    };
    Ok(written(&file))
}

pub(crate) fn plot(arguments: &args::Plot) -> Result<Answer, Failure> {
    let results = Results::open(&arguments.result)?;
    let (what, name) = (arguments.what, name(arguments.what));
    let file = arguments.output.clone().unwrap_or_else(|| arguments.result.join(format!("{name}.svg")));
    let png = match file.extension().and_then(|extension| extension.to_str()) {
        Some("svg") => false,
        Some("png") => true,
        _ => return Err(Failure::Usage(format!("{}: a picture is a .svg or .png file", file.display()))),
    };
    if what == PlotWhat::Snapshots {
        write_file(&file, &snapshots(&results, png)?)?;
        return Ok(written(&file));
    }
    let plot = curves(&results, what)?.ok_or_else(|| {
        let message = format!(
            "{}: these results hold no {name}; ask for the channel in the scene's [run] section",
            arguments.result.display()
        );
        Failure::Usage(message)
    })?;
    let bytes = if png { plot.png(SIZE, FINENESS)? } else { plot.svg(SIZE)?.into_bytes() };
    write_file(&file, &bytes)?;
    Ok(written(&file))
}

fn name(what: PlotWhat) -> &'static str {
    match what {
        PlotWhat::Tensions => "tensions",
        PlotWhat::Lengths => "lengths",
        PlotWhat::Energies => "energies",
        PlotWhat::EnergyDrift => "energy-drift",
        PlotWhat::Slack => "slack",
        PlotWhat::Points => "points",
        PlotWhat::Reactions => "reactions",
        PlotWhat::Sweep => "sweep",
        PlotWhat::Snapshots => "snapshots",
    }
}

fn curves(results: &Results, what: PlotWhat) -> Result<Option<Plot>, Failure> {
    let group = match what {
        PlotWhat::Sweep => return swept(results),
        PlotWhat::EnergyDrift => return Ok(Plot::energy_drift(&results.table()?, "total energy")),
        PlotWhat::Tensions => "tension",
        PlotWhat::Lengths => "length",
        PlotWhat::Energies => "energy",
        PlotWhat::Slack => "slack",
        PlotWhat::Points => "point",
        PlotWhat::Reactions => "reaction",
        PlotWhat::Snapshots => return Ok(None),
    };
    Ok(Plot::of_group(&results.table()?, group))
}

/// Equilibria are drawn by the sweep itself, frequencies and what motions come to are columns.
fn swept(results: &Results) -> Result<Option<Plot>, Failure> {
    if let Some(plot) = results.plots()?.into_iter().next() {
        return Ok(Some(plot));
    }
    let table = results.table()?;
    let of_motions = || Plot::of_group(&table, "tension").filter(|_| results.manifest.kind == Kind::Sweep);
    Ok(Plot::of_group(&table, "frequency").or_else(of_motions))
}

fn snapshots(results: &Results, png: bool) -> Result<Vec<u8>, Failure> {
    let nothing = || Failure::Usage("these results hold no pictures of the structure".into());
    let outline = results.manifest.outline.as_ref().ok_or_else(nothing)?;
    let shapes = evenly(&results.shapes()?, SNAPSHOTS);
    let captions = shapes.iter().map(|shape| shape.label.clone()).collect();
    let frames = if shapes.is_empty() {
        evenly(&results.frames()?, SNAPSHOTS)
    } else {
        shapes.into_iter().map(|shape| shape.frame).collect()
    };
    let projection = if outline.dimension == 2 { Projection::Front } else { Projection::Isometric };
    let picture = Picture {
        projection,
        size: [SIZE[0] * 1.5, SIZE[1]],
        title: results.manifest.title.clone(),
        captions,
        ..Picture::default()
    };
    Ok(if png {
        strip_png(outline, &frames, &picture, FINENESS)?
    } else {
        strip_svg(outline, &frames, &picture)?.into_bytes()
    })
}

pub(crate) fn export(arguments: &args::Export) -> Result<Answer, Failure> {
    let results = Results::open(&arguments.result)?;
    let given = |name: &str| arguments.output.clone().unwrap_or_else(|| arguments.result.join(name));
    let outline = || {
        let outline = results.manifest.outline.as_ref();
        outline.ok_or_else(|| Failure::Usage("these results hold no pictures of the structure".into()))
    };
    let file: PathBuf = match arguments.form {
        ExportForm::Csv => {
            let file = given("trajectory.csv");
            results.table()?.write_csv(&file)?;
            file
        }
        ExportForm::Npy => {
            let file = given("trajectory.npy");
            results.table()?.write_npy(&file)?;
            file
        }
        ExportForm::Vtk => {
            let file = given("motion.pvd");
            write_vtk(&file, outline()?, &results.frames()?)?;
            file
        }
        ExportForm::Gltf => {
            let file = given("motion.glb");
            write_glb(&file, outline()?, &results.frames()?)?;
            file
        }
    };
    Ok(written(&file))
}

fn written(path: &Path) -> Answer {
    Answer::new(json!({ "written": path }), format!("{}\n", path.display()))
}
