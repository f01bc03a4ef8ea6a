//! A gauge for rigid motions: coordinates that are held while everything else settles.
//!
//! As many coordinates as there are rigid motions without work, chosen so that holding them stops those motions: each
//! next one is where the remaining motion is largest (Gaussian elimination with complete pivoting).

use tg_model::Tensioned;
use tg_tangent::TangentError;

use crate::rigid::RigidMotions;

/// Positions, among the free coordinates, of the held ones.
pub(crate) fn held_coordinates(
    structure: &dyn Tensioned,
    q: &[f64],
    u: &[f64],
) -> Result<Vec<usize>, TangentError> {
    let motions = RigidMotions::free(structure, q)?.without_work(structure, q, u)?;
    let free = structure.mechanics().free();
    let mut fields: Vec<Vec<f64>> = motions
        .fields(structure, q)
        .into_iter()
        .map(|field| free.iter().map(|&i| field[i]).collect())
        .collect();
    let mut held = Vec::new();
    for k in 0..motions.count() {
        let places = (k..fields.len()).flat_map(|f| (0..free.len()).map(move |i| (f, i)));
        let Some((f, i)) =
            places.max_by(|&(f, i), &(g, j)| fields[f][i].abs().total_cmp(&fields[g][j].abs()))
        else {
            break;
        };
        fields.swap(k, f);
        let pivot = fields[k].clone();
        for field in &mut fields[k + 1..] {
            let share = field[i] / pivot[i];
            field.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= share * p);
        }
        held.push(i);
    }
    Ok(held)
}
