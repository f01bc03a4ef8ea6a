//! Structures in YAML of the NASA Tensegrity Robotics Toolkit (NTRT).
//!
//! ```text
//! nodes:          name: [x, y, z]
//! pair_groups:    tags: [[node, node], ...]        tags are words, as `prism_rod segment`
//! builders:       tags: { class, parameters }      a pair that has all these tags is made by it
//! substructures:  a/b/c: { path, rotation { axis, angle °, reference }, scale, offset, translation }
//! bond_groups:    tags: { a/b/c/node_node: [[node, node], ...], a/b/node_edge: [[node, node/node], ...] }
//! ```
//! Bond groups may be nested the other way: tags in bonds. A node of a substructure is also `substructure.node`.
//!
//! What it means there, and here:
//! - the builder added last wins, a structure's after those of its substructures, rods and boxes before strings; `rod`,
//!   `string` and `box` have default builders;
//! - a rod's mass is π r² l times its density; the width and height of a box are halves of its edges;
//! - a string's rest length is its length less pretension / stiffness: pretension is a force;
//! - rods that end in the same point are one rigid body; a group without mass does not move;
//! - a substructure is rotated (about its nodes' centroid if no reference is given), scaled about that centroid, shifted
//!   by its number times the offset, then translated; node_edge bonds move the second structure onto the first.
//!
//! Source: NTRTsim, `src/yamlbuilder/TensegrityModel`, `src/core/tgSpringCable`, `src/tgcreator/tgRodInfo`, `tgBoxInfo`,
//! `tgStructureInfo`, `tgRigidAutoCompound`.

mod bonds;
mod builders;
mod load;
mod part;
mod resolve;

use std::path::Path;

use super::ImportError;
use super::draft::Draft;
use super::sources::Sources;
use part::World;

/// Reads a structure and its substructures.
pub(super) fn read(path: &Path, sources: &mut Sources) -> Result<Draft, ImportError> {
    let mut world = World::default();
    let whole = load::load(path, &mut world, sources)?;
    let mut draft = resolve::resolve(&world, &whole).map_err(|fault| sources.fault(fault))?;
    draft.title = path.file_stem().map(|name| name.to_string_lossy().into_owned());
    Ok(draft)
}
