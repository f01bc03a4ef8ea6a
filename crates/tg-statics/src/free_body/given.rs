//! What is given on each member: cables, weight, loads.

use nalgebra::{SVector, Vector3};
use tg_model::{Load, MemberId, Model, MomentAxes, Place, PlaceError};

use super::{Action, FreeBody, FreeBodyError, Line, Source, Wrench};

/// The member that a place is on; `None` for the ground.
pub(super) fn member_of<const D: usize>(place: Place<D>) -> Option<MemberId> {
    match place {
        Place::Node(member, _) | Place::Material(member, _) | Place::MassCentre(member) => Some(member),
        Place::Anchor(_) => None,
    }
}

pub(super) fn bodies<const D: usize>(
    model: &Model<D>,
    q: &[f64],
    u: &[f64],
) -> Result<Vec<FreeBody<D>>, FreeBodyError> {
    let mut bodies = Vec::new();
    for member in model.members() {
        let centre = model.form(member.mass_centre())?.eval(q);
        let mut given = Vec::new();
        let weight = SVector::<f64, D>::from(model.gravity()) * model.member(member).mass_properties().mass();
        if weight.iter().any(|f| *f != 0.0) {
            given.push(action(Source::Weight, centre, Wrench::force(weight)));
        }
        let name = model.member_name(member).to_owned();
        bodies.push(FreeBody { member, name, given, reactions: Vec::new(), centre });
    }
    let index = |member: MemberId| model.members().position(|m| m == member);
    cables(model, q, u, &mut bodies, index)?;
    loads(model, q, u, &mut bodies, index)?;
    for body in &bodies {
        let not_finite = |what| FreeBodyError::NotFinite { member: body.name.clone(), what };
        if !body.centre.iter().all(|x| x.is_finite()) {
            return Err(not_finite("the position"));
        }
        let finite = |w: &Wrench<D>| w.force.iter().chain(w.moment.iter()).all(|x| x.is_finite());
        if !body.given.iter().all(|a| finite(&a.wrench) && a.point.iter().all(|x| x.is_finite())) {
            return Err(not_finite("a force"));
        }
    }
    Ok(bodies)
}

fn action<const D: usize>(source: Source<D>, point: SVector<f64, D>, wrench: Wrench<D>) -> Action<D> {
    Action { source, point, wrench, determinate: true }
}

fn cables<const D: usize>(
    model: &Model<D>,
    q: &[f64],
    u: &[f64],
    bodies: &mut [FreeBody<D>],
    index: impl Fn(MemberId) -> Option<usize>,
) -> Result<(), FreeBodyError> {
    let rest = vec![0.0; q.len()];
    for cable in model.cables() {
        let tension = model.cable(cable, q, &rest, u).tension;
        let [from, to] = model.cable_places(cable);
        for (near, far) in [(from, to), (to, from)] {
            let Some(k) = member_of(near).and_then(&index) else { continue };
            let (point, other) = (model.form(near)?.eval(q), model.form(far)?.eval(q));
            let line = Line::through(&point, &other);
            let source = Source::Cable { name: model.cable_name(cable).into(), tension, line };
            // A spring of no free length may have no length either, and then no direction.
            let force = if tension == 0.0 { SVector::zeros() } else { line.direction * tension };
            bodies[k].given.push(action(source, point, Wrench::force(force)));
        }
    }
    Ok(())
}

fn loads<const D: usize>(
    model: &Model<D>,
    q: &[f64],
    u: &[f64],
    bodies: &mut [FreeBody<D>],
    index: impl Fn(MemberId) -> Option<usize>,
) -> Result<(), FreeBodyError> {
    for load in model.loads() {
        let components = &u[model.load_inputs(load)];
        let source = Source::Load { name: model.load_name(load).into() };
        match model.load(load) {
            Load::Force(place) => {
                let Some(k) = member_of(place).and_then(&index) else { continue };
                let force = Wrench::force(SVector::from_column_slice(components));
                bodies[k].given.push(action(source, model.form(place)?.eval(q), force));
            }
            Load::Moment(member, axes) => {
                let Some(k) = index(member) else { continue };
                let moment = moment(model, member, axes, components, q)?;
                let centre = bodies[k].centre;
                bodies[k].given.push(action(source, centre, Wrench::moment(moment)));
            }
            Load::JointMoments(bar) => {
                let Some(k) = index(bar) else { continue };
                let [x, y, _] = joint_axes(&bar_direction(model, bar, q));
                let moment = x * components[0] + y * components[1];
                let centre = bodies[k].centre;
                bodies[k].given.push(action(source, centre, Wrench::moment(moment)));
            }
        }
    }
    Ok(())
}

/// A moment along the axes of space; of that on a bar, which has no spin, the part that acts.
fn moment<const D: usize>(
    model: &Model<D>,
    member: MemberId,
    axes: MomentAxes,
    components: &[f64],
    q: &[f64],
) -> Result<Vector3<f64>, FreeBodyError> {
    if D == 2 {
        return Ok(Vector3::z() * components[0]);
    }
    let moment = Vector3::from_column_slice(components);
    if model.member(member).coord_type().span() == 1 {
        let along = bar_direction(model, member, q);
        return Ok(moment - along * along.dot(&moment));
    }
    if axes == MomentAxes::Space {
        return Ok(moment);
    }
    let pose = model
        .pose(member, q)
        .map_err(|source| PlaceError::NotOfMember { member: model.member_name(member).into(), source })?;
    let rotation = pose.pose.rotation;
    Ok(Vector3::from_fn(|i, _| (0..D).map(|k| rotation[(i, k)] * moment[k]).sum()))
}

/// Unit vector along a bar, from its first node.
pub(super) fn bar_direction<const D: usize>(model: &Model<D>, bar: MemberId, q: &[f64]) -> Vector3<f64> {
    let nodes = model.member_nodes(bar, q);
    let along = match nodes.as_slice() {
        [from, to] if model.member(bar).coord_type().points() == 2 => to - from,
        [_, along, ..] => *along,
        _ => SVector::zeros(),
    };
    super::in_space(&along.normalize())
}

/// Axes of the universal joint that holds a bar: x of space, the second axis, their normal; antiprism paper (50).
pub(super) fn joint_axes(along: &Vector3<f64>) -> [Vector3<f64>; 3] {
    let angle = (-along.y).atan2(along.z);
    let (sin, cos) = angle.sin_cos();
    [Vector3::x(), Vector3::new(0.0, cos, sin), Vector3::new(0.0, -sin, cos)]
}
