//! Imports: structures in other formats become readable scene files.
//!
//! | given | format | module |
//! |---|---|---|
//! | a folder, or `nodes.csv` in it | tables of nodes, bars and cables | `triples` |
//! | `.yaml`, `.yml` | structures of the NASA Tensegrity Robotics Toolkit | `ntrt` |
//! | `.json` with a list `nodes` | the neutral form of published structures | `neutral` |
//!
//! Each reader fills one draft (`draft`), which is checked, scaled and written (`write`). Errors point into the file
//! read.

mod draft;
mod mass;
mod names;
mod neutral;
mod ntrt;
mod sources;
mod table;
mod tree;
mod triples;
mod write;
mod yaml_text;

use std::path::Path;

use thiserror::Error;

use crate::error::{Mistake, SceneError};
use crate::read::{Language, SceneFile};
use draft::Draft;
use sources::Sources;

/// Factors from the units of the file to metre, newton and kilogram. Time stays in seconds: stiffness and damping are
/// multiplied by force / length, densities by mass / length³, inertia by mass · length².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImportOptions {
    /// Metres by unit of length: 0.1 for decimetres.
    pub length_scale: f64,
    /// Newtons by unit of force: 0.1 for kg dm/s².
    pub force_scale: f64,
    /// Kilograms by unit of mass.
    pub mass_scale: f64,
}

impl Default for ImportOptions {
    /// The numbers as they are.
    fn default() -> Self {
        Self { length_scale: 1.0, force_scale: 1.0, mass_scale: 1.0 }
    }
}

/// A structure as a scene file.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The scene in TOML; its comments name the source and say what was assumed.
    pub toml: String,
    /// What the user should know: assumptions, what was left out, whether the scene builds.
    pub warnings: Vec<String>,
}

/// Why nothing could be imported.
#[derive(Debug, Error)]
pub enum ImportError {
    /// A file cannot be read at all.
    #[error("{path}: {source}; check the path and its permissions")]
    Unreadable {
        /// The file.
        path: String,
        /// The reason.
        source: std::io::Error,
    },
    /// The name tells no format.
    #[error(
        "{path}: no import is known for this name; give a folder with nodes.csv, bars.csv and cables.csv, \
         an NTRT .yaml, or a .json with nodes, bars and cables"
    )]
    UnknownFormat {
        /// The file.
        path: String,
    },
    /// A scale is no positive number.
    #[error("{option} is {value}; give a positive number")]
    Scale {
        /// Name of the option.
        option: &'static str,
        /// Its value.
        value: f64,
    },
    /// Something in a file is wrong.
    #[error("{0}")]
    Mistake(Box<Mistake>),
}

/// Reads a structure in another format, numbers as they are. See [`import_with`].
///
/// # Errors
/// The file cannot be read or is no structure; the error says where.
pub fn import(path: &Path) -> Result<Imported, ImportError> {
    import_with(path, &ImportOptions::default())
}

/// Reads a structure in another format: a folder with `nodes.csv`, `bars.csv` and `cables.csv`, an NTRT `.yaml`, or a
/// `.json` of nodes, bars and cables.
///
/// # Errors
/// A scale is not positive; the file cannot be read or is no structure; the error says where.
pub fn import_with(path: &Path, options: &ImportOptions) -> Result<Imported, ImportError> {
    for (option, value) in [
        ("length_scale", options.length_scale),
        ("force_scale", options.force_scale),
        ("mass_scale", options.mass_scale),
    ] {
        if !(value.is_finite() && value > 0.0) {
            return Err(ImportError::Scale { option, value });
        }
    }
    let mut sources = Sources::default();
    let mut draft = read(path, &mut sources)?;
    draft.check().map_err(|fault| sources.fault(fault))?;
    draft.tidy();
    draft.scale(options);
    Ok(finish(draft, options, &sources))
}

fn read(path: &Path, sources: &mut Sources) -> Result<Draft, ImportError> {
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    match extension.as_deref() {
        _ if path.is_dir() => triples::read(&path.join("nodes.csv"), sources),
        Some("csv") => triples::read(path, sources),
        Some("yaml" | "yml") => ntrt::read(path, sources),
        Some("json") => neutral::read(path, sources),
        _ => Err(ImportError::UnknownFormat { path: path.display().to_string() }),
    }
}

/// Writes the scene and tries it: a closed chain of bars may have redundant constraints.
fn finish(mut draft: Draft, options: &ImportOptions, sources: &Sources) -> Imported {
    let build = |toml: &str| {
        SceneFile::parse(toml, Language::Toml, "imported scene", ".".into()).and_then(|s| s.build(&[]))
    };
    let toml = write::toml(&draft, options, sources);
    let Err(error) = build(&toml) else { return Imported { toml, warnings: draft.warnings } };
    let kept = draft.warnings.len();
    draft.drop_redundancies = true;
    draft.warnings.push(format!(
        "the constraints repeat each other, so that redundancies are dropped; without: {}",
        reason(&error)
    ));
    let dropped = write::toml(&draft, options, sources);
    if build(&dropped).is_ok() {
        return Imported { toml: dropped, warnings: draft.warnings };
    }
    draft.drop_redundancies = false;
    draft.warnings.truncate(kept);
    draft.warnings.push(format!("the scene does not build as it is: {}", reason(&error)));
    Imported { toml: write::toml(&draft, options, sources), warnings: draft.warnings }
}

/// Without the line, which another comment would shift.
fn reason(error: &SceneError) -> String {
    match error {
        SceneError::Mistake(mistake) => {
            let help = mistake.help.as_ref().map(|help| format!("; {help}"));
            mistake.message.clone() + &help.unwrap_or_default()
        }
        other => other.to_string(),
    }
}
