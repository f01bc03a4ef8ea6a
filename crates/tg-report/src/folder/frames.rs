//! `frames.ndjson`: one frame a line.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::error::ReportError;
use crate::folder::files;
use crate::frame::Frame;

/// Where the frames are.
pub(crate) fn path(results: &Path) -> PathBuf {
    results.join("frames.ndjson")
}

/// A file of frames that is being written.
pub(crate) struct Frames {
    path: PathBuf,
    file: File,
}

impl Frames {
    /// Appends to the frames that are there.
    pub(crate) fn open(results: &Path) -> Result<Self, ReportError> {
        let path = path(results);
        let file = OpenOptions::new().create(true).append(true).open(&path);
        let file = file.map_err(ReportError::io("write", &path))?;
        Ok(Self { path, file })
    }

    /// Appends a frame, in one write.
    pub(crate) fn push(&mut self, frame: &Frame) -> Result<(), ReportError> {
        let mut line = serde_json::to_vec(frame).map_err(ReportError::json(&self.path))?;
        line.push(b'\n');
        self.file.write_all(&line).map_err(ReportError::io("write", &self.path))
    }
}

/// All frames; a last line that was cut off is left out.
pub(crate) fn read(results: &Path) -> Result<Vec<Frame>, ReportError> {
    let path = path(results);
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => return Err(ReportError::io("read", &path)(e)),
    };
    let lines = bytes.split_inclusive(|&b| b == b'\n').filter(|line| line.ends_with(b"\n"));
    lines
        .enumerate()
        .map(|(k, line)| {
            let damaged = |e| ReportError::damaged(&path, format!("line {}: {e}", k + 1));
            serde_json::from_slice(line).map_err(damaged)
        })
        .collect()
}

/// Drops frames later than `time` and a last line that was cut off.
pub(crate) fn cut(results: &Path, time: f64) -> Result<(), ReportError> {
    let mut bytes = Vec::new();
    for frame in read(results)?.iter().filter(|f| f.time <= time) {
        serde_json::to_writer(&mut bytes, frame).map_err(ReportError::json(&path(results)))?;
        bytes.push(b'\n');
    }
    files::write_bytes(&path(results), &bytes)
}
