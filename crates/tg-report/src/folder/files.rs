//! Files that are there completely or not at all.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::error::ReportError;

/// A file that takes the place of an earlier one when it is complete; one that is dropped before is removed. What is no
/// plain file, a pipe or a device, is written where it is.
pub(crate) struct NewFile {
    path: PathBuf,
    file: File,
    /// Where it grows.
    temporary: Option<PathBuf>,
}

impl NewFile {
    /// Begins a file that grows beside its place.
    pub(crate) fn create(path: &Path) -> Result<Self, ReportError> {
        let begin = || {
            let Ok(about) = fs::metadata(path) else { return Self::growing(path, beside(path)) };
            // Refuses what may not be written.
            let earlier = OpenOptions::new().write(true).open(path)?;
            if about.is_file() {
                // Behind a link it is the file that is replaced.
                let path = fs::canonicalize(path)?;
                return Self::growing(&path, beside(&path));
            }
            Ok(Self { path: path.to_owned(), file: earlier, temporary: None })
        };
        begin().map_err(ReportError::io("write", path))
    }

    /// Begins a file that grows under another name.
    pub(crate) fn growing(path: &Path, temporary: PathBuf) -> io::Result<Self> {
        let file = File::create(&temporary)?;
        Ok(Self { path: path.to_owned(), file, temporary: Some(temporary) })
    }

    /// Puts it in its place.
    pub(crate) fn finish(mut self) -> Result<(), ReportError> {
        let Some(temporary) = &self.temporary else { return Ok(()) };
        let placed = self.file.sync_all().and_then(|()| fs::rename(temporary, &self.path));
        placed.map_err(ReportError::io("write", &self.path))?;
        self.temporary = None;
        Ok(())
    }
}

impl Write for NewFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for NewFile {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}

impl Drop for NewFile {
    /// What is incomplete would only take room.
    fn drop(&mut self) {
        if let Some(temporary) = &self.temporary {
            let _ = fs::remove_file(temporary);
        }
    }
}

/// Writes a value as JSON on one line; the file is the earlier one until the new one is complete.
pub(crate) fn write_json(path: &Path, value: &(impl Serialize + ?Sized)) -> Result<(), ReportError> {
    let mut bytes = serde_json::to_vec(value).map_err(ReportError::json(path))?;
    bytes.push(b'\n');
    write_file(path, &bytes)
}

/// Writes a file; it is the earlier one until the new one is complete.
///
/// # Errors
/// The file cannot be written.
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), ReportError> {
    write(NewFile::create(path)?, bytes)
}

/// Fills a file and puts it in its place.
pub(crate) fn write(mut file: NewFile, bytes: &[u8]) -> Result<(), ReportError> {
    file.write_all(bytes).map_err(ReportError::io("write", &file.path))?;
    file.finish()
}

/// Makes names of a folder last: without it a power failure may take back a file that was put in its place.
pub(crate) fn sync_folder(path: &Path) -> Result<(), ReportError> {
    // Only Unix opens folders.
    if !cfg!(unix) {
        return Ok(());
    }
    File::open(path).and_then(|folder| folder.sync_all()).map_err(ReportError::io("write", path))
}

/// Removes a file that may be missing.
pub(crate) fn remove(path: &Path) -> Result<(), ReportError> {
    match fs::remove_file(path) {
        Err(e) if e.kind() != io::ErrorKind::NotFound => Err(ReportError::io("remove", path)(e)),
        _ => Ok(()),
    }
}

/// Refuses a file that other files say must be there.
pub(crate) fn vanished(path: &Path) -> ReportError {
    ReportError::damaged(path, "it has vanished; put it back, or begin anew")
}

/// What is said of a file whose checksum does not fit.
pub(crate) const CHANGED: &str =
    "it is not what was written: its checksum does not fit; take it from a copy, or begin anew";

fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".new");
    path.with_file_name(name)
}
