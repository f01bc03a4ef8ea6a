//! Bars as thin rods, or as bodies with a thickness.

use nalgebra::{Matrix3, Rotation3, Vector3};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_fixtures::{Mast, MastScene};
use tg_model::{BuildError, MemberId, ModelBuilder};
use tg_trade::{Motion, Quantity, Reference, Subject};

use super::{Cost, Topic};
use crate::TaskError;
use crate::bench::page::{digits, table};

/// Step \[s\].
const STEP: f64 = 1e-3;
/// Simulated time: a multiple of 128 steps \[s\].
const END: f64 = 0.512;
/// Stages.
const STAGES: usize = 4;

/// A solid cylinder between two ends, in coordinates of two points on its axis and two vectors across.
fn cylinder(
    b: &mut ModelBuilder<3>,
    name: &str,
    radius: f64,
    [from, to]: [Vector3<f64>; 2],
) -> Result<MemberId, TaskError> {
    let (along, m) = (to - from, MastScene::BAR_MASS);
    let length = along.norm();
    let (axial, across) = (0.5 * m * radius * radius, m * (length * length / 12.0 + 0.25 * radius * radius));
    let mass =
        MassProperties::from_principal_moments(m, Vector3::x() * (0.5 * length), [axial, across, across])?;
    let nodes = [Vector3::zeros(), Vector3::x() * length, Vector3::y(), Vector3::z()];
    let member = Member::<3>::new(CoordType::Rrvw, &nodes, mass)?;
    let turn = Rotation3::rotation_between(&Vector3::x(), &along).unwrap_or_else(Rotation3::identity);
    let rotation: Matrix3<f64> = turn.into_inner();
    Ok(b.member(name, member, Pose { position: from, rotation })?)
}

pub(super) fn thick() -> Result<Topic, TaskError> {
    let scene = MastScene::new(STAGES);
    let thin = Mast::build(&scene)?;
    let rest = thin.model.velocities_at_rest();
    let subject = Subject::new(&thin.model, &rest, END);
    let truth = Reference::new(&subject, 2.0)?.motion;
    let mut rows = vec![row(
        "thin",
        thin.model.mechanics().free().len(),
        &Cost::symplectic("", &subject, STEP)?,
        &truth,
    )];
    for radius in [1e-3, 4e-3, 16e-3] {
        let mut failed = None;
        let mast = Mast::build_with(&scene, |b, name, from, to| {
            cylinder(b, name, radius, [from.into(), to.into()]).or_else(|error| {
                failed = Some(error);
                b.bar(name, MastScene::BAR_MASS, from, to)
            })
        });
        let mast: Result<Mast, BuildError> = mast;
        if let Some(error) = failed {
            return Err(error);
        }
        let mast = mast?;
        let rest = mast.model.velocities_at_rest();
        let cost = Cost::symplectic("", &Subject::new(&mast.model, &rest, END), STEP)?;
        let name = format!("radius {} mm", 1e3 * radius);
        rows.push(row(&name, mast.model.mechanics().free().len(), &cost, &truth));
    }
    let header = ["bars", "coordinates", "µs per step", "iterations", "positions [m]", "tensions [N]"];
    Ok(Topic {
        title: "Thin bars or thick ones",
        text: "Guyed mast of 4 stages, 0.512 s in steps of 1 ms: bars as thin rods (two points, no inertia about their axis), or \
               as solid cylinders of the same mass (two points, two vectors). Distances are from the true motion of thin bars: for \
               them the error of the step, for thick ones what the thickness changes as well.",
        table: table(&header.map(String::from), &rows),
    })
}

fn row(name: &str, coordinates: usize, cost: &Cost, truth: &Motion) -> Vec<String> {
    let errors = truth.distance(&cost.motion);
    let [time, iterations] = cost.per_step();
    let [positions, tensions] = [Quantity::Positions, Quantity::Tensions].map(|of| digits(errors[of]));
    vec![name.into(), coordinates.to_string(), time, iterations, positions, tensions]
}
