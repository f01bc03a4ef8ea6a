//! One checked number.

use serde::Serialize;

/// A number of ours beside its reference.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// Which example.
    pub case: &'static str,
    /// What it is.
    pub quantity: String,
    /// Its unit; `1` if it has none.
    pub unit: &'static str,
    /// Our value.
    pub value: f64,
    /// What it should be; 0 where the tolerance is a bound.
    pub reference: f64,
    /// Where the reference comes from.
    pub source: &'static str,
    /// Largest difference that holds.
    pub tolerance: f64,
    /// Whether it holds.
    pub pass: bool,
}

/// Collects the rows of one case.
#[derive(Debug)]
pub struct Rows {
    case: &'static str,
    rows: Vec<Row>,
}

impl Rows {
    /// No rows yet.
    pub fn new(case: &'static str) -> Self {
        Self { case, rows: Vec::new() }
    }

    /// Adds `value` with the reference that it must meet within `tolerance`; NaN never holds.
    pub fn near(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        (value, reference): (f64, f64),
        source: &'static str,
        tolerance: f64,
    ) {
        let pass = (value - reference).abs() <= tolerance;
        let quantity = quantity.into();
        self.rows.push(Row { case: self.case, quantity, unit, value, reference, source, tolerance, pass });
    }

    /// Adds a magnitude that must not exceed `bound`.
    pub fn below(
        &mut self,
        quantity: impl Into<String>,
        unit: &'static str,
        value: f64,
        source: &'static str,
        bound: f64,
    ) {
        self.near(quantity, unit, (value, 0.0), source, bound);
    }

    /// Adds a count that must be exact.
    pub fn exact(
        &mut self,
        quantity: impl Into<String>,
        (value, reference): (usize, usize),
        source: &'static str,
    ) {
        self.near(quantity, "1", (value as f64, reference as f64), source, 0.0);
    }

    /// The rows.
    pub fn finish(self) -> Vec<Row> {
        self.rows
    }
}
