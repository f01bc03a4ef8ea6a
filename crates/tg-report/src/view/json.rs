//! The data of a page, as the viewer reads it: numbers in base64.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

use crate::error::ReportError;
use crate::frame::{CableFrame, Frame, ModeShape, Shape};
use crate::outline::{CableOutline, MemberOutline, Outline};
use crate::plot::{Plot, PlotKind};
use crate::view::View;

#[derive(Serialize)]
struct Data<'a> {
    version: u32,
    title: &'a str,
    subtitle: &'a str,
    dimension: usize,
    up: [f64; 3],
    members: &'a [MemberOutline],
    cables: &'a [CableOutline],
    motion: Option<Motion>,
    modes: Option<Modes<'a>>,
    shapes: Option<Shapes<'a>>,
    plots: Vec<PlotData<'a>>,
}

#[derive(Serialize)]
struct Motion {
    time: String,
    poses: String,
    ends: String,
    tension: String,
    slack: String,
}

#[derive(Serialize)]
struct Modes<'a> {
    reference: Still,
    list: Vec<Mode<'a>>,
}

#[derive(Serialize)]
struct Still {
    poses: String,
    ends: String,
    tension: String,
    slack: String,
}

#[derive(Serialize)]
struct Mode<'a> {
    label: &'a str,
    frequency: Option<f64>,
    damping: Option<f64>,
    vertices: String,
    ends: String,
}

#[derive(Serialize)]
struct Shapes<'a> {
    list: Vec<ShapeData<'a>>,
}

#[derive(Serialize)]
struct ShapeData<'a> {
    label: &'a str,
    stable: Option<bool>,
    energy: Option<f64>,
    #[serde(flatten)]
    still: Still,
}

#[derive(Serialize)]
struct PlotData<'a> {
    title: &'a str,
    kind: PlotKind,
    x: Abscissa<'a>,
    y: Ordinate<'a>,
    series: Vec<Curve<'a>>,
}

#[derive(Serialize)]
struct Abscissa<'a> {
    label: &'a str,
    unit: &'a str,
    time: bool,
    values: String,
}

#[derive(Serialize)]
struct Ordinate<'a> {
    label: &'a str,
    unit: &'a str,
}

#[derive(Serialize)]
struct Curve<'a> {
    name: &'a str,
    values: String,
}

/// The data of a page, checked.
pub(super) fn data(view: &View) -> Result<String, ReportError> {
    let outline = &view.outline;
    outline.check()?;
    let modes = match &view.modes {
        None => None,
        Some((reference, list)) => {
            let list = list.iter().map(|m| mode(m, outline)).collect::<Result<_, _>>()?;
            Some(Modes { reference: still(reference, outline)?, list })
        }
    };
    let shapes = view.shapes.iter().map(|s| shape(s, outline)).collect::<Result<Vec<_>, _>>()?;
    let data = Data {
        version: 1,
        title: &view.title,
        subtitle: &view.subtitle,
        dimension: outline.dimension,
        up: outline.up,
        members: &outline.members,
        cables: &outline.cables,
        motion: motion(&view.motion, outline)?,
        modes,
        shapes: (!shapes.is_empty()).then_some(Shapes { list: shapes }),
        plots: view.plots.iter().map(plot).collect::<Result<_, _>>()?,
    };
    serde_json::to_string(&data).map_err(ReportError::json("the page".as_ref()))
}

fn motion(frames: &[Frame], outline: &Outline) -> Result<Option<Motion>, ReportError> {
    frames.iter().try_for_each(|f| f.check(outline))?;
    let Still { poses, ends, tension, slack } = stills(frames);
    let time = doubles(frames.iter().map(|f| f.time));
    Ok((!frames.is_empty()).then_some(Motion { time, poses, ends, tension, slack }))
}

fn still(frame: &Frame, outline: &Outline) -> Result<Still, ReportError> {
    frame.check(outline)?;
    Ok(stills(std::slice::from_ref(frame)))
}

fn stills(frames: &[Frame]) -> Still {
    let cables = || frames.iter().flat_map(|f| &f.cables);
    Still {
        poses: floats(frames.iter().flat_map(|f| &f.poses).flat_map(|&p| <[f64; 7]>::from(p))),
        ends: floats(cables().flat_map(|c| c.ends).flatten()),
        tension: floats(cables().map(|c| c.tension)),
        slack: STANDARD.encode(cables().map(|c: &CableFrame| u8::from(c.slack)).collect::<Vec<_>>()),
    }
}

fn mode<'a>(mode: &'a ModeShape, outline: &Outline) -> Result<Mode<'a>, ReportError> {
    mode.check(outline)?;
    let length = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let all = mode.vertices.iter().chain(mode.ends.iter().flatten());
    let largest = all.map(length).fold(0.0, f64::max);
    let scale = if largest > 0.0 { 1.0 / largest } else { 1.0 };
    Ok(Mode {
        label: &mode.label,
        frequency: mode.frequency,
        damping: mode.damping,
        vertices: floats(mode.vertices.iter().flatten().map(|x| x * scale)),
        ends: floats(mode.ends.iter().flatten().flatten().map(|x| x * scale)),
    })
}

fn shape<'a>(shape: &'a Shape, outline: &Outline) -> Result<ShapeData<'a>, ReportError> {
    let still = still(&shape.frame, outline)?;
    Ok(ShapeData { label: &shape.label, stable: shape.stable, energy: shape.energy, still })
}

fn plot(plot: &Plot) -> Result<PlotData<'_>, ReportError> {
    plot.check()?;
    let curves =
        plot.series.iter().map(|s| Curve { name: &s.name, values: doubles(s.values.iter().copied()) });
    Ok(PlotData {
        title: &plot.title,
        kind: plot.kind,
        x: Abscissa {
            label: &plot.x.label,
            unit: &plot.x.unit,
            time: plot.time,
            values: doubles(plot.at.iter().copied()),
        },
        y: Ordinate { label: &plot.y.label, unit: &plot.y.unit },
        series: curves.collect(),
    })
}

fn floats(values: impl Iterator<Item = f64>) -> String {
    STANDARD.encode(values.flat_map(|x| (x as f32).to_le_bytes()).collect::<Vec<_>>())
}

fn doubles(values: impl Iterator<Item = f64>) -> String {
    STANDARD.encode(values.flat_map(f64::to_le_bytes).collect::<Vec<_>>())
}
