//! Welded bodies: of bars by their numbers, as thin rods; or with mass, mass centre and inertia along the axes of space.

use nalgebra::{Matrix3, Vector3};

use super::{index, optional};
use crate::error::ReadError;
use crate::import::draft::{Draft, DraftBody};
use crate::import::mass::{Mass, cylinder, weld};
use crate::import::tree::{get, list, number, numbers, positive, require, table};
use crate::node::{Entry, Node, Value};

/// Reads the bodies; gives the numbers of the bars that they consist of.
pub(super) fn read(entries: &[Entry], draft: &mut Draft) -> Result<Vec<usize>, ReadError> {
    let mut welded = Vec::new();
    let bars = optional(entries, "bars")?;
    for (k, body) in optional(entries, "bodies")?.iter().enumerate() {
        let fields = table(body, "a body { nodes, bars } or { nodes, mass, com, inertia_world }")?;
        let count = draft.nodes.len();
        let nodes = list(require(fields, "nodes", body)?, "a list of nodes")?;
        let mut nodes: Vec<usize> =
            nodes.iter().map(|node| index(node, count, "node")).collect::<Result<_, _>>()?;
        let (mut rods, mut edges) = (Vec::new(), Vec::new());
        for bar in get(fields, "bars").map_or(Ok(&[][..]), |bars| list(bars, "a list of bars"))? {
            let number = index(bar, bars.len(), "bar")?;
            if welded.contains(&number) {
                return Err(ReadError::new(format!("bar {number} is welded twice")).at(&bar.span));
            }
            welded.push(number);
            let given = &bars[number];
            let fields = table(given, "a bar { nodes, mass }")?;
            let ends = super::ends(fields, given, draft)?;
            let mass = positive(require(fields, "mass", given)?, "the mass")?;
            let [from, to] = ends.map(|node| draft.nodes[node].position);
            if from == to {
                return Err(ReadError::new("the bar has no length").at(&given.span));
            }
            rods.push(cylinder(mass, 0.0, &from, &to));
            edges.push(ends);
            nodes.extend(ends);
        }
        let mut seen = std::collections::HashSet::new();
        nodes.retain(|node| seen.insert(*node));
        let Mass { mass, centre, inertia } = match get(fields, "mass") {
            Some(mass) => stated(fields, mass, body, draft.dimension)?,
            None => weld(&rods).ok_or_else(|| {
                ReadError::new("the body has neither bars nor a mass")
                    .at(&body.span)
                    .help("add bars, or mass, com and inertia_world")
            })?,
        };
        draft.bodies.push(DraftBody { name: format!("body {k}"), nodes, edges, mass, centre, inertia });
    }
    Ok(welded)
}

fn stated(fields: &[Entry], mass: &Node, body: &Node, dimension: usize) -> Result<Mass, ReadError> {
    let mass = positive(mass, "the mass")?;
    let com = require(fields, "com", body)?;
    let given = require(fields, "inertia_world", body)?;
    let mut inertia = Matrix3::zeros();
    if matches!(given.value, Value::List(_)) {
        let rows = list(given, "an inertia of three rows")?;
        if rows.len() != 3 {
            return Err(ReadError::new("an inertia of three rows is expected").at(&given.span));
        }
        for (k, row) in rows.iter().enumerate() {
            inertia.set_row(k, &Vector3::from(numbers::<3>(row, "a row of the inertia")?).transpose());
        }
    } else {
        inertia[(2, 2)] = number(given, "the inertia")?;
    }
    let centre = if dimension == 2 {
        let [x, y] = numbers(com, "the mass centre")?;
        Vector3::new(x, y, 0.0)
    } else {
        Vector3::from(numbers::<3>(com, "the mass centre")?)
    };
    Ok(Mass { mass, centre, inertia })
}
