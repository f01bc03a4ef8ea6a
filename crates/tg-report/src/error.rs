//! What can go wrong with reports.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a report cannot be written, read or drawn.
#[derive(Debug, Error)]
pub enum ReportError {
    /// The operating system refuses.
    #[error("cannot {action} {}: {source}{}", path.display(), mend(source.kind()))]
    Io {
        /// What was tried: "read", "write", ...
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The reason.
        source: std::io::Error,
    },
    /// A JSON file does not hold what it should, or a value has no JSON form.
    #[error("{}: {source}", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// The reason, with line and column.
        source: serde_json::Error,
    },
    /// A data file is damaged or of another kind.
    #[error("{}: {reason}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// The folder is no results folder.
    #[error("{} is not a results folder: {reason}", path.display())]
    NotResults {
        /// The folder.
        path: PathBuf,
        /// What is missing.
        reason: String,
    },
    /// The folder holds earlier results.
    #[error("{} holds earlier results; replace them, resume them, or choose another folder", path.display())]
    Exists {
        /// The folder.
        path: PathBuf,
    },
    /// The folder holds files of someone else.
    #[error("{} holds files that are no results, first {found:?}; choose another folder", path.display())]
    Foreign {
        /// The folder.
        path: PathBuf,
        /// One of the files.
        found: String,
    },
    /// Something has the wrong number of entries.
    #[error("{what}: {got} given, {expected} expected")]
    Count {
        /// What is counted.
        what: String,
        /// How many there are.
        got: usize,
        /// How many there must be.
        expected: usize,
    },
    /// Two channels have one name, or a name is empty.
    #[error("channel {index} has the name {name:?}, which is {reason}")]
    Channel {
        /// Its number, from 0.
        index: usize,
        /// Its name.
        name: String,
        /// "empty" or "that of an earlier channel".
        reason: &'static str,
    },
    /// An outline that cannot be drawn.
    #[error("outline of member \"{member}\": {reason}")]
    Outline {
        /// Name of the member.
        member: String,
        /// What is wrong.
        reason: String,
    },
    /// A document's name is not a plain file name or is taken by the folder itself.
    #[error(
        "{name:?} cannot name a document: use lower-case letters, digits, '-' and '_', and none of {taken}"
    )]
    DocumentName {
        /// The name.
        name: String,
        /// Names that are taken.
        taken: String,
    },
    /// There is nothing to draw.
    #[error("{what} has nothing to draw: {reason}")]
    Empty {
        /// The picture.
        what: String,
        /// What is missing.
        reason: String,
    },
    /// A picture cannot be drawn.
    #[error("cannot draw {what}: {reason}")]
    Drawing {
        /// The picture.
        what: String,
        /// The reason of the drawing library.
        reason: String,
    },
}

impl ReportError {
    /// For `map_err`: what was tried with which file.
    pub(crate) fn io(action: &'static str, path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Io { action, path, source }
    }

    /// For `map_err`: which file.
    pub(crate) fn json(path: &Path) -> impl FnOnce(serde_json::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Json { path, source }
    }

    /// A data file that is not what it should be.
    pub(crate) fn damaged(path: &Path, reason: impl ToString) -> Self {
        Self::Damaged { path: path.to_owned(), reason: reason.to_string() }
    }
}

/// What would mend a refusal of the operating system.
fn mend(kind: ErrorKind) -> &'static str {
    match kind {
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => "; make room, or choose another folder",
        ErrorKind::FileTooLarge => "; raise the limit of file sizes, or choose another folder",
        ErrorKind::NotFound => "; it or a folder above it is missing",
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => {
            "; choose another place, or allow it there"
        }
        ErrorKind::NotADirectory | ErrorKind::AlreadyExists => "; a file is where a folder should be",
        ErrorKind::IsADirectory => "; a folder is where a file should be",
        _ => "",
    }
}
