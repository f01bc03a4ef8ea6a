//! Example 3: the spatial deployable tower (Sec. 6.3).
//!
//! - `accuracy`: runs against a path that is known at a few times;
//! - `statics`: the rest lengths of Table 5 and the way back to both states (Sec. 6.3.1);
//! - `modes`: natural frequencies of both states (Fig. 19);
//! - `runs`: seismic runs from both static states (Sec. 6.3.2), and what must not matter to a run;
//! - `deployments`: the sixteen deployments (Sec. 6.3.3).

mod accuracy;
mod deployments;
mod modes;
mod runs;
mod statics;

use nalgebra::Vector3;
use tg_coords::{CoordType, Member};
use tg_integrate::State;
use tg_model::Form;

use super::mass_difference;
use crate::deployable::statics::rest_lengths;
use crate::deployable::{BAR_LENGTH, BAR_MASS, Choices, Configuration, Deployable, tetrahedron};
use crate::error::CaseError;
use crate::published::{EXACT, Upright, framework};
use crate::row::{Row, Rows};
use crate::simulate::record;

/// Name of the case.
pub const NAME: &str = "example3";
const GEOMETRY: &str = "geometry of the example";
/// Frequency of the ground between the two states' lowest natural ones \[Hz\].
const RESONANT: f64 = 0.5;

/// All rows.
///
/// # Errors
/// A model cannot be built or a run fails.
pub fn rows() -> Result<Vec<Row>, CaseError> {
    let mut rows = Rows::new(NAME);
    counts(&mut rows)?;
    masses(&mut rows)?;
    for configuration in Configuration::ALL {
        positions(&mut rows, configuration)?;
    }
    statics::rows(&mut rows)?;
    modes::rows(&mut rows)?;
    runs::rows(&mut rows)?;
    deployments::rows(&mut rows)?;
    Ok(rows.finish())
}

/// Reference values of a static state.
fn published(configuration: Configuration) -> &'static Upright {
    match configuration {
        Configuration::Initial => &framework().example3.initial,
        Configuration::Target => &framework().example3.target,
    }
}

/// A static state on resting ground, with the rest lengths that hold it.
fn still(configuration: Configuration) -> Result<Choices, CaseError> {
    Ok(Choices::still(configuration, &rest_lengths(configuration)?))
}

fn counts(rows: &mut Rows) -> Result<(), CaseError> {
    let structure = Deployable::new(&still(Configuration::Initial)?)?;
    let report = structure.model.report();
    rows.exact("free coordinates", (report.free, 54), GEOMETRY);
    rows.exact("intrinsic constraints", (report.intrinsic, 30), GEOMETRY);
    rows.exact("extrinsic constraints", (report.extrinsic, 0), GEOMETRY);
    rows.exact("degrees of freedom", (report.degrees_of_freedom(), 24), "paper, Sec. 6.3");
    rows.exact("cables", (structure.cables.len(), 24), GEOMETRY);
    Ok(())
}

fn masses(rows: &mut Rows) -> Result<(), CaseError> {
    let bar = Member::thin_rod(BAR_MASS, Vector3::zeros(), Vector3::new(0.0, 0.0, BAR_LENGTH))?;
    for (name, member) in [
        ("tet7(rrrr)", tetrahedron(CoordType::Rrrr)?),
        ("tet10(ruvw, unit axes, r_i=apex)", tetrahedron(CoordType::Ruvw)?),
        ("bar(rr)", bar),
    ] {
        let worst = mass_difference(member.mass_matrix(), &framework().example3.masses[name]);
        rows.below(format!("mass matrix {name}, largest difference"), "kg", worst, EXACT, 1e-15);
    }
    Ok(())
}

/// Every point of an upright configuration (Table 5), and the lengths of its cables.
fn positions(rows: &mut Rows, configuration: Configuration) -> Result<(), CaseError> {
    let (name, published) = (configuration.name(), published(configuration));
    let structure = Deployable::new(&still(configuration)?)?;
    let q = structure.model.initial_coordinates();
    let nodes = &published.nodes;
    let mut pairs: Vec<(&Form<3>, [f64; 3])> = structure.ground.iter().zip(nodes.ground).collect();
    pairs.extend(structure.ring.iter().zip(nodes.ring));
    for (k, body) in nodes.tetrahedra.values().enumerate() {
        let [apex, base @ ..] = &structure.vertices[k];
        pairs.extend([(&structure.centres[k], body.mass_centre), (apex, body.apex)]);
        pairs.extend(base.iter().zip(body.base));
    }
    rows.exact(format!("{name}: points compared"), (pairs.len(), 3 + 3 + 4 * 5), GEOMETRY);
    let apart = pairs.iter().map(|(form, point)| (form.eval(&q) - Vector3::from(*point)).norm());
    let worst = apart.fold(0.0, f64::max);
    rows.below(format!("{name}: largest distance of a point"), "m", worst, EXACT, 1e-15);
    let lengths = structure.cables.iter().map(|&cable| structure.model.cable_form(cable).eval(&q).norm());
    let worst = lengths.zip(published.lengths).map(|(l, l0)| (l - l0).abs()).fold(0.0, f64::max);
    rows.below(format!("{name}: largest difference of a cable's length"), "m", worst, EXACT, 1e-15);
    Ok(())
}

/// Path of the mass centre of tetrahedron 10.
fn top_path(choices: &Choices, h: f64, end: f64) -> Result<Vec<[f64; 3]>, CaseError> {
    let structure = Deployable::new(choices)?;
    record(&structure.model, h, end, |state: &State| structure.centres[3].eval(&state.q).into())
}
