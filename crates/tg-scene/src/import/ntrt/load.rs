//! Files to structures: nodes, pairs, substructures and their placement.

use std::path::{Path, PathBuf};

use nalgebra::{Rotation3, Unit, Vector3};

use super::part::{Pair, Part, Point, World, words};
use super::{bonds, builders};
use crate::error::ReadError;
use crate::import::sources::{At, Sources};
use crate::import::tree::{get, list, number, numbers, only, positive, require, table, text};
use crate::import::{ImportError, yaml_text};
use crate::node::{Entry, Node};

/// More levels, or more structures in all, are a slip of the pen.
const DEEPEST: usize = 16;
const MOST: usize = 2_000;

/// Loads a file and what it refers to.
pub(super) fn load(path: &Path, world: &mut World, sources: &mut Sources) -> Result<Part, ImportError> {
    world.builders = builders::defaults();
    let mut loader = Loader { world, sources, open: Vec::new(), loaded: 0 };
    loader.structure(path, String::new(), "")
}

struct Loader<'w> {
    world: &'w mut World,
    sources: &'w mut Sources,
    /// Files being read, each from within the one before.
    open: Vec<PathBuf>,
    loaded: usize,
}

/// A substructure as written: its name, where, which copy of its line it is, and its attributes.
struct Child<'n> {
    name: &'n str,
    entry: &'n Entry,
    copy: usize,
    fields: &'n [Entry],
}

impl Loader<'_> {
    fn structure(&mut self, path: &Path, name: String, prefix: &str) -> Result<Part, ImportError> {
        let source = self.sources.read(path)?;
        let mut part = Part { name, ..Part::default() };
        self.open.push(path.into());
        self.loaded += 1;
        let root = yaml_text::parse(self.sources.text(source));
        let root = root.map_err(|error| self.sources.mistake(source, error))?;
        let read = self.contents(&root, &mut part, path, source, prefix);
        self.open.pop();
        read?;
        Ok(part)
    }

    fn contents(
        &mut self,
        root: &Node,
        part: &mut Part,
        path: &Path,
        source: usize,
        prefix: &str,
    ) -> Result<(), ImportError> {
        let placed = |entries| children(entries);
        let entries = table(root, "a structure with nodes and pair_groups").and_then(|entries| {
            only(entries, &["nodes", "pair_groups", "builders", "substructures", "bond_groups"])?;
            Ok((entries, placed(entries)?))
        });
        let (entries, list) = entries.map_err(|error| self.sources.mistake(source, error))?;
        for child in list {
            let path = self.path(&child, path).map_err(|error| self.sources.mistake(source, error))?;
            let inner = format!("{prefix}{}/", child.name);
            let made = self.structure(&path, child.name.into(), &inner)?;
            place(&made, &child, self.world).map_err(|error| self.sources.mistake(source, error))?;
            part.children.push(made);
        }
        let own = self.own(entries, part, source, prefix);
        own.map_err(|error| self.sources.mistake(source, error))
    }

    /// The file of a substructure.
    fn path(&self, child: &Child<'_>, parent: &Path) -> Result<PathBuf, ReadError> {
        let given = require(child.fields, "path", &child.entry.node)?;
        let path = parent.with_file_name("").join(text(given, "a path")?);
        if self.open.contains(&path) || self.open.len() >= DEEPEST {
            let error = ReadError::new("the structure is a substructure of itself").at(&given.span);
            return Err(error.help(format!("structures are nested {DEEPEST} deep at most")));
        }
        if self.loaded >= MOST {
            return Err(ReadError::new(format!("there are more than {MOST} substructures")).at(&given.span));
        }
        if !path.is_file() {
            let error = ReadError::new(format!("there is no file {}", path.display())).at(&given.span);
            return Err(error.help("paths start from the folder of the file that names them"));
        }
        Ok(path)
    }

    /// Builders, nodes, pairs and bonds, in the toolkit's order.
    fn own(
        &mut self,
        entries: &[Entry],
        part: &mut Part,
        source: usize,
        prefix: &str,
    ) -> Result<(), ReadError> {
        for entry in section(entries, "builders")? {
            self.world.builders.push(builders::read(entry, source)?);
        }
        for entry in section(entries, "nodes")? {
            let position = numbers::<3>(&entry.node, "a node [x, y, z]")?;
            part.points.push(self.world.points.len());
            self.world.points.push(Point {
                name: entry.key.clone(),
                full: format!("{prefix}{}", entry.key),
                position: position.into(),
                at: At { source, span: entry.span.clone() },
            });
        }
        for entry in section(entries, "pair_groups")? {
            for [a, b, pair] in pairs(&entry.node)? {
                let end = |node: &Node| part.point(text(node, "a node's name")?, self.world, &node.span);
                let pair = Pair {
                    ends: [end(a)?, end(b)?],
                    group: entry.key.clone(),
                    tags: words(&entry.key),
                    at: At { source, span: pair.span.clone() },
                };
                part.add_pair(pair)?;
            }
        }
        for entry in section(entries, "bond_groups")? {
            bonds::add(entry, part, self.world, source)?;
        }
        Ok(())
    }
}

/// The entries of a section that may be missing or empty.
fn section<'n>(entries: &'n [Entry], key: &str) -> Result<&'n [Entry], ReadError> {
    get(entries, key).map_or(Ok(&[]), |node| table(node, &format!("a table of {key}")))
}

/// The pairs of a list, each with its whole.
pub(super) fn pairs(node: &Node) -> Result<Vec<[&Node; 3]>, ReadError> {
    if matches!(node.value, crate::node::Value::Null) {
        return Ok(Vec::new());
    }
    let pair = |pair| match list(pair, "a pair [node, node]")? {
        [a, b] => Ok([a, b, pair]),
        other => {
            let message = format!("a pair has two nodes, not {}", other.len());
            Err(ReadError::new(message).at(&pair.span))
        }
    };
    list(node, "a list of pairs")?.iter().map(pair).collect()
}

/// The substructures: one line may name several, as `a/b/c`.
fn children(entries: &[Entry]) -> Result<Vec<Child<'_>>, ReadError> {
    let mut children: Vec<Child<'_>> = Vec::new();
    for entry in section(entries, "substructures")? {
        let fields = table(&entry.node, "a substructure { path, ... }")?;
        only(fields, &["path", "rotation", "translation", "scale", "offset"])?;
        for (copy, name) in entry.key.split('/').enumerate() {
            if name.trim().is_empty() || children.iter().any(|other| other.name == name) {
                let message = format!("the substructure `{name}` has no name of its own");
                return Err(ReadError::new(message)
                    .at(&entry.span)
                    .help("write different names, as t1/t2/t3"));
            }
            children.push(Child { name, entry, copy, fields });
        }
    }
    Ok(children)
}

/// Rotation, scale, offset, translation.
fn place(part: &Part, child: &Child<'_>, world: &mut World) -> Result<(), ReadError> {
    if let Some(rotation) = get(child.fields, "rotation") {
        let fields = table(rotation, "a rotation { axis, angle, reference }")?;
        only(fields, &["axis", "angle", "reference"])?;
        let axis = require(fields, "axis", rotation)?;
        let vector = Vector3::from(numbers::<3>(axis, "an axis [x, y, z]")?);
        let angle = number(require(fields, "angle", rotation)?, "an angle in degrees")?.to_radians();
        let axis = Unit::try_new(vector, 0.0).ok_or_else(|| {
            ReadError::new("the axis of the rotation is zero")
                .at(&axis.span)
                .help("give a direction, as [0, 1, 0]")
        })?;
        let about = match get(fields, "reference") {
            Some(reference) => numbers::<3>(reference, "a point [x, y, z]")?.into(),
            None => part.centroid(world),
        };
        part.rotate(world, about, &Rotation3::from_axis_angle(&axis, angle));
    }
    if let Some(scale) = get(child.fields, "scale") {
        let (factor, about) = (positive(scale, "a scale")?, part.centroid(world));
        part.transform(world, |x| about + (x - about) * factor);
    }
    if let Some(offset) = get(child.fields, "offset") {
        let step = Vector3::from(numbers::<3>(offset, "an offset [x, y, z]")?);
        part.transform(world, |x| x + step * child.copy as f64);
    }
    if let Some(translation) = get(child.fields, "translation") {
        let shift = Vector3::from(numbers::<3>(translation, "a translation [x, y, z]")?);
        part.transform(world, |x| x + shift);
    }
    Ok(())
}
