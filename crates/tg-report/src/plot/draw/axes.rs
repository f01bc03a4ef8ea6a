//! Axes with ticks, a light grid and labels.

use super::scale::Scale;
use super::{LABEL, TICK};
use crate::canvas::{Anchor, Canvas, INK, Point, Stroke, Text, width};
use crate::colour::Colour;

const GRID: Colour = [228, 228, 228];

/// Where places along the axes are on the picture.
pub(super) struct Frame {
    /// Upper left and lower right corner \[px\].
    pub(super) corners: [Point; 2],
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
    pub(super) scales: [Scale; 2],
}

impl Frame {
    pub(super) fn x(&self, value: f64) -> f64 {
        let [[left, _], [right, _]] = self.corners;
        left + (value - self.x[0]) / (self.x[1] - self.x[0]) * (right - left)
    }

    pub(super) fn y(&self, value: f64) -> f64 {
        let [[_, top], [_, bottom]] = self.corners;
        bottom - (value - self.y[0]) / (self.y[1] - self.y[0]) * (bottom - top)
    }

    /// The abscissa beneath, with a grid above it.
    pub(super) fn abscissa(&self, canvas: &mut dyn Canvas, label: &str) {
        let [[left, top], [right, bottom]] = self.corners;
        let wanted = ((right - left) / 90.0).clamp(2.0, 10.0) as usize;
        for (value, text) in self.scales[0].ticks(self.x, wanted) {
            let x = self.x(value);
            canvas.line(&[[x, top], [x, bottom]], Stroke::plain(1.0, GRID), "");
            canvas.line(&[[x, bottom], [x, bottom + 5.0]], Stroke::plain(1.0, INK), "");
            canvas.text(Text::new([x, bottom + 8.0 + TICK], TICK, Anchor::Middle, &text));
        }
        let below = [0.5 * (left + right), bottom + 16.0 + TICK + LABEL];
        canvas.text(Text::new(below, LABEL, Anchor::Middle, label));
        canvas.line(&[[left, bottom], [right, bottom]], Stroke::plain(1.0, INK), "");
    }

    /// The ordinate to the left, with a grid.
    pub(super) fn ordinate(&self, canvas: &mut dyn Canvas, label: &str) {
        let [[left, top], [right, bottom]] = self.corners;
        let mut widest = 0.0_f64;
        for (value, text) in ordinates(self.scales[1], self.y, bottom - top) {
            let y = self.y(value);
            canvas.line(&[[left, y], [right, y]], Stroke::plain(1.0, GRID), "");
            canvas.line(&[[left - 5.0, y], [left, y]], Stroke::plain(1.0, INK), "");
            canvas.text(Text::new([left - 8.0, y + 0.36 * TICK], TICK, Anchor::End, &text));
            widest = widest.max(width(&text, TICK, false));
        }
        let beside = [left - 18.0 - widest, 0.5 * (top + bottom)];
        canvas.text(Text { upwards: true, ..Text::new(beside, LABEL, Anchor::Middle, label) });
        canvas.line(&[[left, top], [left, bottom]], Stroke::plain(1.0, INK), "");
    }
}

/// Ticks of an ordinate of this height \[px\].
pub(super) fn ordinates(scale: Scale, range: [f64; 2], height: f64) -> Vec<(f64, String)> {
    scale.ticks(range, (height / 60.0).clamp(2.0, 8.0) as usize)
}
