//! Affine functions of variables, and linear relations solved for as many variables as there are.
//!
//! ```text
//! Σ_k a_rk X_k + b_r = 0   ⇒   X = c + C y,   y some of the X themselves
//! ```

use tg_homotopy::Complex64;

/// Entries below this part of a row's largest are rounding.
const ZERO: f64 = 1e-12;
/// Constants above this in a row without variables contradict each other.
const CONTRADICTION: f64 = 1e-9;

const NOTHING: Complex64 = Complex64::new(0.0, 0.0);
const ONE: Complex64 = Complex64::new(1.0, 0.0);

/// Σ_k a_k X_k + b: an affine function of variables, or the relation that it is zero.
#[derive(Clone, Debug)]
pub(crate) struct Form {
    pub(crate) constant: Complex64,
    pub(crate) terms: Vec<(usize, Complex64)>,
}

impl Form {
    pub(crate) fn constant(constant: impl Into<Complex64>) -> Self {
        Self { constant: constant.into(), terms: Vec::new() }
    }

    pub(crate) fn variable(k: usize) -> Self {
        Self { constant: NOTHING, terms: vec![(k, ONE)] }
    }

    pub(crate) fn add(&mut self, other: &Self, factor: impl Into<Complex64>) {
        let factor = factor.into();
        self.constant += factor * other.constant;
        self.terms.extend(other.terms.iter().map(|&(k, c)| (k, factor * c)));
    }

    /// The sum of `parts` with factors.
    pub(crate) fn sum<'a>(parts: impl IntoIterator<Item = (&'a Self, Complex64)>) -> Self {
        let mut sum = Self::constant(NOTHING);
        parts.into_iter().for_each(|(part, factor)| sum.add(part, factor));
        sum
    }
}

/// Why relations have no such solution.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Obstacle {
    /// They contradict each other.
    Contradiction,
    /// One is left between variables that may not be eliminated; this is one of them.
    Left(usize),
}

/// Every variable as an affine function of the independent ones.
#[derive(Clone, Debug, Default)]
pub(crate) struct Affine {
    /// Independent variables, ascending.
    pub(crate) independent: Vec<usize>,
    /// For each variable its constant and (position in `independent`, coefficient).
    pub(crate) values: Vec<(Complex64, Vec<(usize, Complex64)>)>,
}

impl Affine {
    /// Eliminates variables in the given order of preference: those that come first are expressed by the others, those
    /// that are not in it stay independent.
    pub(crate) fn solve(
        variables: usize,
        relations: &[Form],
        preference: impl Iterator<Item = usize>,
    ) -> Result<Self, Obstacle> {
        let mut rows = scaled_rows(variables, relations);
        let mut row_of = vec![None; variables];
        let mut next = 0;
        for column in preference {
            let best =
                (next..rows.len()).max_by(|&a, &b| rows[a][column].norm().total_cmp(&rows[b][column].norm()));
            let Some(best) = best.filter(|&r| rows[r][column].norm() > ZERO) else { continue };
            rows.swap(next, best);
            let pivot = rows[next][column];
            rows[next].iter_mut().for_each(|x| *x /= pivot);
            let pivot_row = rows[next].clone();
            for (r, row) in rows.iter_mut().enumerate() {
                let share = row[column];
                if r != next && share != NOTHING {
                    row.iter_mut().zip(&pivot_row).for_each(|(x, p)| *x -= share * p);
                    row[column] = NOTHING;
                }
            }
            row_of[column] = Some(next);
            next += 1;
        }
        for row in &rows[next..] {
            if let Some(k) = (0..variables).find(|&k| row[k].norm() > CONTRADICTION) {
                return Err(Obstacle::Left(k));
            }
            if row[variables].norm() > CONTRADICTION {
                return Err(Obstacle::Contradiction);
            }
        }
        let independent: Vec<usize> = (0..variables).filter(|&k| row_of[k].is_none()).collect();
        let value = |k: usize| match row_of[k] {
            None => {
                let at = independent.iter().position(|&i| i == k).unwrap_or(0);
                (NOTHING, vec![(at, ONE)])
            }
            Some(row) => {
                let terms = independent.iter().enumerate().map(|(at, &i)| (at, -rows[row][i]));
                (-rows[row][variables], terms.filter(|(_, c)| c.norm() > ZERO).collect())
            }
        };
        Ok(Self { values: (0..variables).map(value).collect(), independent })
    }
}

/// Dense rows [a_r, b_r] with largest |a_rk| = 1.
fn scaled_rows(variables: usize, relations: &[Form]) -> Vec<Vec<Complex64>> {
    let dense = |relation: &Form| {
        let mut row = vec![NOTHING; variables + 1];
        relation.terms.iter().for_each(|&(k, a)| row[k] += a);
        row[variables] = relation.constant;
        let largest = row[..variables].iter().fold(f64::MIN_POSITIVE, |a, x| a.max(x.norm()));
        row.iter_mut().for_each(|x| *x /= largest);
        row
    };
    relations.iter().map(dense).collect()
}
