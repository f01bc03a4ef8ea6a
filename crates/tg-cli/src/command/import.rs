//! `tg import`: files of other programs into scenes.

use serde_json::json;
use tg_report::write_file;
use tg_scene::{ImportError, ImportOptions, SceneError, import_with};

use crate::answer::{Answer, Failure};
use crate::args::Import;

pub(crate) fn import(arguments: &Import) -> Result<Answer, Failure> {
    let options = ImportOptions {
        length_scale: arguments.length_scale,
        mass_scale: arguments.mass_scale,
        force_scale: arguments.force_scale,
    };
    let imported = import_with(&arguments.path, &options).map_err(|error| match error {
        ImportError::Mistake(mistake) => Failure::Scene(SceneError::Mistake(mistake)),
        other => Failure::Usage(other.to_string()),
    })?;
    let text = match &arguments.output {
        Some(path) => {
            write_file(path, imported.toml.as_bytes())?;
            format!("{}: imported; go on with: tg statics --relax {}\n", path.display(), path.display())
        }
        None => imported.toml.clone(),
    };
    let document = json!({ "scene": imported.toml });
    Ok(Answer::new(document, text).warn(imported.warnings))
}
