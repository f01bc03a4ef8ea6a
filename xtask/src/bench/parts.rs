//! What a step and the analyses are made of: assembly, factorisation, solve; inverse statics, modes.

use std::convert::Infallible;

use serde::Serialize;
use tg_fixtures::{Mast, MastScene, mast};
use tg_modal::{ModeOptions, modes};
use tg_model::{At, Layout};
use tg_sparse::SaddleSystem;
use tg_statics::{Forward, ForwardOptions, InverseStatics, Request, Unknown};

use super::clock::repeated;
use super::scene::Scene;
use crate::TaskError;

/// Seconds of each part of a Newton iteration.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Newton {
    /// Tangents and Jacobian evaluated and put into the matrix.
    pub(crate) assembly: f64,
    pub(crate) factorisation: f64,
    pub(crate) solve: f64,
}

/// The matrix (55) of the first step of 1 ms.
pub(crate) fn newton(scene: &Scene, budget: f64) -> Result<Newton, TaskError> {
    let mechanics = scene.mechanics.as_ref();
    let mass: Vec<_> = mechanics.mass().iter().map(|e| (e.row, e.col)).collect();
    let values: Vec<f64> = mechanics.mass().iter().map(|e| e.value).collect();
    let groups = [&mass, mechanics.stiffness_pattern(), mechanics.damping_pattern()];
    let mut system = SaddleSystem::new(Layout::new(mechanics).saddle(mechanics, &groups)?);
    let mut stiffness = vec![0.0; mechanics.stiffness_pattern().len()];
    let mut damping = vec![0.0; mechanics.damping_pattern().len()];
    let mut jacobian = vec![0.0; mechanics.jacobian_pattern().len()];
    let mut inputs = vec![0.0; mechanics.sizes().inputs];
    mechanics.inputs(0.0, &mut inputs);
    let at = At { q: &scene.q, v: &scene.v, u: &inputs, taut: None };
    let h = 1e-3;
    let assembly = repeated(budget, || {
        mechanics.stiffness(at, &mut stiffness);
        mechanics.damping(at, &mut damping);
        mechanics.jacobian(at.q, &mut jacobian);
        system.clear_leading();
        system.add_leading(0, 1.0, &values);
        system.add_leading(1, h * h / 4.0, &stiffness);
        system.add_leading(2, h / 2.0, &damping);
        system.set_jacobian(&jacobian, &jacobian);
        Ok::<(), Infallible>(())
    })?;
    let factorisation = repeated(budget, || system.factor())?;
    let rhs = vec![1e-3; mechanics.free().len() + mechanics.sizes().constraints];
    let mut x = rhs.clone();
    let solve = repeated(budget, || {
        x.copy_from_slice(&rhs);
        system.solve(&mut x).map(drop)
    })?;
    Ok(Newton { assembly, factorisation, solve })
}

/// Rest lengths that hold the mast's design geometry, all cables at 1 N or more \[s\].
pub(crate) fn inverse_statics(stages: usize, budget: f64) -> Result<f64, TaskError> {
    let model = Mast::build(&MastScene::balanced(stages))?.model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let request = Request::new(Unknown::RestLength).tension_between(1.0, 200.0);
    let seconds = repeated(budget, || {
        InverseStatics::new(&model, &q, &u).and_then(|statics| statics.solve(&request)).map(drop)
    })?;
    Ok(seconds)
}

/// Ten lowest modes about the mast's loaded equilibrium, and the search for that.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct Modal {
    /// Seconds of the search.
    pub(crate) search: f64,
    /// Seconds of the modes alone.
    pub(crate) modes: f64,
    /// ω² of the ten lowest modes \[1/s²\].
    pub(crate) omega_squared: Vec<f64>,
}

/// Measures both, each for about `budget` seconds.
pub(crate) fn modal(stages: usize, budget: f64) -> Result<Modal, TaskError> {
    let model = mast(stages)?.model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let forward = Forward::new(&model, ForwardOptions::default());
    let search = repeated(budget, || forward.solve(&q, &u).map(drop))?;
    let at = forward.solve(&q, &u)?.configuration;
    let options = ModeOptions::new(10);
    let seconds = repeated(budget, || modes(&model, &at, &options).map(drop))?;
    let list = modes(&model, &at, &options)?.list;
    Ok(Modal { search, modes: seconds, omega_squared: list.iter().map(|mode| mode.omega_squared).collect() })
}
