//! The structure's forces as polynomials.
//!
//! ```text
//! V = Σ_j ½ κ_j (d_j - μ_j)² - Σ f·P,   ∂V/∂y = Σ_j ½ κ_j (1 - μ_j u_j) ∂g_j/∂y - ∂(Σ f·P)/∂y,   g = d², u = 1/d
//! ```

use tg_homotopy::Polynomial;
use tg_model::{At, Mechanics, Model, Tensioned};

use crate::error::EquilibriaError;
use crate::unknowns::Unknowns;

/// How far the coordinates are moved, per size of the structure, to see whether a load changes.
const MOVED: f64 = 0.1;
/// Changes of a load below this part of the largest force are rounding.
const UNCHANGED: f64 = 1e-8;

/// A cable that acts on the structure.
pub(crate) struct Spring {
    /// Its number among the cables.
    pub(crate) cable: usize,
    /// κ \[N/m\].
    pub(crate) stiffness: f64,
    /// Squared length.
    pub(crate) square: Polynomial,
}

/// Cables that act and constant forces.
pub(crate) struct Potential {
    pub(crate) springs: Vec<Spring>,
    /// Cables between points at a constant distance: they do nothing.
    pub(crate) idle: Vec<usize>,
    /// Work of weights, per squared unit of length.
    pub(crate) work: Polynomial,
    /// Work of the load components that are not zero, with the input of each, per unit.
    pub(crate) loads: Vec<(usize, Polynomial)>,
}

impl Potential {
    pub(crate) fn new<const D: usize>(
        model: &Model<D>,
        unknowns: &Unknowns<D>,
        u: &[f64],
    ) -> Result<Self, EquilibriaError> {
        let (mut springs, mut idle) = (Vec::new(), Vec::new());
        for (cable, id) in model.cables().enumerate() {
            let stiffness = model.linear_stiffness(cable).ok_or_else(|| EquilibriaError::NotAlgebraic {
                what: format!("the law of cable \"{}\"", model.cable_name(id)),
            })?;
            let square = unknowns.square_length(&unknowns.point(model.cable_form(id).terms()));
            if square.degree() > 0 {
                springs.push(Spring { cable, stiffness, square });
            } else {
                idle.push(cable);
            }
        }
        check_constant(model, u)?;
        let q = model.initial_coordinates();
        let mut inputs = u.to_vec();
        inputs[model.cable_count()..].fill(0.0);
        let weights = force_without_cables(model, &q, &inputs);
        let per_unit: Vec<f64> = weights.iter().map(|f| f / unknowns.unit).collect();
        let mut loads = Vec::new();
        for input in (model.cable_count()..u.len()).filter(|&input| u[input] != 0.0) {
            inputs[input] = 1.0;
            let with = force_without_cables(model, &q, &inputs);
            inputs[input] = 0.0;
            let force: Vec<f64> = with.iter().zip(&weights).map(|(a, b)| a - b).collect();
            loads.push((input, unknowns.work(&force)));
        }
        Ok(Self { springs, idle, work: unknowns.work(&per_unit), loads })
    }
}

/// Whether what is left of the force without the cables is the same everywhere.
fn check_constant<const D: usize>(model: &Model<D>, u: &[f64]) -> Result<(), EquilibriaError> {
    let q = model.initial_coordinates();
    let step = MOVED * model.size();
    let moved: Vec<f64> = q.iter().enumerate().map(|(i, x)| x + step * (1.0 + i as f64).sin()).collect();
    let (force, elsewhere) = (force_without_cables(model, &q, u), force_without_cables(model, &moved, u));
    let rest = vec![0.0; q.len()];
    let scale = |q: &[f64]| model.force_scale(At { q, v: &rest, u, taut: None });
    let size = scale(&q).max(scale(&moved));
    match model.free().iter().find(|&&i| (force[i] - elsewhere[i]).abs() > UNCHANGED * size) {
        None => Ok(()),
        Some(&i) => Err(EquilibriaError::NotAlgebraic {
            what: format!("a load that depends on the configuration, at the {}", model.coordinate_name(i)),
        }),
    }
}

fn force_without_cables<const D: usize>(model: &Model<D>, q: &[f64], u: &[f64]) -> Vec<f64> {
    let rest = vec![0.0; q.len()];
    let mut force = rest.clone();
    model.force(At { q, v: &rest, u, taut: None }, &mut force);
    let mut lengths = vec![0.0; model.cable_count()];
    let mut gradients = vec![0.0; model.length_pattern().len()];
    model.lengths(q, &mut lengths, &mut gradients);
    for (&(cable, i), gradient) in model.length_pattern().iter().zip(&gradients) {
        force[i] += model.static_tension(cable, lengths[cable], u[cable]) * gradient;
    }
    force
}
