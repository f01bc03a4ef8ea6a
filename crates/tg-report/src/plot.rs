//! Curves over a common abscissa, as data; drawn as SVG or PNG, or shown by the viewer.

mod draw;
mod standard;
mod thin;

use serde::{Deserialize, Deserializer, Serialize};

use crate::error::ReportError;

/// Curves over one abscissa.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Title.
    pub title: String,
    /// How the values are drawn.
    pub kind: PlotKind,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate; unused by strips.
    pub y: Axis,
    /// Whether the abscissa is the time of the motion, which the viewer then marks.
    #[serde(default)]
    pub time: bool,
    /// Values of the abscissa.
    #[serde(deserialize_with = "with_gaps")]
    pub at: Vec<f64>,
    /// The curves.
    pub series: Vec<Series>,
}

/// How values are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PlotKind {
    /// Joined by lines, apart from gaps.
    Lines,
    /// Single points.
    Points,
    /// 0 or 1: a bar where it is 1, a row for each series.
    Strips,
}

/// What an axis shows.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axis {
    /// Quantity.
    pub label: String,
    /// Unit; "" or "1" for a plain number.
    pub unit: String,
    /// By powers of ten, in files: values that are not positive are gaps. The viewer's axes are linear.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub logarithmic: bool,
}

/// One curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Name, for the legend.
    pub name: String,
    /// As many values as the abscissa has; NaN is a gap.
    #[serde(deserialize_with = "with_gaps")]
    pub values: Vec<f64>,
    /// Its own abscissa where the curves have none in common, in files: as many values as the curve has.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<Vec<f64>>,
}

impl Plot {
    /// Curves with an abscissa each ([`Series::over`]), by powers of ten both ways.
    pub fn log_log(title: impl Into<String>, x: Axis, y: Axis, series: Vec<Series>) -> Self {
        Self {
            title: title.into(),
            kind: PlotKind::Lines,
            x: x.logarithmic(),
            y: y.logarithmic(),
            time: false,
            at: Vec::new(),
            series,
        }
    }

    /// Checks that every curve has as many values as the abscissa.
    ///
    /// # Errors
    /// A curve has not.
    pub fn check(&self) -> Result<(), ReportError> {
        let wrong = self.series.iter().find(|s| s.values.len() != self.at_of(s).len());
        wrong.map_or(Ok(()), |s| {
            let what = format!("values of {:?} in the plot {:?}", s.name, self.title);
            Err(ReportError::Count { what, got: s.values.len(), expected: self.at_of(s).len() })
        })
    }

    /// The abscissa of a curve: its own, or the common one.
    pub(crate) fn at_of<'p>(&'p self, series: &'p Series) -> &'p [f64] {
        series.at.as_deref().unwrap_or(&self.at)
    }
}

impl Axis {
    /// An axis from quantity and unit.
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), logarithmic: false }
    }

    /// The same by powers of ten.
    #[must_use]
    pub fn logarithmic(self) -> Self {
        Self { logarithmic: true, ..self }
    }

    /// "tension \[N\]", or the quantity alone for a plain number.
    pub fn text(&self) -> String {
        label(&self.label, &self.unit)
    }
}

impl Series {
    /// A curve over the common abscissa.
    pub fn new(name: impl Into<String>, values: Vec<f64>) -> Self {
        Self { name: name.into(), values, at: None }
    }

    /// A curve over its own.
    pub fn over(name: impl Into<String>, at: Vec<f64>, values: Vec<f64>) -> Self {
        Self { at: Some(at), ..Self::new(name, values) }
    }
}

/// A quantity with its unit in brackets.
pub(crate) fn label(quantity: &str, unit: &str) -> String {
    if matches!(unit, "" | "1") { quantity.into() } else { format!("{quantity} [{unit}]") }
}

/// JSON has no NaN; its writer puts null.
fn with_gaps<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<f64>, D::Error> {
    let values = Vec::<Option<f64>>::deserialize(from)?;
    Ok(values.into_iter().map(|x| x.unwrap_or(f64::NAN)).collect())
}
