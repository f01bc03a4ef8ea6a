//! SVG.

use std::fmt::Write;

use super::{Anchor, Canvas, INK, Point, Stroke, Text};
use crate::colour::{Colour, hex};
use crate::view::escaped;

/// A picture as SVG text.
pub(crate) struct Svg {
    text: String,
}

impl Svg {
    pub(crate) fn new([width, height]: Point) -> Self {
        let (width, height) = (number(width), number(height));
        let text = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"DejaVu Sans, Verdana, Helvetica, Arial, sans-serif\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
        );
        Self { text }
    }

    pub(crate) fn finish(mut self) -> String {
        self.text.push_str("</svg>\n");
        self.text
    }

    fn push(&mut self, args: std::fmt::Arguments<'_>) {
        // Writing to a string does not fail.
        let _ = self.text.write_fmt(args);
    }
}

impl Canvas for Svg {
    fn line(&mut self, points: &[Point], stroke: Stroke<'_>, note: &str) {
        let (path, colour, width) = (path(points), hex(stroke.colour), number(stroke.width));
        self.push(format_args!(
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\""
        ));
        self.push(format_args!(" stroke-linecap=\"round\" stroke-linejoin=\"round\""));
        if !stroke.dashes.is_empty() {
            let dashes: Vec<String> = stroke.dashes.iter().map(|&d| number(d)).collect();
            self.push(format_args!(" stroke-dasharray=\"{}\"", dashes.join(" ")));
        }
        match note {
            "" => self.push(format_args!("/>\n")),
            note => self.push(format_args!("><title>{}</title></path>\n", escaped(note))),
        }
    }

    fn polygon(&mut self, points: &[Point], fill: Colour, opacity: f64) {
        let (path, fill) = (path(points), hex(fill));
        self.push(format_args!("<path d=\"{path}Z\" fill=\"{fill}\""));
        if opacity < 1.0 {
            self.push(format_args!(" fill-opacity=\"{}\"", number(opacity)));
        }
        self.push(format_args!("/>\n"));
    }

    fn disc(&mut self, centre: Point, radius: f64, fill: Colour) {
        let ([x, y], r, fill) = (centre.map(number), number(radius), hex(fill));
        self.push(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{fill}\"/>\n"));
    }

    fn text(&mut self, text: Text<'_>) {
        let ([x, y], size, fill) = (text.at.map(number), number(text.size), hex(INK));
        let anchor = match text.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        self.push(format_args!("<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\""));
        if text.bold {
            self.push(format_args!(" font-weight=\"bold\""));
        }
        if text.upwards {
            self.push(format_args!(" transform=\"rotate(-90 {x} {y})\""));
        }
        self.push(format_args!(" fill=\"{fill}\">{}</text>\n", escaped(text.content)));
    }
}

fn path(points: &[Point]) -> String {
    let mut path = String::new();
    for (k, p) in points.iter().enumerate() {
        let [x, y] = p.map(number);
        let _ = write!(path, "{}{x} {y}", if k == 0 { "M" } else { "L" });
    }
    path
}

/// A hundredth of a pixel is enough.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}
