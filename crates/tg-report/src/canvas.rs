//! What pictures are drawn on: SVG text or pixels. Lengths in pixels, y downwards.

mod font;
mod pixels;
mod png;
mod vector;

use crate::colour::Colour;

pub(crate) use font::width;
pub(crate) use pixels::Pixels;
pub(crate) use vector::Svg;

/// A point on the picture.
pub(crate) type Point = [f64; 2];

/// How a line is drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stroke<'a> {
    pub(crate) width: f64,
    pub(crate) colour: Colour,
    /// Lengths of dashes and gaps; empty for an unbroken line.
    pub(crate) dashes: &'a [f64],
}

impl Stroke<'_> {
    pub(crate) fn plain(width: f64, colour: Colour) -> Self {
        Self { width, colour, dashes: &[] }
    }
}

/// Where a text stands relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// A line of text; its point is on the base line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Text<'a> {
    pub(crate) at: Point,
    pub(crate) size: f64,
    pub(crate) anchor: Anchor,
    pub(crate) bold: bool,
    /// Turned to run upwards.
    pub(crate) upwards: bool,
    pub(crate) content: &'a str,
}

/// Dark, not black.
pub(crate) const INK: Colour = [34, 34, 34];

impl<'a> Text<'a> {
    pub(crate) fn new(at: Point, size: f64, anchor: Anchor, content: &'a str) -> Self {
        Self { at, size, anchor, bold: false, upwards: false, content }
    }
}

/// Something to draw on.
pub(crate) trait Canvas {
    /// A line through points; `note` tells a reader who points at it what it is.
    fn line(&mut self, points: &[Point], stroke: Stroke<'_>, note: &str);

    /// A filled polygon.
    fn polygon(&mut self, points: &[Point], fill: Colour, opacity: f64);

    /// A filled disc.
    fn disc(&mut self, centre: Point, radius: f64, fill: Colour);

    /// A line of text.
    fn text(&mut self, text: Text<'_>);

    /// A filled rectangle.
    fn rectangle(&mut self, [x, y]: Point, [width, height]: Point, fill: Colour) {
        self.polygon(&[[x, y], [x + width, y], [x + width, y + height], [x, y + height]], fill, 1.0);
    }
}
