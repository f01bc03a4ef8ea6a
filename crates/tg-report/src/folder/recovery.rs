//! What is made of a folder that an earlier program left, finished or killed.

use std::fs;
use std::path::Path;

use serde::de::IgnoredAny;

use crate::error::ReportError;
use crate::folder::checkpoint::{self, Checkpoint};
use crate::folder::journal::{self, Journal};
use crate::folder::parts::{self, Part};
use crate::folder::{Existing, Manifest, document, files, frames};

/// Makes a part of what a killed program left in the journal; the number of its rows.
pub(crate) fn recover(path: &Path, manifest: &Manifest) -> Result<usize, ReportError> {
    let Some((number, rows)) = journal::read(path, &manifest.channels)? else { return Ok(0) };
    let mut parts = parts::list(path)?;
    if rows.rows() == 0 || parts.iter().any(|part| part.part == number) {
        return Ok(0);
    }
    parts.push(parts::write(path, number, &rows)?);
    parts::write_list(path, &parts)?;
    Journal::start(path, number.saturating_add(1), manifest.channels.len())?;
    Ok(rows.rows())
}

/// What a folder holds up to a time.
#[derive(Default)]
pub(crate) struct Until {
    /// Parts; one that is cut becomes another one, which the list does not know yet: the folder stays as it is until the
    /// list changes.
    pub(crate) parts: Vec<Part>,
    /// Number of the next one.
    pub(crate) next: u32,
    /// First channel of the last row.
    pub(crate) last: Option<f64>,
}

impl Until {
    /// The rows whose first channel is at most `time`.
    pub(crate) fn of(path: &Path, manifest: &Manifest, time: f64) -> Result<Self, ReportError> {
        recover(path, manifest)?;
        let mut parts = parts::list(path)?;
        let mut next = parts.iter().map(|part| part.part.saturating_add(1)).max().unwrap_or(0);
        let mut last = None;
        while let Some(part) = parts.pop() {
            let mut table = parts::read(path, &part)?;
            table.retain(|x| x <= time);
            if table.rows() == 0 {
                continue;
            }
            last = table.columns.first().and_then(|column| column.last()).copied();
            if table.rows() == part.rows {
                parts.push(part);
            } else {
                parts.push(parts::write(path, next, &table)?);
                next = next.saturating_add(1);
            }
            break;
        }
        parts::check(path, &parts)?;
        Ok(Self { parts, next, last })
    }
}

/// Refuses to go on where rows or frames are missing that the checkpoint has counted.
pub(crate) fn check(path: &Path, time: f64, rows: usize, frames: usize) -> Result<(), ReportError> {
    let Some(counted) = Checkpoint::<IgnoredAny>::read(path)? else { return Ok(()) };
    if counted.last.is_some_and(|last| last > time) {
        return Ok(());
    }
    let missing = |what: &str, path: &Path, left: usize, counted: usize| {
        let reason =
            format!("{left} {what} are left of the {counted} that the checkpoint counts; begin anew");
        if left < counted { Err(ReportError::damaged(path, reason)) } else { Ok(()) }
    };
    missing("rows", &journal::path(path), rows, counted.rows)?;
    missing("frames", &frames::path(path), frames, counted.frames)
}

/// Removes earlier results, or refuses.
pub(crate) fn clear(path: &Path, existing: Existing) -> Result<(), ReportError> {
    let mut entries = match fs::read_dir(path) {
        Ok(entries) => entries,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(e) => return Err(ReportError::io("read", path)(e)),
    };
    let names = entries.try_fold(Vec::new(), |mut names, entry| {
        names.push(entry?.file_name().to_string_lossy().into_owned());
        Ok(names)
    });
    let names = names.map_err(ReportError::io("read", path))?;
    if !names.iter().any(|name| name == "run.json") {
        // A program that was killed before it had computed anything leaves nothing else.
        return match names.into_iter().find(|name| !is_begun(path, name)) {
            Some(found) => Err(ReportError::Foreign { path: path.to_owned(), found }),
            None => Ok(()),
        };
    }
    let earlier = Manifest::read(path)?;
    if existing == Existing::Keep {
        return Err(ReportError::Exists { path: path.to_owned() });
    }
    // The manifest stays until the next one takes its place: the folder is always one of results. Without a checkpoint nothing
    // goes on with half of them.
    files::remove(&checkpoint::path(path))?;
    for name in &earlier.documents {
        files::remove(&document::path(path, name)?)?;
    }
    parts::keep(path, &[])?;
    for name in ["trajectory.csv", "trajectory.npy", "part.new"] {
        files::remove(&path.join(name))?;
    }
    [journal::path(path), frames::path(path)].iter().try_for_each(|file| files::remove(file))
}

/// Whether a file is one of those that are there before the manifest, and as empty as then.
fn is_begun(path: &Path, name: &str) -> bool {
    let path = path.join(name);
    let size = || fs::metadata(&path).map_or(u64::MAX, |about| about.len());
    match name {
        "trajectory" => fs::read_dir(&path).is_ok_and(|mut entries| entries.next().is_none()),
        "journal.bin" => size() <= journal::HEADER as u64,
        "frames.ndjson" => size() == 0,
        _ => ["parts.json", "parts.json.new", "frames.ndjson.new", "run.json.new"].contains(&name),
    }
}
