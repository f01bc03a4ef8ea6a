//! Pictures of a structure as SVG and PNG: one frame, or several side by side.

mod camera;
mod legend;
mod paint;

use crate::canvas::{Anchor, Canvas, Pixels, Point, Svg, Text};
use crate::error::ReportError;
use crate::frame::Frame;
use crate::outline::Outline;
use camera::{Camera, Extent};
use legend::Tensions;
use paint::Sheet;

/// From where a structure is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Projection {
    /// Along the second horizontal axis: in the plane x to the right and y up; in space x to the right and z up.
    #[default]
    Front,
    /// From the right: against the first horizontal axis.
    Side,
    /// From above.
    Top,
    /// From the front, the right and above, all axes equally short.
    Isometric,
}

/// How a picture is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// From where the structure is seen.
    pub projection: Projection,
    /// Size \[px\].
    pub size: [f64; 2],
    /// A line above; empty for none.
    pub title: String,
    /// What stands beneath the pictures of a strip; those without get their time.
    pub captions: Vec<String>,
    /// Tensions of the first and the last colour \[N\]; none takes them from the frames.
    pub tensions: Option<[f64; 2]>,
}

impl Default for Picture {
    fn default() -> Self {
        let projection = Projection::Front;
        Self { projection, size: [800.0, 600.0], title: String::new(), captions: Vec::new(), tensions: None }
    }
}

/// A picture of one frame as SVG: bars thick, cables thin and coloured by tension, slack ones grey and dashed.
///
/// # Errors
/// The frame does not fit the outline, or has no finite point to draw.
pub fn svg(outline: &Outline, frame: &Frame, picture: &Picture) -> Result<String, ReportError> {
    as_svg(outline, std::slice::from_ref(frame), picture, false)
}

/// Several frames side by side with their times as SVG, in one scale and one range of colours.
///
/// # Errors
/// There is no frame, one does not fit the outline, or none has a finite point to draw.
pub fn strip_svg(outline: &Outline, frames: &[Frame], picture: &Picture) -> Result<String, ReportError> {
    as_svg(outline, frames, picture, true)
}

/// [`svg`] as the content of a PNG file, with `scale` pixels for each unit of length.
///
/// # Errors
/// As for [`svg`].
pub fn png(outline: &Outline, frame: &Frame, picture: &Picture, scale: f64) -> Result<Vec<u8>, ReportError> {
    as_png(outline, std::slice::from_ref(frame), picture, false, scale)
}

/// [`strip_svg`] as the content of a PNG file, with `scale` pixels for each unit of length.
///
/// # Errors
/// As for [`strip_svg`].
pub fn strip_png(
    outline: &Outline,
    frames: &[Frame],
    picture: &Picture,
    scale: f64,
) -> Result<Vec<u8>, ReportError> {
    as_png(outline, frames, picture, true, scale)
}

/// Room around pictures \[px\].
const MARGIN: f64 = 24.0;
/// Height of a line of text \[px\].
const LINE: f64 = 22.0;
/// Width of the colour bar with its texts \[px\].
const BAR: f64 = 96.0;
/// Sizes of texts \[px\].
const TITLE: f64 = 17.0;
const TIME: f64 = 14.0;
const LABEL: f64 = 13.0;

fn as_svg(
    outline: &Outline,
    frames: &[Frame],
    picture: &Picture,
    times: bool,
) -> Result<String, ReportError> {
    let mut canvas = Svg::new(picture.room());
    picture.draw(&mut canvas, outline, frames, times)?;
    Ok(canvas.finish())
}

fn as_png(
    outline: &Outline,
    frames: &[Frame],
    picture: &Picture,
    times: bool,
    scale: f64,
) -> Result<Vec<u8>, ReportError> {
    let mut canvas = Pixels::new(picture.room(), scale);
    picture.draw(&mut canvas, outline, frames, times)?;
    canvas.finish()
}

impl Picture {
    fn room(&self) -> Point {
        let [width, height] = self.size;
        let usable = |x: f64, default: f64| if x.is_finite() { x.max(160.0) } else { default };
        [usable(width, 800.0), usable(height, 600.0)]
    }

    fn draw(
        &self,
        canvas: &mut dyn Canvas,
        outline: &Outline,
        frames: &[Frame],
        times: bool,
    ) -> Result<(), ReportError> {
        outline.check()?;
        frames.iter().try_for_each(|f| f.check(outline))?;
        let camera = Camera::new(outline, self.projection);
        let Some(extent) = camera.extent(outline, frames) else {
            let reason = "no frame has a finite point".into();
            return Err(ReportError::Empty { what: "the picture".into(), reason });
        };
        let [width, height] = self.room();
        let tensions = Tensions::of(frames, self.tensions);
        let top = MARGIN + if self.title.is_empty() { 0.0 } else { 1.5 * LINE };
        let bottom = height - MARGIN - 1.5 * LINE;
        let right = width - MARGIN - if tensions.is_some() { BAR } else { 0.0 };
        let space = [(right - MARGIN).max(10.0), (bottom - top).max(10.0)];
        let grid = Grid::best(frames.len(), space, extent.size(), if times { LINE } else { 0.0 });
        let title = Text::new([MARGIN, MARGIN + 12.0], TITLE, Anchor::Start, &self.title);
        canvas.text(Text { bold: true, ..title });
        for (k, frame) in frames.iter().enumerate() {
            let centre = grid.centre([MARGIN, top], k);
            let sheet = Sheet { camera: &camera, extent: &extent, centre, scale: grid.scale };
            sheet.structure(canvas, outline, frame, tensions.as_ref());
            if times {
                let below = [centre[0], centre[1] + 0.5 * extent.size()[1] * grid.scale + LINE];
                let time = || format!("{} s", rounded(frame.time));
                let caption = self.captions.get(k).cloned().unwrap_or_else(time);
                canvas.text(Text::new(below, TIME, Anchor::Middle, &caption));
            }
        }
        legend::length(canvas, [MARGIN, height - MARGIN], grid.scale, 0.25 * space[0]);
        if let Some(tensions) = &tensions {
            let at = [width - MARGIN - BAR + 28.0, top + LINE];
            tensions.bar(canvas, at, (bottom - top - LINE).min(260.0));
        }
        if frames.iter().flat_map(|f| &f.cables).any(|c| c.slack) {
            legend::slack(canvas, [width - MARGIN - BAR + 4.0, height - MARGIN]);
        }
        Ok(())
    }
}

/// Cells for the snapshots.
struct Grid {
    columns: usize,
    cell: Point,
    scale: f64,
    caption: f64,
}

impl Grid {
    /// The number of columns that shows `count` pictures of one size largest.
    fn best(count: usize, space: Point, size: [f64; 2], caption: f64) -> Self {
        let with = |columns: usize| {
            let rows = count.div_ceil(columns);
            let cell = [space[0] / columns as f64, space[1] / rows as f64];
            // Thick ends of bars need room as well.
            let inner = [0.88 * cell[0], (0.94 * cell[1] - 1.4 * caption).max(4.0)];
            let scale = (inner[0] / size[0].max(1e-300)).min(inner[1] / size[1].max(1e-300));
            Self { columns, cell, scale, caption }
        };
        let best = (1..=count.max(1)).map(with).reduce(|a, b| if b.scale >= a.scale { b } else { a });
        let grid = best.unwrap_or(Self { columns: 1, cell: space, scale: 1.0, caption });
        // A structure without extent is drawn at some size.
        Self { scale: if grid.scale < 1e12 { grid.scale } else { 1.0 }, ..grid }
    }

    fn centre(&self, origin: Point, k: usize) -> Point {
        let place = [k % self.columns, k / self.columns].map(|n| n as f64);
        let middle = [0.5 * self.cell[0], 0.5 * (self.cell[1] - self.caption)];
        std::array::from_fn(|i| origin[i] + place[i] * self.cell[i] + middle[i])
    }
}

impl Extent {
    fn size(&self) -> [f64; 2] {
        [self.greatest[0] - self.least[0], self.greatest[1] - self.least[1]]
    }

    fn centre(&self) -> [f64; 2] {
        [0.5 * (self.greatest[0] + self.least[0]), 0.5 * (self.greatest[1] + self.least[1])]
    }
}

/// A number with few digits.
fn rounded(x: f64) -> String {
    let text = format!("{x:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "\u{2212}") }
}
