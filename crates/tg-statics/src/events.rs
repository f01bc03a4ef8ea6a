//! Events on a branch: where the sign of t_p, the number of negative eigenvalues or the set of taut cables changes,
//! bisection in the arclength finds the place.

use crate::branch::{BranchPoint, Event, EventKind};
use crate::continuation_error::ContinuationError;
use crate::path::{Path, Place};

/// Part of a step to which events are located; the parameter of a limit point is then exact to the square of it.
const LOCATED: f64 = 1e-11;
/// Events within this part of a step of each other are one: at a limit point an eigenvalue changes sign too.
const TOGETHER: f64 = 1e-5;

impl Path<'_> {
    /// Events between two places, the second `to.length` along the branch from the first.
    pub(crate) fn events(&mut self, from: &Place, to: &Place) -> Result<Vec<Event>, ContinuationError> {
        let mut found: Vec<(f64, Event)> = Vec::new();
        let mut left = from.clone();
        left.length = 0.0;
        while !same(&left.point, &to.point) {
            let (mut low, mut high) = (left.clone(), to.clone());
            while high.length - low.length > LOCATED * to.length {
                let middle = 0.5 * (low.length + high.length);
                // Where Newton's method fails right at a singular point, a place beside it will do.
                let place = match self.step(from, middle)? {
                    None => self.step(from, middle + 0.1 * (high.length - low.length))?,
                    found => found,
                };
                let Some(place) = place else { break };
                if same(&place.point, &left.point) { low = place } else { high = place }
            }
            found.extend(self.changes(&low, &high).into_iter().map(|event| (high.length, event)));
            left = high;
        }
        Ok(merged(found, TOGETHER * to.length))
    }

    /// The events between two places next to each other.
    fn changes(&self, low: &Place, high: &Place) -> Vec<Event> {
        let (a, b) = (&low.point, &high.point);
        let event = |kind| Event {
            kind,
            parameter: b.parameter,
            configuration: b.configuration.clone(),
            negative: (a.negative, b.negative),
        };
        let mut events = Vec::new();
        if a.direction.signum() != b.direction.signum() {
            events.push(event(EventKind::LimitPoint));
        } else if a.negative != b.negative {
            events.push(event(EventKind::Bifurcation));
        }
        if let Ok(instance) = self.family.at(b.parameter) {
            let name = |k| instance.structure().switch_name(k);
            let pairs = a.taut.iter().zip(&b.taut).enumerate();
            events.extend(pairs.filter(|(_, (a, b))| a != b).map(|(k, (_, &taut))| {
                event(if taut {
                    EventKind::Taut { cable: name(k) }
                } else {
                    EventKind::Slack { cable: name(k) }
                })
            }));
        }
        events
    }
}

fn same(a: &BranchPoint, b: &BranchPoint) -> bool {
    a.negative == b.negative && a.taut == b.taut && a.direction.signum() == b.direction.signum()
}

/// A change of sign of an eigenvalue beside a limit point belongs to it; rounding sets them apart.
fn merged(found: Vec<(f64, Event)>, together: f64) -> Vec<Event> {
    let mut merged: Vec<(f64, Event)> = Vec::new();
    for (length, event) in found {
        let singular = |e: &Event| matches!(e.kind, EventKind::LimitPoint | EventKind::Bifurcation);
        match merged.last_mut() {
            Some((at, last)) if length - *at <= together && singular(last) && singular(&event) => {
                last.negative.1 = event.negative.1;
                if event.kind == EventKind::LimitPoint {
                    last.kind = EventKind::LimitPoint;
                    last.parameter = event.parameter;
                }
            }
            _ => merged.push((length, event)),
        }
    }
    let is_change = |e: &Event| e.kind != EventKind::Bifurcation || e.negative.0 != e.negative.1;
    merged.into_iter().map(|(_, event)| event).filter(is_change).collect()
}
