//! From a file to a scene, and from a scene to its structure.

use std::path::{Path, PathBuf};

use crate::assemble::{Context, assemble};
use crate::deserialize::from_node;
use crate::error::{Mistake, ReadError, SceneError};
use crate::expression::Variables;
use crate::quantity::Quantity;
use crate::run::{ChannelName, Format as RunFormat, RunSection, Scheme};
use crate::scene::Scene;
use crate::structure::Built;
use crate::{json_text, toml_text, values};

/// Version of the format that this crate reads.
pub const VERSION: u32 = 1;

/// Spectral radius of generalised-α at infinity that a scene need not say.
const SPECTRAL_RADIUS: f64 = 0.7;
/// Pictures per second that a scene need not say.
const FRAME_RATE: f64 = 50.0;
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

/// The numbers of a scene's run section.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Simulated time \[s\].
    pub duration: f64,
    /// Step \[s\], unless accuracy is asked for.
    pub step: Option<f64>,
    /// Position error aimed at \[m\].
    pub accuracy: Option<f64>,
    /// Time stepping.
    pub scheme: Scheme,
    /// Spectral radius of generalised-α.
    pub spectral_radius: f64,
    /// Time between rows \[s\].
    pub every: Option<f64>,
    /// Pictures per second.
    pub frame_rate: f64,
    /// Columns.
    pub channels: Vec<ChannelName>,
    /// Further forms of the trajectory.
    pub formats: Vec<RunFormat>,
}

impl RunSettings {
    /// The settings of a scene that says nothing about its run, without a step.
    pub fn new(duration: f64) -> Self {
        Self {
            duration,
            step: None,
            accuracy: None,
            scheme: Scheme::default(),
            spectral_radius: SPECTRAL_RADIUS,
            every: None,
            frame_rate: FRAME_RATE,
            channels: vec![ChannelName::Energies, ChannelName::Lengths, ChannelName::Tensions],
            formats: Vec::new(),
        }
    }
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

fn run_settings(run: &RunSection, variables: &Variables) -> Result<RunSettings, ReadError> {
    let positive = |quantity: &Quantity| values::positive(variables, quantity);
    let optional = |quantity: &Option<Quantity>| quantity.as_ref().map(positive).transpose();
    let (step, accuracy) = (optional(&run.step)?, optional(&run.accuracy)?);
    if let (Some(_), Some(accuracy)) = (&run.step, &run.accuracy) {
        let error = ReadError::new("step and accuracy are both given").at(&accuracy.span);
        return Err(error.help("keep one"));
    }
    if step.is_none() && accuracy.is_none() {
        return Err(ReadError::new("the run has no step")
            .at(&run.duration.span)
            .help("give step [s] or accuracy [m]"));
    }
    let spectral_radius =
        run.spectral_radius.as_ref().map_or(Ok(SPECTRAL_RADIUS), |r| variables.number(r))?;
    if let (Some(given), false) = (&run.spectral_radius, (0.0..=1.0).contains(&spectral_radius)) {
        return Err(ReadError::new("the spectral radius lies between 0 and 1").at(&given.span));
    }
    let mut settings = RunSettings::new(positive(&run.duration)?);
    if let Some(channels) = &run.channels {
        settings.channels.clone_from(channels);
    }
    if !run.points.is_empty() && !settings.channels.contains(&ChannelName::Points) {
        settings.channels.push(ChannelName::Points);
    }
    Ok(RunSettings {
        step,
        accuracy,
        scheme: run.scheme.unwrap_or_default(),
        spectral_radius,
        every: optional(&run.every)?,
        frame_rate: optional(&run.frame_rate)?.unwrap_or(FRAME_RATE),
        formats: run.formats.clone(),
        ..settings
    })
}
