//! Processor time to an error, per scheme and size.

use super::converged::converged;
use super::curve::{Point, curves, fastest, seconds_to};
use super::floor::Floor;
use super::page::{digits, table};
use super::scene::MastRun;
use super::{Options, folder};
use crate::TaskError;

/// Errors to reach \[m\].
const TARGETS: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

pub(super) fn section(options: &Options, floor: Option<&Floor>) -> Result<String, TaskError> {
    let (stages, limit): (&[usize], f64) =
        if options.quick { (&[2, 8], 0.2) } else { (&[2, 8, 32, 128], 4.0) };
    let mut text = String::from("### Processor seconds for 2 s of the mast, to an error\n\n");
    for &n in stages {
        let run = MastRun::new(n)?;
        let converged = converged(&run, &folder()?)?;
        let mut passes = Vec::new();
        for _ in 0..options.passes().min(2) {
            passes.push(curves(&run, &converged, limit)?);
            if let Some(floor) = floor {
                passes.push(floor.curves(&run, &converged, limit)?);
            }
        }
        text += &by_target(n, &fastest(passes));
        text.push('\n');
    }
    Ok(text)
}

/// One row per curve, one column per error.
fn by_target(stages: usize, points: &[Point]) -> String {
    let mut header = vec![format!("N = {stages}")];
    header.extend(TARGETS.map(|target| format!("{target:.0e} m")));
    header.push("error at 1 ms [m]".into());
    let mut names: Vec<(&str, &str)> = Vec::new();
    for point in points {
        let name = (point.tool.as_str(), point.variant.as_str());
        // A later pass may add a point far behind the others of its curve.
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let rows: Vec<Vec<String>> = names
        .into_iter()
        .map(|(tool, variant)| {
            let curve: Vec<&Point> =
                points.iter().filter(|p| p.tool == tool && p.variant == variant).collect();
            let name = if tool == "ours" { variant.to_string() } else { format!("{tool}: {variant}") };
            let mut row = vec![name];
            row.extend(TARGETS.map(|target| seconds_to(target, &curve).map_or("–".into(), digits)));
            let at = curve.iter().find(|point| point.dial == "1.000e-3 s");
            row.push(at.map_or("–".into(), |point| digits(point.error)));
            row
        })
        .collect();
    table(&header, &rows)
}
