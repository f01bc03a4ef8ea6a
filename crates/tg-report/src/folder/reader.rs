//! Reading a results folder, finished or not.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;

use crate::error::ReportError;
use crate::folder::{Manifest, document, frames, journal, parts, writer};
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
        let mut numbers = parts::list(&self.path)?;
        if let Some((open, _)) = rest {
            numbers.retain(|&n| n < open);
        }
        for number in numbers {
            let part = parts::read(&self.path, number)?;
            if part.channels != table.channels {
                let path = parts::path(&self.path, number);
                return Err(ReportError::damaged(&path, "its columns are not the channels of run.json"));
            }
            table.append(part)?;
        }
        match rest {
            Some((_, rows)) => table.append(rows).map(|()| table),
            None => Ok(table),
        }
    }

    /// Makes a part of the rows that a killed program left in the journal, so that programs which read `trajectory/` see
    /// them too; returns their number. Only where nothing writes the folder any more.
    ///
    /// # Errors
    /// A file cannot be read or written.
    pub fn recover(&self) -> Result<usize, ReportError> {
        writer::recover(&self.path, &self.manifest)
    }

    /// All frames.
    ///
    /// # Errors
    /// The file cannot be read or is damaged before its last line.
    pub fn frames(&self) -> Result<Vec<Frame>, ReportError> {
        frames::read(&self.path)
    }

    /// A document; none where there is no such one.
    ///
    /// # Errors
    /// The name is no plain name, or the file cannot be read as this type.
    pub fn document<T: DeserializeOwned>(&self, name: &str) -> Result<Option<T>, ReportError> {
        read_json(&document::path(&self.path, name)?)
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
    /// It cannot be read as this type.
    pub fn checkpoint<T: DeserializeOwned>(&self) -> Result<Option<T>, ReportError> {
        read_json(&writer::checkpoint_path(&self.path))
    }
}

fn read_json<T: DeserializeOwned>(path: &Path) -> Result<Option<T>, ReportError> {
    match std::fs::read(path) {
        Ok(bytes) => serde_json::from_slice(&bytes).map(Some).map_err(ReportError::json(path)),
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(e) => Err(ReportError::io("read", path)(e)),
    }
}
