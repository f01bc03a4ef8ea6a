//! An observer that records chosen channels with a stride.

use crate::run::Observer;
use crate::state::State;
use crate::stepper::StepReport;

/// Records named channels (functions of the state) every `stride` steps; nobody computes what is not asked for.
pub struct Recorder<'a> {
    stride: usize,
    seen: usize,
    times: Vec<f64>,
    channels: Vec<Channel<'a>>,
}

struct Channel<'a> {
    name: String,
    function: Box<dyn FnMut(&State) -> f64 + 'a>,
    values: Vec<f64>,
}

impl<'a> Recorder<'a> {
    /// A recorder of the start and of every `stride`-th step (a stride of 0 counts as 1).
    pub fn every(stride: usize) -> Self {
        Self { stride: stride.max(1), seen: 0, times: Vec::new(), channels: Vec::new() }
    }

    /// Adds a channel.
    #[must_use]
    pub fn channel(mut self, name: &str, function: impl FnMut(&State) -> f64 + 'a) -> Self {
        let channel = Channel { name: name.into(), function: Box::new(function), values: Vec::new() };
        self.channels.push(channel);
        self
    }

    /// Recorded times \[s\].
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Recorded values of a channel, one per time; `None` if there is no such channel.
    pub fn values(&self, name: &str) -> Option<&[f64]> {
        self.channels.iter().find(|channel| channel.name == name).map(|channel| channel.values.as_slice())
    }

    /// Names of the channels in the order in which they were added.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.channels.iter().map(|channel| channel.name.as_str())
    }
}

impl Observer for Recorder<'_> {
    fn observe(&mut self, state: &State, _: &StepReport) {
        if self.seen.is_multiple_of(self.stride) {
            self.times.push(state.t);
            for channel in &mut self.channels {
                channel.values.push((channel.function)(state));
            }
        }
        self.seen += 1;
    }
}
