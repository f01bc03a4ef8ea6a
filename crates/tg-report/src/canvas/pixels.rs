//! Pixels, written as PNG: edges are smooth, and the same file comes out everywhere.

use ab_glyph_rasterizer::{Rasterizer, point};

use super::{Anchor, Canvas, INK, Point, Stroke, Text, font, png};
use crate::colour::Colour;
use crate::error::ReportError;

/// Pixels of a coordinate that are drawn beyond a picture's edges; what is farther away is cut off.
const BEYOND: f64 = 64.0;

/// A picture as pixels, white at first.
pub(crate) struct Pixels {
    width: usize,
    height: usize,
    /// Pixels for each unit of length.
    scale: f64,
    rgb: Vec<u8>,
    raster: Rasterizer,
}

impl Pixels {
    /// A picture of this size in units of length, with `scale` pixels for each.
    pub(crate) fn new(size: Point, scale: f64) -> Self {
        let scale = if scale.is_finite() { scale.clamp(0.01, 100.0) } else { 1.0 };
        let [width, height] = size.map(|x| (x * scale).round().clamp(1.0, 16_384.0) as usize);
        let (rgb, raster) = (vec![255; 3 * width * height], Rasterizer::new(1, 1));
        Self { width, height, scale, rgb, raster }
    }

    /// The content of a PNG file.
    pub(crate) fn finish(self) -> Result<Vec<u8>, ReportError> {
        png::encode(self.width, self.height, &self.rgb)
    }

    /// Fills what some outlines enclose: all of them run one way round, so that where they overlap counts once.
    fn fill(&mut self, outlines: &[Vec<Point>], colour: Colour, opacity: f64) {
        let Some(area) = self.area(outlines.iter().flatten().copied()) else { return };
        self.raster.reset(area.size[0], area.size[1]);
        for outline in outlines {
            let doubled: f64 = sides(outline).map(|([a, b], [c, d])| a * d - c * b).sum();
            for (from, to) in sides(outline) {
                let (from, to) = if doubled >= 0.0 { (from, to) } else { (to, from) };
                self.raster.draw_line(area.pixel(from), area.pixel(to));
            }
        }
        self.blend(&area, colour, opacity);
    }

    /// The pixels that some points span, cut off where they leave the picture; none if they are outside or not finite.
    fn area(&self, points: impl Iterator<Item = Point>) -> Option<Area> {
        let (mut least, mut greatest) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for p in points {
            if !(p[0].is_finite() && p[1].is_finite()) {
                return None;
            }
            for k in 0..2 {
                least[k] = least[k].min(p[k]);
                greatest[k] = greatest[k].max(p[k]);
            }
        }
        let end = [self.width as f64 + BEYOND, self.height as f64 + BEYOND];
        let start: [f64; 2] = std::array::from_fn(|k| least[k].floor().max(-BEYOND) - 1.0);
        let size: [f64; 2] = std::array::from_fn(|k| greatest[k].ceil().min(end[k]) + 2.0 - start[k]);
        let least_size = 1.0;
        (size[0] >= least_size && size[1] >= least_size)
            .then(|| Area { start, size: size.map(|x| x as usize) })
    }

    fn blend(&mut self, area: &Area, colour: Colour, opacity: f64) {
        let (width, height, rgb) = (self.width, self.height, &mut self.rgb);
        let [left, top] = area.start.map(|x| x as i64);
        self.raster.for_each_pixel_2d(|x, y, cover| {
            let (x, y) = (left + i64::from(x), top + i64::from(y));
            let cover = f64::from(cover.min(1.0)) * opacity;
            if cover < 1e-3 || x < 0 || y < 0 || x >= width as i64 || y >= height as i64 {
                return;
            }
            let at = 3 * (y as usize * width + x as usize);
            for (to, from) in rgb[at..at + 3].iter_mut().zip(colour) {
                let old = f64::from(*to);
                *to = (old + (f64::from(from) - old) * cover).round() as u8;
            }
        });
    }
}

/// A part of the pixels.
struct Area {
    start: [f64; 2],
    size: [usize; 2],
}

impl Area {
    /// Within the part; the rasteriser does not know points outside.
    fn pixel(&self, p: Point) -> ab_glyph_rasterizer::Point {
        let [x, y]: [f64; 2] =
            std::array::from_fn(|k| (p[k] - self.start[k]).clamp(0.0, self.size[k] as f64 - 1.0));
        point(x as f32, y as f32)
    }
}

impl Canvas for Pixels {
    fn line(&mut self, points: &[Point], stroke: Stroke<'_>, _: &str) {
        let scale = self.scale;
        let points: Vec<Point> = points.iter().map(|p| p.map(|x| x * scale)).collect();
        let dashes: Vec<f64> = stroke.dashes.iter().map(|d| d * scale).collect();
        let radius = 0.5 * stroke.width * scale;
        let mut outlines = Vec::new();
        for piece in dashed(&points, &dashes) {
            for ends in piece.windows(2) {
                outlines.extend(rod([ends[0], ends[1]], radius));
            }
            // Joints and ends are round.
            outlines.extend(piece.iter().map(|&p| circle(p, radius)));
        }
        self.fill(&outlines, stroke.colour, 1.0);
    }

    fn polygon(&mut self, points: &[Point], fill: Colour, opacity: f64) {
        let scale = self.scale;
        self.fill(&[points.iter().map(|p| p.map(|x| x * scale)).collect()], fill, opacity);
    }

    fn disc(&mut self, centre: Point, radius: f64, fill: Colour) {
        self.fill(&[circle(centre.map(|x| x * self.scale), radius * self.scale)], fill, 1.0);
    }

    fn text(&mut self, text: Text<'_>) {
        let size = text.size * self.scale;
        let length = font::width(text.content, size, text.bold);
        let back = match text.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => 0.5 * length,
            Anchor::End => length,
        };
        let at = text.at.map(|x| x * self.scale);
        let place = |[right, down]: Point| {
            let along = right - back;
            if text.upwards { [at[0] + down, at[1] - along] } else { [at[0] + along, at[1] + down] }
        };
        let corners = [[0.0, -1.3 * size], [length, -1.3 * size], [length, 0.5 * size], [0.0, 0.5 * size]];
        let Some(area) = self.area(corners.into_iter().map(place)) else { return };
        self.raster.reset(area.size[0], area.size[1]);
        let start = area.start;
        let place = |p: Point| {
            let p = place(p);
            [p[0] - start[0], p[1] - start[1]]
        };
        font::outlines(text.content, size, text.bold, &mut self.raster, &place);
        self.blend(&area, INK, 1.0);
    }
}

/// The sides of a closed outline.
fn sides(outline: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    let next = outline.iter().cycle().skip(1);
    outline.iter().copied().zip(next.copied())
}

/// A straight piece of a line; none without length.
fn rod([a, b]: [Point; 2], radius: f64) -> Option<Vec<Point>> {
    let along = [b[0] - a[0], b[1] - a[1]];
    let length = along[0].hypot(along[1]);
    let [x, y] = along.map(|d| radius * d / length);
    (length > 0.0)
        .then(|| vec![[a[0] + y, a[1] - x], [b[0] + y, b[1] - x], [b[0] - y, b[1] + x], [a[0] - y, a[1] + x]])
}

fn circle([x, y]: Point, radius: f64) -> Vec<Point> {
    let corners = (4.0 * radius).clamp(8.0, 64.0) as usize;
    let angle = std::f64::consts::TAU / corners as f64;
    (0..corners)
        .map(|k| (k as f64 * angle).sin_cos())
        .map(|(s, c)| [x + radius * c, y + radius * s])
        .collect()
}

/// The pieces of a line with gaps.
fn dashed(points: &[Point], dashes: &[f64]) -> Vec<Vec<Point>> {
    if dashes.iter().sum::<f64>() <= 0.0 {
        return vec![points.to_vec()];
    }
    let mut pieces = Vec::new();
    let mut piece: Vec<Point> = points.first().copied().into_iter().collect();
    let (mut k, mut left) = (0, dashes[0]);
    for ends in points.windows(2) {
        let (mut from, to) = (ends[0], ends[1]);
        let mut length = (to[0] - from[0]).hypot(to[1] - from[1]);
        while length > left {
            let part = left / length;
            from = [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
            length -= left;
            if k % 2 == 0 {
                piece.push(from);
                pieces.push(std::mem::take(&mut piece));
            } else {
                piece = vec![from];
            }
            k += 1;
            left = dashes[k % dashes.len()];
        }
        left -= length;
        if k % 2 == 0 {
            piece.push(to);
        }
    }
    if piece.len() > 1 {
        pieces.push(piece);
    }
    pieces
}
