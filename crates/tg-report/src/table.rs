//! Named columns of numbers.

mod csv;
mod npy;
pub(crate) mod parquet;

use std::collections::HashSet;

use serde::{Deserialize, Serialize};

use crate::error::ReportError;

pub(crate) use self::csv::CsvRows;
pub(crate) use self::npy::NpyRows;

/// What one column holds.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Channel {
    /// Name, unlike every other in its table: "cable 3.tension".
    pub name: String,
    /// Unit: "N"; "" or "1" for a plain number.
    pub unit: String,
    /// What it is plotted with: "time", "energy", "tension", "length", "point", "reaction", "slack" (0 or 1), ...
    pub group: String,
}

/// Columns of equal length. The first is what the others depend on: the time of a run, the parameter of a sweep.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// What the columns hold.
    pub channels: Vec<Channel>,
    /// One column for each channel.
    pub columns: Vec<Vec<f64>>,
}

impl Channel {
    /// A channel from name, unit and group.
    pub fn new(name: impl Into<String>, unit: impl Into<String>, group: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), group: group.into() }
    }

    /// Time in seconds, the first channel of a run.
    pub fn time() -> Self {
        Self::new("time", "s", "time")
    }

    /// "tension \[N\]", or the name alone for a plain number.
    pub fn label(&self) -> String {
        crate::plot::label(&self.name, &self.unit)
    }
}

impl Table {
    /// A table without rows.
    pub fn new(channels: Vec<Channel>) -> Self {
        let columns = vec![Vec::new(); channels.len()];
        Self { channels, columns }
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.columns.first().map_or(0, Vec::len)
    }

    /// Appends a row.
    ///
    /// # Errors
    /// Not as many values as channels.
    pub fn push(&mut self, row: &[f64]) -> Result<(), ReportError> {
        if row.len() != self.channels.len() {
            let (what, got, expected) = ("values of a row".into(), row.len(), self.channels.len());
            return Err(ReportError::Count { what, got, expected });
        }
        for (column, &value) in self.columns.iter_mut().zip(row) {
            column.push(value);
        }
        Ok(())
    }

    /// Appends the rows of a table with the same channels.
    ///
    /// # Errors
    /// Another number of channels.
    pub fn append(&mut self, mut other: Self) -> Result<(), ReportError> {
        if other.columns.len() != self.columns.len() {
            let (what, got, expected) = ("columns".into(), other.columns.len(), self.columns.len());
            return Err(ReportError::Count { what, got, expected });
        }
        for (column, more) in self.columns.iter_mut().zip(&mut other.columns) {
            column.append(more);
        }
        Ok(())
    }

    /// Number of the channel with this name.
    pub fn position(&self, name: &str) -> Option<usize> {
        self.channels.iter().position(|c| c.name == name)
    }

    /// The column with this name.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        Some(&self.columns[self.position(name)?])
    }

    /// Numbers of the channels of a group.
    pub fn group(&self, group: &str) -> Vec<usize> {
        (0..self.channels.len()).filter(|&k| self.channels[k].group == group).collect()
    }

    /// Keeps the rows whose first column satisfies `keep`.
    pub(crate) fn retain(&mut self, keep: impl Fn(f64) -> bool) {
        let Some(kept) = self.columns.first().map(|c| c.iter().map(|&x| keep(x)).collect::<Vec<bool>>())
        else {
            return;
        };
        for column in &mut self.columns {
            let mut kept = kept.iter();
            column.retain(|_| kept.next() == Some(&true));
        }
    }

    /// Checks that there are as many columns as channels, all of one length.
    pub(crate) fn check(&self) -> Result<(), ReportError> {
        check_channels(&self.channels)?;
        let count = |what: &str, got, expected| {
            if got == expected {
                Ok(())
            } else {
                Err(ReportError::Count { what: what.into(), got, expected })
            }
        };
        count("columns", self.columns.len(), self.channels.len())?;
        let mut columns = self.channels.iter().zip(&self.columns);
        columns.try_for_each(|(c, x)| count(&format!("rows of {:?}", c.name), x.len(), self.rows()))
    }
}

/// Names must be there and differ: they are keys of data frames.
pub(crate) fn check_channels(channels: &[Channel]) -> Result<(), ReportError> {
    let mut seen = HashSet::new();
    for (index, Channel { name, .. }) in channels.iter().enumerate() {
        let refuse = |reason| Err(ReportError::Channel { index, name: name.clone(), reason });
        if name.is_empty() {
            return refuse("empty");
        }
        if !seen.insert(name) {
            return refuse("that of an earlier channel");
        }
    }
    Ok(())
}
