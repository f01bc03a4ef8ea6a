//! DejaVu Sans: texts look the same wherever a picture is made.

use std::sync::OnceLock;

use ab_glyph_rasterizer::{Rasterizer, point};
use ttf_parser::{Face, OutlineBuilder};

use super::Point;

/// Width of a line of text \[px\].
pub(crate) fn width(text: &str, size: f64, bold: bool) -> f64 {
    let Some(face) = face(bold) else { return 0.6 * size * text.chars().count() as f64 };
    let scale = size / f64::from(face.units_per_em());
    text.chars().map(|c| advance(face, c) * scale).sum()
}

/// Draws a text's outlines; `place` takes a point, right and down of the start of the base line \[px\], to its place.
pub(super) fn outlines(
    text: &str,
    size: f64,
    bold: bool,
    raster: &mut Rasterizer,
    place: &dyn Fn(Point) -> Point,
) {
    let Some(face) = face(bold) else { return };
    let scale = size / f64::from(face.units_per_em());
    let mut right = 0.0;
    for c in text.chars() {
        if let Some(glyph) = face.glyph_index(c) {
            let mut pen = Pen { raster, place, right, scale, start: [0.0; 2], at: [0.0; 2] };
            face.outline_glyph(glyph, &mut pen);
        }
        right += advance(face, c) * scale;
    }
}

fn face(bold: bool) -> Option<&'static Face<'static>> {
    static FACES: OnceLock<[Option<Face<'static>>; 2]> = OnceLock::new();
    let faces = FACES.get_or_init(|| {
        [dejavu::sans::regular(), dejavu::sans::bold()].map(|font| Face::parse(font, 0).ok())
    });
    faces[usize::from(bold)].as_ref()
}

/// Width of a letter in units of the font; half an em where the font has none.
fn advance(face: &Face, c: char) -> f64 {
    let advance = face.glyph_index(c).and_then(|glyph| face.glyph_hor_advance(glyph));
    advance.map_or(0.5 * f64::from(face.units_per_em()), f64::from)
}

/// Takes outlines from the font's units, y upwards, to the picture.
struct Pen<'a> {
    raster: &'a mut Rasterizer,
    place: &'a dyn Fn(Point) -> Point,
    right: f64,
    scale: f64,
    start: Point,
    at: Point,
}

impl Pen<'_> {
    fn to(&self, x: f32, y: f32) -> Point {
        (self.place)([self.right + f64::from(x) * self.scale, -f64::from(y) * self.scale])
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        self.start = self.to(x, y);
        self.at = self.start;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.to(x, y);
        self.raster.draw_line(pixel(self.at), pixel(to));
        self.at = to;
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (control, to) = (self.to(x1, y1), self.to(x, y));
        self.raster.draw_quad(pixel(self.at), pixel(control), pixel(to));
        self.at = to;
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (first, second, to) = (self.to(x1, y1), self.to(x2, y2), self.to(x, y));
        self.raster.draw_cubic(pixel(self.at), pixel(first), pixel(second), pixel(to));
        self.at = to;
    }

    fn close(&mut self) {
        self.raster.draw_line(pixel(self.at), pixel(self.start));
        self.at = self.start;
    }
}

fn pixel([x, y]: Point) -> ab_glyph_rasterizer::Point {
    point(x as f32, y as f32)
}
