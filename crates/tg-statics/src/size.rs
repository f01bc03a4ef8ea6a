//! The size of a structure: what displacements are held against.

use tg_model::Tensioned;

/// Largest length of a cable or member: the size of a structure wherever it stands.
pub(crate) fn size(structure: &dyn Tensioned, q: &[f64]) -> f64 {
    let (mut lengths, mut gradients) =
        (vec![0.0; structure.cable_count()], vec![0.0; structure.length_pattern().len()]);
    structure.lengths(q, &mut lengths, &mut gradients);
    let members = structure.constraint_scales().iter().map(|s| s.sqrt());
    members.chain(lengths).fold(0.0, f64::max)
}
