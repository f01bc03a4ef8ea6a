//! Rows that are in no part yet: `journal.bin`.
//!
//! 20 bytes of header (`TGJOURN2`, the number of the part that the rows will become, the number of channels, CRC-32 of these),
//! then the rows as little-endian float64, each with its CRC-32. In Python, apart from a last row that was cut off:
//! `numpy.fromfile("journal.bin", [("row", "<f8", channels), ("crc32", "<u4")], offset=20)["row"]`.

use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::checksum::crc32;
use crate::error::ReportError;
use crate::folder::files::CHANGED;
use crate::table::{Channel, Table};

const MAGIC: &[u8; 8] = b"TGJOURN2";
/// Bytes of a journal without rows.
pub(crate) const HEADER: usize = 20;

/// The journal of a folder that is being written.
pub(crate) struct Journal {
    path: PathBuf,
    file: File,
    bytes: Vec<u8>,
}

impl Journal {
    /// An empty journal of part `number`.
    pub(crate) fn start(results: &Path, number: u32, channels: usize) -> Result<Self, ReportError> {
        let path = path(results);
        let file = OpenOptions::new().create(true).write(true).truncate(true).open(&path);
        let mut file = file.map_err(ReportError::io("write", &path))?;
        file.write_all(&header(number, channels)).map_err(ReportError::io("write", &path))?;
        Ok(Self { path, file, bytes: Vec::new() })
    }

    /// Appends a row, in one write.
    pub(crate) fn row(&mut self, row: &[f64]) -> Result<(), ReportError> {
        self.bytes.clear();
        for x in row {
            self.bytes.extend_from_slice(&x.to_le_bytes());
        }
        let check = crc32(&self.bytes);
        self.bytes.extend_from_slice(&check.to_le_bytes());
        self.file.write_all(&self.bytes).map_err(ReportError::io("write", &self.path))
    }

    /// Makes what was written survive a power failure.
    pub(crate) fn sync(&self) -> Result<(), ReportError> {
        self.file.sync_data().map_err(ReportError::io("write", &self.path))
    }
}

/// Where the journal is.
pub(crate) fn path(results: &Path) -> PathBuf {
    results.join("journal.bin")
}

/// Rows of the journal, with the number of the part they will become. Nothing where there is no journal, or one that was
/// cut off within its header; last rows that were cut off are left out.
pub(crate) fn read(results: &Path, channels: &[Channel]) -> Result<Option<(u32, Table)>, ReportError> {
    let path = path(results);
    let bytes = match std::fs::read(&path) {
        Ok(bytes) => bytes,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(e) => return Err(ReportError::io("read", &path)(e)),
    };
    let Some((start, rows)) = bytes.split_first_chunk::<HEADER>() else { return Ok(None) };
    let [_, _, _, _, _, _, _, _, a, b, c, d, ..] = *start;
    let number = u32::from_le_bytes([a, b, c, d]);
    if *start != header(number, channels.len()) {
        return Err(ReportError::damaged(
            &path,
            "its header is not that of this folder's journal; take it from a copy, or begin anew",
        ));
    }
    let mut table = Table::new(channels.to_vec());
    let size = 8 * channels.len();
    let mut torn = None;
    for (k, row) in rows.chunks_exact(size + 4).enumerate() {
        let (numbers, check) = row.split_at(size);
        match (crc32(numbers).to_le_bytes() == check, torn) {
            (true, None) => {
                for (column, x) in table.columns.iter_mut().zip(numbers.as_chunks::<8>().0) {
                    column.push(f64::from_le_bytes(*x));
                }
            }
            (true, Some(k)) => {
                return Err(ReportError::damaged(&path, format!("row {k}: {CHANGED}")));
            }
            (false, None) => torn = Some(k + 1),
            (false, Some(_)) => {}
        }
    }
    Ok(Some((number, table)))
}

fn header(number: u32, channels: usize) -> [u8; HEADER] {
    let mut header = [0; HEADER];
    header[..8].copy_from_slice(MAGIC);
    header[8..12].copy_from_slice(&number.to_le_bytes());
    header[12..16].copy_from_slice(&(channels as u32).to_le_bytes());
    let check = crc32(&header[..16]);
    header[16..].copy_from_slice(&check.to_le_bytes());
    header
}
