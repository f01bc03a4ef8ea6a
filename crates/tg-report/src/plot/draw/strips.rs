//! When something is the case: a row for each series, a bar where it is 1.

use super::scale::Scale;
use super::{Frame, TICK, drawable, fitted, range, widened};
use crate::canvas::{Anchor, Canvas, Point, Stroke, Text, width};
use crate::colour::{Colour, SERIES};
use crate::plot::Plot;

const TRACK: Colour = [236, 236, 236];
/// Room for names and for shares \[px\].
const NAMES: f64 = 180.0;
const SHARES: f64 = 56.0;

pub(super) fn draw(plot: &Plot, canvas: &mut dyn Canvas, [[left, top], [right, bottom]]: [Point; 2]) {
    let names = plot.series.iter().map(|s| width(&s.name, TICK, false)).fold(0.0, f64::max).min(NAMES);
    let corners = [[left + names + 10.0, top], [right - SHARES, bottom]];
    let frame =
        Frame { corners, x: widened(range(plot.at.iter()), 0.0), y: [0.0, 1.0], scales: [Scale::LINEAR; 2] };
    frame.abscissa(canvas, &plot.x.text());
    let [[left, _], [right, _]] = frame.corners;
    let row = (bottom - top) / plot.series.len() as f64;
    let thick = (0.62 * row).min(22.0);
    // Names of rows that are close are left out, not laid over each other.
    let every = (1.15 * TICK / row).ceil().max(1.0) as usize;
    for (k, series) in plot.series.iter().enumerate() {
        let y = top + (k as f64 + 0.5) * row;
        canvas.rectangle([left, y - 0.5 * thick], [right - left, thick], TRACK);
        let intervals = intervals(&plot.at, &series.values);
        for &[from, to] in &intervals {
            let (from, to) = (frame.x(from), frame.x(to));
            canvas.rectangle([from, y - 0.5 * thick], [(to - from).max(1.0), thick], SERIES[1]);
        }
        if k % every == 0 {
            let name = fitted(&series.name, TICK, NAMES);
            canvas.text(Text::new([left - 8.0, y + 0.36 * TICK], TICK, Anchor::End, &name));
            let total = intervals.iter().fold(0.0, |sum, [from, to]| sum + (to - from));
            let share = total / (frame.x[1] - frame.x[0]);
            let share = format!("{:.1} %", 100.0 * share);
            canvas.text(Text::new([right + SHARES - 2.0, y + 0.36 * TICK], TICK, Anchor::End, &share));
        }
    }
    canvas.line(&[[left, top], [left, bottom]], Stroke::plain(1.0, crate::canvas::INK), "");
}

/// Where values are 1: from such a value to the next that is not.
fn intervals(at: &[f64], values: &[f64]) -> Vec<[f64; 2]> {
    let mut intervals = Vec::new();
    let mut open = None;
    for (&x, &value) in at.iter().zip(values).filter(|(x, _)| drawable(**x)) {
        match (open, value > 0.5) {
            (None, true) => open = Some(x),
            (Some(from), false) => {
                intervals.push([from, x]);
                open = None;
            }
            _ => {}
        }
    }
    let last = at.iter().rfind(|&&x| drawable(x));
    intervals.extend(open.zip(last).map(|(from, &to)| [from, to]));
    intervals
}
