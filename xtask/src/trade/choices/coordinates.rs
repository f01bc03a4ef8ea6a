//! In which coordinates a body is described, and how members are joined.

use tg_cases::tower::{self, Joints, Setup, Tower};
use tg_coords::{CoordType, MassProperties, Member, Pose, Twist};
use tg_model::{Model, ModelBuilder};
use tg_trade::{Reference, Subject};

use super::{Cost, Topic, against, of_rows, rows, truth};
use crate::TaskError;

/// Step \[s\].
const STEP: f64 = 1e-3;
/// Simulated time: a multiple of 128 steps \[s\].
const END: f64 = 0.512;

/// Size of the body \[m\].
const SIZE: f64 = 0.1;

/// A heavy top of 0.3 kg and 0.1 m, hinged at its tip, in coordinates of a type with points and vectors of a length \[m\].
fn top(coord_type: CoordType, length: f64) -> Result<(Model<3>, Vec<f64>), TaskError> {
    let mass = MassProperties::from_principal_moments(0.3, [0.03, 0.02, 0.08].into(), [7e-4, 5e-4, 9e-4])?;
    let axis = |k: usize| std::array::from_fn::<f64, 3, _>(|i| if i + 1 == k { length } else { 0.0 }).into();
    let nodes: Vec<_> = (0..coord_type.points() + coord_type.vectors()).map(axis).collect();
    let member = Member::<3>::new(coord_type, &nodes, mass)?;
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -9.81])?;
    let pose = Pose::from_axis_angle([0.3, -0.2, 0.7].into(), [1.0, 0.5, 0.0].into(), 0.6)?;
    let top = b.member("top", member, pose)?;
    b.fix("tip", top.node(0))?;
    let model = b.build()?;
    let (q, mut v) = (model.initial_coordinates(), model.velocities_at_rest());
    model.set_twist(top, &Twist::spatial([0.0; 3].into(), [1.0, -2.0, 9.0].into()), &q, &mut v)?;
    Ok((model, v))
}

pub(super) fn coordinate_type() -> Result<Topic, TaskError> {
    let variants = [
        ("one point, three unit vectors", CoordType::Ruvw, 1.0),
        ("one point, three vectors of body size", CoordType::Ruvw, SIZE),
        ("two points, two vectors of body size", CoordType::Rrvw, SIZE),
        ("four points of body size", CoordType::Rrrr, SIZE),
        ("one point, three vectors of 1000 m", CoordType::Ruvw, 1e3),
    ];
    // Each type has points of its own: positions are compared with the same type's truth, and the energy is the same for all.
    let mut all = Vec::new();
    for (name, coord_type, length) in variants {
        let (model, velocities) = top(coord_type, length)?;
        let subject = Subject::new(&model, &velocities, END);
        let truth = Reference::new(&subject, 1.0)?.motion;
        all.extend(rows(&[Cost::symplectic(name, &subject, STEP)?], &truth));
    }
    Ok(Topic {
        title: "Coordinate type",
        text: "A heavy top of 0.1 m spinning about its tip, 0.512 s in steps of 1 ms, in natural coordinates of several types. \
               The motion is the same for all up to rounding (tests of `tg-integrate`); positions are those of the type's \
               own basic points, so that a fixed point alone shows no error. There are no cables.",
        table: of_rows("coordinates", &all),
    })
}

pub(super) fn joints() -> Result<Topic, TaskError> {
    let with = |joints| {
        let types = [CoordType::Rrr; 3];
        Tower::new(&tower::Choices { joints, types, ..tower::Choices::paper(Setup::Un) })
    };
    let variants = [
        ("all shared", with(Joints::Shared)?),
        ("two shared, five constrained (the paper's)", with(Joints::Paper)?),
        ("all constrained", with(Joints::Constrained)?),
    ];
    let rest = variants[0].1.model.velocities_at_rest();
    let truth = truth(&Subject::new(&variants[0].1.model, &rest, END))?;
    let mut costs = Vec::new();
    for (name, tower) in &variants {
        let rest = tower.model.velocities_at_rest();
        let unknowns = tower.model.mechanics().free().len() + tower.model.mechanics().sizes().constraints;
        let name = format!("{name}: {unknowns} unknowns");
        costs.push(Cost::symplectic(name, &Subject::new(&tower.model, &rest, END), STEP)?);
    }
    Ok(Topic {
        title: "Sharing or extrinsic joints",
        text: "The seven joints of the planar tower UN by sharing basic points or by constraints, 0.512 s in steps of 1 ms, \
               errors against the true motion.",
        table: against("joints", &costs, &truth),
    })
}
