//! The framework paper's examples.

use super::page::{digits, table};
use super::scene::Scene;
use super::scheme::SCHEMES;
use super::stepping::{cost, whole};
use super::{Options, parts};
use crate::TaskError;

/// Duration of example 3 \[s\].
const DURATION: f64 = 25.0;

pub(super) fn section(options: &Options) -> Result<String, TaskError> {
    let scenes = Scene::papers()?;
    let mut header: Vec<String> = vec!["µs per step of 1 ms".into()];
    header.extend(scenes.iter().map(|scene| scene.name.clone()));
    let mut rows = Vec::new();
    for scheme in &SCHEMES {
        let mut row = vec![scheme.name.to_string()];
        let mut counts = vec![scheme.counts.label().to_string()];
        for scene in &scenes {
            // A scheme may not be made for a scene: an explicit one without mass, say.
            let measured = (0..options.passes()).filter_map(|_| cost(scene, scheme, options.budget()).ok());
            let best = measured.min_by(|a, b| a.micros.total_cmp(&b.micros));
            row.push(best.map_or("–".into(), |cost| digits(cost.micros)));
            counts.push(best.map_or("–".into(), |cost| digits(cost.iterations)));
        }
        rows.extend([row, counts]);
    }
    for (name, part) in [("assembly", 0), ("factorisation", 1), ("solve", 2)] {
        let mut row = vec![name.to_string()];
        for scene in &scenes {
            let newton = parts::newton(scene, options.budget() / 2.0)?;
            row.push(digits(1e6 * [newton.assembly, newton.factorisation, newton.solve][part]));
        }
        rows.push(row);
    }
    Ok(format!("### The papers' examples\n\n{}\n{}\n", table(&header, &rows), real_time(options)?))
}

/// How much faster than the motion example 3 is computed.
fn real_time(options: &Options) -> Result<String, TaskError> {
    let scene = Scene::example3()?;
    let duration = if options.quick { DURATION / 10.0 } else { DURATION };
    let header = [format!("example 3, {duration} s at 1 ms"), "s".into(), "times real time".into()];
    let mut rows = Vec::new();
    for scheme in &SCHEMES {
        // Past the collapse some schemes do not come.
        let row = match whole(&scene, scheme, duration) {
            Ok(seconds) => [digits(seconds), digits(duration / seconds)],
            Err(_) => ["–".into(), "a step fails".into()],
        };
        rows.push([vec![scheme.name.to_string()], row.to_vec()].concat());
    }
    Ok(table(&header, &rows))
}
