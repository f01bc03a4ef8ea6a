//! `checkpoint.json`: where a computation goes on, and how many rows and frames it had by then.
//!
//! The counts tell where rows are missing before the checkpoint: a file has vanished, or the power failed before the operating
//! system had written it.

use std::fs;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::error::ReportError;
use crate::folder::{files, sealed};

/// A checkpoint in its file.
#[derive(Serialize, Deserialize)]
pub(crate) struct Checkpoint<T> {
    /// Rows by then.
    pub(crate) rows: usize,
    /// Frames by then.
    pub(crate) frames: usize,
    /// First channel of the last row.
    pub(crate) last: Option<f64>,
    /// What the computation wants to know.
    pub(crate) value: T,
}

/// Where the checkpoint is.
pub(crate) fn path(results: &Path) -> PathBuf {
    results.join("checkpoint.json")
}

impl<T: Serialize> Checkpoint<T> {
    /// Writes it in place of an earlier one.
    pub(crate) fn write(&self, results: &Path) -> Result<(), ReportError> {
        let path = path(results);
        files::write_file(&path, &sealed::seal(self).map_err(ReportError::json(&path))?)
    }
}

impl<T: DeserializeOwned> Checkpoint<T> {
    /// The checkpoint; none where there is none.
    pub(crate) fn read(results: &Path) -> Result<Option<Self>, ReportError> {
        let path = path(results);
        match fs::read(&path) {
            Ok(bytes) => sealed::open(&bytes).map(Some).map_err(|e| ReportError::damaged(&path, e)),
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(e) => Err(ReportError::io("read", &path)(e)),
        }
    }
}
