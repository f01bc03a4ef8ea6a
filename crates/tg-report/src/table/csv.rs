//! Comma-separated text: a line of names with units, `time [s]`, then the rows.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::error::ReportError;
use crate::folder::NewFile;
use crate::table::{Channel, Table};

impl Table {
    /// Writes comma-separated text: names as `name [unit]`, numbers with as many digits as tell them apart. Groups are
    /// not kept.
    ///
    /// # Errors
    /// The file cannot be written, or the table is ill-formed.
    pub fn write_csv(&self, path: &Path) -> Result<(), ReportError> {
        self.check()?;
        let mut rows = CsvRows::create(path, &self.channels)?;
        rows.append(self)?;
        rows.finish()
    }

    /// Reads what [`Table::write_csv`] wrote, or any comma-separated numbers under a line of names.
    ///
    /// # Errors
    /// The file cannot be read, or holds something else.
    pub fn read_csv(path: &Path) -> Result<Self, ReportError> {
        let file = File::open(path).map_err(ReportError::io("read", path))?;
        let mut reader = csv::Reader::from_reader(std::io::BufReader::new(file));
        let damaged = |e: csv::Error| ReportError::damaged(path, e);
        let mut table = Self::new(reader.headers().map_err(damaged)?.iter().map(channel).collect());
        for (k, record) in reader.records().enumerate() {
            let record = record.map_err(damaged)?;
            let row: Result<Vec<f64>, _> = record.iter().map(|text| text.trim().parse()).collect();
            let row = row.map_err(|e| ReportError::damaged(path, format!("row {}: {e}", k + 1)))?;
            table.push(&row)?;
        }
        Ok(table)
    }
}

/// Writes a CSV file piece by piece.
pub(crate) struct CsvRows {
    path: PathBuf,
    file: BufWriter<NewFile>,
}

impl CsvRows {
    pub(crate) fn create(path: &Path, channels: &[Channel]) -> Result<Self, ReportError> {
        let mut file = BufWriter::new(NewFile::create(path)?);
        let mut header = csv::Writer::from_writer(&mut file);
        let written = header.write_record(channels.iter().map(heading));
        written.map_err(|e| ReportError::damaged(path, e))?;
        header.flush().map_err(ReportError::io("write", path))?;
        drop(header);
        Ok(Self { path: path.to_owned(), file })
    }

    pub(crate) fn append(&mut self, table: &Table) -> Result<(), ReportError> {
        let mut line = String::new();
        for row in 0..table.rows() {
            line.clear();
            for (k, column) in table.columns.iter().enumerate() {
                let comma = if k == 0 { "" } else { "," };
                line.push_str(comma);
                line.push_str(&number(column[row]));
            }
            line.push('\n');
            self.file.write_all(line.as_bytes()).map_err(ReportError::io("write", &self.path))?;
        }
        Ok(())
    }

    pub(crate) fn finish(self) -> Result<(), ReportError> {
        let file =
            self.file.into_inner().map_err(|e| ReportError::io("write", &self.path)(e.into_error()))?;
        file.finish()
    }
}

/// The shortest text that reads back as the same number, with an exponent where that is shorter.
fn number(x: f64) -> String {
    let size = x.abs();
    if x.is_finite() && (size >= 1e16 || (size < 1e-4 && size > 0.0)) {
        format!("{x:e}")
    } else {
        format!("{x}")
    }
}

fn heading(channel: &Channel) -> String {
    if channel.unit.is_empty() && !channel.name.ends_with(']') {
        channel.name.clone()
    } else {
        format!("{} [{}]", channel.name, channel.unit)
    }
}

fn channel(heading: &str) -> Channel {
    let parts = heading.strip_suffix(']').and_then(|rest| rest.rsplit_once(" ["));
    let (name, unit) = parts.unwrap_or((heading, ""));
    Channel::new(name, unit, "")
}
