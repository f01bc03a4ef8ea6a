//! Plots as SVG and PNG.

mod axes;
mod curves;
mod scale;
mod strips;

use super::{Plot, PlotKind, Series};
use crate::canvas::{Anchor, Canvas, Pixels, Point, Svg, Text};
use crate::error::ReportError;
use axes::Frame;
use scale::Scale;

/// Sizes of text \[px\].
const TITLE: f64 = 16.0;
const LABEL: f64 = 13.0;
const TICK: f64 = 12.0;
/// Room around a plot \[px\].
const MARGIN: f64 = 16.0;

impl Plot {
    /// The plot as SVG of this size \[px\].
    ///
    /// # Errors
    /// There is no finite value, or a curve does not have as many values as the abscissa.
    pub fn svg(&self, size: [f64; 2]) -> Result<String, ReportError> {
        let size = usable(size);
        let mut canvas = Svg::new(size);
        self.draw(&mut canvas, size)?;
        Ok(canvas.finish())
    }

    /// The plot as the content of a PNG file: laid out for this size, with `scale` pixels for each unit of length; 2 is
    /// sharp on paper. The same plot gives the same bytes.
    ///
    /// # Errors
    /// There is no finite value, or a curve does not have as many values as the abscissa.
    pub fn png(&self, size: [f64; 2], scale: f64) -> Result<Vec<u8>, ReportError> {
        let size = usable(size);
        let mut canvas = Pixels::new(size, scale);
        self.draw(&mut canvas, size)?;
        canvas.finish()
    }

    fn draw(&self, canvas: &mut dyn Canvas, [width, height]: Point) -> Result<(), ReportError> {
        self.check()?;
        let (x, y) = (Scale::of(&self.x), Scale::of(&self.y));
        let some = |s: &Series| self.at_of(s).iter().any(|&v| x.has(v)) && s.values.iter().any(|&v| y.has(v));
        if !self.series.iter().any(some) {
            let reason = "there is no finite value".into();
            return Err(ReportError::Empty { what: format!("the plot {:?}", self.title), reason });
        }
        let title =
            Text { bold: true, ..Text::new([MARGIN, MARGIN + TITLE], TITLE, Anchor::Start, &self.title) };
        canvas.text(title);
        let (top, bottom) = (MARGIN + TITLE + 18.0, height - MARGIN - LABEL - TICK - 16.0);
        let room = [[MARGIN, top], [width - MARGIN, bottom]];
        match self.kind {
            PlotKind::Strips => strips::draw(self, canvas, room),
            PlotKind::Lines | PlotKind::Points => curves::draw(self, canvas, room),
        }
        Ok(())
    }
}

fn usable(size: [f64; 2]) -> [f64; 2] {
    let [width, height] = size;
    [
        if width.is_finite() { width.max(240.0) } else { 900.0 },
        if height.is_finite() { height.max(160.0) } else { 500.0 },
    ]
}

/// A text with its end left out where it is wider than `most`.
fn fitted(text: &str, size: f64, most: f64) -> String {
    if crate::canvas::width(text, size, false) <= most {
        return text.into();
    }
    let mut short = String::new();
    for c in text.chars() {
        short.push(c);
        if crate::canvas::width(&short, size, false) > most - size {
            break;
        }
    }
    short.pop();
    short + "\u{2026}"
}

/// Whether a value has a place: larger ones are as good as infinite, and their differences are.
fn drawable(x: f64) -> bool {
    x.abs() <= 1e300
}

/// The least and the greatest value that is drawn.
fn range<'a>(values: impl Iterator<Item = &'a f64>) -> [f64; 2] {
    let finite = values.filter(|&&x| drawable(x));
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)])
}

/// A range with room at its ends, and with some width where all values are one or differ by rounding.
fn widened([low, high]: [f64; 2], part: f64) -> [f64; 2] {
    let size = low.abs().max(high.abs());
    let least = if size > 0.0 { 1e-9 * size } else { 1.0 };
    if high - low < least {
        let half = if high > low {
            0.5 * least
        } else if size > 0.0 {
            0.05 * size
        } else {
            1.0
        };
        let middle = 0.5 * (low + high);
        return [middle - half, middle + half];
    }
    let room = part * (high - low);
    [low - room, high + room]
}
