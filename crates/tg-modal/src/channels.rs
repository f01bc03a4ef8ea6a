//! Inputs and outputs of a linear model.

use tg_model::{CableId, CableLaw, Model, Place, PlaceError, Tensioned};
use tg_tangent::Configuration;

use crate::balance::{check_index, check_length};
use crate::derivative::central;
use crate::error::ModalError;
use crate::ground::SupportMotion;

/// First step, per rest length, of the differences that tell how a user's law depends on it.
const STEP: f64 = 1e-2;

/// What drives a linear model.
#[derive(Clone, Debug, PartialEq)]
pub enum Input {
    /// An input u\[index\] of the structure (rest lengths, then force components), as its change from the equilibrium: one
    /// column.
    Parameter {
        /// Name of the column.
        name: String,
        /// Index into u.
        index: usize,
    },
    /// A motion of the supports: three columns, for s, ṡ and s̈, which the caller keeps consistent.
    Ground(SupportMotion),
}

impl Input {
    /// The rest length of a cable \[m\], cables counted in the user's order.
    ///
    /// # Errors
    /// There is no such cable.
    pub fn rest_length(structure: &dyn Tensioned, cable: usize) -> Result<Self, ModalError> {
        check_index("cable", cable, structure.cable_count())?;
        let name = format!("rest length of {}", structure.cable_name(cable));
        Ok(Self::Parameter { name, index: cable })
    }

    /// Names of the columns.
    pub(crate) fn names(&self) -> Vec<String> {
        match self {
            Self::Parameter { name, .. } => vec![name.clone()],
            Self::Ground(SupportMotion { name, .. }) => {
                ["displacement", "velocity", "acceleration"].map(|what| format!("{name} {what}")).to_vec()
            }
        }
    }
}

/// A linear output `y = p · δq + v · δq̇ + d · δu`, all over full coordinates and inputs.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name.
    pub name: String,
    /// p as (coordinate, weight).
    pub displacement: Vec<(usize, f64)>,
    /// v as (coordinate, weight).
    pub velocity: Vec<(usize, f64)>,
    /// d as (input, weight).
    pub inputs: Vec<(usize, f64)>,
}

impl Output {
    /// A weighted sum of displacements.
    pub fn displacement(name: &str, weights: &[(usize, f64)]) -> Self {
        let (velocity, inputs) = (Vec::new(), Vec::new());
        Self { name: name.into(), displacement: weights.to_vec(), velocity, inputs }
    }

    /// A weighted sum of velocities.
    pub fn velocity(name: &str, weights: &[(usize, f64)]) -> Self {
        let (displacement, inputs) = (Vec::new(), Vec::new());
        Self { name: name.into(), displacement, velocity: weights.to_vec(), inputs }
    }

    /// Change of a cable's length \[m\], cables counted in the user's order.
    ///
    /// # Errors
    /// There is no such cable, or `at` has another size.
    pub fn length(structure: &dyn Tensioned, cable: usize, at: &Configuration) -> Result<Self, ModalError> {
        check_index("cable", cable, structure.cable_count())?;
        check_length("configuration", &at.q, structure.sizes().coordinates)?;
        let pattern = structure.length_pattern();
        let (mut lengths, mut gradients) = (vec![0.0; structure.cable_count()], vec![0.0; pattern.len()]);
        structure.lengths(&at.q, &mut lengths, &mut gradients);
        let of_cable = pattern.iter().zip(&gradients).filter(|((id, _), _)| *id == cable);
        let weights: Vec<_> = of_cable.map(|(&(_, i), &g)| (i, g)).collect();
        Ok(Self::displacement(&format!("length of {}", structure.cable_name(cable)), &weights))
    }

    /// Change of a cable's tension \[N\], positive when it pulls more:
    /// `δf = ∂f/∂l δl + ∂f/∂l̇ δl̇ + ∂f/∂μ δμ`; zero for a slack cable.
    ///
    /// # Errors
    /// A length of zero, a law that is not finite, or `at` of another size.
    pub fn tension<const D: usize>(
        model: &Model<D>,
        cable: CableId,
        at: &Configuration,
    ) -> Result<Self, ModalError> {
        check_length("configuration", &at.q, model.mechanics().sizes().coordinates)?;
        check_length("vector of inputs", &at.u, model.mechanics().sizes().inputs)?;
        let state = model.cable(cable, &at.q, &vec![0.0; at.q.len()], &at.u);
        let [by_length, by_rate, by_rest] = if state.slack {
            [0.0; 3]
        } else {
            match model.cable_law(cable) {
                CableLaw::Linear { stiffness, damping } | CableLaw::Slacking { stiffness, damping } => {
                    [*stiffness, *damping, -stiffness]
                }
                CableLaw::User(law) => {
                    let tension = law.tension(state.length, 0.0, state.rest);
                    let step = STEP * if state.rest == 0.0 { state.length } else { state.rest };
                    let force = |h: f64| vec![law.tension(state.length, 0.0, state.rest + h).force];
                    [tension.by_length, tension.by_rate, central(step, force)[0]]
                }
            }
        };
        let form = model.cable_form(cable);
        let direction = form.eval(&at.q) / state.length;
        let weights = |by: f64| -> Vec<(usize, f64)> {
            let terms = form.terms().iter();
            terms
                .flat_map(|&(node, w)| (0..D).map(move |k| (node, w, k)))
                .map(|(node, w, k)| (node * D + k, by * w * direction[k]))
                .collect()
        };
        let name = format!("tension of {}", model.cable_name(cable));
        let index = model.cables().position(|id| id == cable);
        let output = Self {
            displacement: weights(by_length),
            velocity: if by_rate == 0.0 { Vec::new() } else { weights(by_rate) },
            inputs: index.map(|k| (k, by_rest)).into_iter().collect(),
            name,
        };
        let mut values = output.displacement.iter().chain(&output.velocity).chain(&output.inputs);
        if values.all(|(_, x)| x.is_finite()) {
            Ok(output)
        } else {
            Err(ModalError::NotFinite { what: format!("the {}", output.name) })
        }
    }
}

/// Weights of one component (0 is x) of a point over the full coordinates, for [`Output::displacement`] and
/// [`Output::velocity`].
///
/// # Errors
/// The place is not of this model.
///
/// # Panics
/// When the axis is not one of the space's.
#[track_caller]
pub fn point_weights<const D: usize>(
    model: &Model<D>,
    place: impl Into<Place<D>>,
    axis: usize,
) -> Result<Vec<(usize, f64)>, PlaceError> {
    assert!(axis < D, "axis {axis} of {D}-dimensional space");
    let form = model.form(place)?;
    Ok(form.terms().iter().map(|&(node, w)| (node * D + axis, w)).collect())
}
