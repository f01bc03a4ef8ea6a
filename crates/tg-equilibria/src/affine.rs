//! Linear relations between the variables of a form, solved for as many of them as there are.
//!
//! ```text
//! Σ_k a_rk X_k + b_r = 0   ⇒   X = c + C y,   y some of the X themselves
//! ```

use tg_homotopy::Complex64;

/// Entries below this part of a row's largest are rounding.
const ZERO: f64 = 1e-12;

/// One linear relation: (variable, coefficient), constant.
#[derive(Clone, Debug)]
pub(crate) struct Relation {
    pub(crate) terms: Vec<(usize, Complex64)>,
    pub(crate) constant: Complex64,
}

/// Every variable as an affine function of the independent ones.
#[derive(Clone, Debug)]
pub(crate) struct Affine {
    /// Independent variables, ascending.
    pub(crate) independent: Vec<usize>,
    /// For each variable its constant and (position in `independent`, coefficient).
    pub(crate) values: Vec<(Complex64, Vec<(usize, Complex64)>)>,
}

impl Affine {
    /// Eliminates variables in the given order of preference: those that come first are expressed by the others. `None`
    /// where the relations contradict each other.
    pub(crate) fn solve(variables: usize, relations: &[Relation], preference: &[usize]) -> Option<Self> {
        let zero = Complex64::new(0.0, 0.0);
        let mut rows: Vec<Vec<Complex64>> = relations
            .iter()
            .map(|relation| {
                let mut row = vec![zero; variables + 1];
                relation.terms.iter().for_each(|&(k, a)| row[k] += a);
                row[variables] = relation.constant;
                row
            })
            .collect();
        let size = |row: &[Complex64]| row.iter().fold(0.0_f64, |a, x| a.max(x.norm()));
        let scales: Vec<f64> =
            rows.iter().map(|row| size(&row[..variables]).max(f64::MIN_POSITIVE)).collect();
        for (row, scale) in rows.iter_mut().zip(scales) {
            row.iter_mut().for_each(|x| *x /= scale);
        }
        let mut pivots: Vec<(usize, usize)> = Vec::new();
        let mut next = 0;
        for &column in preference {
            let best =
                (next..rows.len()).max_by(|&a, &b| rows[a][column].norm().total_cmp(&rows[b][column].norm()));
            let Some(best) = best.filter(|&r| rows[r][column].norm() > ZERO) else { continue };
            rows.swap(next, best);
            let pivot = rows[next][column];
            rows[next].iter_mut().for_each(|x| *x /= pivot);
            let pivot_row = rows[next].clone();
            for (r, row) in rows.iter_mut().enumerate() {
                let share = row[column];
                if r != next && share != zero {
                    row.iter_mut().zip(&pivot_row).for_each(|(x, p)| *x -= share * p);
                    row[column] = zero;
                }
            }
            pivots.push((next, column));
            next += 1;
        }
        if rows[next..].iter().any(|row| row[variables].norm() > 1e-9) {
            return None;
        }
        let mut row_of = vec![None; variables];
        pivots.iter().for_each(|&(row, column)| row_of[column] = Some(row));
        let independent: Vec<usize> = (0..variables).filter(|&k| row_of[k].is_none()).collect();
        let value = |k: usize| match row_of[k] {
            None => {
                let at = independent.iter().position(|&i| i == k).unwrap_or(0);
                (zero, vec![(at, Complex64::new(1.0, 0.0))])
            }
            Some(row) => {
                let terms = independent.iter().enumerate().map(|(at, &i)| (at, -rows[row][i]));
                (-rows[row][variables], terms.filter(|(_, c)| c.norm() > ZERO).collect())
            }
        };
        Some(Self { values: (0..variables).map(value).collect(), independent })
    }
}
