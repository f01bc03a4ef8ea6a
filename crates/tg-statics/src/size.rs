//! The size of a structure: what displacements are held against.

use tg_model::{Mechanics, Tensioned};

/// Largest length of a cable or member: the size of a structure wherever it stands.
pub(crate) fn size(structure: &dyn Tensioned, q: &[f64]) -> f64 {
    let (mut lengths, mut gradients) =
        (vec![0.0; structure.cable_count()], vec![0.0; structure.length_pattern().len()]);
    structure.lengths(q, &mut lengths, &mut gradients);
    lengths.into_iter().fold(members(structure.mechanics()), f64::max)
}

/// Largest length that constraints speak of: of a member where Φ is a dot product, whose size is that length squared; joints
/// let whole members move, as far as the structure is large.
pub(crate) fn members(mechanics: &dyn Mechanics) -> f64 {
    let mut is_square = vec![false; mechanics.sizes().constraints];
    mechanics.constraint_hessian().iter().for_each(|e| is_square[e.constraint] = true);
    let scales = mechanics.constraint_scales().iter().zip(is_square);
    let length = |(scale, square): (&f64, bool)| if square { scale.sqrt() } else { mechanics.size() };
    scales.map(length).fold(0.0, f64::max)
}
