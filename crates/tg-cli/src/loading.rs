//! Scenes and their structures.

use std::path::Path;

use tg_scene::{Built, SceneFile, Structure};

use crate::answer::Failure;
use crate::args::SceneArgs;

/// A scene that has been read and built.
pub(crate) struct Loaded {
    pub(crate) file: SceneFile,
    pub(crate) built: Built,
    pub(crate) set: Vec<(String, f64)>,
}

impl Loaded {
    /// Reads and builds a scene with the parameters of the command line.
    pub(crate) fn new(arguments: &SceneArgs) -> Result<Self, Failure> {
        Self::read(&arguments.scene, &arguments.set)
    }

    /// Reads and builds a scene.
    pub(crate) fn read(path: &Path, set: &[(String, f64)]) -> Result<Self, Failure> {
        let file = SceneFile::read(path)?;
        let built = file.build(set)?;
        Ok(Self { file, built, set: set.to_vec() })
    }

    /// Title for headings.
    pub(crate) fn title(&self) -> String {
        self.file.scene.title.clone().unwrap_or_else(|| stem(Path::new(&self.file.name)))
    }
}

/// Name of a file without folder and extension.
pub(crate) fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "scene".into(), |stem| stem.to_string_lossy().into_owned())
}

/// What the reader of any answer should know about a structure.
pub(crate) fn remarks<const D: usize>(structure: &Structure<D>) -> Vec<String> {
    let report = structure.model.report();
    let idle = report
        .idle_cables
        .iter()
        .map(|name| format!("cable \"{name}\" joins two held points and does nothing"));
    let redundant = report.redundant.iter().map(|redundancy| format!("left out: {redundancy}"));
    idle.chain(redundant).collect()
}
