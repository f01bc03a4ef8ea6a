//! NumPy's `.npy`: structured, one named field for each channel, or a plain matrix with its names beside it.

use std::io::{BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use crate::error::ReportError;
use crate::folder::NewFile;
use crate::table::{Channel, Table};

const MAGIC: &[u8] = b"\x93NUMPY";
/// Width of the padded number of rows, so that it can be written last.
const COUNT: usize = 20;

impl Table {
    /// Writes a structured array: `numpy.load("trajectory.npy")["time"]` is a column. Units and groups are not kept.
    ///
    /// # Errors
    /// The file cannot be written, or the table is ill-formed.
    pub fn write_npy(&self, path: &Path) -> Result<(), ReportError> {
        self.check()?;
        let mut rows = NpyRows::create(path, &self.channels)?;
        rows.append(self)?;
        rows.finish()
    }

    /// Writes a matrix (rows, channels), and the channels beside it as JSON: `trajectory.npy` and
    /// `trajectory.channels.json`.
    ///
    /// # Errors
    /// A file cannot be written, or the table is ill-formed.
    pub fn write_npy_plain(&self, path: &Path) -> Result<(), ReportError> {
        self.check()?;
        let mut rows = NpyRows::create_plain(path, self.channels.len())?;
        rows.append(self)?;
        rows.finish()?;
        crate::folder::write_json(&channels_path(path), &self.channels)
    }

    /// Reads what [`Table::write_npy`] or [`Table::write_npy_plain`] wrote.
    ///
    /// # Errors
    /// The file cannot be read, or holds an array of another kind.
    pub fn read_npy(path: &Path) -> Result<Self, ReportError> {
        let bytes = std::fs::read(path).map_err(ReportError::io("read", path))?;
        let damaged = |reason: &str| ReportError::damaged(path, reason);
        let (header, data) = split(&bytes).ok_or_else(|| damaged("no header of an NPY file"))?;
        if value(header, "fortran_order").is_none_or(|v| !v.starts_with("False")) {
            return Err(damaged("its rows are not stored one after another"));
        }
        let kind = value(header, "descr").ok_or_else(|| damaged("its header says no type"))?;
        let channels: Vec<Channel> = if kind.starts_with('[') {
            let names = fields(kind).ok_or_else(|| damaged("not all of its fields are float64"))?;
            names.into_iter().map(|name| Channel::new(name, "", "")).collect()
        } else if kind.starts_with("'<f8'") {
            let beside = channels_path(path);
            let text = std::fs::read(&beside).map_err(ReportError::io("read", &beside))?;
            serde_json::from_slice(&text).map_err(ReportError::json(&beside))?
        } else {
            return Err(damaged("it does not hold float64"));
        };
        if channels.is_empty() || data.len() % (8 * channels.len()) != 0 {
            return Err(damaged("its size is not that of its header"));
        }
        let mut table = Self::new(channels);
        let mut row = vec![0.0; table.channels.len()];
        for bytes in data.chunks_exact(8 * row.len()) {
            for (x, bytes) in row.iter_mut().zip(bytes.as_chunks::<8>().0) {
                *x = f64::from_le_bytes(*bytes);
            }
            table.push(&row)?;
        }
        Ok(table)
    }
}

/// Writes an NPY file piece by piece; the number of rows is put into the header at the end.
pub(crate) struct NpyRows {
    path: PathBuf,
    file: BufWriter<NewFile>,
    count_at: u64,
    rows: usize,
}

impl NpyRows {
    pub(crate) fn create(path: &Path, channels: &[Channel]) -> Result<Self, ReportError> {
        let fields: String = channels.iter().map(|c| format!("({}, '<f8'), ", quoted(&c.name))).collect();
        Self::with_header(
            path,
            &format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ("),
            ",), }",
        )
    }

    fn create_plain(path: &Path, channels: usize) -> Result<Self, ReportError> {
        let end = format!(", {channels}), }}");
        Self::with_header(path, "{'descr': '<f8', 'fortran_order': False, 'shape': (", &end)
    }

    fn with_header(path: &Path, start: &str, end: &str) -> Result<Self, ReportError> {
        // Version 3 has UTF-8 names and room for many; plain ASCII fits version 1 or 2, which everything reads.
        let text = start.len() + COUNT + end.len() + 1;
        let version = match (start.is_ascii(), text + 10 + 64 > 0xffff) {
            (false, _) => 3,
            (true, true) => 2,
            (true, false) => 1,
        };
        let prefix = if version == 1 { 10 } else { 12 };
        let padding = (64 - (prefix + text) % 64) % 64;
        let length = text + padding;
        let mut bytes = MAGIC.to_vec();
        bytes.extend([version, 0]);
        if version == 1 {
            bytes.extend((length as u16).to_le_bytes());
        } else {
            bytes.extend((length as u32).to_le_bytes());
        }
        bytes.extend(start.bytes());
        let count_at = bytes.len() as u64;
        bytes.extend(format!("{:>COUNT$}{end}", 0).bytes());
        bytes.resize(bytes.len() + padding, b' ');
        bytes.push(b'\n');
        let mut file = BufWriter::new(NewFile::create(path)?);
        file.write_all(&bytes).map_err(ReportError::io("write", path))?;
        Ok(Self { path: path.to_owned(), file, count_at, rows: 0 })
    }

    pub(crate) fn append(&mut self, table: &Table) -> Result<(), ReportError> {
        for row in 0..table.rows() {
            for column in &table.columns {
                let written = self.file.write_all(&column[row].to_le_bytes());
                written.map_err(ReportError::io("write", &self.path))?;
            }
        }
        self.rows += table.rows();
        Ok(())
    }

    pub(crate) fn finish(mut self) -> Result<(), ReportError> {
        let count = format!("{:>COUNT$}", self.rows);
        let written = self.file.seek(SeekFrom::Start(self.count_at));
        let written = written.and_then(|_| self.file.write_all(count.as_bytes()));
        written.map_err(ReportError::io("write", &self.path))?;
        let file =
            self.file.into_inner().map_err(|e| ReportError::io("write", &self.path)(e.into_error()))?;
        file.finish()
    }
}

fn channels_path(path: &Path) -> PathBuf {
    path.with_extension("channels.json")
}

/// A name as a Python string.
fn quoted(name: &str) -> String {
    let mut text = String::from("'");
    for c in name.chars() {
        match c {
            '\\' => text.push_str("\\\\"),
            '\'' => text.push_str("\\'"),
            '\n' => text.push_str("\\n"),
            c => text.push(c),
        }
    }
    text.push('\'');
    text
}

fn split(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let rest = bytes.strip_prefix(MAGIC)?;
    let (version, rest) = rest.split_first_chunk::<2>()?;
    let (length, rest) = if version[0] == 1 {
        let (n, rest) = rest.split_first_chunk::<2>()?;
        (usize::from(u16::from_le_bytes(*n)), rest)
    } else {
        let (n, rest) = rest.split_first_chunk::<4>()?;
        (u32::from_le_bytes(*n) as usize, rest)
    };
    let (header, data) = rest.split_at_checked(length)?;
    Some((std::str::from_utf8(header).ok()?, data))
}

/// The text after a key of the header.
fn value<'a>(header: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = header.split_once(&format!("'{key}':"))?;
    Some(rest.trim_start())
}

/// Names of the fields in `[('a', '<f8'), ...]`, if all are float64.
fn fields(kind: &str) -> Option<Vec<String>> {
    let mut names = Vec::new();
    let mut rest = kind.strip_prefix('[')?.trim_start_matches([' ', ',']);
    while !rest.starts_with(']') {
        let (name, after) = unquoted(rest.strip_prefix('(')?)?;
        rest = after.strip_prefix(", '<f8')")?.trim_start_matches([' ', ',']);
        names.push(name);
    }
    Some(names)
}

/// A Python string at the start of a text, and what follows it.
fn unquoted(text: &str) -> Option<(String, &str)> {
    let mut chars = text.char_indices();
    let (_, quote) = chars.next()?;
    let mut name = String::new();
    while let Some((at, c)) = chars.next() {
        match c {
            c if c == quote => return Some((name, &text[at + 1..])),
            '\\' => match chars.next()?.1 {
                'n' => name.push('\n'),
                c => name.push(c),
            },
            c => name.push(c),
        }
    }
    None
}
