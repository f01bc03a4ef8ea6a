//! The files that an import has read, so that each error can point into one of them.

use std::path::{Path, PathBuf};

use super::ImportError;
use crate::error::{Mistake, ReadError};
use crate::node::Span;

/// A place in one of the files.
#[derive(Clone, Debug, Default)]
pub(super) struct At {
    pub(super) source: usize,
    pub(super) span: Span,
}

impl At {
    /// A fault at this place.
    pub(super) fn fault(&self, message: impl Into<String>, help: impl Into<String>) -> Fault {
        let error = ReadError::new(message).at(&self.span).help(help);
        Fault { source: self.source, error }
    }
}

/// A mistake in one of the files.
#[derive(Debug)]
pub(super) struct Fault {
    pub(super) source: usize,
    pub(super) error: ReadError,
}

/// A file that was read.
#[derive(Debug)]
pub(super) struct Source {
    path: PathBuf,
    pub(super) text: String,
}

/// All files that were read, each once.
#[derive(Debug, Default)]
pub(super) struct Sources(Vec<Source>);

impl Sources {
    /// Reads a file, or finds that it has been read.
    pub(super) fn read(&mut self, path: &Path) -> Result<usize, ImportError> {
        if let Some(known) = self.0.iter().position(|source| source.path == path) {
            return Ok(known);
        }
        let unreadable = |source| ImportError::Unreadable { path: path.display().to_string(), source };
        let text = std::fs::read_to_string(path).map_err(unreadable)?;
        self.0.push(Source { path: path.into(), text });
        Ok(self.0.len() - 1)
    }

    pub(super) fn text(&self, source: usize) -> &str {
        &self.0[source].text
    }

    /// The names of the files, without their folders.
    pub(super) fn names(&self) -> Vec<String> {
        let name = |source: &Source| source.path.file_name().map(|name| name.to_string_lossy().into_owned());
        self.0.iter().filter_map(name).collect()
    }

    pub(super) fn mistake(&self, source: usize, error: ReadError) -> ImportError {
        let Source { path, text } = &self.0[source];
        ImportError::Mistake(Box::new(Mistake::new(error, &path.display().to_string(), text)))
    }

    pub(super) fn fault(&self, fault: Fault) -> ImportError {
        self.mistake(fault.source, fault.error)
    }
}
