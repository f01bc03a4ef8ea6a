//! The structures that are measured.

use tg_cases::deployable::statics::rest_lengths;
use tg_cases::deployable::{self, Configuration, Deployable};
use tg_cases::double_pendulum::{self, DoublePendulum};
use tg_cases::tower::{self, Setup, Tower};
use tg_fixtures::{MastScene, mast};
use tg_model::{Form, Mechanics, Model};

use crate::TaskError;

/// A structure and where it starts.
pub(crate) struct Scene {
    pub(crate) name: String,
    pub(crate) mechanics: Box<dyn Mechanics>,
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) degrees_of_freedom: usize,
}

impl Scene {
    fn new<const D: usize>(name: impl Into<String>, model: Model<D>) -> Self {
        Self {
            name: name.into(),
            q: model.initial_coordinates(),
            v: model.velocities_at_rest(),
            degrees_of_freedom: model.report().degrees_of_freedom(),
            mechanics: Box::new(model),
        }
    }

    /// The mast of `stages` stages.
    pub(crate) fn mast(stages: usize) -> Result<Self, TaskError> {
        Ok(Self::new(format!("mast, N = {stages}"), mast(stages)?.model))
    }

    /// Example 3 as it unfolds in 20 s on ground that moves at 0.2 Hz.
    pub(crate) fn example3() -> Result<Self, TaskError> {
        let [initial, target] = [Configuration::Initial, Configuration::Target].map(rest_lengths);
        let choices = deployable::Choices::deployment(&initial?, &target?, 20.0).on_seismic_ground(0.2);
        Ok(Self::new("example 3, unfolding", Deployable::new(&choices)?.model))
    }

    /// The framework paper's examples.
    pub(crate) fn papers() -> Result<Vec<Self>, TaskError> {
        let pendulum = DoublePendulum::new(double_pendulum::Choices::default())?;
        let mut scenes = vec![Self::new("example 1, double pendulum", pendulum.model)];
        for setup in [Setup::Un, Setup::Dn, Setup::Us] {
            let tower = Tower::new(&tower::Choices::paper(setup))?;
            scenes.push(Self::new(format!("example 2, tower {}", setup.name()), tower.model));
        }
        scenes.push(Self::example3()?);
        Ok(scenes)
    }
}

/// A trajectory: positions of all nodes but the fixed ones, one row per sample.
pub(crate) type Trajectory = Vec<Vec<[f64; 3]>>;

/// The mast with what its trajectory is read by.
pub(crate) struct MastRun {
    pub(crate) stages: usize,
    pub(crate) scene: Scene,
    /// The free nodes, level by level.
    nodes: Vec<Form<3>>,
}

impl MastRun {
    /// # Errors
    /// The model cannot be built.
    pub(crate) fn new(stages: usize) -> Result<Self, TaskError> {
        let mast = mast(stages)?;
        let nodes = mast.nodes.iter().map(|&place| mast.model.form(place)).collect::<Result<_, _>>()?;
        Ok(Self { stages, nodes, scene: Scene::new(format!("mast, N = {stages}"), mast.model) })
    }

    /// Positions of the free nodes \[m\].
    pub(crate) fn positions(&self, q: &[f64]) -> Vec<[f64; 3]> {
        self.nodes.iter().map(|node| node.eval(q).into()).collect()
    }

    /// The numbers that the model is made of.
    pub(crate) fn numbers(&self) -> MastScene {
        MastScene::new(self.stages)
    }
}

/// Largest distance of a node from where it should be, over all samples \[m\]; NaN if the sizes differ.
pub(crate) fn error(ours: &[Vec<[f64; 3]>], converged: &[Vec<[f64; 3]>]) -> f64 {
    if ours.len() != converged.len() || ours.iter().zip(converged).any(|(a, b)| a.len() != b.len()) {
        return f64::NAN;
    }
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| {
        let squares = a.iter().zip(b).map(|(a, b)| (a - b).powi(2));
        squares.sum::<f64>().sqrt()
    };
    let worst = ours.iter().zip(converged).flat_map(|(a, b)| a.iter().zip(b)).map(apart);
    // NaN must not be lost: `f64::max` would drop it.
    worst.fold(0.0, |worst, distance| if distance <= worst { worst } else { distance })
}
