//! Random structures of every coordinate type, law, joint and end, in the plane and in space.

use std::sync::Arc;

use nalgebra::{SMatrix, SVector, Vector3};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::{
    AnchorId, BuildError, CableId, CableLaw, Joining, MemberId, Model, ModelBuilder, Place, Signal, Tension,
    TensionLaw,
};

use super::Random;

/// What differs between the plane and space.
pub(crate) trait Space<const D: usize> {
    const TYPES: &'static [CoordType];
    fn pose(position: [f64; D], r: &mut Random) -> Pose<D>;
}

pub(crate) struct Plane;
pub(crate) struct Spatial;

impl Space<2> for Plane {
    const TYPES: &'static [CoordType] =
        &[CoordType::Ruv, CoordType::Rrv, CoordType::Rrr, CoordType::Ru, CoordType::Rr, CoordType::R];

    fn pose(position: [f64; 2], r: &mut Random) -> Pose<2> {
        Pose::planar(position[0], position[1], 3.0 * r.value())
    }
}

impl Space<3> for Spatial {
    const TYPES: &'static [CoordType] = &[
        CoordType::Ruvw,
        CoordType::Rrvw,
        CoordType::Rrrw,
        CoordType::Rrrr,
        CoordType::Ru,
        CoordType::Rr,
        CoordType::R,
    ];

    fn pose(position: [f64; 3], r: &mut Random) -> Pose<3> {
        Pose::from_axis_angle(position.into(), Vector3::from(r.array(1.0)), 3.0 * r.value()).unwrap()
    }
}

/// f = a s + b s³ + c l̇ (1 + s²), s = l - μ.
pub(crate) struct Cubic {
    pub(crate) a: f64,
    pub(crate) b: f64,
    pub(crate) c: f64,
}

impl TensionLaw for Cubic {
    fn tension(&self, length: f64, rate: f64, rest: f64) -> Tension {
        let s = length - rest;
        Tension {
            force: self.a * s + self.b * s.powi(3) + self.c * rate * (1.0 + s * s),
            by_length: self.a + 3.0 * self.b * s * s + 2.0 * self.c * rate * s,
            by_rate: self.c * (1.0 + s * s),
        }
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        let s = length - rest;
        0.5 * self.a * s * s + 0.25 * self.b * s.powi(4)
    }

    fn damped(&self) -> bool {
        self.c != 0.0
    }
}

pub(crate) const KAPPA: f64 = 100.0;
pub(crate) const ETA: f64 = 5.0;

/// Every law, in the order in which the cables of a mixed structure repeat them.
pub(crate) fn laws() -> Vec<CableLaw> {
    vec![
        CableLaw::slacking(KAPPA).with_damping(ETA),
        CableLaw::linear(KAPPA),
        CableLaw::User(Arc::new(Cubic { a: 80.0, b: 50.0, c: 4.0 })),
        CableLaw::slacking(KAPPA),
        CableLaw::linear(KAPPA).with_damping(ETA),
        CableLaw::User(Arc::new(Cubic { a: 60.0, b: 30.0, c: 0.0 })),
    ]
}

pub(crate) struct Mixed<const D: usize> {
    pub(crate) model: Model<D>,
    /// Every member with its type.
    pub(crate) members: Vec<(MemberId, Member<D>)>,
    pub(crate) cables: Vec<(CableId, CableLaw)>,
}

/// Local nodes with base vectors of size one half in clearly different directions.
fn local_nodes<const D: usize>(kind: CoordType, r: &mut Random) -> Vec<SVector<f64, D>> {
    let origin = SVector::<f64, D>::from(r.array(0.2));
    let mut nodes = vec![origin];
    for a in 1..kind.nodes() {
        let mut vector = SVector::<f64, D>::from(r.array(0.15));
        vector[a - 1] += 0.6;
        nodes.push(if kind.is_point(a) { origin + vector } else { vector });
    }
    nodes
}

fn base_vector<const D: usize>(member: &Member<D>, k: usize) -> SVector<f64, D> {
    let nodes = member.local_nodes();
    if member.coord_type().is_point(k + 1) { nodes[k + 1] - nodes[0] } else { nodes[k + 1] }
}

/// A random material point that the member can carry.
pub(crate) fn local_point<const D: usize>(member: &Member<D>, r: &mut Random) -> SVector<f64, D> {
    let mut point = member.local_nodes()[0];
    for k in 0..member.coord_type().span() {
        point += base_vector(member, k) * r.value();
    }
    point
}

pub(crate) fn member<const D: usize>(kind: CoordType, r: &mut Random) -> Member<D> {
    let nodes = local_nodes::<D>(kind, r);
    let mass = r.within(1.0, 3.0);
    let properties = match kind {
        CoordType::R => MassProperties::point(mass, nodes[0]).unwrap(),
        CoordType::Ru | CoordType::Rr => {
            let u = if kind == CoordType::Rr { nodes[1] - nodes[0] } else { nodes[1] };
            MassProperties::rod(mass, nodes[0] + u * 0.4, u, r.within(0.05, 0.1)).unwrap()
        }
        _ => {
            let diagonal = SVector::<f64, D>::from_fn(|_, _| r.within(0.03, 0.1));
            let mut j = SMatrix::<f64, D, D>::from_diagonal(&diagonal);
            j[(0, 1)] = 0.01;
            j[(1, 0)] = 0.01;
            MassProperties::from_second_moment(mass, SVector::from(r.array(0.3)), j).unwrap()
        }
    };
    Member::new(kind, &nodes, properties).unwrap()
}

/// A random structure; with `ground` also anchors (one moving), supports of single components, loads and gravity.
pub(crate) fn mixed<S: Space<D>, const D: usize>(seed: u64, ground: bool) -> Mixed<D> {
    try_mixed::<S, D>(seed, ground).unwrap()
}

fn try_mixed<S: Space<D>, const D: usize>(seed: u64, ground: bool) -> Result<Mixed<D>, BuildError> {
    let r = &mut Random::new(seed);
    let mut b = ModelBuilder::<D>::new();
    let (mut members, mut poses) = (Vec::new(), Vec::new());
    for (k, &kind) in S::TYPES.iter().enumerate() {
        let mut at = r.array(0.2);
        at[0] += 2.0 * k as f64;
        at[1] += (k % 2) as f64;
        let (body, pose) = (member(kind, r), S::pose(at, r));
        members.push((b.member(&format!("{kind} {k}"), body.clone(), pose)?, body));
        poses.push(pose);
    }
    // One bar shares a basic point with the first two members, another is pinned to material points of the next two.
    let ends = [0, 1].map(|k| poses[k].apply_point(&members[k].1.local_nodes()[0]).into());
    let bar = b.bar("sharing bar", 0.7, ends[0], ends[1])?;
    for k in 0..2 {
        b.joint(&format!("share {k}"), &[members[k].0.node(0), bar.node(k)], Joining::Share)?;
    }
    let local = [2, 3].map(|k: usize| local_point(&members[k].1, r));
    let ends = [0, 1].map(|k| poses[k + 2].apply_point(&local[k]).into());
    let pinned = b.bar("pinned bar", 0.6, ends[0], ends[1])?;
    for k in 0..2 {
        let place = members[k + 2].0.at(local[k].into());
        b.joint(&format!("pin {k}"), &[place, pinned.node(k)], Joining::Constrain)?;
    }
    let rod = |ends: [[f64; D]; 2], mass| Member::thin_rod(mass, ends[0].into(), ends[1].into()).unwrap();
    let shared_ends = [0, 1].map(|k| poses[k].apply_point(&members[k].1.local_nodes()[0]).into());
    let bodies = members.len();
    members.push((bar, rod(shared_ends, 0.7)));
    members.push((pinned, rod(ends, 0.6)));

    let mut anchors = Vec::new();
    if ground {
        anchors = supports_and_loads(&mut b, &members, r)?;
    }
    let mut cables = Vec::new();
    for (c, law) in laws().into_iter().cycle().take(4 * bodies).enumerate() {
        let (i, j) = (c % bodies, (c + 1 + c / bodies) % bodies);
        let mut end = |k: usize| -> Place<D> {
            match r.index(4) {
                0 => members[k].0.mass_centre(),
                1 => members[k].0.node(0),
                _ => members[k].0.at(local_point(&members[k].1, r).into()),
            }
        };
        let from = end(i);
        let to = if ground && c % 5 == 2 { anchors[c % anchors.len()].into() } else { end(j) };
        cables.push((b.cable(&format!("cable {c}"), from, to, law.clone(), 1.0)?, law));
    }
    Ok(Mixed { model: b.build()?, members, cables })
}

fn supports_and_loads<const D: usize>(
    b: &mut ModelBuilder<D>,
    members: &[(MemberId, Member<D>)],
    r: &mut Random,
) -> Result<Vec<AnchorId>, BuildError> {
    b.gravity(r.array(9.0))?;
    let held = b.anchor("held", r.array(3.0))?;
    let moving = b.anchor("moving", r.array(3.0))?;
    b.shake("quake", moving, Signal::Sine { amplitude: 0.1, frequency: 0.5, phase: 0.3 })?;
    b.support("slide", members[0].0.node(0), 1, Signal::sine(0.05, 1.0))?;
    b.support("rail", members[2].0.at(local_point(&members[2].1, r).into()), 0, Signal::sine(0.02, 0.7))?;
    let on = &members[1];
    b.load("push", on.0.at(local_point(&on.1, r).into()), r.array(5.0), Signal::ramp(0.5, 1.0, 2.0))?;
    b.load("pull", members[members.len() - 1].0.mass_centre(), r.array(5.0), 1.0)?;
    Ok(vec![held, moving])
}

/// A state near the initial one, off the constraints, with velocities of order one and rest lengths such that
/// slacking cables are away from both of their switching lines.
pub(crate) fn random_state<const D: usize>(
    mixed: &Mixed<D>,
    r: &mut Random,
) -> (Vec<f64>, Vec<f64>, Vec<f64>) {
    let model = &mixed.model;
    let mut q = model.initial_coordinates();
    for q in &mut q {
        *q += 0.05 * r.value();
    }
    let v = r.vector(q.len(), 1.0);
    let mut u = model.inputs_at(0.4);
    for (k, (id, _)) in mixed.cables.iter().enumerate() {
        let form = model.cable_form(*id);
        let l = form.eval(&q);
        let rate = l.dot(&form.eval(&v)) / l.norm();
        loop {
            let factor = if r.value() > 0.0 { r.within(0.7, 0.95) } else { r.within(1.05, 1.3) };
            u[k] = factor * l.norm();
            if (KAPPA * (l.norm() - u[k]) + ETA * rate).abs() > 2.0 {
                break;
            }
        }
    }
    (q, v, u)
}

/// Rigid motion of all members with velocity `t` and skew spin `s` about the origin.
pub(crate) fn rigid_motion<const D: usize>(
    mixed: &Mixed<D>,
    q: &[f64],
    t: SVector<f64, D>,
    s: SMatrix<f64, D, D>,
) -> Vec<f64> {
    let mut moved = vec![f64::NAN; q.len()];
    for (id, member) in &mixed.members {
        for i in 0..member.coord_type().nodes() {
            let node = mixed.model.form(id.node(i)).unwrap().terms()[0].0;
            let x = SVector::<f64, D>::from_column_slice(&q[node * D..node * D + D]);
            let rate = if member.coord_type().is_point(i) { t + s * x } else { s * x };
            moved[node * D..node * D + D].copy_from_slice(rate.as_slice());
        }
    }
    moved
}

/// All skew matrices of one unit entry.
pub(crate) fn spins<const D: usize>() -> Vec<SMatrix<f64, D, D>> {
    let pairs = (0..D).flat_map(|i| (i + 1..D).map(move |j| (i, j)));
    pairs
        .map(|(i, j)| {
            let mut s = SMatrix::zeros();
            (s[(i, j)], s[(j, i)]) = (-1.0, 1.0);
            s
        })
        .collect()
}
