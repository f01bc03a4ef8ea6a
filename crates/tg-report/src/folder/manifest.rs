//! What a results folder says about itself.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::error::ReportError;
use crate::folder::{files, sealed};
use crate::outline::Outline;
use crate::table::Channel;

const FORMAT: &str = "tensegrity-results";
const VERSION: u32 = 2;

/// The file `run.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// "tensegrity-results".
    pub format: String,
    /// Version of the folder's format.
    pub version: u32,
    /// What was computed.
    pub kind: Kind,
    /// Title of pictures and pages.
    pub title: String,
    /// The file that describes the structure.
    #[serde(default)]
    pub scene: Option<Scene>,
    /// The program and its version.
    #[serde(default)]
    pub program: String,
    /// When it was started, as text.
    #[serde(default)]
    pub started: Option<String>,
    /// Settings of the computation.
    #[serde(default)]
    pub settings: Value,
    /// What came out, in few numbers.
    #[serde(default)]
    pub summary: Value,
    /// What the reader should know.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// Whether the computation came to its end.
    pub complete: bool,
    /// Why it did not.
    #[serde(default)]
    pub interrupted: Option<String>,
    /// Names of the documents in the folder.
    #[serde(default)]
    pub documents: Vec<String>,
    /// Number of frames, once the computation has ended.
    #[serde(default)]
    pub frames: Option<usize>,
    /// Columns of the table.
    #[serde(default)]
    pub channels: Vec<Channel>,
    /// What the structure looks like; none where there is nothing to show.
    #[serde(default)]
    pub outline: Option<Outline>,
}

/// What tells whether a file is a manifest at all.
#[derive(Deserialize)]
struct Head {
    format: Option<String>,
    version: Option<u32>,
}

/// What was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// A motion over time.
    Run,
    /// A static answer: rest lengths, an equilibrium.
    Statics,
    /// Natural or damped modes.
    Modes,
    /// All equilibria.
    Equilibria,
    /// Something against a parameter.
    Sweep,
}

/// The file that describes the structure.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Scene {
    /// Its name.
    pub name: String,
    /// Hash of its content, to tell versions apart.
    pub hash: String,
}

impl Manifest {
    /// A manifest of a computation that starts now.
    pub fn new(kind: Kind, title: &str) -> Self {
        Self {
            format: FORMAT.into(),
            version: VERSION,
            kind,
            title: title.into(),
            scene: None,
            program: String::new(),
            started: None,
            settings: Value::Null,
            summary: Value::Null,
            warnings: Vec::new(),
            complete: false,
            interrupted: None,
            documents: Vec::new(),
            frames: None,
            channels: Vec::new(),
            outline: None,
        }
    }

    pub(crate) fn path(folder: &Path) -> PathBuf {
        folder.join("run.json")
    }

    pub(crate) fn read(folder: &Path) -> Result<Self, ReportError> {
        let path = Self::path(folder);
        let refuse = |reason: String| ReportError::NotResults { path: folder.to_owned(), reason };
        let bytes = std::fs::read(&path).map_err(|e| refuse(format!("run.json: {e}")))?;
        let head: Head = serde_json::from_slice(&bytes).map_err(|e| refuse(format!("run.json: {e}")))?;
        if head.format.as_deref() != Some(FORMAT) {
            return Err(refuse(format!("run.json does not say \"format\": \"{FORMAT}\"")));
        }
        if head.version != Some(VERSION) {
            let version = head.version.map_or("none".into(), |v| v.to_string());
            return Err(refuse(format!("its version is {version}; this program reads version {VERSION}")));
        }
        if sealed::fits(&bytes) == Some(false) {
            let reason =
                "its checksum does not fit: it was damaged, or edited; if that was meant, take out `crc32`";
            return Err(ReportError::damaged(&path, reason));
        }
        serde_json::from_slice(&bytes).map_err(ReportError::json(&path))
    }

    pub(crate) fn write(&self, folder: &Path) -> Result<(), ReportError> {
        let path = Self::path(folder);
        files::write_file(&path, &sealed::seal_indented(self).map_err(ReportError::json(&path))?)
    }

    /// Whether the computation has ended, by itself or by an orderly interrupt.
    pub(crate) fn ended(&self) -> bool {
        self.complete || self.interrupted.is_some()
    }
}

impl Kind {
    /// What a reader calls it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Run => "motion",
            Self::Statics => "statics",
            Self::Modes => "modes",
            Self::Equilibria => "equilibria",
            Self::Sweep => "sweep",
        }
    }
}
