//! From a file to a scene, and from a scene to its structure.

use std::path::{Path, PathBuf};

use crate::assemble::{Context, assemble};
use crate::deserialize::from_node;
use crate::error::{Mistake, ReadError, SceneError};
use crate::expression::Variables;
use crate::run::RunSection;
use crate::scene::Scene;
use crate::settings::{RunSettings, run_settings};
use crate::structure::Built;
use crate::{json_text, toml_text};

/// Version of the format that this crate reads.
pub const VERSION: u32 = 1;

/// Larger recordings \[bytes\] are a slip of the pen: hours of ground motion at 1 kHz have less.
const LARGEST_FILE: u64 = 256 << 20;

/// The language of a scene's text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// TOML.
    Toml,
    /// JSON; comments are allowed.
    Json,
}

/// Gives the text of files that a scene refers to.
pub trait Files {
    /// The text of a file named in a scene.
    ///
    /// # Errors
    /// The file cannot be read.
    fn text(&self, name: &str) -> std::io::Result<String>;
}

/// Files by their path from a folder.
#[derive(Clone, Debug)]
pub struct Folder(pub PathBuf);

impl Files for Folder {
    fn text(&self, name: &str) -> std::io::Result<String> {
        let path = self.0.join(name);
        let about = std::fs::metadata(&path)?;
        // A device may have no end.
        if !about.is_file() || about.len() > LARGEST_FILE {
            let message = format!("not a file of at most {} MiB", LARGEST_FILE >> 20);
            return Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, message));
        }
        std::fs::read_to_string(path)
    }
}

/// A scene and its text.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// The scene.
    pub scene: Scene,
    /// The file, as it was named.
    pub name: String,
    /// Its text.
    pub text: String,
    folder: Folder,
}

impl SceneFile {
    /// Reads a scene from a `.toml` or `.json` file.
    ///
    /// # Errors
    /// The file cannot be read, or is no scene; the error says where.
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let name = path.display().to_string();
        let language = match path.extension().and_then(|extension| extension.to_str()) {
            Some("toml") => Language::Toml,
            Some("json") => Language::Json,
            _ => return Err(SceneError::UnknownFormat { path: name }),
        };
        let unreadable = |source| SceneError::Unreadable { path: name.clone(), source };
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        let folder = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Self::parse(&text, language, &name, folder)
    }

    /// Reads a scene from text; files that it names are sought in `folder`.
    ///
    /// # Errors
    /// The text is no scene; the error says where.
    pub fn parse(text: &str, language: Language, name: &str, folder: PathBuf) -> Result<Self, SceneError> {
        let scene = parse(text, language).map_err(|error| mistake(error, name, text))?;
        Ok(Self { scene, name: name.into(), text: text.into(), folder: Folder(folder) })
    }

    /// Builds the structure, with some parameters replaced.
    ///
    /// # Errors
    /// Something in the scene contradicts itself or the laws of structures; the error says where.
    pub fn build(&self, overrides: &[(String, f64)]) -> Result<Built, SceneError> {
        let build = || {
            let variables = Variables::of(&self.scene.parameters, overrides)?;
            let context = Context { variables, files: &self.folder };
            Ok(match self.scene.dimension.value {
                2 => Built::Plane(Box::new(assemble::<2>(&self.scene, context)?)),
                _ => Built::Space(Box::new(assemble::<3>(&self.scene, context)?)),
            })
        };
        build().map_err(|error| mistake(error, &self.name, &self.text))
    }

    /// Values of all parameters, some replaced.
    ///
    /// # Errors
    /// A parameter has no value.
    pub fn parameters(&self, overrides: &[(String, f64)]) -> Result<Vec<(String, f64)>, SceneError> {
        let variables = Variables::of(&self.scene.parameters, overrides);
        let variables = variables.map_err(|error| mistake(error, &self.name, &self.text))?;
        Ok(variables.all().to_vec())
    }

    /// The run section in numbers, if the scene has one.
    ///
    /// # Errors
    /// A number is missing or out of its range.
    pub fn run(&self, overrides: &[(String, f64)]) -> Result<Option<RunSettings>, SceneError> {
        let settings = |section: &RunSection| {
            let variables = Variables::of(&self.scene.parameters, overrides)?;
            run_settings(section, &variables)
        };
        let run = self.scene.run.as_ref().map(settings).transpose();
        run.map_err(|error| mistake(error, &self.name, &self.text))
    }
}

fn mistake(error: ReadError, name: &str, text: &str) -> SceneError {
    SceneError::Mistake(Box::new(Mistake::new(error, name, text)))
}

fn parse(text: &str, language: Language) -> Result<Scene, ReadError> {
    let node = match language {
        Language::Toml => toml_text::parse(text),
        Language::Json => json_text::parse(text),
    }?;
    let scene: Scene = from_node(&node)?;
    if scene.version.value != VERSION {
        let message = format!("this program reads version {VERSION} of scenes, not {}", scene.version.value);
        return Err(ReadError::new(message).at(&scene.version.span));
    }
    if !matches!(scene.dimension.value, 2 | 3) {
        let message = format!("a scene has 2 or 3 dimensions, not {}", scene.dimension.value);
        return Err(ReadError::new(message).at(&scene.dimension.span));
    }
    Ok(scene)
}
