//! Bonds between substructures.
//!
//! node_node: a pair between a node of each.
//!
//! node_edge: at least three nodes that shall lie in the middle of strings of the other structure. The second structure
//! is turned so that both planes agree and the first nodes point the same way, and moved so that both centroids agree;
//! then each string gives way to two that meet in the node, and strings among the nodes themselves go.

use nalgebra::{Rotation3, Unit, Vector3};

use super::builders::is_rigid;
use super::load::pairs;
use super::part::{Pair, Part, World, words};
use crate::error::ReadError;
use crate::import::sources::At;
use crate::import::tree::{table, text};
use crate::node::{Entry, Node, Span};

/// Directions closer than this are the same to the toolkit.
const SAME: f64 = 1e-5;

/// Adds the bonds of one entry: bonds within tags, or tags within bonds. Bonds are the names with a slash.
pub(super) fn add(entry: &Entry, part: &mut Part, world: &mut World, source: usize) -> Result<(), ReadError> {
    for inner in table(&entry.node, "bonds within tags, or tags within bonds")? {
        let (bond, tags) = match (entry.key.contains('/'), inner.key.contains('/')) {
            (true, false) => (entry, inner),
            (false, true) => (inner, entry),
            (_, slash) => {
                let what = if slash { "bonds are nested in bonds" } else { "tags are nested in tags" };
                let error = ReadError::new(format!("{what}: `{}` in `{}`", inner.key, entry.key));
                return Err(error
                    .at(&inner.span)
                    .help("a bond is written a/b/node_node, a tag without a slash"));
            }
        };
        let names: Vec<&str> = bond.key.split('/').collect();
        let [structures @ .., kind] = names.as_slice() else { continue };
        if structures.len() < 2 {
            let error = ReadError::new("a bond joins two structures or more").at(&bond.span);
            return Err(error.help("write first/second/node_node"));
        }
        for two in structures.windows(2) {
            let between = Between { names: [two[0], two[1]], tags: &tags.key, span: &bond.span, source };
            match *kind {
                "node_node" => between.nodes(&inner.node, part, world)?,
                "node_edge" => between.edges(&inner.node, part, world)?,
                other => {
                    let error = ReadError::new(format!("the bond `{other}` is not known")).at(&bond.span);
                    return Err(error.suggest(other, &["node_node", "node_edge"]));
                }
            }
        }
    }
    Ok(())
}

/// What is bonded.
struct Between<'n> {
    names: [&'n str; 2],
    tags: &'n str,
    span: &'n Span,
    source: usize,
}

/// A node, or the two ends of a string.
enum Attachment {
    Node(usize),
    Edge(usize, usize),
}

impl Between<'_> {
    fn pair(&self, ends: [usize; 2], tags: Vec<String>, span: &Span) -> Pair {
        Pair { ends, group: self.tags.into(), tags, at: At { source: self.source, span: span.clone() } }
    }

    fn nodes(&self, list: &Node, part: &mut Part, world: &World) -> Result<(), ReadError> {
        let [a, b] = self.names;
        for [first, second, whole] in pairs(list)? {
            let end = |structure: &str, node: &Node| {
                part.child(structure, self.span)?.point(text(node, "a node's name")?, world, &node.span)
            };
            let mut tags = words(self.tags);
            tags.extend([a.to_string(), b.to_string(), format!("{a}/{b}")]);
            let pair = self.pair([end(a, first)?, end(b, second)?], tags, &whole.span);
            part.add_pair(pair)?;
        }
        Ok(())
    }

    fn edges(&self, list: &Node, part: &mut Part, world: &mut World) -> Result<(), ReadError> {
        let given = pairs(list)?;
        if given.is_empty() {
            return Ok(());
        }
        if given.len() < 3 {
            let error = ReadError::new("a node_edge bond has three pairs or more").at(&list.span);
            return Err(error.help("two planes meet in three points"));
        }
        let mut sides = [Vec::new(), Vec::new()];
        let mut bonds = Vec::new();
        for [first, second, whole] in given {
            let attachment = |structure: &str, node: &Node| {
                let child = part.child(structure, self.span)?;
                let path = text(node, "a node, or an edge node/node")?;
                let point = |path: &str| child.point(path, world, &node.span);
                Ok(match path.split_once('/') {
                    Some((a, b)) => Attachment::Edge(point(a)?, point(b)?),
                    None => Attachment::Node(point(path)?),
                })
            };
            let two = [attachment(self.names[0], first)?, attachment(self.names[1], second)?];
            for (side, end) in sides.iter_mut().zip(&two) {
                let position = |k: usize| world.points[k].position;
                side.push(match *end {
                    Attachment::Node(k) => position(k),
                    Attachment::Edge(a, b) => (position(a) + position(b)) / 2.0,
                });
            }
            bonds.push(match two {
                [Attachment::Node(node), Attachment::Edge(a, b)]
                | [Attachment::Edge(a, b), Attachment::Node(node)] => (node, [a, b], whole),
                _ => {
                    let error = ReadError::new("a node_edge pair is a node and an edge").at(&whole.span);
                    return Err(error.help("write the edge as node/node"));
                }
            });
        }
        self.fit(part.child(self.names[1], self.span)?, &sides, world)?;
        self.replace(&bonds, part, world)
    }

    /// Moves the second structure onto the first.
    fn fit(
        &self,
        second: &Part,
        [ours, theirs]: &[Vec<Vector3<f64>>; 2],
        world: &mut World,
    ) -> Result<(), ReadError> {
        let centre = |points: &[Vector3<f64>]| points.iter().sum::<Vector3<f64>>() / points.len() as f64;
        let normal = |points: &[Vector3<f64>]| {
            let n = (points[1] - points[0]).cross(&(points[2] - points[0]));
            Unit::try_new(n, 1e-12).ok_or_else(|| {
                let error = ReadError::new("the first three points of the bond lie in a line").at(self.span);
                error.help("order the pairs so that they span a plane")
            })
        };
        let (to, from) = (centre(ours), centre(theirs));
        let (n_to, n_from) = (normal(ours)?, normal(theirs)?);
        let fallback = Unit::new_normalize(theirs[1] - theirs[0]);
        let turn = between(&n_from, &n_to, &fallback);
        second.rotate(world, from, &turn);
        second.transform(world, |x| x + (to - from));
        let (a, b) = (turn * (theirs[0] - from), ours[0] - to);
        if let (Some(a), Some(b)) = (Unit::try_new(a, 1e-12), Unit::try_new(b, 1e-12)) {
            second.rotate(world, to, &between(&a, &b, &n_to));
        }
        Ok(())
    }

    fn replace(
        &self,
        bonds: &[(usize, [usize; 2], &Node)],
        part: &mut Part,
        world: &World,
    ) -> Result<(), ReadError> {
        for (node, [a, b], whole) in bonds {
            for name in self.names {
                let structure = child_mut(part, name);
                let Some(structure) = structure else { continue };
                if structure.pair(*a, *b).is_some_and(|pair| is_rigid(&world.builders, pair)) {
                    return Err(ReadError::new("the edge of a node_edge bond is a rod")
                        .at(&whole.span)
                        .help("bond to a string"));
                }
                structure.remove_pair(*a, *b);
                for (other, _, _) in bonds {
                    if structure.pair(*node, *other).is_some_and(|pair| !is_rigid(&world.builders, pair)) {
                        structure.remove_pair(*node, *other);
                    }
                }
            }
            for ends in [[*a, *node], [*node, *b]] {
                part.add_pair(self.pair(ends, words(self.tags), &whole.span))?;
            }
        }
        Ok(())
    }
}

/// A structure within another, level by level.
fn child_mut<'p>(part: &'p mut Part, name: &str) -> Option<&'p mut Part> {
    let wanted = words(name);
    let mut queue: std::collections::VecDeque<&mut Part> = part.children.iter_mut().collect();
    while let Some(part) = queue.pop_front() {
        if super::part::has_all(&words(&part.name), &wanted) {
            return Some(part);
        }
        queue.extend(&mut part.children);
    }
    None
}

/// The shortest rotation from one direction to another; half a turn about the fallback if they are opposed.
fn between(
    from: &Unit<Vector3<f64>>,
    to: &Unit<Vector3<f64>>,
    fallback: &Unit<Vector3<f64>>,
) -> Rotation3<f64> {
    if (from.into_inner() - to.into_inner()).norm() < SAME {
        return Rotation3::identity();
    }
    if (from.into_inner() + to.into_inner()).norm() < SAME {
        return Rotation3::from_axis_angle(fallback, std::f64::consts::PI);
    }
    let cross = from.cross(to);
    Rotation3::from_axis_angle(&Unit::new_normalize(cross), cross.norm().atan2(from.dot(to)))
}
