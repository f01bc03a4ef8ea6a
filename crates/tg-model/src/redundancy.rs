//! Redundant constraints: rows of A that are combinations of others in the initial configuration.

use tg_sparse::{Row, SparseError, dependent_rows};

use crate::constraints::{Constraints, Named};
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
    /// By how much each row differs from its combination in residual or rate (scaled): only the gradients over the
    /// free coordinates agree by necessity.
    violations: Vec<f64>,
}

impl Found {
    /// Refuses a row that demands something else than the rows that imply it; points that meet may be apart by
    /// `allowed` \[m\].
    pub(crate) fn check_consistent<const D: usize>(
        &self,
        list: &[Named<D>],
        allowed: f64,
    ) -> Result<(), BuildError> {
        for ((&row, &violation), redundancy) in self.rows.iter().zip(&self.violations).zip(&self.named) {
            if violation > 10.0 * allowed / list[row].constraint.length() {
                return Err(BuildError::ContradictoryConstraint {
                    redundancy: redundancy.clone(),
                    violation,
                });
            }
        }
        Ok(())
    }
}

pub(crate) fn find<const D: usize>(
    list: &[Named<D>],
    free: &[usize],
    q: &[f64],
    v: &[f64],
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
    let mut dependent = dependent_rows(free.len(), list.len(), &pattern, &values, TOLERANCE)
        .map_err(|source| BuildError::Sparse { culprit: culprit(list, &source), source })?;
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
    let (mut residual, mut rate, mut speed) =
        (vec![0.0; list.len()], vec![0.0; list.len()], vec![0.0; list.len()]);
    flat.residual::<D>(q, &mut residual);
    for (&(row, i), a) in flat.jacobian_pattern::<D>().iter().zip(&values) {
        rate[row] += a * v[i];
        speed[row] += (a * v[i]).abs();
    }
    let violations = dependent.iter().map(|row| {
        let differs =
            |x: &[f64]| (x[row.row] - row.combination.iter().map(|&(k, c)| c * x[k]).sum::<f64>()).abs();
        let moving = speed[row.row] + row.combination.iter().map(|&(k, c)| (c * speed[k]).abs()).sum::<f64>();
        let by_rate = if moving > 0.0 { differs(&rate) / moving } else { 0.0 };
        by_rate.max(differs(&residual) / flat.scales()[row.row])
    });
    let violations = violations.collect();
    Ok(Found { rows: dependent.iter().map(|row| row.row).collect(), named, violations })
}

fn culprit<const D: usize>(list: &[Named<D>], error: &SparseError) -> String {
    match error.row() {
        Some(Row::Multiplier(row)) if row < list.len() => list[row].name.clone(),
        _ => "the structure as a whole".into(),
    }
}
