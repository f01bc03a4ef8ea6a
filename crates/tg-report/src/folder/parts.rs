//! The parts of the table, in `trajectory/`, and the list of them, `parts.json`.
//!
//! A part counts if it is in the list, which tells its rows and the checksum of the whole file: a part that has vanished, was
//! damaged, or was left by a killed program is told apart.

use std::fs;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::checksum::crc32;
use crate::error::ReportError;
use crate::folder::files::{self, NewFile};
use crate::folder::sealed;
use crate::table::Table;

/// Rows after which a part is closed.
pub const PART_ROWS: usize = 65_536;
/// Numbers, rows times channels, after which a part is closed: 16 MiB.
pub const PART_VALUES: usize = 1 << 21;
/// Age \[s\] at which a part is closed with the next row.
pub const PART_SECONDS: u64 = 60;

/// A part of the list.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Part {
    /// Its number.
    pub(crate) part: u32,
    /// Its rows.
    pub(crate) rows: usize,
    /// CRC-32 of the file.
    checksum: u32,
}

#[derive(Serialize, Deserialize)]
struct List {
    parts: Vec<Part>,
}

/// The folder of the parts. Nothing else is in it, so that data frames read it as a whole.
pub(crate) fn folder(results: &Path) -> PathBuf {
    results.join("trajectory")
}

/// Where the list is.
pub(crate) fn list_path(results: &Path) -> PathBuf {
    results.join("parts.json")
}

/// Rows of a full part.
pub(crate) fn most_rows(channels: usize) -> usize {
    (PART_VALUES / channels.max(1)).clamp(1, PART_ROWS)
}

/// The file of a part.
pub(crate) fn path(results: &Path, number: u32) -> PathBuf {
    folder(results).join(format!("part-{number:05}.parquet"))
}

/// The list, in the order of the rows.
pub(crate) fn list(results: &Path) -> Result<Vec<Part>, ReportError> {
    let path = list_path(results);
    match fs::read(&path) {
        Ok(bytes) => {
            sealed::open(&bytes).map(|list: List| list.parts).map_err(|e| ReportError::damaged(&path, e))
        }
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => Err(files::vanished(&path)),
        Err(e) => Err(ReportError::io("read", &path)(e)),
    }
}

/// Writes the list.
pub(crate) fn write_list(results: &Path, parts: &[Part]) -> Result<(), ReportError> {
    let path = list_path(results);
    let list = sealed::seal(&List { parts: parts.to_vec() }).map_err(ReportError::json(&path))?;
    files::write_file(&path, &list)
}

/// Writes a part that is not in the list yet: complete in the results folder first, then in its place.
pub(crate) fn write(results: &Path, number: u32, table: &Table) -> Result<Part, ReportError> {
    let (path, folder) = (path(results, number), folder(results));
    let bytes = table.parquet(&path)?;
    fs::create_dir_all(&folder).map_err(ReportError::io("make", &folder))?;
    let file = NewFile::growing(&path, results.join("part.new")).map_err(ReportError::io("write", &path))?;
    files::write(file, &bytes)?;
    files::sync_folder(&folder)?;
    Ok(Part { part: number, rows: table.rows(), checksum: crc32(&bytes) })
}

/// Reads a part of the list.
pub(crate) fn read(results: &Path, part: &Part) -> Result<Table, ReportError> {
    let path = path(results, part.part);
    let bytes = match fs::read(&path) {
        Ok(bytes) => bytes,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Err(files::vanished(&path)),
        Err(e) => return Err(ReportError::io("read", &path)(e)),
    };
    if crc32(&bytes) != part.checksum {
        return Err(ReportError::damaged(&path, files::CHANGED));
    }
    let table = Table::read_parquet(&path)?;
    if table.rows() != part.rows {
        return Err(ReportError::damaged(&path, "it has not the rows that parts.json says"));
    }
    Ok(table)
}

/// Refuses where the file of a part has vanished.
pub(crate) fn check(results: &Path, parts: &[Part]) -> Result<(), ReportError> {
    let mut paths = parts.iter().map(|part| path(results, part.part));
    paths.find(|path| !path.exists()).map_or(Ok(()), |path| Err(files::vanished(&path)))
}

/// Makes these the only parts, whatever a killed program left.
pub(crate) fn keep(results: &Path, parts: &[Part]) -> Result<(), ReportError> {
    write_list(results, parts)?;
    remove_others(results, parts)
}

/// Removes the files of parts that are not in a list.
pub(crate) fn remove_others(results: &Path, parts: &[Part]) -> Result<(), ReportError> {
    let folder = folder(results);
    let entries = match fs::read_dir(&folder) {
        Ok(entries) => entries,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(()),
        Err(e) => return Err(ReportError::io("read", &folder)(e)),
    };
    for entry in entries {
        let name = entry.map_err(ReportError::io("read", &folder))?.file_name();
        let digits = name.to_str().and_then(|n| n.strip_prefix("part-")?.strip_suffix(".parquet"));
        if let Some(number) = digits.and_then(|digits| digits.parse().ok())
            && parts.iter().all(|part| part.part != number)
        {
            files::remove(&path(results, number))?;
        }
    }
    Ok(())
}
