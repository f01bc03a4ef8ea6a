//! Writing a results folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Serialize;

use crate::error::ReportError;
use crate::folder::checkpoint::Checkpoint;
use crate::folder::journal::{self, Journal};
use crate::folder::parts::{self, Part};
use crate::folder::recovery::{self, Until};
use crate::folder::{Manifest, document, files, frames};
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
    parts: Vec<Part>,
    /// Number of the open part, and its rows.
    number: u32,
    part: Table,
    /// First channel of the last row.
    last: Option<f64>,
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
        recovery::clear(path, existing)?;
        let folder = if manifest.channels.is_empty() { path.to_owned() } else { parts::folder(path) };
        fs::create_dir_all(&folder).map_err(ReportError::io("make", &folder))?;
        manifest.complete = false;
        manifest.interrupted = None;
        manifest.documents.clear();
        manifest.frames = None;
        parts::write_list(path, &[])?;
        let frames = frames::Frames::start(path)?;
        let writer = Self::at_part(path, manifest, formats, Until::default(), frames)?;
        // Last: from now on it is a folder of results.
        writer.manifest.write(path)?;
        Ok(writer)
    }

    /// Goes on with a folder: rows whose first channel is greater than `time`, and later frames, are dropped.
    ///
    /// # Errors
    /// The folder holds no results, rows or frames from before the checkpoint are missing, or a file cannot be read or
    /// written.
    pub fn resume(path: &Path, formats: Formats, time: f64) -> Result<Self, ReportError> {
        let mut manifest = Manifest::read(path)?;
        let until = Until::of(path, &manifest, time)?;
        let mut frames = frames::read(path)?;
        frames.retain(|frame| frame.time <= time);
        let rows = until.parts.iter().map(|part| part.rows).sum();
        recovery::check(path, time, rows, frames.len())?;
        parts::keep(path, &until.parts)?;
        let frames = frames::Frames::go_on(path, &frames)?;
        manifest.complete = false;
        manifest.interrupted = None;
        manifest.frames = None;
        let writer = Self::at_part(path, manifest, formats, until, frames)?;
        writer.manifest.write(path)?;
        Ok(writer)
    }

    fn at_part(
        path: &Path,
        manifest: Manifest,
        formats: Formats,
        until: Until,
        frames: frames::Frames,
    ) -> Result<Self, ReportError> {
        Ok(Self {
            path: path.to_owned(),
            journal: Journal::start(path, until.next, manifest.channels.len())?,
            frames,
            parts: until.parts,
            number: until.next,
            last: until.last,
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
        self.last = row.first().copied();
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
        files::write_json(&document::path(&self.path, name)?, value)?;
        if !self.manifest.documents.iter().any(|d| d == name) {
            self.manifest.documents.push(name.into());
            self.manifest.write(&self.path)?;
        }
        Ok(())
    }

    /// Writes `checkpoint.json` in place of an earlier one, which stays until the new one is complete. Rows and frames so far
    /// are made to survive a power failure first.
    ///
    /// # Errors
    /// The value has no JSON form, or the file cannot be written.
    pub fn checkpoint(&mut self, value: &(impl Serialize + ?Sized)) -> Result<(), ReportError> {
        self.journal.sync()?;
        self.frames.sync()?;
        let closed: usize = self.parts.iter().map(|part| part.rows).sum();
        let (rows, frames) = (closed + self.part.rows(), self.frames.count);
        Checkpoint { rows, frames, last: self.last, value }.write(&self.path)
    }

    /// Closes the last part, writes the other formats and the manifest. The manifest is complete unless `change`, which
    /// adds summary and warnings, says why it was interrupted.
    ///
    /// # Errors
    /// A file cannot be written, or one that was written before has vanished.
    pub fn finish(mut self, change: impl FnOnce(&mut Manifest)) -> Result<(), ReportError> {
        self.close_part()?;
        self.frames.check()?;
        parts::check(&self.path, &self.parts)?;
        self.other_formats()?;
        self.manifest.complete = true;
        self.manifest.frames = Some(self.frames.count);
        change(&mut self.manifest);
        self.manifest.complete &= self.manifest.interrupted.is_none();
        self.manifest.write(&self.path)?;
        files::remove(&journal::path(&self.path))
    }

    fn close_part(&mut self) -> Result<(), ReportError> {
        self.since = Instant::now();
        if self.part.rows() == 0 {
            return Ok(());
        }
        self.parts.push(parts::write(&self.path, self.number, &self.part)?);
        parts::write_list(&self.path, &self.parts)?;
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
        for part in &self.parts {
            let part = parts::read(path, part)?;
            csv.as_mut().map_or(Ok(()), |rows| rows.append(&part))?;
            npy.as_mut().map_or(Ok(()), |rows| rows.append(&part))?;
        }
        csv.map_or(Ok(()), CsvRows::finish)?;
        npy.map_or(Ok(()), NpyRows::finish)
    }
}
