//! Structures with builders to a draft: rods, rigid bodies of rods that touch, and strings.

use std::collections::HashMap;

use nalgebra::{Rotation3, Vector3};

use super::builders::{Builder, Kind, of_pair};
use super::part::{Pair, Part, World};
use crate::import::draft::{BarMass, Draft, DraftBar, DraftBody, DraftCable, DraftNode, Rest, Stiffness};
use crate::import::mass::{Mass, cuboid, cylinder, weld};
use crate::import::sources::Fault;

/// Nodes closer than this part of the structure's size are one.
const SAME: f64 = 1e-9;

/// A pair and what it becomes; its ends are nodes of the draft.
struct Made<'w> {
    pair: &'w Pair,
    kind: Kind,
    builder: &'w Builder,
    ends: [usize; 2],
}

/// The draft of a whole structure.
pub(super) fn resolve(world: &World, whole: &Part) -> Result<Draft, Fault> {
    let mut draft = Draft { dimension: 3, gravity: GRAVITY.into(), ..Draft::default() };
    draft.notes.extend(NOTES.iter().map(|note| note.to_string()));
    let node = |point: &super::part::Point| DraftNode {
        name: point.full.clone(),
        position: point.position,
        fixed: [false; 3],
        mass: None,
        at: point.at.clone(),
    };
    draft.nodes = world.points.iter().map(node).collect();
    let first = coincident(world);
    let (mut rigid, mut strings, mut unbuilt) = (Vec::new(), Vec::new(), Vec::new());
    let mut queue = vec![whole];
    while let Some(part) = queue.pop() {
        for pair in &part.pairs {
            let Some(builder) = of_pair(&world.builders, pair, &part.name) else {
                if !unbuilt.contains(&&pair.group) {
                    unbuilt.push(&pair.group);
                }
                continue;
            };
            let made = Made { pair, kind: builder.kind, builder, ends: pair.ends.map(|end| first[end]) };
            has_length(world, &made)?;
            if matches!(made.kind, Kind::String { .. }) { strings.push(made) } else { rigid.push(made) }
        }
        queue.extend(part.children.iter().rev());
    }
    for group in unbuilt {
        let message = format!("pairs tagged `{group}` have no builder and are left out, as in the simulator");
        draft.warnings.push(message);
    }
    warn_of_defaults(&mut draft, rigid.iter().chain(&strings));
    let held = bodies(&mut draft, &rigid);
    cables(&mut draft, &strings, &held)?;
    Ok(draft)
}

const GRAVITY: &str = "gravity = [0, -9.81, 0]   y is up in NTRT; in decimetres 98.1";

const NOTES: [&str; 3] = [
    "An NTRT structure. Its unit of length is often a decimetre; forces are then kg dm/s²,\n\
     and length and force scales of 0.1 give SI.",
    "Strings end in nodes here, on the surface of the rods there; rods that touch are one rigid body,\n\
     with the inertia of solid cylinders.",
    "Limits of motors and of tension, friction and contact are left out.",
];

/// For each node the first one at the same place.
fn coincident(world: &World) -> Vec<usize> {
    let all = || world.points.iter().map(|point| point.position);
    let size = all().map(|x| x.amax()).fold(0.0, f64::max);
    let cell = (size * SAME).max(f64::MIN_POSITIVE);
    let mut cells: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    let mut first = Vec::with_capacity(world.points.len());
    for (k, x) in all().enumerate() {
        let key: [i64; 3] = std::array::from_fn(|axis| (x[axis] / cell).round() as i64);
        let near = (0..27).flat_map(|n| {
            let shifts = [n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1];
            cells
                .get(&std::array::from_fn(|axis| key[axis].saturating_add(shifts[axis])))
                .into_iter()
                .flatten()
        });
        let found = near.copied().find(|other| (world.points[*other].position - x).norm() <= cell);
        if found.is_none() {
            cells.entry(key).or_default().push(k);
        }
        first.push(found.unwrap_or(k));
    }
    first
}

fn has_length(world: &World, made: &Made<'_>) -> Result<(), Fault> {
    let [from, to] = made.pair.ends.map(|end| &world.points[end]);
    if made.ends[0] == made.ends[1] {
        let message =
            format!("the nodes `{}` and `{}` of the pair are at the same place", from.full, to.full);
        return Err(made.pair.at.fault(message, "move one of them"));
    }
    let Kind::String { stiffness, pretension, .. } = made.kind else { return Ok(()) };
    let length = (to.position - from.position).norm();
    if length - pretension / stiffness > 0.0 {
        return Ok(());
    }
    let message = format!(
        "the builder of `{}` shortens a string of length {length} by pretension / stiffness = {}",
        made.builder.tags,
        pretension / stiffness
    );
    let help =
        format!("the string from `{}` to `{}` holds less than {}", from.full, to.full, stiffness * length);
    Err(made.builder.at.fault(message, help))
}

fn warn_of_defaults<'m>(draft: &mut Draft, all: impl Iterator<Item = &'m Made<'m>>) {
    for Builder { tags, defaults, .. } in all.map(|made| made.builder) {
        let message = format!(
            "the builder of `{tags}` leaves these to the toolkit's defaults: {}",
            defaults.join(", ")
        );
        if !defaults.is_empty() && !draft.warnings.contains(&message) {
            draft.warnings.push(message);
        }
    }
}

fn mass(made: &Made<'_>, positions: [Vector3<f64>; 2]) -> Mass {
    let [from, to] = positions;
    let length = (to - from).norm();
    match made.kind {
        Kind::Rod { radius, density } => {
            cylinder(density * std::f64::consts::PI * radius * radius * length, radius, &from, &to)
        }
        Kind::Box { width, height, density } => {
            let edges = [2.0 * width, 2.0 * height];
            // Its length is along y before it is turned by the shortest way.
            let turn = Rotation3::rotation_between(&Vector3::y(), &(to - from));
            let turn =
                turn.unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
            let axes = [turn * Vector3::x(), turn * Vector3::z()];
            cuboid(density * edges[0] * edges[1] * length, edges, axes, &from, &to)
        }
        Kind::String { .. } => Mass { mass: 0.0, centre: from, inertia: nalgebra::Matrix3::zeros() },
    }
}

/// A name by the first tag, with a number.
fn numbered(counts: &mut HashMap<String, usize>, pair: &Pair) -> String {
    let tag = pair.tags.first().cloned().unwrap_or_default();
    let count = counts.entry(tag.clone()).or_default();
    *count += 1;
    format!("{tag} {count}")
}

/// Rods that touch nothing rigid become bars, others with theirs a body. Gives the nodes that are held.
fn bodies(draft: &mut Draft, rigid: &[Made<'_>]) -> Vec<bool> {
    let mut held = vec![false; draft.nodes.len()];
    let mut counts = HashMap::new();
    let (mut welded, mut still) = (0, 0);
    for group in groups(rigid, draft.nodes.len()) {
        let parts: Vec<Mass> =
            group.iter().map(|made| mass(made, made.ends.map(|end| draft.nodes[end].position))).collect();
        group.iter().flat_map(|made| made.ends).for_each(|node| held[node] = true);
        let total: f64 = parts.iter().map(|part| part.mass).sum();
        if total == 0.0 {
            still += 1;
            group.iter().flat_map(|made| made.ends).for_each(|node| draft.nodes[node].fixed = [true; 3]);
            continue;
        }
        if let &[Made { pair, kind: Kind::Rod { radius, density }, ends, .. }] = &group[..] {
            draft.bars.push(DraftBar {
                name: numbered(&mut counts, pair),
                ends: *ends,
                mass: BarMass::Density(*density),
                radius: Some(*radius),
                at: pair.at.clone(),
            });
            continue;
        }
        let Some(Mass { mass, centre, inertia }) = weld(&parts) else { continue };
        welded += usize::from(group.len() > 1);
        let mut nodes: Vec<usize> = Vec::new();
        for node in group.iter().flat_map(|made| made.ends) {
            if !nodes.contains(&node) {
                nodes.push(node);
            }
        }
        let edges = group.iter().map(|made| made.ends).collect();
        let name = format!("body {}", draft.bodies.len() + 1);
        draft.bodies.push(DraftBody { name, nodes, edges, mass, centre, inertia });
    }
    if welded > 0 {
        let message = "groups of rods that share nodes are one rigid body each, as in the simulator";
        draft.warnings.push(format!("{welded} {message}"));
    }
    if still > 0 {
        let message = "groups of rods have no mass: the simulator holds those still; their nodes are anchors";
        draft.warnings.push(format!("{still} {message}"));
    }
    held
}

/// Groups of what touches, in the order of their first members.
fn groups<'g, 'w>(rigid: &'g [Made<'w>], nodes: usize) -> Vec<Vec<&'g Made<'w>>> {
    let mut parent: Vec<usize> = (0..nodes).collect();
    let root = |mut k: usize, parent: &mut Vec<usize>| {
        while parent[k] != k {
            parent[k] = parent[parent[k]];
            k = parent[k];
        }
        k
    };
    for made in rigid {
        let [a, b] = made.ends.map(|end| root(end, &mut parent));
        parent[b] = a;
    }
    let mut groups: Vec<Vec<&Made<'_>>> = Vec::new();
    let mut known = HashMap::new();
    for made in rigid {
        let k = *known.entry(root(made.ends[0], &mut parent)).or_insert(groups.len());
        if k == groups.len() {
            groups.push(Vec::new());
        }
        groups[k].push(made);
    }
    groups
}

fn cables(draft: &mut Draft, strings: &[Made<'_>], held: &[bool]) -> Result<(), Fault> {
    let mut counts = HashMap::new();
    for made in strings {
        let Kind::String { stiffness, damping, pretension } = made.kind else { continue };
        if let Some(node) = made.ends.into_iter().find(|node| !held[*node]) {
            let message =
                format!("a string ends in the node `{}`, where no rod ends", draft.nodes[node].name);
            return Err(made.pair.at.fault(message, "strings join rods; let a rod or box end there"));
        }
        draft.cables.push(DraftCable {
            name: numbered(&mut counts, made.pair),
            ends: made.ends,
            group: Some(made.pair.group.clone()),
            stiffness: Stiffness::Spring(stiffness),
            damping,
            rest: Rest::Tension(pretension),
            linear: false,
            at: made.pair.at.clone(),
        });
    }
    Ok(())
}
