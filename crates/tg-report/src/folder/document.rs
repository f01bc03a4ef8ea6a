//! Names of documents.

use std::path::{Path, PathBuf};

use crate::error::ReportError;

/// Files of the folder itself.
const TAKEN: [&str; 4] = ["run", "checkpoint", "trajectory", "parts"];

/// Where a document is.
pub(crate) fn path(folder: &Path, name: &str) -> Result<PathBuf, ReportError> {
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    if name.is_empty() || !name.chars().all(plain) || TAKEN.contains(&name) {
        return Err(ReportError::DocumentName { name: name.into(), taken: TAKEN.join(", ") });
    }
    Ok(folder.join(name).with_extension("json"))
}
