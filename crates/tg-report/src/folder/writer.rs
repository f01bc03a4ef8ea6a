//! Writing a results folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::error::ReportError;
use crate::folder::journal::{self, Journal};
use crate::folder::{Manifest, document, files, frames, parts};
use crate::frame::Frame;
use crate::table::{CsvRows, NpyRows, Table, check_channels};

/// Files besides the Parquet parts, made at the end.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Formats {
    /// `trajectory.csv`.
    pub csv: bool,
    /// `trajectory.npy`, structured.
    pub npy: bool,
}

/// What happens to earlier results in the folder.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Existing {
    /// They stay; the folder is refused.
    #[default]
    Keep,
    /// They are removed; other files of the folder stay.
    Replace,
}

/// Writes a results folder. Dropped without [`ResultsWriter::finish`] it leaves a folder that says it is incomplete and
/// holds every row and frame.
pub struct ResultsWriter {
    path: PathBuf,
    manifest: Manifest,
    formats: Formats,
    journal: Journal,
    frames: frames::Frames,
    number: u32,
    part: Table,
    since: Instant,
}

impl ResultsWriter {
    /// Starts a results folder; folders above it are made.
    ///
    /// # Errors
    /// The folder holds something that is no results, or earlier results that are to stay; two channels have one name;
    /// the outline cannot be drawn; a file cannot be written.
    pub fn create(
        path: &Path,
        mut manifest: Manifest,
        formats: Formats,
        existing: Existing,
    ) -> Result<Self, ReportError> {
        check_channels(&manifest.channels)?;
        manifest.outline.as_ref().map_or(Ok(()), |o| o.check())?;
        clear(path, existing)?;
        let folder = if manifest.channels.is_empty() { path.to_owned() } else { parts::folder(path) };
        fs::create_dir_all(&folder).map_err(ReportError::io("make", &folder))?;
        manifest.complete = false;
        manifest.interrupted = None;
        manifest.documents.clear();
        manifest.write(path)?;
        Self::at_part(path, manifest, formats, 0)
    }

    /// Goes on with a folder: rows whose first channel is greater than `time`, and later frames, are dropped.
    ///
    /// # Errors
    /// The folder holds no results, or a file cannot be read or written.
    pub fn resume(path: &Path, formats: Formats, time: f64) -> Result<Self, ReportError> {
        let mut manifest = Manifest::read(path)?;
        recover(path, &manifest)?;
        let mut next = 0;
        for number in parts::list(path)?.into_iter().rev() {
            let mut part = parts::read(path, number)?;
            let before = part.rows();
            part.retain(|x| x <= time);
            if part.rows() == before {
                next = number + 1;
                break;
            }
            if part.rows() > 0 {
                parts::write(path, number, &part)?;
                next = number + 1;
                break;
            }
            files::remove(&parts::path(path, number))?;
        }
        frames::cut(path, time)?;
        manifest.complete = false;
        manifest.interrupted = None;
        manifest.write(path)?;
        Self::at_part(path, manifest, formats, next)
    }

    fn at_part(path: &Path, manifest: Manifest, formats: Formats, number: u32) -> Result<Self, ReportError> {
        Ok(Self {
            path: path.to_owned(),
            journal: Journal::start(path, number, manifest.channels.len())?,
            frames: frames::Frames::open(path)?,
            number,
            part: Table::new(manifest.channels.clone()),
            since: Instant::now(),
            manifest,
            formats,
        })
    }

    /// What the folder says about itself.
    pub fn manifest(&self) -> &Manifest {
        &self.manifest
    }

    /// Where the folder is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Appends a row; it survives the end of the program, however it ends.
    ///
    /// # Errors
    /// Not as many values as channels, or a file cannot be written.
    pub fn row(&mut self, row: &[f64]) -> Result<(), ReportError> {
        self.part.push(row)?;
        self.journal.row(row)?;
        let full = self.part.rows() >= parts::most_rows(row.len());
        if full || self.since.elapsed() >= Duration::from_secs(parts::PART_SECONDS) {
            self.close_part()?;
        }
        Ok(())
    }

    /// Appends a frame.
    ///
    /// # Errors
    /// Its members or cables are not as many as those of the outline, or the file cannot be written.
    pub fn frame(&mut self, frame: &Frame) -> Result<(), ReportError> {
        self.manifest.outline.as_ref().map_or(Ok(()), |outline| frame.check(outline))?;
        self.frames.push(frame)
    }

    /// Writes a document, `name.json`, in place of an earlier one. [`crate::View::of`] shows `modes`
    /// ([`crate::ModeSet`]), `shapes` (a list of [`crate::Shape`]) and `plots` (a list of [`crate::Plot`]).
    ///
    /// # Errors
    /// The name is taken or no plain name, the value has no JSON form, or the file cannot be written.
    pub fn document(&mut self, name: &str, value: &(impl Serialize + ?Sized)) -> Result<(), ReportError> {
        files::write_json_compact(&document::path(&self.path, name)?, value)?;
        if !self.manifest.documents.iter().any(|d| d == name) {
            self.manifest.documents.push(name.into());
            self.manifest.write(&self.path)?;
        }
        Ok(())
    }

    /// Writes `checkpoint.json` in place of an earlier one, which stays until the new one is complete.
    ///
    /// # Errors
    /// The value has no JSON form, or the file cannot be written.
    pub fn checkpoint(&mut self, value: &(impl Serialize + ?Sized)) -> Result<(), ReportError> {
        files::write_json_compact(&checkpoint_path(&self.path), value)
    }

    /// Closes the last part, writes the other formats and the manifest. The manifest is complete unless `change`, which
    /// adds summary and warnings, says why it was interrupted.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn finish(mut self, change: impl FnOnce(&mut Manifest)) -> Result<(), ReportError> {
        self.close_part()?;
        files::remove(&journal::path(&self.path))?;
        self.other_formats()?;
        self.manifest.complete = true;
        change(&mut self.manifest);
        self.manifest.complete &= self.manifest.interrupted.is_none();
        self.manifest.write(&self.path)
    }

    fn close_part(&mut self) -> Result<(), ReportError> {
        self.since = Instant::now();
        if self.part.rows() == 0 {
            return Ok(());
        }
        parts::write(&self.path, self.number, &self.part)?;
        self.number += 1;
        self.journal = Journal::start(&self.path, self.number, self.part.channels.len())?;
        self.part.columns.iter_mut().for_each(Vec::clear);
        Ok(())
    }

    fn other_formats(&self) -> Result<(), ReportError> {
        let (path, channels) = (&self.path, &self.manifest.channels);
        let mut csv = match self.formats.csv {
            true => Some(CsvRows::create(&path.join("trajectory.csv"), channels)?),
            false => None,
        };
        let mut npy = match self.formats.npy {
            true => Some(NpyRows::create(&path.join("trajectory.npy"), channels)?),
            false => None,
        };
        if csv.is_none() && npy.is_none() {
            return Ok(());
        }
        for number in parts::list(path)? {
            let part = parts::read(path, number)?;
            csv.as_mut().map_or(Ok(()), |rows| rows.append(&part))?;
            npy.as_mut().map_or(Ok(()), |rows| rows.append(&part))?;
        }
        csv.map_or(Ok(()), CsvRows::finish)?;
        npy.map_or(Ok(()), NpyRows::finish)
    }
}

/// Where the checkpoint is.
pub(crate) fn checkpoint_path(folder: &Path) -> PathBuf {
    folder.join("checkpoint.json")
}

/// Makes a part of what a killed program left in the journal; the number of its rows.
pub(crate) fn recover(path: &Path, manifest: &Manifest) -> Result<usize, ReportError> {
    let left = journal::read(path, &manifest.channels)?;
    let left = left.filter(|(number, rows)| rows.rows() > 0 && !parts::path(path, *number).exists());
    if let Some((number, rows)) = &left {
        let folder = parts::folder(path);
        fs::create_dir_all(&folder).map_err(ReportError::io("make", &folder))?;
        parts::write(path, *number, rows)?;
    }
    files::remove(&journal::path(path))?;
    Ok(left.map_or(0, |(_, rows)| rows.rows()))
}

/// Removes earlier results, or refuses.
fn clear(path: &Path, existing: Existing) -> Result<(), ReportError> {
    let mut entries = match fs::read_dir(path) {
        Ok(entries) => entries,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(e) => return Err(ReportError::io("read", path)(e)),
    };
    let Some(first) = entries.next() else { return Ok(()) };
    let first = first.map_err(ReportError::io("read", path))?;
    let earlier = match Manifest::read(path) {
        Ok(manifest) => manifest,
        Err(_) => {
            let found = first.file_name().to_string_lossy().into_owned();
            return Err(ReportError::Foreign { path: path.to_owned(), found });
        }
    };
    if existing == Existing::Keep {
        return Err(ReportError::Exists { path: path.to_owned() });
    }
    for number in parts::list(path)? {
        files::remove(&parts::path(path, number))?;
    }
    for name in &earlier.documents {
        files::remove(&document::path(path, name)?)?;
    }
    for name in ["trajectory.csv", "trajectory.npy", "part.new"] {
        files::remove(&path.join(name))?;
    }
    // The manifest stays until the next one takes its place: the folder is always one of results.
    for file in [journal::path(path), frames::path(path), checkpoint_path(path)] {
        files::remove(&file)?;
    }
    Ok(())
}
