//! The antiprism paper: both examples, unloaded and loaded.
//!
//! - `unloaded`: Yin's states and the paper's tables of them;
//! - `forces`: example 1, three sliding feet and a force on each top (Tables 4 and 5);
//! - `moments`: example 2, four fixed feet and moments about the universal joints (Tables 9 and 10);
//! - `free_body`: strut 4 of example 2 alone (Fig. 10);
//! - `paths`: what happens on the way to the load and beyond.
//!
//! Lengths are in mm and forces in N, as in the paper. References of more digits than the paper prints are of its own
//! equations solved to 50 digits.

mod forces;
mod free_body;
mod moments;
mod paths;
mod unloaded;

use nalgebra::Vector3;

use crate::antiprism::{Antiprism, Feet, Loads, Parameters};
use crate::error::CaseError;
use crate::reference::antiprism as virtual_work;
use crate::row::{Row, Rows};

/// Name of this case.
pub const NAME: &str = "antiprism";

const EXACT: &str = "the paper's equations to 50 digits";
const MODEL: &str = "virtual work in ε, β and the feet's places";
const MM: f64 = 1e3;

/// All numbers of both examples.
///
/// # Errors
/// A model or solver fails; none does.
pub fn rows() -> Result<Vec<Row>, CaseError> {
    let mut rows = Rows::new(NAME);
    unloaded::rows(&mut rows)?;
    forces::rows(&mut rows)?;
    moments::rows(&mut rows)?;
    free_body::rows(&mut rows)?;
    paths::rows(&mut rows)?;
    Ok(rows.finish())
}

/// A list of numbers against printed ones, to half a unit of their last digit.
fn table<'a>(
    rows: &mut Rows,
    name: &str,
    unit: &'static str,
    values: impl IntoIterator<Item = f64>,
    printed: impl IntoIterator<Item = &'a f64>,
    (source, tolerance): (&'static str, f64),
) {
    for (k, (value, printed)) in values.into_iter().zip(printed).enumerate() {
        rows.near(format!("{name}, strut {}", k + 1), unit, (value, *printed), source, tolerance);
    }
}

/// Ends of all struts in mm.
fn ends(antiprism: &Antiprism, q: &[f64]) -> Vec<[Vector3<f64>; 2]> {
    (0..antiprism.struts.len()).map(|j| antiprism.ends(j, q).map(|p| p * MM)).collect()
}

/// The same structure in the virtual-work model, with a factor on its loads.
fn twin(antiprism: &Antiprism, feet: Feet, loads: &Loads, factor: f64) -> virtual_work::Model {
    let Parameters { struts, length, top, bottom, lateral } = antiprism.parameters;
    let feet = (feet == Feet::Fixed).then(|| {
        (0..struts).map(|j| antiprism.unloaded.ends(j)[0] * MM).map(|foot| [foot.x, foot.y]).collect()
    });
    let mut forces = vec![([0.0; 3], 0.0); struts];
    let mut moments = vec![[0.0; 2]; struts];
    match loads {
        Loads::Force(force, part) => forces.fill((force.map(|f| f * factor), part * length * MM)),
        Loads::JointMoments(all) => {
            moments = all.iter().map(|m| m.map(|m| m * factor * MM)).collect();
        }
        Loads::None | Loads::MomentVectors(_) => {}
    }
    let ties = [top, bottom, lateral].map(|tie| (tie.stiffness / MM, tie.free * MM));
    virtual_work::Model { length: length * MM, ties, feet, forces, moments }
}

/// Largest distance of two lists of ends.
fn apart(ours: &[[Vector3<f64>; 2]], theirs: &[[Vector3<f64>; 2]]) -> f64 {
    let pairs = ours.iter().flatten().zip(theirs.iter().flatten());
    pairs.map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// Ends turned about the vertical.
fn turned(ends: &[[Vector3<f64>; 2]], angle: f64) -> Vec<[Vector3<f64>; 2]> {
    let rotation = nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
    ends.iter().map(|strut| strut.map(|p| rotation * p)).collect()
}

/// Angle about the vertical through the origin that brings the feet of `ours` nearest to those of `theirs`.
fn turn(ours: &[[Vector3<f64>; 2]], theirs: &[Vector3<f64>]) -> f64 {
    let feet = || ours.iter().zip(theirs).map(|([foot, _], other)| (foot, other));
    let sin: f64 = feet().map(|(a, b)| a.x * b.y - a.y * b.x).sum();
    let cos: f64 = feet().map(|(a, b)| a.x * b.x + a.y * b.y).sum();
    sin.atan2(cos)
}
