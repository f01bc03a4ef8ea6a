//! Pictures of a structure as SVG: one frame, or several side by side.

mod bar;
mod camera;
mod paint;

use std::fmt::Write;

use crate::error::ReportError;
use crate::frame::Frame;
use crate::outline::Outline;
use crate::view::escaped;
use bar::Tensions;
use camera::Camera;
use paint::Sheet;

/// From where a structure is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Projection {
    /// Along the second horizontal axis: in the plane x to the right and y up; in space x to the right and z up.
    #[default]
    Front,
    /// Against the first horizontal axis.
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
    /// Tensions of the first and the last colour \[N\]; none takes them from the frames.
    pub tensions: Option<[f64; 2]>,
}

impl Default for Picture {
    fn default() -> Self {
        let projection = Projection::Front;
        Self { projection, size: [800.0, 600.0], title: String::new(), tensions: None }
    }
}

/// Room around pictures \[px\].
const MARGIN: f64 = 24.0;
/// Height of a line of text \[px\].
const LINE: f64 = 22.0;
/// Width of the colour bar with its texts \[px\].
const BAR: f64 = 96.0;

/// A picture of one frame: bars thick, cables thin and coloured by tension, slack ones grey and dashed.
///
/// # Errors
/// The frame does not fit the outline, or has no finite point to draw.
pub fn svg(outline: &Outline, frame: &Frame, picture: &Picture) -> Result<String, ReportError> {
    draw(outline, std::slice::from_ref(frame), picture, false)
}

/// Several frames side by side with their times, in one scale and one range of colours.
///
/// # Errors
/// There is no frame, one does not fit the outline, or has no finite point to draw.
pub fn strip_svg(outline: &Outline, frames: &[Frame], picture: &Picture) -> Result<String, ReportError> {
    draw(outline, frames, picture, true)
}

fn draw(outline: &Outline, frames: &[Frame], picture: &Picture, times: bool) -> Result<String, ReportError> {
    outline.check()?;
    frames.iter().try_for_each(|f| f.check(outline))?;
    let camera = Camera::new(outline, picture.projection);
    let Some(extent) = camera.extent(outline, frames) else {
        let reason = "no frame has a finite point".into();
        return Err(ReportError::Empty { what: "the picture".into(), reason });
    };
    let [width, height] = picture.size.map(|x| if x.is_finite() { x.max(100.0) } else { 800.0 });
    let tensions = Tensions::of(frames, picture.tensions);
    let top = MARGIN + if picture.title.is_empty() { 0.0 } else { 1.5 * LINE };
    let bottom = height - MARGIN - 1.5 * LINE;
    let right = width - MARGIN - if tensions.is_some() { BAR } else { 0.0 };
    let space = [(right - MARGIN).max(10.0), (bottom - top).max(10.0)];
    let caption = if times { LINE } else { 0.0 };
    let grid = Grid::best(frames.len(), space, extent.size(), caption);
    let mut out = head(width, height);
    if !picture.title.is_empty() {
        text(&mut out, [MARGIN, MARGIN + 12.0], 17.0, "start", "bold", &picture.title);
    }
    for (k, frame) in frames.iter().enumerate() {
        let centre = grid.centre([MARGIN, top], k);
        let sheet = Sheet { camera: &camera, extent: &extent, centre, scale: grid.scale };
        sheet.structure(&mut out, outline, frame, tensions.as_ref());
        if times {
            let below = [centre[0], centre[1] + extent.size()[1] / 2.0 * grid.scale + LINE];
            text(&mut out, below, 14.0, "middle", "normal", &format!("{} s", rounded(frame.time)));
        }
    }
    let slack = frames.iter().flat_map(|f| &f.cables).any(|c| c.slack);
    bar::length(&mut out, [MARGIN, height - MARGIN], grid.scale, space[0] / 4.0);
    if let Some(tensions) = &tensions {
        tensions.bar(&mut out, [width - MARGIN - BAR + 28.0, top + LINE], (bottom - top - LINE).min(260.0));
    }
    if slack {
        bar::slack(&mut out, [width - MARGIN - BAR + 4.0, height - MARGIN]);
    }
    out.push_str("</svg>\n");
    Ok(out)
}

/// Cells for the snapshots.
struct Grid {
    columns: usize,
    cell: [f64; 2],
    scale: f64,
    caption: f64,
}

impl Grid {
    /// The number of columns that shows `count` pictures of one size largest.
    fn best(count: usize, space: [f64; 2], size: [f64; 2], caption: f64) -> Self {
        let with = |columns: usize| {
            let rows = count.div_ceil(columns);
            let cell = [space[0] / columns as f64, space[1] / rows as f64];
            // Thick ends of bars need room as well.
            let inner = [0.88 * cell[0], (0.94 * cell[1] - 1.4 * caption).max(4.0)];
            let scale = (inner[0] / size[0].max(1e-300)).min(inner[1] / size[1].max(1e-300));
            Self { columns, cell, scale, caption }
        };
        let all = (1..=count.max(1)).map(with);
        let best = all.reduce(|a, b| if b.scale >= a.scale { b } else { a });
        let grid = best.unwrap_or(Self { columns: 1, cell: space, scale: 1.0, caption });
        // A structure without extent is drawn at some size.
        Self { scale: if grid.scale < 1e12 { grid.scale } else { 1.0 }, ..grid }
    }

    fn centre(&self, origin: [f64; 2], k: usize) -> [f64; 2] {
        let (row, column) = (k / self.columns, k % self.columns);
        let middle = [0.5 * self.cell[0], 0.5 * (self.cell[1] - self.caption)];
        [
            origin[0] + column as f64 * self.cell[0] + middle[0],
            origin[1] + row as f64 * self.cell[1] + middle[1],
        ]
    }
}

fn head(width: f64, height: f64) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" \
         font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    )
}

/// A line of text.
fn text(out: &mut String, at: [f64; 2], size: f64, anchor: &str, weight: &str, content: &str) {
    let [x, y] = at;
    let content = escaped(content);
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
         font-weight=\"{weight}\" fill=\"#222222\">{content}</text>"
    );
}

/// A number with few digits.
fn rounded(x: f64) -> String {
    let text = format!("{x:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.replace('-', "\u{2212}") }
}
