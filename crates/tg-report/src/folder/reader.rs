//! Reading a results folder, finished or not.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use crate::error::ReportError;
use crate::folder::checkpoint::Checkpoint;
use crate::folder::{Manifest, document, files, frames, journal, parts, recovery};
use crate::frame::{Frame, ModeSet, Shape};
use crate::plot::Plot;
use crate::table::Table;

/// A results folder that is read; the program that makes it may still run.
#[derive(Clone, Debug)]
pub struct Results {
    /// Where it is.
    pub path: PathBuf,
    /// What it says about itself.
    pub manifest: Manifest,
}

impl Results {
    /// Opens a results folder.
    ///
    /// # Errors
    /// It is no results folder, or one of another version.
    pub fn open(path: &Path) -> Result<Self, ReportError> {
        Ok(Self { path: path.to_owned(), manifest: Manifest::read(path)? })
    }

    /// The whole table: all parts, then the rows of the journal that are in no part.
    ///
    /// # Errors
    /// A file cannot be read or is damaged.
    pub fn table(&self) -> Result<Table, ReportError> {
        let mut table = Table::new(self.manifest.channels.clone());
        // The journal is read first: a part that is closed meanwhile then counts once.
        let rest = journal::read(&self.path, &table.channels)?;
        let parts = parts::list(&self.path)?;
        for part in &parts {
            let rows = parts::read(&self.path, part)?;
            if rows.channels != table.channels {
                let path = parts::path(&self.path, part.part);
                return Err(ReportError::damaged(&path, "its columns are not the channels of run.json"));
            }
            table.append(rows)?;
        }
        match rest {
            Some((open, rows)) if parts.iter().all(|part| part.part != open) => {
                table.append(rows).map(|()| table)
            }
            // A run that ends while it is read takes its journal away last.
            None if !journal::path(&self.path).exists() && !Manifest::read(&self.path)?.ended() => {
                Err(files::vanished(&journal::path(&self.path)))
            }
            _ => Ok(table),
        }
    }

    /// Makes a part of the rows that a killed program left in the journal, so that programs which read `trajectory/` see
    /// them too; returns their number. Only where nothing writes the folder any more.
    ///
    /// # Errors
    /// A file cannot be read or written.
    pub fn recover(&self) -> Result<usize, ReportError> {
        recovery::recover(&self.path, &self.manifest)
    }

    /// All frames.
    ///
    /// # Errors
    /// The file cannot be read or is damaged before its last line.
    pub fn frames(&self) -> Result<Vec<Frame>, ReportError> {
        let frames = frames::read(&self.path)?;
        match self.manifest.frames {
            Some(count) if count != frames.len() => {
                let reason =
                    format!("{} frames are left of {count}; put it back, or begin anew", frames.len());
                Err(ReportError::damaged(&frames::path(&self.path), reason))
            }
            _ => Ok(frames),
        }
    }

    /// A document; none where there is no such one.
    ///
    /// # Errors
    /// The name is no plain name, or the file has vanished or cannot be read as this type.
    pub fn document<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>, ReportError> {
        let path = document::path(&self.path, name)?;
        match std::fs::read(&path) {
            Ok(bytes) => serde_json::from_slice(&bytes).map(Some).map_err(ReportError::json(&path)),
            Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(ReportError::io("read", &path)(e)),
            Err(_) if self.manifest.documents.iter().any(|known| known == name) => {
                Err(files::vanished(&path))
            }
            Err(_) => Ok(None),
        }
    }

    /// The document `modes`.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn modes(&self) -> Result<Option<ModeSet>, ReportError> {
        self.document("modes")
    }

    /// The document `shapes`; empty where there is none.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn shapes(&self) -> Result<Vec<Shape>, ReportError> {
        Ok(self.document("shapes")?.unwrap_or_default())
    }

    /// The document `plots`; empty where there is none.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn plots(&self) -> Result<Vec<Plot>, ReportError> {
        Ok(self.document("plots")?.unwrap_or_default())
    }

    /// The checkpoint; none where there is none.
    ///
    /// # Errors
    /// It is damaged, or cannot be read as this type.
    pub fn checkpoint<T: DeserializeOwned>(&self) -> Result<Option<T>, ReportError> {
        Ok(Checkpoint::read(&self.path)?.map(|checkpoint| checkpoint.value))
    }
}
