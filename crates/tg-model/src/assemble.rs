//! From a builder to a model: numbering of shared nodes, supports, constraints, checks.

use std::sync::Arc;

use crate::cables::Cables;
use crate::constraints::{Constraint, ConstraintSource, Constraints, Named};
use crate::drive::Drive;
use crate::error::BuildError;
use crate::form::{Form, add_to_node};
use crate::inertia::{self, Inertia};
use crate::load::Load;
use crate::model::Model;
use crate::moments::Moments;
use crate::nodes::{MEETING, Nodes};
use crate::parts::{Joining, JointPart, MemberId, Parts, Place, Redundancies, axis_name};
use crate::placed::{Cable, PlacedMember};
use crate::redundancy;
use crate::report::BuildReport;
use crate::supports::{Supports, check_held};

pub(crate) fn assemble<const D: usize>(parts: Parts<D>) -> Result<Model<D>, BuildError> {
    let parts = Arc::new(parts);
    let owned = Arc::clone(&parts);
    let parts = parts.as_ref();
    let mut nodes = Nodes::new(parts);
    nodes.check_resolved()?;
    let allowed = MEETING * nodes.size();
    share_points(parts, &mut nodes, allowed)?;
    nodes.number();

    let supports = Supports::new(parts, &mut nodes)?;
    let mut q = nodes.initial();
    let mut v = vec![0.0; q.len()];
    let drive = Drive::new(parts, &supports.prescribed, &q);
    drive.prescribe(0.0, &mut q, &mut v);
    let free: Vec<usize> = (0..q.len()).filter(|&i| supports.prescribed[i].is_none()).collect();
    if free.is_empty() {
        return Err(BuildError::NothingFree);
    }
    let is_free = |i: usize| supports.prescribed[i].is_none();

    let mut list = intrinsic(parts, &nodes);
    list.extend(joints(parts, &nodes, allowed)?);
    list.extend(supports.constraints);
    let (mut list, held): (Vec<_>, Vec<_>) =
        list.into_iter().partition(|named| named.constraint.coordinates().into_iter().any(is_free));
    held.iter().try_for_each(|named| check_held(named, &q, &v))?;

    let redundant = redundancy::find(&list, &free, &q, &v)?;
    let mut dropped = Vec::new();
    if !redundant.rows.is_empty() {
        if parts.redundancies == Redundancies::Reject {
            return Err(BuildError::Redundant { list: redundant.named, tolerance: redundancy::TOLERANCE });
        }
        redundant.check_consistent(&list, allowed)?;
        for &row in redundant.rows.iter().rev() {
            dropped.push(list.remove(row).constraint);
        }
    }

    let (cables, in_equations, idle_cables) = cables(parts, &nodes, is_free)?;
    let load_starts = load_starts(parts);
    let forces = forces(parts, &nodes, &load_starts)?;
    let moments = Moments::of(parts, &nodes, |k| load_starts[k], is_free)?;
    let mut stiffness_pattern = in_equations.stiffness_pattern::<D>();
    let cable_entries = stiffness_pattern.len();
    stiffness_pattern.extend(moments.stiffness_pattern());
    let members: Vec<PlacedMember<D>> = nodes.place_members(parts);
    let intrinsic = list.iter().filter(|c| matches!(c.constraint, Constraint::Dot { .. })).count();
    let report = BuildReport {
        coordinates: q.len(),
        free: free.len(),
        intrinsic,
        extrinsic: list.len() - intrinsic,
        dropped_constraints: held.len(),
        idle_cables,
        redundant: redundant.named,
        redundancy_tolerance: redundancy::TOLERANCE,
    };
    let constraints = Constraints::new(&list.iter().map(|c| c.constraint.clone()).collect::<Vec<_>>());
    let mass = inertia::assemble(&members);
    Ok(Model {
        inertia: Inertia::new(q.len(), &mass),
        mass,
        jacobian_pattern: constraints.jacobian_pattern::<D>(),
        hessian: constraints.hessian::<D>(),
        constraints,
        dropped: Constraints::new(&ordered(dropped)),
        constraint_sources: list.iter().map(|c| c.source.clone()).collect(),
        constraint_names: list.into_iter().map(|c| c.name).collect(),
        node_names: nodes.names(),
        stiffness_pattern,
        cable_entries,
        damping_pattern: in_equations.damping_pattern::<D>(),
        in_equations,
        cables,
        parts: owned,
        forces,
        moments,
        load_starts,
        anchors: nodes.anchors(),
        weight: weight(parts, &members, q.len()),
        members,
        drive,
        size: nodes.size(),
        free,
        initial: q,
        report,
    })
}

/// First input of each load behind the rest lengths, and the end of all.
fn load_starts<const D: usize>(parts: &Parts<D>) -> Vec<usize> {
    let mut starts = vec![parts.cables.len()];
    for load in &parts.loads {
        starts.push(starts[starts.len() - 1] + load.components.len());
    }
    starts
}

fn forces<const D: usize>(
    parts: &Parts<D>,
    nodes: &Nodes<D>,
    starts: &[usize],
) -> Result<Vec<(Form<D>, usize)>, BuildError> {
    let mut forces = Vec::new();
    for (part, &start) in parts.loads.iter().zip(starts) {
        if let Load::Force(place) = part.load {
            forces.push((nodes.point(parts, "load", &part.name, place)?, start));
        }
    }
    Ok(forces)
}

/// Generalised force of gravity over the full coordinates: the weight at each mass centre (Sec. 3.3).
fn weight<const D: usize>(parts: &Parts<D>, members: &[PlacedMember<D>], coordinates: usize) -> Vec<f64> {
    let mut weight = vec![0.0; coordinates];
    for placed in members {
        let force = parts.gravity * placed.member.mass_properties().mass();
        for (&node, w) in placed.nodes.iter().zip(placed.member.mass_centre_weights().as_slice()) {
            add_to_node(&mut weight, node, &(force * *w));
        }
    }
    weight
}

/// Dot products before linear constraints, as the flat list wants them.
fn ordered<const D: usize>(mut list: Vec<Constraint<D>>) -> Vec<Constraint<D>> {
    list.sort_by_key(|c| matches!(c, Constraint::Linear { .. }));
    list
}

/// Joints by sharing: their points become one node.
fn share_points<const D: usize>(
    parts: &Parts<D>,
    nodes: &mut Nodes<D>,
    allowed: f64,
) -> Result<(), BuildError> {
    for joint in parts.joints.iter().filter(|joint| joint.joining == Joining::Share) {
        let mut places = joint.places.iter();
        let Some(&first) = places.next() else { continue };
        let a = nodes.shareable(parts, &joint.name, first)?;
        for &other in places {
            let b = nodes.shareable(parts, &joint.name, other)?;
            if a == b {
                return Err(with_itself(joint));
            }
            let distance = (nodes.position(b) - nodes.position(a)).norm();
            meet(parts, nodes, joint, (first, other), distance, allowed)?;
            nodes.merge(a, b);
        }
    }
    match nodes.self_joined() {
        Some(m) => Err(BuildError::SelfJoined { member: parts.members[m].name.clone() }),
        None => Ok(()),
    }
}

fn with_itself<const D: usize>(joint: &JointPart<D>) -> BuildError {
    BuildError::MeaninglessJoint { name: joint.name.clone(), what: "joins a point with itself" }
}

fn meet<const D: usize>(
    parts: &Parts<D>,
    nodes: &Nodes<D>,
    joint: &JointPart<D>,
    (first, second): (Place<D>, Place<D>),
    distance: f64,
    allowed: f64,
) -> Result<(), BuildError> {
    if distance <= allowed {
        return Ok(());
    }
    Err(BuildError::InconsistentJoint {
        name: joint.name.clone(),
        first: nodes.describe(parts, first),
        second: nodes.describe(parts, second),
        distance,
        allowed,
    })
}

/// Intrinsic constraints of all members: eqs. (5), (10), (13) through the selection (22).
fn intrinsic<const D: usize>(parts: &Parts<D>, nodes: &Nodes<D>) -> Vec<Named<D>> {
    let mut list = Vec::new();
    for (m, part) in parts.members.iter().enumerate() {
        for dot in part.member.constraints() {
            list.push(Named {
                name: format!("rigidity {} of \"{}\"", dot.label(), part.name),
                source: ConstraintSource::Rigidity(MemberId(m)),
                constraint: Constraint::Dot {
                    a: nodes.member_form(m, dot.a()),
                    b: nodes.member_form(m, dot.b()),
                    value: dot.value(),
                    scale: dot.scale(),
                },
            });
        }
    }
    list
}

/// Joints by constraints, eq. (19): k places give k-1 equations per component.
fn joints<const D: usize>(
    parts: &Parts<D>,
    nodes: &Nodes<D>,
    allowed: f64,
) -> Result<Vec<Named<D>>, BuildError> {
    let q = nodes.initial();
    let mut list = Vec::new();
    for joint in parts.joints.iter().filter(|joint| joint.joining == Joining::Constrain) {
        let mut places = joint.places.iter();
        let Some(&first) = places.next() else { continue };
        let a = nodes.point(parts, "joint", &joint.name, first)?;
        for &other in places {
            let gap = nodes.point(parts, "joint", &joint.name, other)?.minus(&a);
            meet(parts, nodes, joint, (first, other), gap.eval(&q).norm(), allowed)?;
            // A material point at a basic point has its weights to rounding only.
            if gap.terms().iter().all(|(_, w)| w.abs() <= MEETING) {
                return Err(with_itself(joint));
            }
            let scale = nodes.scale(parts, &[first, other]);
            list.extend((0..D).map(|axis| Named {
                name: format!(
                    "{} component of joint \"{}\" at {}",
                    axis_name(axis),
                    joint.name,
                    nodes.describe(parts, other)
                ),
                source: ConstraintSource::Joint {
                    name: joint.name.clone(),
                    at: nodes.describe(parts, other),
                    axis,
                },
                constraint: Constraint::component(&gap, axis, scale),
            }));
        }
    }
    Ok(list)
}

type AllCables<const D: usize> = (Vec<Cable<D>>, Cables, Vec<String>);

fn cables<const D: usize>(
    parts: &Parts<D>,
    nodes: &Nodes<D>,
    is_free: impl Fn(usize) -> bool,
) -> Result<AllCables<D>, BuildError> {
    let q = nodes.initial();
    let (mut list, mut idle) = (Vec::new(), Vec::new());
    for part in &parts.cables {
        let from = nodes.point(parts, "cable", &part.name, part.from)?;
        let form = nodes.point(parts, "cable", &part.name, part.to)?.minus(&from);
        let length = form.eval(&q).norm();
        if length <= MEETING * nodes.size() {
            return Err(BuildError::ZeroLengthCable {
                name: part.name.clone(),
                from: nodes.describe(parts, part.from),
                to: nodes.describe(parts, part.to),
            });
        }
        if !form.terms().iter().any(|&(node, _)| (node * D..node * D + D).any(&is_free)) {
            idle.push(part.name.clone());
        }
        list.push(Cable { name: part.name.clone(), form, law: part.law.clone() });
    }
    let sets = Cables::of(&list, is_free);
    Ok((list, sets, idle))
}
