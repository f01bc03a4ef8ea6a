//! From a builder to a model: numbering of shared nodes, supports, constraints, checks.

use crate::builder::{Joining, JointPart, ModelBuilder, Place, Redundancies, axis_name};
use crate::cables::Cables;
use crate::constraints::{Constraint, Constraints};
use crate::drive::{Drive, Prescription};
use crate::error::BuildError;
use crate::form::{Form, add_to_node};
use crate::inertia::{self, Inertia};
use crate::model::{Cable, Model, PlacedMember};
use crate::nodes::Nodes;
use crate::redundancy;
use crate::report::BuildReport;

/// Points that are to meet may be apart by this part of the structure's size: rounding of hand-written coordinates
/// passes, a misplaced member does not.
const MEETING: f64 = 1e-9;

pub(crate) fn assemble<const D: usize>(builder: ModelBuilder<D>) -> Result<Model<D>, BuildError> {
    let mut nodes = Nodes::new(&builder);
    let allowed = MEETING * nodes.size();
    share_points(&builder, &mut nodes, allowed)?;
    nodes.number();

    let supports = Supports::new(&builder, &mut nodes)?;
    let mut q = nodes.initial();
    let mut v = vec![0.0; q.len()];
    let drive = Drive::new(&builder, &supports.prescribed, &q);
    drive.prescribe(0.0, &mut q, &mut v);
    let free: Vec<usize> = (0..q.len()).filter(|&i| supports.prescribed[i].is_none()).collect();
    if free.is_empty() {
        return Err(BuildError::NothingFree);
    }
    let is_free = |i: usize| supports.prescribed[i].is_none();

    let mut list = intrinsic(&builder, &nodes);
    list.extend(joints(&builder, &nodes, allowed)?);
    list.extend(supports.constraints);
    let (mut list, held): (Vec<_>, Vec<_>) =
        list.into_iter().partition(|named| named.constraint.coordinates().into_iter().any(is_free));
    held.iter().try_for_each(|named| check_held(named, &q, &v))?;

    let redundant = redundancy::find(&list, &free, &q, &v)?;
    let mut dropped = Vec::new();
    if !redundant.rows.is_empty() {
        if builder.redundancies == Redundancies::Reject {
            return Err(BuildError::Redundant { list: redundant.named, tolerance: redundancy::TOLERANCE });
        }
        redundant.check_consistent(&list, allowed)?;
        for &row in redundant.rows.iter().rev() {
            dropped.push(list.remove(row).constraint);
        }
    }

    let (cables, in_equations, idle_cables) = cables(&builder, &nodes, is_free)?;
    let loads = builder
        .loads
        .iter()
        .map(|load| nodes.point(&builder, "load", &load.name, load.place))
        .collect::<Result<_, _>>()?;
    let members: Vec<PlacedMember<D>> = nodes.place_members(&builder);
    let mut weight = vec![0.0; q.len()];
    for placed in &members {
        let force = builder.gravity * placed.member.mass_properties().mass();
        for (&node, w) in placed.nodes.iter().zip(placed.member.mass_centre_weights().as_slice()) {
            add_to_node(&mut weight, node, &(force * *w));
        }
    }
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
        constraint_names: list.into_iter().map(|c| c.name).collect(),
        node_names: nodes.names(),
        stiffness_pattern: in_equations.stiffness_pattern::<D>(),
        damping_pattern: in_equations.damping_pattern::<D>(),
        in_equations,
        cables,
        loads,
        load_names: builder.loads.iter().map(|load| load.name.clone()).collect(),
        anchors: nodes.anchors(),
        members,
        weight,
        drive,
        free,
        initial: q,
        report,
    })
}

/// A constraint and the words for it.
pub(crate) struct Named<const D: usize> {
    pub(crate) name: String,
    pub(crate) constraint: Constraint<D>,
}

/// Dot products before linear constraints, as the flat list wants them.
fn ordered<const D: usize>(mut list: Vec<Constraint<D>>) -> Vec<Constraint<D>> {
    list.sort_by_key(|c| matches!(c, Constraint::Linear { .. }));
    list
}

/// Joints by sharing: their points become one node.
fn share_points<const D: usize>(
    builder: &ModelBuilder<D>,
    nodes: &mut Nodes<D>,
    allowed: f64,
) -> Result<(), BuildError> {
    for joint in builder.joints.iter().filter(|joint| joint.joining == Joining::Share) {
        let mut places = joint.places.iter();
        let Some(&first) = places.next() else { continue };
        let a = nodes.shareable(builder, &joint.name, first)?;
        for &other in places {
            let b = nodes.shareable(builder, &joint.name, other)?;
            if a == b {
                return Err(with_itself(joint));
            }
            let distance = (nodes.position(b) - nodes.position(a)).norm();
            meet(builder, nodes, joint, (first, other), distance, allowed)?;
            nodes.merge(a, b);
        }
    }
    match nodes.self_joined() {
        Some(m) => Err(BuildError::SelfJoined { member: builder.members[m].name.clone() }),
        None => Ok(()),
    }
}

fn with_itself<const D: usize>(joint: &JointPart<D>) -> BuildError {
    BuildError::MeaninglessJoint { name: joint.name.clone(), what: "joins a point with itself" }
}

fn meet<const D: usize>(
    builder: &ModelBuilder<D>,
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
        first: nodes.describe(builder, first),
        second: nodes.describe(builder, second),
        distance,
        allowed,
    })
}

/// Intrinsic constraints of all members: eqs. (5), (10), (13) through the selection (22).
fn intrinsic<const D: usize>(builder: &ModelBuilder<D>, nodes: &Nodes<D>) -> Vec<Named<D>> {
    let mut list = Vec::new();
    for (m, part) in builder.members.iter().enumerate() {
        for dot in part.member.constraints() {
            list.push(Named {
                name: format!("rigidity {} of \"{}\"", dot.label(), part.name),
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
    builder: &ModelBuilder<D>,
    nodes: &Nodes<D>,
    allowed: f64,
) -> Result<Vec<Named<D>>, BuildError> {
    let q = nodes.initial();
    let mut list = Vec::new();
    for joint in builder.joints.iter().filter(|joint| joint.joining == Joining::Constrain) {
        let mut places = joint.places.iter();
        let Some(&first) = places.next() else { continue };
        let a = nodes.point(builder, "joint", &joint.name, first)?;
        for &other in places {
            let gap = nodes.point(builder, "joint", &joint.name, other)?.minus(&a);
            meet(builder, nodes, joint, (first, other), gap.eval(&q).norm(), allowed)?;
            // A material point at a basic point has its weights to rounding only.
            if gap.terms().iter().all(|(_, w)| w.abs() <= MEETING) {
                return Err(with_itself(joint));
            }
            let scale = nodes.scale(builder, &[first, other]);
            list.extend((0..D).map(|axis| Named {
                name: format!(
                    "{} component of joint \"{}\" at {}",
                    axis_name(axis),
                    joint.name,
                    nodes.describe(builder, other)
                ),
                constraint: component(&gap, axis, scale),
            }));
        }
    }
    Ok(list)
}

/// One component of a form that is to vanish.
fn component<const D: usize>(form: &Form<D>, axis: usize, scale: f64) -> Constraint<D> {
    Constraint::Linear { terms: form.terms().iter().map(|&(n, w)| (n * D + axis, w)).collect(), scale }
}

/// Which components are prescribed, by whom, and the constraints of supports at material points.
struct Supports<const D: usize> {
    prescribed: Vec<Option<Prescription>>,
    constraints: Vec<Named<D>>,
}

impl<const D: usize> Supports<D> {
    fn new(builder: &ModelBuilder<D>, nodes: &mut Nodes<D>) -> Result<Self, BuildError> {
        let mut by_support: Vec<(usize, usize)> = Vec::new();
        let mut constraints = Vec::new();
        for (s, support) in builder.supports.iter().enumerate() {
            let form = match support.place {
                Place::Node(..) => nodes.node_form(builder, "support", &support.name, support.place)?,
                place => nodes.point(builder, "support", &support.name, place)?,
            };
            let coordinate = match form.terms() {
                [(node, 1.0)] => node * D + support.axis,
                _ => {
                    let hidden = nodes.add_hidden(&form, &support.name);
                    let gap = form.minus(&Form::new([(hidden, 1.0)]));
                    let scale = nodes.scale(builder, &[support.place]);
                    constraints.push(Named {
                        name: format!("support \"{}\"", support.name),
                        constraint: component(&gap, support.axis, scale),
                    });
                    hidden * D + support.axis
                }
            };
            by_support.push((coordinate, s));
        }
        let mut prescribed = vec![None; nodes.count() * D];
        for anchor in nodes.fixed() {
            prescribed[anchor * D..anchor * D + D].fill(Some(Prescription::AtRest));
        }
        for (coordinate, s) in by_support {
            if let Some(Prescription::By(other)) = prescribed[coordinate] {
                let (first, second) = (&builder.supports[other], &builder.supports[s]);
                if first.offset != second.offset {
                    return Err(BuildError::ContradictorySupports {
                        first: first.name.clone(),
                        second: second.name.clone(),
                        axis: axis_name(second.axis),
                        place: nodes.describe(builder, second.place),
                    });
                }
            }
            prescribed[coordinate] = Some(Prescription::By(s));
        }
        Ok(Self { prescribed, constraints })
    }
}

/// A constraint that supports hold wholly: it must be satisfied, also in its rate; then it is dropped.
fn check_held<const D: usize>(named: &Named<D>, q: &[f64], v: &[f64]) -> Result<(), BuildError> {
    let flat = Constraints::new(std::slice::from_ref(&named.constraint));
    let pattern = flat.jacobian_pattern::<D>();
    let mut row = vec![0.0; pattern.len()];
    flat.jacobian::<D>(q, &mut row);
    let parts = || row.iter().zip(&pattern).map(|(a, &(_, i))| a * v[i]);
    let speed: f64 = parts().map(f64::abs).sum();
    let rate = if speed > 0.0 { parts().sum::<f64>().abs() / speed } else { 0.0 };
    let violation = rate.max(named.constraint.residual(q).abs() / named.constraint.scale());
    if violation <= MEETING {
        Ok(())
    } else {
        Err(BuildError::UnsatisfiableConstraint { constraint: named.name.clone(), violation })
    }
}

type AllCables<const D: usize> = (Vec<Cable<D>>, Cables, Vec<String>);

fn cables<const D: usize>(
    builder: &ModelBuilder<D>,
    nodes: &Nodes<D>,
    is_free: impl Fn(usize) -> bool,
) -> Result<AllCables<D>, BuildError> {
    let q = nodes.initial();
    let (mut list, mut sets, mut idle) = (Vec::new(), Cables::default(), Vec::new());
    let moves = |node: usize| (node * D..node * D + D).any(&is_free);
    for (id, part) in builder.cables.iter().enumerate() {
        let from = nodes.point(builder, "cable", &part.name, part.from)?;
        let form = nodes.point(builder, "cable", &part.name, part.to)?.minus(&from);
        let length = form.eval(&q).norm();
        if length <= MEETING * nodes.size() {
            return Err(BuildError::ZeroLengthCable {
                name: part.name.clone(),
                from: nodes.describe(builder, part.from),
                to: nodes.describe(builder, part.to),
            });
        }
        if form.terms().iter().any(|&(node, _)| moves(node)) {
            sets.push(id, &form, &part.law, |a, b| moves(a) && moves(b));
        } else {
            idle.push(part.name.clone());
        }
        list.push(Cable { name: part.name.clone(), form, law: part.law.clone() });
    }
    Ok((list, sets, idle))
}
