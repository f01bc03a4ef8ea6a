//! How much generalised-α damps what a step does not resolve.

use tg_cases::tower::{Choices, Setup, Tower};
use tg_integrate::{GeneralizedAlpha, NewtonOptions};
use tg_trade::Subject;

use super::{Cost, Topic, against, truth};
use crate::TaskError;

/// Step \[s\].
const STEP: f64 = 1e-3;
/// Simulated time: a multiple of 128 steps \[s\].
const END: f64 = 0.512;

pub(super) fn spectral_radius() -> Result<Topic, TaskError> {
    let tower = Tower::new(&Choices::paper(Setup::Un))?;
    let rest = tower.model.velocities_at_rest();
    let subject = Subject::new(&tower.model, &rest, END);
    let truth = truth(&subject)?;
    let costs = [0.0, 0.3, 0.5, 0.7, 0.8, 0.9, 0.95].map(|radius| {
        Cost::of(format!("{radius}"), &subject, STEP, |model| {
            GeneralizedAlpha::new(model, radius, NewtonOptions::default())
        })
    });
    Ok(Topic {
        title: "Spectral radius",
        text: "Generalised-α on the planar tower UN, 0.512 s in steps of 1 ms, by its spectral radius at infinity, errors \
               against the true motion. The smaller the radius, the harder it damps what steps do not resolve, and the larger \
               the error of what they do; near 1 nothing is damped. The default 0.7 is where the error still is near its least.",
        table: against("radius", &costs.into_iter().collect::<Result<Vec<_>, _>>()?, &truth),
    })
}
