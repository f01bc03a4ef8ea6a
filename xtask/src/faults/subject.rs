//! A run that faults happen to: its scene, what it gives undisturbed, and whether another folder holds the same.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde_json::Value;
use tg_report::{Results, Table};

use super::program::Program;
use crate::TaskError;

/// A run of a scene.
pub(super) struct Subject {
    /// Arguments of `tg`, but for the folder.
    pub(super) arguments: &'static [&'static str],
    /// The folder of the undisturbed run.
    pub(super) folder: PathBuf,
    /// Its rows.
    pub(super) table: Table,
    /// Its time on the clock.
    pub(super) time: Duration,
}

/// In the plane: so many rows that a part is closed on the way.
pub(super) const PLANE: &[&str] = &[
    "run",
    "scenes/double_pendulum.toml",
    "--step",
    "1e-5",
    "--duration",
    "1.2",
    "--checkpoint-every",
    "0.1",
];
/// In space: bars and bodies, with a table of the ground's motion beside the scene.
pub(super) const SPACE: &[&str] =
    &["run", "scenes/seismic.toml", "--duration", "3", "--step", "5e-4", "--checkpoint-every", "0.1"];

impl Subject {
    /// Runs undisturbed.
    pub(super) fn new(
        program: &Program,
        name: &str,
        arguments: &'static [&'static str],
    ) -> Result<Self, TaskError> {
        let folder = program.free(name)?;
        let begin = Instant::now();
        program.must(&with_folder(arguments, &folder, &[]).iter().map(String::as_str).collect::<Vec<_>>())?;
        let time = begin.elapsed();
        let table = Results::open(&folder)?.table()?;
        Ok(Self { arguments, folder, table, time })
    }

    /// The command line for another folder.
    pub(super) fn line(&self, folder: &Path, more: &[&str]) -> Vec<String> {
        with_folder(self.arguments, folder, more)
    }

    /// Why a folder does not hold a first part of the undisturbed run, bit for bit; else its rows.
    pub(super) fn prefix(&self, folder: &Path) -> Result<usize, String> {
        let results = Results::open(folder).map_err(|error| error.to_string())?;
        let table = results.table().map_err(|error| error.to_string())?;
        let rows = table.rows();
        for (ours, whole) in table.columns.iter().zip(&self.table.columns) {
            if rows > whole.len() || ours.iter().zip(whole).any(|(a, b)| a.to_bits() != b.to_bits()) {
                return Err(format!("its {rows} rows are not those of the undisturbed run"));
            }
        }
        let frames = results.frames().map_err(|error| error.to_string())?.len();
        let [left, whole] = [folder, &self.folder].map(|at| fs::read(at.join("frames.ndjson")));
        let (left, whole) = (left.map_err(|e| e.to_string())?, whole.map_err(|e| e.to_string())?);
        let lines = left.split_inclusive(|&b| b == b'\n').take(frames).map(<[u8]>::len).sum();
        match left.get(..lines).is_some_and(|lines| whole.starts_with(lines)) {
            true => Ok(rows),
            false => Err(format!("its {frames} frames are not those of the undisturbed run")),
        }
    }

    /// Why a folder does not hold what the undisturbed run gives, bit for bit.
    pub(super) fn same(&self, folder: &Path) -> Result<(), String> {
        let rows = self.prefix(folder)?;
        if rows != self.table.rows() {
            return Err(format!("{rows} rows instead of {}", self.table.rows()));
        }
        for name in ["frames.ndjson", "checkpoint.json"] {
            let [ours, whole] = [folder, &self.folder].map(|at| fs::read(at.join(name)));
            if ours.ok() != whole.ok() {
                return Err(format!("another {name}"));
            }
        }
        let [ours, whole] = [folder, &self.folder].map(manifest);
        if ours? == whole? { Ok(()) } else { Err("another run.json".into()) }
    }
}

/// What a folder says about itself, but for the time of day and for the remark that a run was begun anew.
fn manifest(folder: &Path) -> Result<Value, String> {
    let mut manifest = Results::open(folder).map_err(|error| error.to_string())?.manifest;
    manifest.started = None;
    manifest.warnings.retain(|warning| !warning.contains("begun anew"));
    serde_json::to_value(manifest).map_err(|error| error.to_string())
}

fn with_folder(arguments: &[&str], folder: &Path, more: &[&str]) -> Vec<String> {
    let folder = folder.display().to_string();
    arguments.iter().copied().chain(["-o", &folder]).chain(more.iter().copied()).map(Into::into).collect()
}
