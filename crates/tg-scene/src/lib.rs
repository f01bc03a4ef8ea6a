//! Scene files: tensegrity structures written by hand in TOML or JSON, read with errors that point into the file, and
//! built into models.
//!
//! ```
//! use tg_scene::{Built, Language, SceneFile};
//!
//! let text = r#"
//!     version = 1
//!     dimension = 2
//!     gravity = [0, "-g"]
//!     parameters = { h = 2 }
//!     anchors = { foot = [0, 0], left = [-1, 0], right = [1, 0] }
//!     bars.mast = { ends = ["foot", [0, "h"]], mass = 1 }
//!     joints.hinge = { places = ["foot", "mast.from"] }
//!     groups.guys = { stiffness = 2000, rest = "1.1 * h" }
//!     cables.left = { ends = ["left", "mast.to"], group = "guys" }
//!     cables.right = { ends = ["right", "mast.to"], group = "guys" }
//! "#;
//! let file = SceneFile::parse(text, Language::Toml, "mast.toml", ".".into())?;
//! let Built::Plane(structure) = file.build(&[])? else { unreachable!() };
//! assert_eq!(structure.model.report().degrees_of_freedom(), 1);
//!
//! let wrong = text.replace("mast.to", "mast.top");
//! let error = SceneFile::parse(&wrong, Language::Toml, "mast.toml", ".".into())?.build(&[]).unwrap_err();
//! assert!(error.to_string().starts_with("mast.toml:10:37: \"mast\" has no point \"top\""));
//! # Ok::<(), tg_scene::SceneError>(())
//! ```
//!
//! The types under [`Scene`] *are* the format: [`schema`] is generated from them, and so is the reference page. Reading has three
//! steps: TOML or JSON become one tree of values with their places (`toml_text`, `json_text`, `node`), serde makes a
//! [`Scene`] of it (`deserialize`, `spanned`), and `assemble` builds the model, copy by copy of each array.
//!
//! [`import()`] writes scenes from tables of nodes, bars and cables, from NTRT structures and from a neutral JSON.

mod arithmetic;
mod assemble;
mod cable;
mod deserialize;
mod dimension;
mod error;
mod expression;
mod import;
mod json_text;
mod load;
mod member;
mod names;
mod node;
mod parts;
mod place;
mod quantity;
mod read;
mod reference;
mod run;
mod scene;
mod scheme;
mod settings;
mod shape;
mod signal;
mod signals;
mod spanned;
mod structure;
mod toml_text;
mod values;

pub use cable::{Cable, Group, Law};
pub use error::{Mistake, SceneError};
pub use import::{ImportError, ImportOptions, Imported, import, import_with};
pub use load::{Load, MomentAxesName};
pub use member::{AxisAngle, Bar, Body, CoordTypeName, Inertia, Particle, Rotation};
pub use parts::{Array, JoiningName, Joint, Motion, Support};
pub use place::{OnMember, PlaceName, PlaceRef};
pub use quantity::{Expression, Quantity, Vector};
pub use read::{Files, Folder, Language, SceneFile, VERSION};
pub use reference::reference;
pub use run::{ChannelName, Format, RunSection};
pub use scene::{Parameters, RedundanciesName, Scene};
pub use scheme::{Scheme, UnknownScheme};
pub use settings::RunSettings;
pub use shape::{Cylinder, Plate, Shape};
pub use signal::{CsvFile, Function, Ramp, RecordKind, Samples, SignalSpec, SignalValue, Sine};
pub use spanned::{Named, Spanned};
pub use structure::{Built, MemberPicture, Outline, PictureKind, Structure};

/// The JSON Schema of scene files, for editors.
pub fn schema() -> schemars::Schema {
    let mut schema = schemars::schema_for!(Scene);
    reference::add_aliases(&mut schema);
    schema
}
