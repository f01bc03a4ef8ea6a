//! One structure with and without each feature: what a scene does not have it must not pay for.

use tg_cases::tower::{Choices, Joints, Setup, Tower};
use tg_coords::CoordType;
use tg_integrate::{NewtonOptions, StartError, State, StepError, StepReport, Stepper, Symplectic};
use tg_model::{BuildError, CableLaw, Joining, Mechanics, Model, ModelBuilder, Signal};

use crate::TaskError;

/// What the counts of this group stand under.
pub(crate) const GROUP: &str = "features";
/// The planar tower with nothing that can be left out, and the chain of bars in the plane.
pub(crate) const PLAIN: &str = "planar tower: linear cables, shared joints, ground at rest";
pub(crate) const PLANE: &str = "hanging chain in the plane";

/// Horizontal velocity that every free point starts with, as far as joints let it \[m/s\]: a structure at rest takes fewer
/// iterations.
const START: f64 = -0.2;

/// A structure, and what is looked at after each step.
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    /// The variant without the feature.
    pub(crate) without: &'static str,
    pub(crate) model: AnyModel,
    pub(crate) channels: Channels,
}

/// A model in the plane or in space.
pub(crate) enum AnyModel {
    Plane(Box<Model<2>>),
    Space(Box<Model<3>>),
}

/// What is looked at after each step.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Channels {
    None,
    Tensions,
    TensionsAndEnergies,
}

/// The structures, each with one feature more than the one that it is compared with.
pub(crate) fn variants() -> Result<Vec<Variant>, TaskError> {
    let plain = Choices {
        ground: Signal::Constant(0.0),
        types: [CoordType::Rrr; 3],
        joints: Joints::Shared,
        ..Choices::paper(Setup::Un)
    };
    let law = plain.law.clone();
    let ground = Signal::sine(0.01, 3.0);
    let towers = [
        (PLAIN, plain.clone(), Channels::None),
        ("with damping", Choices { law: law.with_damping(0.1), ..plain.clone() }, Channels::None),
        ("with slack", Choices { law: CableLaw::slacking(100.0), ..plain.clone() }, Channels::None),
        ("with extrinsic joints", Choices { joints: Joints::Constrained, ..plain.clone() }, Channels::None),
        ("with moving supports", Choices { ground, ..plain.clone() }, Channels::None),
        ("with the channel of tensions", plain.clone(), Channels::Tensions),
        ("with the channels of tensions and energies", plain, Channels::TensionsAndEnergies),
    ];
    let towers = towers.into_iter().map(|(name, choices, channels)| {
        let model = AnyModel::Plane(Box::new(Tower::new(&choices)?.model));
        Ok(Variant { name, without: PLAIN, model, channels })
    });
    let mut variants = towers.collect::<Result<Vec<_>, TaskError>>()?;
    let (plane, space) = (Box::new(chain::<2>()?), Box::new(chain::<3>()?));
    for (name, model) in
        [(PLANE, AnyModel::Plane(plane)), ("with the third dimension", AnyModel::Space(space))]
    {
        variants.push(Variant { name, without: PLANE, model, channels: Channels::None });
    }
    Ok(variants)
}

/// Eight bars that hang from each other, each tied to a wall.
fn chain<const D: usize>() -> Result<Model<D>, BuildError> {
    let at = |x: f64, y: f64| std::array::from_fn(|k| [x, y, 0.0][k]);
    let mut b = ModelBuilder::<D>::new();
    b.gravity(at(0.0, -9.81))?;
    let mut above = b.anchor("top", at(0.0, 0.0))?.into();
    for k in 0..8 {
        let y = f64::from(k);
        let bar = b.bar(&format!("bar {k}"), 1.0, at(0.0, -y), at(0.0, -y - 1.0))?;
        b.joint(&format!("hinge {k}"), &[above, bar.node(0)], Joining::Share)?;
        let wall = b.anchor(&format!("wall {k}"), at(1.0, -y - 0.5))?;
        b.cable(&format!("tie {k}"), wall, bar.node(1), CableLaw::linear(1e3), 1.0)?;
        above = bar.node(1);
    }
    b.build()
}

impl AnyModel {
    pub(crate) fn mechanics(&self) -> &dyn Mechanics {
        match self {
            Self::Plane(model) => model.as_ref(),
            Self::Space(model) => model.as_ref(),
        }
    }

    /// Initial coordinates and velocities.
    fn start(&self) -> (Vec<f64>, Vec<f64>) {
        match self {
            Self::Plane(model) => start(model),
            Self::Space(model) => start(model),
        }
    }

    /// Computes channels; a number that depends on all, so that none is optimised away.
    fn look(&self, state: &State, inputs: &mut [f64], channels: Channels) -> f64 {
        match self {
            Self::Plane(model) => look(model, state, inputs, channels),
            Self::Space(model) => look(model, state, inputs, channels),
        }
    }
}

fn start<const D: usize>(model: &Model<D>) -> (Vec<f64>, Vec<f64>) {
    let mut v = model.velocities_at_rest();
    for &i in model.mechanics().free() {
        v[i] = if i % D == 0 { START } else { 0.0 };
    }
    (model.initial_coordinates(), v)
}

fn look<const D: usize>(model: &Model<D>, state: &State, inputs: &mut [f64], channels: Channels) -> f64 {
    if channels == Channels::None {
        return 0.0;
    }
    let State { t, q, v, .. } = state;
    model.mechanics().inputs(*t, inputs);
    let tensions: f64 = model.cables().map(|cable| model.cable(cable, q, v, inputs).tension).sum();
    match channels {
        Channels::TensionsAndEnergies => tensions + model.energy(q, v, inputs).total(),
        _ => tensions,
    }
}

/// The symplectic scheme, with a look after each step.
pub(crate) struct Watched<'v> {
    variant: &'v Variant,
    stepper: Symplectic<'v>,
    inputs: Vec<f64>,
    pub(crate) seen: f64,
    /// Newton iterations so far.
    pub(crate) iterations: u32,
}

impl<'v> Watched<'v> {
    pub(crate) fn new(variant: &'v Variant) -> Result<Self, StartError> {
        let mechanics = variant.model.mechanics();
        let stepper = Symplectic::new(mechanics, NewtonOptions::default())?;
        let inputs = vec![0.0; mechanics.sizes().inputs];
        Ok(Self { variant, stepper, inputs, seen: 0.0, iterations: 0 })
    }

    /// The state at the start of the variant's motion.
    pub(crate) fn begin(&mut self) -> Result<State, StartError> {
        let (q, v) = self.variant.model.start();
        self.start(0.0, &q, &v)
    }
}

impl Stepper for Watched<'_> {
    fn mechanics(&self) -> &dyn Mechanics {
        self.stepper.mechanics()
    }

    fn start(&mut self, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError> {
        self.stepper.start(t, q, v)
    }

    fn step(&mut self, state: &mut State, h: f64) -> Result<StepReport, StepError> {
        let report = self.stepper.step(state, h)?;
        self.iterations += report.iterations;
        self.seen += self.variant.model.look(state, &mut self.inputs, self.variant.channels);
        Ok(report)
    }
}
