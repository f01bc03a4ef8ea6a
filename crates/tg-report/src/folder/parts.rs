//! The parts of the table, in `trajectory/`.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::ReportError;
use crate::folder::files;
use crate::table::Table;

/// Rows after which a part is closed.
pub const PART_ROWS: usize = 65_536;
/// Numbers, rows times channels, after which a part is closed: 16 MiB.
pub const PART_VALUES: usize = 1 << 21;
/// Age \[s\] at which a part is closed with the next row.
pub const PART_SECONDS: u64 = 60;

/// The folder of the parts. Nothing else is in it, so that data frames read it as a whole.
pub(crate) fn folder(results: &Path) -> PathBuf {
    results.join("trajectory")
}

/// Rows of a full part.
pub(crate) fn most_rows(channels: usize) -> usize {
    (PART_VALUES / channels.max(1)).clamp(1, PART_ROWS)
}

/// The file of a part.
pub(crate) fn path(results: &Path, number: u32) -> PathBuf {
    folder(results).join(format!("part-{number:05}.parquet"))
}

/// Numbers of the parts that are there, ascending.
pub(crate) fn list(results: &Path) -> Result<Vec<u32>, ReportError> {
    let folder = folder(results);
    let entries = match fs::read_dir(&folder) {
        Ok(entries) => entries,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => return Err(ReportError::io("read", &folder)(e)),
    };
    let mut numbers = Vec::new();
    for entry in entries {
        let name = entry.map_err(ReportError::io("read", &folder))?.file_name();
        let number: Option<u32> =
            name.to_str().and_then(|n| n.strip_prefix("part-")?.strip_suffix(".parquet")?.parse().ok());
        numbers.extend(number);
    }
    numbers.sort_unstable();
    Ok(numbers)
}

/// Writes a part: complete in the results folder first, then renamed into its place.
pub(crate) fn write(results: &Path, number: u32, table: &Table) -> Result<(), ReportError> {
    let temporary = results.join("part.new");
    table.write_parquet(&temporary)?;
    files::rename(&temporary, &path(results, number))
}

/// Reads a part.
pub(crate) fn read(results: &Path, number: u32) -> Result<Table, ReportError> {
    Table::read_parquet(&path(results, number))
}
