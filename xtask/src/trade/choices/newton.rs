//! How exactly and by which factors a step of the symplectic scheme is solved, and what becomes of its momentum.

use tg_cases::tower::{Choices, Setup, Tower};
use tg_fixtures::mast;
use tg_integrate::{NewtonOptions, Symplectic};
use tg_trade::Subject;

use super::{Cost, Topic, against, of_rows, rows, truth};
use crate::TaskError;

/// Step \[s\].
const STEP: f64 = 1e-3;
/// Simulated time: a multiple of 128 steps \[s\].
const END: f64 = 0.512;

pub(super) fn tolerance() -> Result<Topic, TaskError> {
    let mast = mast(8)?;
    let rest = mast.model.velocities_at_rest();
    let subject = Subject::new(&mast.model, &rest, END);
    let exact = NewtonOptions { tolerance: 1e-14, ..NewtonOptions::default() };
    let exact = Cost::of("", &subject, STEP, |model| Symplectic::new(model, exact))?.motion;
    let costs = [1e-4, 1e-6, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13].map(|tolerance| {
        let options = NewtonOptions { tolerance, ..NewtonOptions::default() };
        Cost::of(format!("{tolerance:.0e}"), &subject, STEP, |model| Symplectic::new(model, options))
    });
    let costs = costs.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(Topic {
        title: "Newton tolerance",
        text: "Guyed mast of 8 stages, 0.512 s in steps of 1 ms, which by themselves are off by 2e-5 m. Distances are from \
               the same steps at 1e-14: what the tolerance alone does. 1e-12, the default, leaves rounding; a looser one \
               saves iterations with kept factors only, and errors of the iteration, unlike those of the step, do not fall with h.",
        table: against("tolerance", &costs, &exact),
    })
}

pub(super) fn kept_factors() -> Result<Topic, TaskError> {
    let (eight, many) = (mast(8)?, mast(32)?);
    let tower = Tower::new(&Choices::paper(Setup::Un))?;
    let never = NewtonOptions { keep_factors: false, ..NewtonOptions::default() };
    let mut costs = Vec::new();
    for (name, model) in [("mast of 8 stages", &eight.model), ("mast of 32 stages", &many.model)] {
        let rest = model.velocities_at_rest();
        let subject = Subject::new(model, &rest, END);
        costs.push(Cost::symplectic(format!("{name}, kept"), &subject, STEP)?);
        let each = Cost::of(format!("{name}, new in each iteration"), &subject, STEP, |model| {
            Symplectic::new(model, never)
        })?;
        costs.push(each);
    }
    let rest = tower.model.velocities_at_rest();
    let subject = Subject::new(&tower.model, &rest, END);
    costs.push(Cost::symplectic("planar tower, kept", &subject, STEP)?);
    let name = "planar tower, new in each iteration";
    costs.push(Cost::of(name, &subject, STEP, |model| Symplectic::new(model, never))?);
    // Pairs: how far the second is from the first.
    let pairs: Vec<_> = costs.chunks(2).flat_map(|pair| rows(pair, &pair[0].motion)).collect();
    Ok(Topic {
        title: "Kept factors",
        text: "Factors of the Newton matrix (55) kept over iterations and steps while they serve, or new ones in each \
               iteration, as Algorithm 1 is printed. 0.512 s in steps of 1 ms; distances are between the two.",
        table: of_rows("factors", &pairs),
    })
}

pub(super) fn projection() -> Result<Topic, TaskError> {
    let tower = Tower::new(&Choices::paper(Setup::Un))?;
    let rest = tower.model.velocities_at_rest();
    let subject = Subject::new(&tower.model, &rest, END);
    let truth = truth(&subject)?;
    let mut costs = Vec::new();
    for (words, step) in [("1 ms", STEP), ("0.25 ms", STEP / 4.0)] {
        costs.push(Cost::symplectic(format!("projected, {words}"), &subject, step)?);
        costs.push(Cost::of(format!("as printed, {words}"), &subject, step, |model| {
            Symplectic::new(model, NewtonOptions::default()).map(Symplectic::carrying_momentum)
        })?);
    }
    Ok(Topic {
        title: "Projection",
        text: "The momentum projected onto the constraints at the end of each step, or carried as (53b) prints it. Planar \
               tower UN on shaking ground, 0.512 s, errors against the true motion. Without damping tensions do not depend \
               on velocities, and the state's velocities are projected either way: the choice shows in the multipliers (tests of \
               `tg-integrate`).",
        table: against("momentum", &costs, &truth),
    })
}
