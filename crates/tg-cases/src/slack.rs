//! When cables were slack during a run.

use tg_integrate::State;
use tg_model::Model;

/// Lengths less rest lengths of all cables \[m\]: slack where negative.
pub fn stretches<const D: usize>(model: &Model<D>, state: &State) -> Vec<f64> {
    let u = model.inputs_at(state.t);
    let stretch = |cable| {
        let cable = model.cable(cable, &state.q, &state.v, &u);
        cable.length - cable.rest
    };
    model.cables().map(stretch).collect()
}

/// A time during which one cable was shorter than its rest length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlackInterval {
    /// Position of the cable in the list that was watched.
    pub cable: usize,
    /// Begin \[s\].
    pub from: f64,
    /// End \[s\], the last time seen if it is still slack.
    pub to: f64,
}

/// Finds slack intervals from stretches `l - μ` at successive times; crossings are interpolated linearly.
#[derive(Clone, Debug, Default)]
pub struct SlackWatch {
    last: Option<(f64, Vec<f64>)>,
    open: Vec<Option<f64>>,
    found: Vec<SlackInterval>,
}

impl SlackWatch {
    /// Takes the stretches of all cables at a later time than before.
    pub fn see(&mut self, t: f64, stretches: Vec<f64>) {
        self.open.resize(stretches.len(), None);
        for (cable, &now) in stretches.iter().enumerate() {
            let crossing = match &self.last {
                Some((before_t, before)) if (before[cable] < 0.0) != (now < 0.0) => {
                    before_t + (t - before_t) * before[cable] / (before[cable] - now)
                }
                Some(_) => continue,
                None => t,
            };
            if now < 0.0 {
                self.open[cable] = Some(crossing);
            } else if let Some(from) = self.open[cable].take() {
                self.found.push(SlackInterval { cable, from, to: crossing });
            }
        }
        self.last = Some((t, stretches));
    }

    /// All intervals, by cable and time.
    pub fn finish(mut self) -> Vec<SlackInterval> {
        let end = self.last.map_or(0.0, |(t, _)| t);
        for (cable, from) in self.open.into_iter().enumerate() {
            if let Some(from) = from {
                self.found.push(SlackInterval { cable, from, to: end });
            }
        }
        sort(&mut self.found);
        self.found
    }
}

/// Sorts intervals by cable and time.
pub fn sort(intervals: &mut [SlackInterval]) {
    intervals.sort_by(|a, b| a.cable.cmp(&b.cable).then(a.from.total_cmp(&b.from)));
}
