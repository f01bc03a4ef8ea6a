//! What the colours and lengths of a picture mean.

use super::LABEL;
use crate::canvas::{Anchor, Canvas, INK, Point, Stroke, Text};
use crate::colour::{Colour, scale};
use crate::frame::Frame;
use crate::ticks::{round_step, ticks};

/// Slack cables.
pub(super) const SLACK: Stroke<'static> = Stroke { width: 1.8, colour: [130, 130, 130], dashes: &[5.0, 5.0] };

/// The range of tensions that the colours span \[N\].
pub(super) struct Tensions {
    low: f64,
    high: f64,
}

impl Tensions {
    /// From zero, or the least tension if it is negative, to the greatest; none where nothing pulls.
    pub(super) fn of(frames: &[Frame], given: Option<[f64; 2]>) -> Option<Self> {
        let tight = frames.iter().flat_map(|f| &f.cables).filter(|c| !c.slack && c.tension.is_finite());
        let mut range = [0.0_f64, 0.0_f64];
        for cable in tight {
            range = [range[0].min(cable.tension), range[1].max(cable.tension)];
        }
        let [low, high] = given.unwrap_or(range);
        (high > low).then_some(Self { low, high })
    }

    pub(super) fn colour(&self, tension: f64) -> Colour {
        scale((tension - self.low) / (self.high - self.low))
    }

    /// The colour bar, its upper left corner given.
    pub(super) fn bar(&self, canvas: &mut dyn Canvas, [x, y]: Point, height: f64) {
        const WIDTH: f64 = 14.0;
        const STEPS: u32 = 64;
        // From the top: each colour reaches to the bottom, so that no light comes through between two.
        for k in 0..STEPS {
            let down = height * f64::from(k) / f64::from(STEPS);
            let colour = scale(1.0 - (f64::from(k) + 0.5) / f64::from(STEPS));
            canvas.rectangle([x, y + down], [WIDTH, height - down], colour);
        }
        canvas.text(Text::new([x - 24.0, y - 12.0], LABEL, Anchor::Start, "tension [N]"));
        for (value, label) in ticks(self.low, self.high, 5) {
            let at = y + height * (1.0 - (value - self.low) / (self.high - self.low));
            canvas.line(&[[x + WIDTH, at], [x + WIDTH + 4.0, at]], Stroke::plain(1.0, INK), "");
            canvas.text(Text::new([x + WIDTH + 8.0, at + 0.36 * LABEL], LABEL, Anchor::Start, &label));
        }
    }
}

/// How long a metre is, its lower left corner given; at most `most` pixels.
pub(super) fn length(canvas: &mut dyn Canvas, [x, y]: Point, pixels: f64, most: f64) {
    // A round length below the longest: half of one that may be too long is short enough.
    let size = round_step(0.45 * most / pixels);
    if !(size > 0.0 && size.is_finite()) {
        return;
    }
    let right = x + size * pixels;
    let ink = Stroke::plain(1.2, INK);
    canvas.line(&[[x, y], [right, y]], ink, "");
    [x, right].iter().for_each(|&x| canvas.line(&[[x, y - 4.0], [x, y + 4.0]], ink, ""));
    let (size, unit) = match size {
        s if s < 0.9e-3 => (s * 1e6, "µm"),
        s if s < 0.09 => (s * 1e3, "mm"),
        s => (s, "m"),
    };
    let label = format!("{} {unit}", super::rounded(size));
    canvas.text(Text::new([right + 8.0, y + 0.36 * LABEL], LABEL, Anchor::Start, &label));
}

/// What dashes mean, its lower left corner given.
pub(super) fn slack(canvas: &mut dyn Canvas, [x, y]: Point) {
    canvas.line(&[[x, y], [x + 34.0, y]], SLACK, "");
    canvas.text(Text::new([x + 42.0, y + 0.36 * LABEL], LABEL, Anchor::Start, "slack"));
}
