//! A structure of nodes, pairs and substructures, as the toolkit nests them.

use std::collections::VecDeque;

use nalgebra::{Rotation3, Vector3};

use super::builders::Builder;
use crate::error::ReadError;
use crate::import::sources::At;
use crate::node::Span;

/// All nodes and builders of a structure and its substructures.
#[derive(Debug, Default)]
pub(super) struct World {
    pub(super) points: Vec<Point>,
    pub(super) builders: Vec<Builder>,
}

/// A node.
#[derive(Debug)]
pub(super) struct Point {
    /// Its name in its structure.
    pub(super) name: String,
    /// With the names of the substructures that it is in.
    pub(super) full: String,
    pub(super) position: Vector3<f64>,
    pub(super) at: At,
}

/// A structure.
#[derive(Debug, Default)]
pub(super) struct Part {
    pub(super) name: String,
    pub(super) points: Vec<usize>,
    pub(super) pairs: Vec<Pair>,
    pub(super) children: Vec<Part>,
}

/// Two nodes and the tags that say what is between them.
#[derive(Clone, Debug)]
pub(super) struct Pair {
    pub(super) ends: [usize; 2],
    /// As written, for people.
    pub(super) group: String,
    /// Words, with the names of the structures that a bond joins.
    pub(super) tags: Vec<String>,
    pub(super) at: At,
}

impl Pair {
    pub(super) fn joins(&self, a: usize, b: usize) -> bool {
        self.ends == [a, b] || self.ends == [b, a]
    }
}

/// The words of a text.
pub(super) fn words(text: &str) -> Vec<String> {
    text.split_whitespace().map(str::to_string).collect()
}

/// Whether all words asked for are there.
pub(super) fn has_all(words: &[String], wanted: &[String]) -> bool {
    wanted.iter().all(|word| words.contains(word))
}

impl Part {
    /// The structure and all in it, level by level.
    fn levels(&self) -> impl Iterator<Item = &Part> {
        let mut queue = VecDeque::from([self]);
        std::iter::from_fn(move || {
            let part = queue.pop_front()?;
            queue.extend(&part.children);
            Some(part)
        })
    }

    /// All nodes in it.
    pub(super) fn all_points(&self) -> Vec<usize> {
        self.levels().flat_map(|part| part.points.iter().copied()).collect()
    }

    /// A structure within this one.
    pub(super) fn child(&self, name: &str, span: &Span) -> Result<&Part, ReadError> {
        let wanted = words(name);
        let found = self.levels().skip(1).find(|part| has_all(&words(&part.name), &wanted));
        found.filter(|_| !wanted.is_empty()).ok_or_else(|| {
            let known: Vec<&str> = self.children.iter().map(|part| part.name.as_str()).collect();
            ReadError::new(format!("there is no substructure `{name}`")).at(span).suggest(name, &known)
        })
    }

    /// A node by `node` or `structure.structure.node`.
    pub(super) fn point(&self, path: &str, world: &World, span: &Span) -> Result<usize, ReadError> {
        let (mut part, mut rest) = (self, path);
        while let Some((child, inner)) = rest.split_once('.') {
            (part, rest) = (part.child(child, span)?, inner);
        }
        let wanted = words(rest);
        let mut points = part.levels().flat_map(|part| part.points.iter().copied());
        let found = points.find(|k| has_all(&words(&world.points[*k].name), &wanted));
        found.filter(|_| !wanted.is_empty()).ok_or_else(|| {
            let known: Vec<&str> = part.all_points().iter().map(|k| world.points[*k].name.as_str()).collect();
            ReadError::new(format!("there is no node `{rest}`")).at(span).suggest(rest, &known)
        })
    }

    /// The first pair between two nodes, level by level.
    pub(super) fn pair(&self, a: usize, b: usize) -> Option<&Pair> {
        self.levels().flat_map(|part| &part.pairs).find(|pair| pair.joins(a, b))
    }

    /// Removes that pair.
    pub(super) fn remove_pair(&mut self, a: usize, b: usize) {
        let mut queue = VecDeque::from([self]);
        while let Some(part) = queue.pop_front() {
            if let Some(k) = part.pairs.iter().position(|pair| pair.joins(a, b)) {
                part.pairs.remove(k);
                return;
            }
            queue.extend(&mut part.children);
        }
    }

    /// Adds a pair, which must be new in this structure.
    pub(super) fn add_pair(&mut self, pair: Pair) -> Result<(), ReadError> {
        let [a, b] = pair.ends;
        if a == b {
            return Err(ReadError::new("a pair joins a node with itself").at(&pair.at.span));
        }
        if self.pairs.iter().any(|other| other.joins(a, b)) {
            let error = ReadError::new("there is a pair between these nodes already").at(&pair.at.span);
            return Err(error.help("remove one of the two"));
        }
        self.pairs.push(pair);
        Ok(())
    }

    /// Moves all nodes.
    pub(super) fn transform(&self, world: &mut World, to: impl Fn(Vector3<f64>) -> Vector3<f64>) {
        for k in self.all_points() {
            world.points[k].position = to(world.points[k].position);
        }
    }

    /// Rotates all nodes about a point.
    pub(super) fn rotate(&self, world: &mut World, about: Vector3<f64>, rotation: &Rotation3<f64>) {
        self.transform(world, |x| about + rotation * (x - about));
    }

    /// The mean of all nodes.
    pub(super) fn centroid(&self, world: &World) -> Vector3<f64> {
        let points = self.all_points();
        let sum: Vector3<f64> = points.iter().map(|k| world.points[*k].position).sum();
        sum / points.len().max(1) as f64
    }
}
