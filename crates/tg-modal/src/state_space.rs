//! The linear model of a structure about an equilibrium, for control.
//!
//! ```text
//! δq = Φ ξ + r s,    x = [ξ; ξ̇],    ẋ = A x + B u,    y = C x + D u
//!
//! A = [ 0     I     ]    B = [ 0                                          ]
//!     [-Ω²  -Φᵀ C Φ ]        [ Φᵀ ∂F/∂u | 0 (s)  -Φᵀ C r (ṡ)  -Φᵀ M r (s̈) ]
//! C = [ p Φ   v Φ   ]    D = [ d        | p r     v r          0          ]
//! ```
//! The basis of ξ in (42) is that of the mass-normalised modes, Φ = N Ξ: then 𝓜 = I and 𝓚 = Ω². Nᵀ K r vanishes by the
//! choice of r, so s itself drives nothing.

use tg_model::Mechanics;
use tg_tangent::Configuration;
use tg_tangent::faer::Mat;

use crate::balance::{check_index, check_length};
use crate::channels::{Input, Output};
use crate::directional::{self, Along};
use crate::error::ModalError;
use crate::modal::Modal;
use crate::modes::{Mode, Modes};
use crate::shape::{dot, mass_product};

/// A, B, C, D with the names of inputs and outputs.
#[derive(Clone, Debug)]
pub struct StateSpace {
    /// A, square, twice the number of modes: modal coordinates ξ, then ξ̇. A state follows from a small displacement δq by
    /// `ξ_i = φ_iᵀ M δq`.
    pub a: Mat<f64>,
    /// B, states by columns of inputs.
    pub b: Mat<f64>,
    /// C, outputs by states.
    pub c: Mat<f64>,
    /// D, outputs by columns of inputs.
    pub d: Mat<f64>,
    /// Names of the columns of B and D; a support motion has three: displacement, velocity, acceleration.
    pub inputs: Vec<String>,
    /// Names of the outputs.
    pub outputs: Vec<String>,
}

/// The linear model in the listed modes: exact to first order where they are complete ([`Modes::is_complete`]), otherwise
/// truncated; the quasi-static response of modes left out is then missing from it.
///
/// ```
/// use tg_modal::{Input, ModeOptions, Output, SupportMotion, modes, point_weights, state_space};
/// # use tg_model::{CableLaw, Joining, ModelBuilder};
/// # use tg_tangent::Configuration;
/// # let mut b = ModelBuilder::<2>::new();
/// # let foot = b.anchor("foot", [0.0, 0.0])?;
/// # let mast = b.bar("mast", 1.0, [0.0, 0.0], [0.0, 1.0])?;
/// # b.joint("hinge", &[foot.into(), mast.node(0)], Joining::Share)?;
/// # let mut guys = Vec::new();
/// # for (name, x) in [("left", -1.0), ("right", 1.0)] {
/// #     let peg = b.anchor(name, [x, 0.0])?;
/// #     guys.push(b.cable(name, peg, mast.node(1), CableLaw::slacking(100.0), 1.2)?);
/// # }
/// # let model = b.build()?; // a mast on two guys
/// let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
/// let found = modes(&model, &at, &ModeOptions::all())?;
/// let inputs = [
///     Input::rest_length(&model, 0)?,
///     Input::Ground(SupportMotion::translation(&model, &at, 0)?),
/// ];
/// let outputs = [
///     Output::displacement("top x", &point_weights(&model, mast.node(1), 0)?),
///     Output::tension(&model, guys[0], &at)?,
/// ];
/// let linear = state_space(&model, &at, &found, &inputs, &outputs)?;
/// assert_eq!((linear.a.nrows(), linear.inputs.len(), linear.outputs.len()), (2, 4, 2));
/// assert_eq!(linear.inputs[3], "ground x acceleration");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// An input or coordinate that does not exist, or a derivative that is not finite.
pub fn state_space(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    modes: &Modes,
    inputs: &[Input],
    outputs: &[Output],
) -> Result<StateSpace, ModalError> {
    check(mechanics, at, inputs, outputs)?;
    let modal = Modal::new(mechanics, at, modes)?;
    let k = modes.list.len();
    let names: Vec<String> = inputs.iter().flat_map(Input::names).collect();
    let (mut b, mut d) = (Mat::zeros(2 * k, names.len()), Mat::zeros(outputs.len(), names.len()));
    let mut column = 0;
    for (input, name) in inputs.iter().map(|input| (input, input.names())) {
        match input {
            Input::Parameter { index, .. } => {
                let what = || format!("the force by \"{}\"", name[0]);
                let force = directional::force(mechanics, at, Along::Input(*index), what)?;
                set_force(&mut b, column, &modes.list, 1.0, &force);
                for (row, output) in outputs.iter().enumerate() {
                    d[(row, column)] = output.inputs.iter().filter(|(i, _)| i == index).map(|(_, x)| x).sum();
                }
            }
            Input::Ground(motion) => {
                let r = &motion.influence;
                if mechanics.features().damping {
                    let what = || format!("the force by \"{}\"", name[1]);
                    let force = directional::force(mechanics, at, Along::Velocities(r), what)?;
                    set_force(&mut b, column + 1, &modes.list, 1.0, &force);
                }
                set_force(&mut b, column + 2, &modes.list, -1.0, &mass_product(mechanics, r));
                for (row, output) in outputs.iter().enumerate() {
                    d[(row, column)] = weighted(&output.displacement, r);
                    d[(row, column + 1)] = weighted(&output.velocity, r);
                }
            }
        }
        column += name.len();
    }
    let c = Mat::from_fn(outputs.len(), 2 * k, |row, column| {
        let output = &outputs[row];
        if column < k {
            weighted(&output.displacement, &modes.list[column].shape)
        } else {
            weighted(&output.velocity, &modes.list[column - k].shape)
        }
    });
    let outputs = outputs.iter().map(|output| output.name.clone()).collect();
    Ok(StateSpace { a: modal.first_order(&vec![1.0; k]), b, c, d, inputs: names, outputs })
}

/// The lower half of a column of B: `sign Φᵀ f`. Shapes are zero at prescribed coordinates.
fn set_force(b: &mut Mat<f64>, column: usize, modes: &[Mode], sign: f64, force: &[f64]) {
    for (row, mode) in modes.iter().enumerate() {
        b[(modes.len() + row, column)] = sign * dot(&mode.shape, force);
    }
}

fn weighted(weights: &[(usize, f64)], x: &[f64]) -> f64 {
    weights.iter().map(|&(i, w)| w * x[i]).sum()
}

fn check(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    inputs: &[Input],
    outputs: &[Output],
) -> Result<(), ModalError> {
    let sizes = mechanics.sizes();
    check_length("configuration", &at.q, sizes.coordinates)?;
    for input in inputs {
        match input {
            Input::Parameter { index, .. } => check_index("input", *index, sizes.inputs)?,
            Input::Ground(motion) => {
                check_length("influence vector", &motion.influence, sizes.coordinates)?;
            }
        }
    }
    for output in outputs {
        for (i, _) in output.displacement.iter().chain(&output.velocity) {
            check_index("coordinate", *i, sizes.coordinates)?;
        }
        for (i, _) in &output.inputs {
            check_index("input", *i, sizes.inputs)?;
        }
    }
    Ok(())
}
