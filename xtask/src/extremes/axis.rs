//! An axis and the values on it.

use std::sync::atomic::AtomicBool;

use super::verdict::{Verdict, guarded};

/// A quantity that is followed from one extreme to the other.
pub(crate) struct Axis {
    /// What is followed, with its unit: a heading of the page.
    pub(crate) title: &'static str,
    /// The structure, what is asked of it, and what the answer is compared with.
    pub(crate) setup: &'static str,
    /// From one end to the other.
    pub(crate) probes: Vec<Probe>,
    /// Why it ends where it ends, or what a refusal comes from; empty if the table says all.
    pub(crate) cause: &'static str,
}

/// One value on an axis.
pub(crate) struct Probe {
    /// The value in words.
    at: String,
    /// More than some seconds.
    long: bool,
    ask: Ask,
}

/// Asks the library; the flag is set when the time is over, for what can be cancelled.
type Ask = Box<dyn FnOnce(&AtomicBool) -> Verdict + Send>;

/// What came of an axis.
pub(crate) struct Found {
    pub(crate) axis: Axis,
    /// Values and verdicts.
    pub(crate) verdicts: Vec<(String, Verdict)>,
}

impl Probe {
    /// A value in words, and the question there.
    pub(crate) fn new(
        at: impl Into<String>,
        ask: impl FnOnce(&AtomicBool) -> Verdict + Send + 'static,
    ) -> Self {
        Self { at: at.into(), long: false, ask: Box::new(ask) }
    }

    /// Left out of a quick check.
    pub(crate) fn long(mut self) -> Self {
        self.long = true;
        self
    }
}

impl Axis {
    /// Asks at every value.
    pub(crate) fn follow(mut self, quick: bool) -> Found {
        let probes = std::mem::take(&mut self.probes).into_iter().filter(|probe| !(quick && probe.long));
        let ask = |probe: Probe| {
            eprintln!("  {}", probe.at);
            (probe.at, guarded(probe.ask))
        };
        let verdicts = probes.map(ask).collect();
        Found { axis: self, verdicts }
    }
}

impl Found {
    /// Whether every answer was right or refused.
    pub(crate) fn holds(&self) -> bool {
        self.verdicts.iter().all(|(_, verdict)| verdict.holds())
    }
}
