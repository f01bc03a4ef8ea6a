//! `frames.ndjson`: one frame a line, with its checksum.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::error::ReportError;
use crate::folder::{files, sealed};
use crate::frame::Frame;

/// Where the frames are.
pub(crate) fn path(results: &Path) -> PathBuf {
    results.join("frames.ndjson")
}

/// A file of frames that is being written.
pub(crate) struct Frames {
    path: PathBuf,
    file: File,
    bytes: u64,
    /// How many there are.
    pub(crate) count: usize,
}

impl Frames {
    /// No frames yet.
    pub(crate) fn start(results: &Path) -> Result<Self, ReportError> {
        Self::go_on(results, &[])
    }

    /// Goes on after some frames, and drops all others.
    pub(crate) fn go_on(results: &Path, frames: &[Frame]) -> Result<Self, ReportError> {
        let path = path(results);
        let lines = frames.iter().map(sealed::seal).collect::<Result<Vec<_>, _>>();
        let bytes = lines.map_err(ReportError::json(&path))?.concat();
        files::write_file(&path, &bytes)?;
        let file = OpenOptions::new().append(true).open(&path).map_err(ReportError::io("write", &path))?;
        Ok(Self { path, file, bytes: bytes.len() as u64, count: frames.len() })
    }

    /// Appends a frame, in one write.
    pub(crate) fn push(&mut self, frame: &Frame) -> Result<(), ReportError> {
        let line = sealed::seal(frame).map_err(ReportError::json(&self.path))?;
        self.file.write_all(&line).map_err(ReportError::io("write", &self.path))?;
        self.bytes += line.len() as u64;
        self.count += 1;
        Ok(())
    }

    /// Makes what was written survive a power failure.
    pub(crate) fn sync(&self) -> Result<(), ReportError> {
        self.file.sync_data().map_err(ReportError::io("write", &self.path))
    }

    /// Refuses where the file is no longer the one that was written: someone has removed or shortened it.
    pub(crate) fn check(&self) -> Result<(), ReportError> {
        match fs::metadata(&self.path) {
            Ok(about) if about.len() == self.bytes => Ok(()),
            Ok(_) => Err(ReportError::damaged(&self.path, "something else has written it; begin anew")),
            Err(_) => Err(files::vanished(&self.path)),
        }
    }
}

/// All frames; last lines that were cut off are left out.
pub(crate) fn read(results: &Path) -> Result<Vec<Frame>, ReportError> {
    let path = path(results);
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Err(files::vanished(&path)),
        Err(e) => return Err(ReportError::io("read", &path)(e)),
    };
    let mut frames = Vec::new();
    let mut torn = None;
    for (k, line) in bytes.split_inclusive(|&b| b == b'\n').enumerate() {
        match (sealed::open(line), &torn) {
            (Ok(frame), None) => frames.push(frame),
            (Ok(_), Some(damage)) => return Err(ReportError::damaged(&path, damage)),
            (Err(why), None) => torn = Some(format!("line {}: {why}", k + 1)),
            (Err(_), Some(_)) => {}
        }
    }
    Ok(frames)
}
