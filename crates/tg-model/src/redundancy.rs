//! Redundant constraints: rows of A that are combinations of others in the initial configuration.

use tg_sparse::dependent_rows;

use crate::assemble::Named;
use crate::constraints::Constraints;
use crate::error::BuildError;
use crate::report::Redundancy;

/// Sine of the angle between a constraint's gradient and the span of the others below which it counts as dependent.
/// Rounding of coordinates leaves 1e-15; a mechanism that is nearly in a singular pose, but still moves as it should,
/// has more than 1e-6.
pub(crate) const TOLERANCE: f64 = 1e-8;

/// Coefficients of a combination below this part of the largest are rounding.
const NEGLIGIBLE: f64 = 1e-6;

pub(crate) struct Found {
    /// Rows, ascending.
    pub(crate) rows: Vec<usize>,
    pub(crate) named: Vec<Redundancy>,
}

pub(crate) fn find<const D: usize>(
    list: &[Named<D>],
    free: &[usize],
    q: &[f64],
) -> Result<Found, BuildError> {
    let mut reduced = vec![None; q.len()];
    for (k, &i) in free.iter().enumerate() {
        reduced[i] = Some(k);
    }
    let constraints: Vec<_> = list.iter().map(|named| named.constraint.clone()).collect();
    let flat = Constraints::new(&constraints);
    let pattern: Vec<_> = flat
        .jacobian_pattern::<D>()
        .into_iter()
        .map(|(row, coordinate)| reduced[coordinate].map(|k| (row, k)))
        .collect();
    let mut values = vec![0.0; pattern.len()];
    flat.jacobian::<D>(q, &mut values);
    let mut dependent = dependent_rows(free.len(), list.len(), &pattern, &values, TOLERANCE)?;
    dependent.sort_by_key(|row| row.row);
    let named = dependent
        .iter()
        .map(|row| {
            let largest = row.combination.iter().map(|(_, c)| c.abs()).fold(0.0, f64::max);
            let terms = row.combination.iter().filter(|(_, c)| c.abs() > NEGLIGIBLE * largest);
            Redundancy {
                constraint: list[row.row].name.clone(),
                implied_by: terms.map(|&(i, _)| list[i].name.clone()).collect(),
                sine: row.sine,
            }
        })
        .collect();
    Ok(Found { rows: dependent.iter().map(|row| row.row).collect(), named })
}
