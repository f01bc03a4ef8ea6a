//! Files that are there completely or not at all.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::ReportError;

/// Writes a value as indented JSON; the file is the earlier one until the new one is complete.
pub(crate) fn write_json(path: &Path, value: &(impl Serialize + ?Sized)) -> Result<(), ReportError> {
    let mut bytes = serde_json::to_vec_pretty(value).map_err(ReportError::json(path))?;
    bytes.push(b'\n');
    write_bytes(path, &bytes)
}

/// Writes a value as JSON on one line; the file is the earlier one until the new one is complete.
pub(crate) fn write_json_compact(path: &Path, value: &(impl Serialize + ?Sized)) -> Result<(), ReportError> {
    let mut bytes = serde_json::to_vec(value).map_err(ReportError::json(path))?;
    bytes.push(b'\n');
    write_bytes(path, &bytes)
}

/// Writes bytes; the file is the earlier one until the new one is complete.
pub(crate) fn write_bytes(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    let temporary = beside(path);
    let write = || -> std::io::Result<()> {
        let mut file = File::create(&temporary)?;
        file.write_all(bytes)?;
        file.sync_all()
    };
    write().map_err(ReportError::io("write", &temporary))?;
    rename(&temporary, path)
}

/// Puts a complete file in its place.
pub(crate) fn rename(from: &Path, to: &Path) -> Result<(), ReportError> {
    fs::rename(from, to).map_err(ReportError::io("write", to))
}

/// Removes a file that may be missing.
pub(crate) fn remove(path: &Path) -> Result<(), ReportError> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(ReportError::io("remove", path)(e)),
        _ => Ok(()),
    }
}

fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".new");
    path.with_file_name(name)
}
