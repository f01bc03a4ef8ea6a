//! Cables that go slack by switching, or by a law that is smoothed.

use std::sync::Arc;

use tg_cases::tower::{Choices, Setup, Tower};
use tg_integrate::{EmbeddedPair, RungeKutta, Tolerances};
use tg_model::{CableLaw, Tension, TensionLaw};
use tg_trade::{LOOKS, Reference, Subject};

use super::{Cost, Topic, against};
use crate::TaskError;

/// Stiffness of the tower's cables \[N/m\].
const STIFFNESS: f64 = 100.0;
/// Simulated time: a multiple of 128 steps \[s\].
const END: f64 = 1.024;

/// `f = κ (x + √(x² + w²)) / 2` of the stretch x = l - μ: law (30) rounded off over some widths w.
struct Smoothed {
    stiffness: f64,
    width: f64,
}

impl TensionLaw for Smoothed {
    fn tension(&self, length: f64, _: f64, rest: f64) -> Tension {
        let x = length - rest;
        let root = x.hypot(self.width);
        let half = 0.5 * self.stiffness;
        Tension { force: half * (x + root), by_length: half * (1.0 + x / root), by_rate: 0.0 }
    }

    /// Its integral, zero at x = 0.
    fn energy(&self, length: f64, rest: f64) -> f64 {
        let (x, w) = (length - rest, self.width);
        0.25 * self.stiffness * (x * x + x * x.hypot(w) + w * w * (x / w).asinh())
    }

    fn damped(&self) -> bool {
        false
    }
}

pub(super) fn smoothed() -> Result<Topic, TaskError> {
    let with = |law| Tower::new(&Choices { law, ..Choices::paper(Setup::Us) });
    let switching = with(CableLaw::slacking(STIFFNESS))?;
    let rest = switching.model.velocities_at_rest();
    let subject = Subject::new(&switching.model, &rest, END);
    let truth = Reference::new(&subject, 4.0)?.motion;
    let mut costs = Vec::new();
    let widths = [None, Some(1e-3), Some(1e-4), Some(1e-5), Some(1e-6)];
    for width in widths {
        let smoothed = |width| CableLaw::User(Arc::new(Smoothed { stiffness: STIFFNESS, width }));
        let tower = with(width.map_or(CableLaw::slacking(STIFFNESS), smoothed))?;
        let subject = Subject::new(&tower.model, &rest, END);
        let name = width.map_or("switching".into(), |width| format!("smoothed over {width:.0e} m"));
        costs.push(Cost::symplectic(format!("{name}; symplectic, 1 ms"), &subject, 1e-3)?);
        let step = END / f64::from(LOOKS);
        costs.push(Cost::of(format!("{name}; runge-kutta-5, 1e-6"), &subject, step, |model| {
            RungeKutta::new(model, EmbeddedPair::DormandPrince5, Tolerances::relative(1e-6))
        })?);
    }
    Ok(Topic {
        title: "Switching or smoothed slack",
        text: "Planar tower US, whose cables go slack, 1.024 s; errors against the true motion of law (30). A smoothed law is \
               another structure: its error is its own, however small the step (under error control a call is 8 ms). Energies of \
               smoothed laws count from zero stretch.",
        table: against("law", &costs, &truth),
    })
}
