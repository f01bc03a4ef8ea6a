//! Results folders as the commands fill them.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use tg_report::{Existing, Formats, Kind, Manifest, Outline, Results, ResultsWriter, View, write_file};

use crate::answer::Failure;
use crate::args::OutputArgs;
use crate::loading::Loaded;

/// The manifest of an analysis of a scene.
pub(crate) fn manifest(kind: Kind, loaded: &Loaded, outline: Outline, settings: Value) -> Manifest {
    let mut manifest = Manifest::new(kind, &loaded.title());
    manifest.scene = Some(tg_report::Scene { name: loaded.file.name.clone(), hash: hash(loaded) });
    manifest.program = format!("tg {}", env!("CARGO_PKG_VERSION"));
    manifest.started = Some(humantime::format_rfc3339_seconds(SystemTime::now()).to_string());
    manifest.settings = settings;
    if let Value::Object(map) = &mut manifest.settings {
        map.insert("set".into(), set(loaded));
    }
    manifest.outline = Some(outline);
    manifest
}

/// Parameters that the command line has set.
pub(crate) fn set(loaded: &Loaded) -> Value {
    Value::Object(loaded.set.iter().map(|(name, value)| (name.clone(), json!(value))).collect())
}

/// SHA-256 of the scene's text, in hexadecimal digits.
pub(crate) fn hash(loaded: &Loaded) -> String {
    Sha256::digest(loaded.file.text.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Writes a folder without trajectory, if one is asked for: the answer, and what `fill` adds.
pub(crate) fn write(
    output: &OutputArgs,
    mut manifest: Manifest,
    answer: &Value,
    fill: impl FnOnce(&mut ResultsWriter) -> Result<(), Failure>,
) -> Result<Option<PathBuf>, Failure> {
    let Some(folder) = &output.output else { return Ok(None) };
    let existing = if output.force { Existing::Replace } else { Existing::Keep };
    let warnings = std::mem::take(&mut manifest.warnings);
    let mut writer = ResultsWriter::create(folder, manifest, Formats::default(), existing)?;
    writer.document("answer", answer)?;
    fill(&mut writer)?;
    writer.finish(|manifest| manifest.warnings = warnings)?;
    write_view(folder, &folder.join("view.html"))?;
    Ok(Some(folder.clone()))
}

/// Writes the page of a results folder.
pub(crate) fn write_view(folder: &Path, file: &Path) -> Result<(), Failure> {
    let html = View::of(&Results::open(folder)?)?.html()?;
    Ok(write_file(file, html.as_bytes())?)
}

/// The sentence that tells where results are.
pub(crate) fn told(folder: Option<&PathBuf>) -> String {
    folder.map_or_else(String::new, |folder| {
        format!("results in {}, to look at: {}\n", folder.display(), folder.join("view.html").display())
    })
}
