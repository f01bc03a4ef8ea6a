//! `nodes.csv`, `bars.csv` and `cables.csv` in one folder; or `NAMEnodes.csv` with `NAMEbars.csv` and `NAMEcables.csv`.
//!
//! ```text
//! nodes:   name, x, y, z?, fixed?, mass?        fixed: the letters of the held components, as xyz
//! bars:    name?, from, to, mass | line_density | density, radius?
//! cables:  name?, from, to, stiffness | axial_stiffness, rest | rest_ratio | tension | force_density,
//!          damping?, group?, law?
//! ```
//! Columns in any order, with the aliases of scenes; commas, semicolons or tabs between them. Without z the structure is
//! of the plane. Bars that end in one node are joined there, a node with a mass is a particle, a fixed node an anchor.

use std::collections::HashMap;
use std::path::Path;

use nalgebra::Vector3;

use super::ImportError;
use super::draft::{BarMass, Draft, DraftBar, DraftCable, DraftNode, Rest, Stiffness};
use super::sources::{Fault, Sources};
use super::table::{Column, Row, Table};
use crate::error::ReadError;

const NAME: Column = &["name", "id", "label"];
const X: Column = &["x"];
const Y: Column = &["y"];
const Z: Column = &["z"];
const FIXED: Column = &["fixed", "support", "supports", "axes"];
const MASS: Column = &["mass", "m"];
const FROM: Column = &["from", "node1", "node_1", "start", "a"];
const TO: Column = &["to", "node2", "node_2", "end", "b"];
const LINE_DENSITY: Column = &["line_density"];
const DENSITY: Column = &["density", "rho"];
const RADIUS: Column = &["radius", "r"];
const STIFFNESS: Column = &["stiffness", "k"];
const AXIAL: Column = &["axial_stiffness", "ea"];
const DAMPING: Column = &["damping", "c"];
const REST: Column = &["rest", "rest_length", "free_length", "natural_length"];
const RATIO: Column = &["rest_ratio"];
const TENSION: Column = &["tension", "pretension"];
const FORCE_DENSITY: Column = &["force_density", "q"];
const GROUP: Column = &["group", "tag"];
const LAW: Column = &["law"];

/// Reads the tables beside one of them.
pub(super) fn read(path: &Path, sources: &mut Sources) -> Result<Draft, ImportError> {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let kinds = ["nodes.csv", "bars.csv", "cables.csv"];
    let Some(prefix) = kinds.iter().find_map(|kind| name.strip_suffix(kind)) else {
        return Err(ImportError::UnknownFormat { path: path.display().to_string() });
    };
    let [nodes, bars, cables] = kinds.map(|kind| path.with_file_name(format!("{prefix}{kind}")));
    let mut draft = Draft { gravity: "gravity = [0, 0, -9.81]".into(), ..Draft::default() };
    let source = sources.read(&nodes)?;
    let table = Table::read(source, &[NAME, X, Y, Z, FIXED, MASS], sources)?;
    let known = read_nodes(&table, &mut draft).map_err(|fault| sources.fault(fault))?;
    let mut optional = |path: &Path, columns: &[Column], draft: &mut Draft| {
        if !path.exists() {
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            draft.warnings.push(format!("there is no {name} beside the nodes"));
            return Ok(None);
        }
        let source = sources.read(path)?;
        Table::read(source, columns, sources).map(Some)
    };
    let columns = [NAME, FROM, TO, MASS, LINE_DENSITY, DENSITY, RADIUS];
    let bars = optional(&bars, &columns, &mut draft)?;
    let columns =
        [NAME, FROM, TO, STIFFNESS, AXIAL, DAMPING, REST, RATIO, TENSION, FORCE_DENSITY, GROUP, LAW];
    let cables = optional(&cables, &columns, &mut draft)?;
    let mut read = || {
        bars.iter().try_for_each(|table| read_bars(table, &known, &mut draft))?;
        cables.iter().try_for_each(|table| read_cables(table, &known, &mut draft))
    };
    read().map_err(|fault| sources.fault(fault))?;
    Ok(draft)
}

/// Nodes by their names.
type Known<'t> = HashMap<&'t str, usize>;

fn read_nodes<'t>(table: &'t Table, draft: &mut Draft) -> Result<Known<'t>, Fault> {
    [NAME, X, Y].into_iter().try_for_each(|column| table.require(column))?;
    draft.dimension = if table.has(Z) { 3 } else { 2 };
    if draft.dimension == 2 {
        draft.gravity = "gravity = [0, -9.81]".into();
    }
    let mut known = HashMap::new();
    for row in table.rows() {
        let name = row.require(NAME)?;
        if known.insert(name, draft.nodes.len()).is_some() {
            return Err(row.fault(format!("the node \"{name}\" is there twice")));
        }
        let coordinate = |column: Column| {
            row.require(column)?;
            row.number(column).map(Option::unwrap_or_default)
        };
        let z = if draft.dimension == 3 { coordinate(Z)? } else { 0.0 };
        let position = Vector3::new(coordinate(X)?, coordinate(Y)?, z);
        let fixed = fixed(&row, draft.dimension)?;
        let mass = row.positive(MASS)?;
        draft.nodes.push(DraftNode { name: name.into(), position, fixed, mass, at: row.at.clone() });
    }
    if known.is_empty() {
        return Err(table.header.fault("the table has no nodes", "add one line for each node"));
    }
    Ok(known)
}

fn fixed(row: &Row<'_>, dimension: usize) -> Result<[bool; 3], Fault> {
    let cell = row.text(FIXED).unwrap_or("").to_lowercase();
    match cell.as_str() {
        "all" | "true" | "yes" | "1" => return Ok([true; 3]),
        "none" | "false" | "no" | "0" => return Ok([false; 3]),
        _ => {}
    }
    let mut fixed = [false; 3];
    for axis in cell.chars() {
        let Some(k) = "xyz".find(axis).filter(|k| *k < dimension) else {
            let axes = &"xyz"[..dimension];
            let mut fault = row.fault(format!("`fixed`: there is no axis `{axis}`"));
            fault.error =
                fault.error.help(format!("write letters of \"{axes}\", as {axes} for a node held wholly"));
            return Err(fault);
        };
        fixed[k] = true;
    }
    Ok(fixed)
}

fn ends(row: &Row<'_>, known: &Known<'_>) -> Result<[usize; 2], Fault> {
    let end = |column: Column| {
        let name = row.require(column)?;
        known.get(name).copied().ok_or_else(|| {
            let mut names: Vec<&str> = known.keys().copied().collect();
            names.sort_unstable();
            let error = ReadError::new(format!("there is no node \"{name}\"")).suggest(name, &names);
            let mut fault = row.fault("");
            fault.error = error.at_opt(fault.error.span);
            fault
        })
    };
    Ok([end(FROM)?, end(TO)?])
}

/// The one of some columns that is filled in.
fn one_of<T>(row: &Row<'_>, given: [(Column, Option<T>); 4]) -> Result<Option<T>, Fault> {
    let mut given = given.into_iter().filter_map(|(column, value)| value.map(|value| (column, value)));
    let first = given.next();
    match (first, given.next()) {
        (Some((a, _)), Some((b, _))) => {
            Err(row.fault(format!("`{}` and `{}` are both given; leave one of them empty", a[0], b[0])))
        }
        (first, _) => Ok(first.map(|(_, value)| value)),
    }
}

fn read_bars(table: &Table, known: &Known<'_>, draft: &mut Draft) -> Result<(), Fault> {
    [FROM, TO].into_iter().try_for_each(|column| table.require(column))?;
    let mut assumed = 0;
    for (k, row) in table.rows().enumerate() {
        let name = row.text(NAME).map_or_else(|| format!("bar {}", k + 1), str::to_string);
        let (ends, radius, density) = (ends(&row, known)?, row.positive(RADIUS)?, row.positive(DENSITY)?);
        if density.is_some() && radius.is_none() {
            return Err(row.fault("a density needs the bar's radius; fill in `radius`"));
        }
        let mass = one_of(
            &row,
            [
                (MASS, row.positive(MASS)?.map(BarMass::Mass)),
                (LINE_DENSITY, row.positive(LINE_DENSITY)?.map(BarMass::LineDensity)),
                (DENSITY, density.map(BarMass::Density)),
                (RADIUS, None),
            ],
        )?;
        assumed += usize::from(mass.is_none());
        let mass = mass.unwrap_or(BarMass::LineDensity(1.0));
        draft.bars.push(DraftBar { name, ends, mass, radius, at: row.at.clone() });
    }
    draft.warn_of_assumed_mass(assumed);
    Ok(())
}

fn read_cables(table: &Table, known: &Known<'_>, draft: &mut Draft) -> Result<(), Fault> {
    [FROM, TO].into_iter().try_for_each(|column| table.require(column))?;
    for (k, row) in table.rows().enumerate() {
        let name = row.text(NAME).map_or_else(|| format!("cable {}", k + 1), str::to_string);
        let springs = [
            (STIFFNESS, row.positive(STIFFNESS)?.map(Stiffness::Spring)),
            (AXIAL, row.positive(AXIAL)?.map(Stiffness::Axial)),
            (NAME, None),
            (NAME, None),
        ];
        let stiffness = one_of(&row, springs)?;
        let rests = [
            (REST, row.number(REST)?.map(Rest::Length)),
            (RATIO, row.number(RATIO)?.map(Rest::Ratio)),
            (TENSION, row.number(TENSION)?.map(Rest::Tension)),
            (FORCE_DENSITY, row.number(FORCE_DENSITY)?.map(Rest::ForceDensity)),
        ];
        let rest = one_of(&row, rests)?;
        let damping = row.number(DAMPING)?.unwrap_or(0.0);
        if damping < 0.0 {
            return Err(row.fault(format!("`damping` is {damping}; it must not be negative")));
        }
        let linear = match row.text(LAW).map(str::to_lowercase).as_deref() {
            None | Some("slacking" | "cable") => false,
            Some("linear" | "spring" | "two_way") => true,
            Some(other) => return Err(row.fault(format!("`law` is `{other}`; write slacking or linear"))),
        };
        draft.cables.push(DraftCable {
            name,
            ends: ends(&row, known)?,
            group: row.text(GROUP).map(str::to_string),
            stiffness: stiffness.ok_or_else(|| {
                row.fault("the cable has no stiffness; fill in stiffness or axial_stiffness")
            })?,
            damping,
            rest: rest.ok_or_else(|| {
                row.fault("the cable has no rest length; fill in rest, rest_ratio, tension or force_density")
            })?,
            linear,
            at: row.at.clone(),
        });
    }
    Ok(())
}
