//! The size of a structure: what displacements are held against.

use tg_model::{Mechanics, Tensioned};

/// Largest length of a cable or member: the size of a structure wherever it stands.
pub(crate) fn size(structure: &dyn Tensioned, q: &[f64]) -> f64 {
    let (mut lengths, mut gradients) =
        (vec![0.0; structure.cable_count()], vec![0.0; structure.length_pattern().len()]);
    structure.lengths(q, &mut lengths, &mut gradients);
    lengths.into_iter().fold(members(structure.mechanics()), f64::max)
}

/// Largest length of a member. The size of a constraint is a squared length where Φ is a dot product, else a length.
pub(crate) fn members(mechanics: &dyn Mechanics) -> f64 {
    let mut is_square = vec![false; mechanics.sizes().constraints];
    mechanics.constraint_hessian().iter().for_each(|e| is_square[e.constraint] = true);
    let scales = mechanics.constraint_scales().iter().zip(is_square);
    scales.map(|(&scale, square)| if square { scale.sqrt() } else { scale }).fold(0.0, f64::max)
}
