//! A table of comma-separated values: columns by name in any order, `#` before comments, errors with their line.

use super::ImportError;
use super::sources::{At, Fault, Sources};
use crate::error::ReadError;

/// A column: its name, then the others that it goes by.
pub(super) type Column = &'static [&'static str];

/// A table as read.
pub(super) struct Table {
    source: usize,
    /// For each known column, where it stands.
    columns: Vec<(Column, Option<usize>)>,
    rows: Vec<(Vec<String>, At)>,
    pub(super) header: At,
}

/// A row of a table.
#[derive(Clone, Copy)]
pub(super) struct Row<'t> {
    table: &'t Table,
    cells: &'t [String],
    pub(super) at: &'t At,
}

impl Table {
    /// Reads a table whose columns are among those known.
    pub(super) fn read(source: usize, known: &[Column], sources: &Sources) -> Result<Self, ImportError> {
        Self::parse(source, sources.text(source), known).map_err(|error| sources.mistake(source, error))
    }

    fn parse(source: usize, text: &str, known: &[Column]) -> Result<Self, ReadError> {
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .flexible(true)
            .has_headers(false)
            .delimiter(delimiter(text))
            .from_reader(text.as_bytes());
        let line_at = |position: Option<&csv::Position>| {
            let start = position.map_or(0, |p| p.byte() as usize).min(text.len());
            // A record may begin with the blank lines and comments before it.
            let mut start = start;
            while let Some(line) = text.get(start..).filter(|rest| !rest.is_empty()) {
                let length = line.find('\n').map_or(line.len(), |at| at + 1);
                if !(line[..length].trim().is_empty() || line.starts_with('#')) {
                    break;
                }
                start += length;
            }
            let end = text.get(start..).and_then(|rest| rest.find('\n')).map_or(text.len(), |at| start + at);
            At { source, span: start..end }
        };
        let mut records = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| {
                let at = line_at(error.position());
                ReadError::new(format!("the line cannot be read: {error}")).at(&at.span)
            })?;
            let cells: Vec<String> = record.iter().map(str::to_string).collect();
            // A blank line of spaces or separators.
            if cells.iter().any(|cell| !cell.is_empty()) {
                records.push((cells, line_at(record.position())));
            }
        }
        let names: Vec<&str> = known.iter().map(|column| column[0]).collect();
        let columns = || format!("known columns: {}", names.join(", "));
        if records.is_empty() {
            return Err(ReadError::new("the table is empty").help(columns()));
        }
        let (titles, header) = records.remove(0);
        let found = place_columns(&titles, &header, known).map_err(|error| error.at(&header.span))?;
        if let Some((cells, at)) = records.iter().find(|(cells, _)| cells.len() > titles.len()) {
            let message = format!("the line has {} cells, the header {}", cells.len(), titles.len());
            return Err(ReadError::new(message).at(&at.span).help("name each column, or quote commas"));
        }
        Ok(Self { source, columns: found, rows: records, header })
    }

    pub(super) fn rows(&self) -> impl Iterator<Item = Row<'_>> {
        self.rows.iter().map(|(cells, at)| Row { table: self, cells, at })
    }

    /// Whether a column is there.
    pub(super) fn has(&self, column: Column) -> bool {
        self.columns.iter().any(|(known, at)| known[0] == column[0] && at.is_some())
    }

    /// Refuses a table without a column.
    pub(super) fn require(&self, column: Column) -> Result<(), Fault> {
        if self.has(column) {
            return Ok(());
        }
        let known: Vec<&str> = self.columns.iter().map(|(known, _)| known[0]).collect();
        let message = format!("there is no column `{}`", column[0]);
        Err(self.header.fault(message, format!("known columns: {}", known.join(", "))))
    }
}

fn delimiter(text: &str) -> u8 {
    let header = text.lines().find(|line| !line.trim().is_empty() && !line.starts_with('#')).unwrap_or("");
    let count = |mark: u8| header.bytes().filter(|byte| *byte == mark).count();
    // The last of equals is taken.
    b"\t;,".iter().copied().max_by_key(|mark| count(*mark)).unwrap_or(b',')
}

fn place_columns(
    titles: &[String],
    header: &At,
    known: &[Column],
) -> Result<Vec<(Column, Option<usize>)>, ReadError> {
    let mut columns: Vec<(Column, Option<usize>)> = known.iter().map(|column| (*column, None)).collect();
    let all: Vec<&str> = known.iter().flat_map(|column| column.iter().copied()).collect();
    for (k, title) in titles.iter().enumerate() {
        let lower = title.to_lowercase().replace([' ', '-'], "_");
        let column = columns.iter_mut().find(|(column, _)| column.iter().any(|name| *name == lower));
        match column {
            Some((_, at @ None)) => *at = Some(k),
            Some((column, Some(_))) => {
                let message = format!("the column `{title}` is there twice (as `{}`)", column[0]);
                return Err(ReadError::new(message).at(&header.span));
            }
            None if title.parse::<f64>().is_ok() => {
                let error =
                    ReadError::new(format!("the first line names the columns, and `{title}` is no name"));
                let names: Vec<&str> = known.iter().map(|column| column[0]).collect();
                return Err(error.help(format!("add a header line of {}", names.join(", "))));
            }
            None => {
                let error = ReadError::new(format!("unknown column `{title}`"));
                return Err(error.suggest(&lower, &all));
            }
        }
    }
    Ok(columns)
}

impl<'t> Row<'t> {
    /// The cell of a column, if there is something in it.
    pub(super) fn text(&self, column: Column) -> Option<&'t str> {
        let at =
            self.table.columns.iter().find(|(known, _)| known[0] == column[0]).and_then(|(_, at)| *at)?;
        self.cells.get(at).map(String::as_str).filter(|cell| !cell.is_empty())
    }

    /// The cell of a column that must not be empty.
    pub(super) fn require(&self, column: Column) -> Result<&'t str, Fault> {
        self.text(column).ok_or_else(|| self.fault(format!("`{}` is missing here", column[0])))
    }

    /// A finite number, if there is one.
    pub(super) fn number(&self, column: Column) -> Result<Option<f64>, Fault> {
        let Some(cell) = self.text(column) else { return Ok(None) };
        let value = cell.parse().ok().filter(|value: &f64| value.is_finite());
        value.map(Some).ok_or_else(|| self.fault(format!("`{}`: `{cell}` is no number", column[0])))
    }

    /// A positive number, if there is one.
    pub(super) fn positive(&self, column: Column) -> Result<Option<f64>, Fault> {
        let value = self.number(column)?;
        match value {
            Some(wrong) if wrong <= 0.0 => {
                Err(self.fault(format!("`{}` is {wrong}; it must be positive", column[0])))
            }
            _ => Ok(value),
        }
    }

    /// A fault in this row.
    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault { source: self.table.source, error: ReadError::new(message).at(&self.at.span) }
    }
}
