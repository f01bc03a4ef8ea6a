//! Lines and points with a legend.

use super::axes::ordinates;
use super::scale::Scale;
use super::{Frame, LABEL, TICK, fitted};
use crate::canvas::{Anchor, Canvas, Point, Stroke, Text, width};
use crate::colour::{Colour, SERIES};
use crate::plot::{Plot, PlotKind};

/// Dashes of the first seven curves, of the next seven, ...
const DASHES: [&[f64]; 4] = [&[], &[8.0, 5.0], &[2.0, 4.0], &[10.0, 4.0, 2.0, 4.0]];
/// Height of a line of the legend, length of its sample, room for names \[px\].
const ROW: f64 = 19.0;
const SAMPLE: f64 = 26.0;
const NAMES: f64 = 200.0;
/// Points for each pixel of width: more cannot be told apart.
const DENSITY: f64 = 4.0;

pub(super) fn draw(plot: &Plot, canvas: &mut dyn Canvas, [[left, top], [right, bottom]]: [Point; 2]) {
    let scales @ [across, upwards] = [Scale::of(&plot.x), Scale::of(&plot.y)];
    let y = upwards.span(plot.series.iter().flat_map(|s| &s.values), 0.04);
    let texts = ordinates(upwards, y, bottom - top);
    let widest = texts.iter().map(|(_, text)| width(text, TICK, false)).fold(0.0, f64::max);
    let left = left + LABEL + 18.0 + widest;
    let names = plot.series.iter().map(|s| width(&s.name, TICK, false)).fold(0.0, f64::max).min(NAMES);
    let legend = if names > 0.0 { names + SAMPLE + 26.0 } else { 12.0 };
    let right = (right - legend).max(left + 60.0);
    let room = if plot.kind == PlotKind::Points || across.is_logarithmic() { 0.03 } else { 0.0 };
    let x = across.span(plot.series.iter().flat_map(|s| plot.at_of(s)), room);
    let frame = Frame { corners: [[left, top], [right, bottom]], x, y, scales };
    frame.abscissa(canvas, &plot.x.text());
    frame.ordinate(canvas, &plot.y.text());
    let thin = match plot.kind {
        PlotKind::Points => plot.clone(),
        _ => plot.thinned((DENSITY * (right - left)) as usize),
    };
    // The first curves, which the legend names in any case, are drawn last.
    for (k, series) in thin.series.iter().enumerate().rev() {
        let points = thin.at_of(series).iter().zip(&series.values).map(|(&x, &y)| {
            let place = [frame.x(across.place(x)), frame.y(upwards.place(y))];
            (across.has(x) && upwards.has(y)).then_some(place)
        });
        curve(canvas, &points.collect::<Vec<_>>(), plot.kind, k);
    }
    if names > 0.0 {
        entries(plot, canvas, [right + 18.0, top], bottom - top);
    }
}

/// Pieces of a line between gaps; single points as discs.
fn curve(canvas: &mut dyn Canvas, points: &[Option<Point>], kind: PlotKind, k: usize) {
    for piece in points.split(Option::is_none) {
        let piece: Vec<Point> = piece.iter().flatten().copied().collect();
        match (kind, piece.as_slice()) {
            (_, []) => {}
            (PlotKind::Lines, [_, _, ..]) => canvas.line(&piece, stroke(k), ""),
            (_, points) => points.iter().for_each(|&p| canvas.disc(p, 2.6, colour(k))),
        }
    }
}

fn entries(plot: &Plot, canvas: &mut dyn Canvas, [left, top]: Point, height: f64) {
    let rows = (height / ROW).floor().max(1.0) as usize;
    let count = plot.series.len();
    let shown = if count > rows { rows - 1 } else { count };
    for (k, series) in plot.series.iter().take(shown).enumerate() {
        let y = top + (k as f64 + 0.5) * ROW;
        match plot.kind {
            PlotKind::Points => canvas.disc([left + 0.5 * SAMPLE, y], 3.2, colour(k)),
            _ => canvas.line(&[[left, y], [left + SAMPLE, y]], stroke(k), ""),
        }
        let name = fitted(&series.name, TICK, NAMES);
        canvas.text(Text::new([left + SAMPLE + 8.0, y + 0.36 * TICK], TICK, Anchor::Start, &name));
    }
    if shown < count {
        let y = top + (shown as f64 + 0.5) * ROW + 0.36 * TICK;
        canvas.text(Text::new([left, y], TICK, Anchor::Start, &format!("and {} more", count - shown)));
    }
}

fn colour(k: usize) -> Colour {
    SERIES[k % SERIES.len()]
}

fn stroke(k: usize) -> Stroke<'static> {
    let dashes = DASHES[(k / SERIES.len()) % DASHES.len()];
    Stroke { width: 1.7, colour: colour(k), dashes }
}
