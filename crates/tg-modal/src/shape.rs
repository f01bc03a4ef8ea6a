//! Mode shapes: their sign, their products with the mass matrix, and the motions of members that they describe.

use tg_coords::Twist;
use tg_model::{Mechanics, Model};
use tg_tangent::faer::c64;

use crate::balance::check_length;
use crate::error::ModalError;

/// Components within this part of the largest are equal but for rounding, and the first of them decides the sign.
const EQUAL: f64 = 1e-6;

/// Makes the largest component positive.
pub(crate) fn orient(shape: &mut [f64]) {
    if leading(shape.iter().map(|x| x.abs())).is_some_and(|k| shape[k] < 0.0) {
        shape.iter_mut().for_each(|x| *x = -*x);
    }
}

/// Turns the phase so that the largest component is real and positive.
pub(crate) fn orient_complex(shape: &mut [c64]) {
    if let Some(k) = leading(shape.iter().map(|x| x.norm()))
        && shape[k].norm() > 0.0
    {
        let turn = shape[k].conj() / shape[k].norm();
        shape.iter_mut().for_each(|x| *x *= turn);
        shape[k].im = 0.0;
    }
}

fn leading(sizes: impl Iterator<Item = f64> + Clone) -> Option<usize> {
    let largest = sizes.clone().fold(0.0, f64::max);
    sizes.into_iter().position(|size| size >= (1.0 - EQUAL) * largest)
}

/// `M x` over the full coordinates \[kg\] times the unit of x.
pub(crate) fn mass_product(mechanics: &dyn Mechanics, x: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; x.len()];
    for entry in mechanics.mass() {
        product[entry.row] += entry.value * x[entry.col];
    }
    product
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The motion of each member in a shape, in the order of [`Model::members`]: the twist of its local frame, per unit of
/// the modal coordinate.
///
/// `q` are the full coordinates of the equilibrium, `shape` is δq over the full coordinates. A thin bar's spin about its
/// own axis is zero.
///
/// # Errors
/// A wrong length, or coordinates that are degenerate.
pub fn member_twists<const D: usize>(
    model: &Model<D>,
    q: &[f64],
    shape: &[f64],
) -> Result<Vec<Twist<D>>, ModalError> {
    let n = model.mechanics().sizes().coordinates;
    check_length("vector of coordinates", q, n)?;
    check_length("shape", shape, n)?;
    let twist = |member| {
        model
            .twist(member, q, shape)
            .map_err(|source| ModalError::Member { member: model.member_name(member).into(), source })
    };
    model.members().map(twist).collect()
}
