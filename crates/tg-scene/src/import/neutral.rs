//! The neutral JSON of published structures: nodes by number from 0; bars, cables and welded bodies between them.
//!
//! ```text
//! nodes:   [[x, y, z], ...]
//! bars:    [{ nodes, mass?, radius? }]
//! cables:  [{ nodes, stiffness, rest_length, damping?, group? | tag? }]
//! bodies:  [{ nodes, bars: [index] | mass, com, inertia_world }]
//! fixed:   [{ node, axes: [0, 1, 2] }]
//! and:     dim?, name?, node_names?, source?, units?
//! ```
//! Bars are rigid: their own stiffness and rest length are left out, and so is the mass of cables.

mod bodies;

use std::path::Path;

use nalgebra::Vector3;

use super::ImportError;
use super::draft::{BarMass, Draft, DraftBar, DraftCable, DraftNode, Rest, Stiffness};
use super::sources::{At, Sources};
use super::tree::{get, list, not_negative, number, positive, require, table, text};
use crate::error::ReadError;
use crate::json_text;
use crate::node::{Entry, Node};

/// Reads a structure.
pub(super) fn read(path: &Path, sources: &mut Sources) -> Result<Draft, ImportError> {
    let source = sources.read(path)?;
    let read = || {
        let root = json_text::parse(sources.text(source))?;
        structure(&root, source)
    };
    read().map_err(|error| sources.mistake(source, error))
}

fn structure(root: &Node, source: usize) -> Result<Draft, ReadError> {
    let entries = table(root, "a structure with nodes, bars and cables")?;
    if get(entries, "nodes").is_none() && get(entries, "dimension").is_some() {
        return Err(ReadError::new("this is a scene already").at(&(0..1)).help("it needs no import"));
    }
    let dimension = get(entries, "dim").map_or(Ok(3.0), |dim| number(dim, "the number of dimensions"))?;
    let dimension = match dimension {
        2.0 => 2,
        3.0 => 3,
        other => {
            let message = format!("a structure has 2 or 3 dimensions, not {other}");
            return Err(ReadError::new(message).at(&require(entries, "dim", root)?.span));
        }
    };
    let down = if dimension == 2 { "[0, -9.81]" } else { "[0, 0, -9.81]" };
    let mut draft = Draft { dimension, gravity: format!("gravity = {down}"), ..Draft::default() };
    draft.title = get(entries, "name").map(|name| text(name, "a name").map(str::to_string)).transpose()?;
    if let Some(source) = get(entries, "source").and_then(|source| table(source, "").ok()) {
        for Entry { key, node, .. } in source {
            text(node, "").into_iter().for_each(|value| draft.notes.push(format!("{key}: {value}")));
        }
    }
    let units = get(entries, "units").and_then(|units| text(units, "").ok());
    units.into_iter().for_each(|units| draft.notes.push(format!("units: {units}")));
    nodes(entries, root, source, &mut draft)?;
    fixed(entries, &mut draft)?;
    let welded = bodies::read(entries, &mut draft)?;
    bars(entries, source, &welded, &mut draft)?;
    cables(entries, source, &mut draft)?;
    if get(entries, "clustered_cables").and_then(|list_| list(list_, "").ok()).is_some_and(|l| !l.is_empty())
    {
        draft.warnings.push("clustered cables run as cables of their own, not over pulleys".into());
    }
    Ok(draft)
}

fn optional<'n>(entries: &'n [Entry], key: &str) -> Result<&'n [Node], ReadError> {
    get(entries, key).map_or(Ok(&[]), |node| list(node, "a list"))
}

fn nodes(entries: &[Entry], root: &Node, source: usize, draft: &mut Draft) -> Result<(), ReadError> {
    let given = list(require(entries, "nodes", root)?, "a list of nodes")?;
    let names = optional(entries, "node_names")?;
    for (k, node) in given.iter().enumerate() {
        let coordinates = list(node, "a node [x, y, z]")?;
        if coordinates.len() < draft.dimension || coordinates.len() > 3 {
            let message = format!("a node has {} coordinates, not {}", draft.dimension, coordinates.len());
            return Err(ReadError::new(message).at(&node.span));
        }
        let mut position = Vector3::zeros();
        for (axis, coordinate) in coordinates.iter().take(draft.dimension).enumerate() {
            position[axis] = number(coordinate, "a coordinate")?;
        }
        let name = names.get(k).and_then(|name| text(name, "").ok()).map(str::to_string);
        let name = name.unwrap_or_else(|| format!("n{k}"));
        let at = At { source, span: node.span.clone() };
        draft.nodes.push(DraftNode { name, position, fixed: [false; 3], mass: None, at });
    }
    Ok(())
}

/// The number of a node that exists.
pub(super) fn index(node: &Node, count: usize, what: &str) -> Result<usize, ReadError> {
    let value = number(node, what)?;
    if value.fract() == 0.0 && value >= 0.0 && (value as usize) < count {
        return Ok(value as usize);
    }
    Err(ReadError::new(format!("there is no {what} {value}; there are {count}, from 0")).at(&node.span))
}

fn fixed(entries: &[Entry], draft: &mut Draft) -> Result<(), ReadError> {
    for support in optional(entries, "fixed")? {
        let entries = table(support, "a support { node, axes }")?;
        let node = index(require(entries, "node", support)?, draft.nodes.len(), "node")?;
        match get(entries, "axes") {
            None => draft.nodes[node].fixed = [true; 3],
            Some(axes) => {
                for axis in list(axes, "a list of axes")? {
                    draft.nodes[node].fixed[index(axis, draft.dimension, "axis")?] = true;
                }
            }
        }
    }
    Ok(())
}

fn ends(entries: &[Entry], of: &Node, draft: &Draft) -> Result<[usize; 2], ReadError> {
    let nodes = require(entries, "nodes", of)?;
    let [from, to] = list(nodes, "a pair of nodes")? else {
        return Err(ReadError::new("a pair of nodes is expected").at(&nodes.span));
    };
    let count = draft.nodes.len();
    Ok([index(from, count, "node")?, index(to, count, "node")?])
}

/// Bars that no body has taken.
fn bars(entries: &[Entry], source: usize, welded: &[usize], draft: &mut Draft) -> Result<(), ReadError> {
    let (mut assumed, mut elastic) = (0, false);
    for (k, bar) in optional(entries, "bars")?.iter().enumerate().filter(|(k, _)| !welded.contains(k)) {
        let entries = table(bar, "a bar { nodes, mass }")?;
        let mass = get(entries, "mass").map(|mass| positive(mass, "the mass")).transpose()?;
        assumed += usize::from(mass.is_none());
        elastic |= get(entries, "stiffness").is_some();
        draft.bars.push(DraftBar {
            name: format!("bar {k}"),
            ends: ends(entries, bar, draft)?,
            mass: mass.map_or(BarMass::LineDensity(1.0), BarMass::Mass),
            radius: get(entries, "radius").map(|radius| positive(radius, "the radius")).transpose()?,
            at: At { source, span: bar.span.clone() },
        });
    }
    draft.warn_of_assumed_mass(assumed);
    if elastic {
        draft.warnings.push("bars are rigid: their stiffness and rest length are left out".into());
    }
    Ok(())
}

fn cables(entries: &[Entry], source: usize, draft: &mut Draft) -> Result<(), ReadError> {
    let mut heavy = false;
    for (k, cable) in optional(entries, "cables")?.iter().enumerate() {
        let entries = table(cable, "a cable { nodes, stiffness, rest_length }")?;
        let group = get(entries, "group").or(get(entries, "tag"));
        heavy |= get(entries, "mass").is_some();
        let damping =
            get(entries, "damping").map_or(Ok(0.0), |damping| not_negative(damping, "the damping"))?;
        draft.cables.push(DraftCable {
            name: format!("cable {k}"),
            ends: ends(entries, cable, draft)?,
            group: group.map(|group| text(group, "a name").map(str::to_string)).transpose()?,
            stiffness: Stiffness::Spring(positive(require(entries, "stiffness", cable)?, "the stiffness")?),
            damping,
            rest: Rest::Length(not_negative(require(entries, "rest_length", cable)?, "the rest length")?),
            linear: false,
            at: At { source, span: cable.span.clone() },
        });
    }
    if heavy {
        draft.warnings.push("cables have no mass: theirs is left out".into());
    }
    Ok(())
}
