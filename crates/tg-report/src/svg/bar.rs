//! What the colours and lengths of a picture mean.

use std::fmt::Write;

use crate::colour::{Colour, hex, scale};
use crate::frame::Frame;
use crate::svg::text;
use crate::ticks::{round_step, ticks};

/// Slack cables.
pub(super) const SLACK: Colour = [130, 130, 130];

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
    pub(super) fn bar(&self, out: &mut String, [x, y]: [f64; 2], height: f64) {
        const WIDTH: f64 = 14.0;
        let steps = 64;
        for k in 0..steps {
            let part = (k as f64 + 0.5) / f64::from(steps);
            let (top, tall) =
                (y + height * (1.0 - f64::from(k + 1) / f64::from(steps)), height / f64::from(steps));
            let fill = hex(scale(part));
            // A little taller, so that no light comes through.
            let _ = writeln!(
                out,
                "<rect x=\"{x:.1}\" y=\"{top:.2}\" width=\"{WIDTH}\" height=\"{:.2}\" fill=\"{fill}\"/>",
                tall + if k == 0 { 0.0 } else { 0.6 }
            );
        }
        text(out, [x - 24.0, y - 12.0], 13.0, "start", "normal", "tension [N]");
        for (value, label) in ticks(self.low, self.high, 5) {
            let at = y + height * (1.0 - (value - self.low) / (self.high - self.low));
            let _ = writeln!(
                out,
                "<path d=\"M{:.1} {at:.2} h4\" stroke=\"#222222\" stroke-width=\"1\"/>",
                x + WIDTH
            );
            text(out, [x + WIDTH + 8.0, at + 4.5], 13.0, "start", "normal", &label);
        }
    }
}

/// How long a metre is, its lower left corner given; at most `most` pixels.
pub(super) fn length(out: &mut String, [x, y]: [f64; 2], pixels: f64, most: f64) {
    let most = most / pixels;
    // The largest round length below: half of the next round one is the last that fits.
    let step = round_step(most);
    let fits = [step, step / 2.0, step / 2.5, step / 5.0].into_iter().find(|&s| s <= most * 1.0001);
    let Some(size) = fits.map(|s| round_step(s * 0.999)).filter(|&s| s <= most * 1.0001 && s > 0.0) else {
        return;
    };
    let width = size * pixels;
    let _ = writeln!(
        out,
        "<path d=\"M{x:.1} {:.1} v-8 m0 4 h{width:.2} m0 -4 v8\" stroke=\"#222222\" stroke-width=\"1.2\" fill=\"none\"/>",
        y + 4.0
    );
    let (size, unit) = if size < 1e-3 {
        (size * 1e6, "µm")
    } else if size < 0.1 {
        (size * 1e3, "mm")
    } else {
        (size, "m")
    };
    let label = format!("{} {unit}", super::rounded(size));
    text(out, [x + width + 8.0, y + 4.5], 13.0, "start", "normal", &label);
}

/// What dashes mean, its lower left corner given.
pub(super) fn slack(out: &mut String, [x, y]: [f64; 2]) {
    let colour = hex(SLACK);
    let _ = writeln!(
        out,
        "<path d=\"M{x:.1} {y:.1} h34\" stroke=\"{colour}\" stroke-width=\"2\" stroke-dasharray=\"5 5\" \
         stroke-linecap=\"round\"/>"
    );
    text(out, [x + 42.0, y + 4.5], 13.0, "start", "normal", "slack");
}
