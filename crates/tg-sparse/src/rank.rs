//! Redundant constraints: rows of `A` that depend on other rows.
//!
//! With the rows normalised to length one, `[I, −Aᵀ; A, 0]` is eliminated in the static order. The pivot of multiplier j
//! is then `a_j (I − P) a_jᵀ`, where P projects on the span of the rows eliminated before: the squared sine of the angle
//! between row j and that span. A row whose pivot is small is taken out, and elimination goes on as if it were not
//! there. For each row taken out, one solve with the kept rows,
//!
//! ```text
//! x − A_Kᵀ c = a_jᵀ,   A_K x = 0   ⇒   x = a_jᵀ + A_Kᵀ c,   x ⟂ rows of A_K,
//! ```
//!
//! gives the part x of row j outside of the span and the combination −c of rows that row j is. It runs over the subtree
//! of j in the elimination tree only, so that local redundancies cost local work.

use crate::error::{EntryList, Row, SparseError};
use crate::pattern::SaddlePattern;
use crate::span::{Outside, Span};

/// Rows with a smaller sine are taken out of the elimination and measured by a solve. The pivot is the sine's square, so
/// its rounding error (some ε times the number of rows in the longest circuit of redundant constraints, 1e-12 at ten
/// thousand) hides sines up to 1e-6.
const SINE_MEASURED: f64 = 1e-5;

/// Coefficients below this, with rows of length one, are rounding errors.
const COEFFICIENT_FLOOR: f64 = 1e-9;

/// A redundant constraint.
#[derive(Clone, Debug, PartialEq)]
pub struct DependentRow {
    /// Index of the row of `A`.
    pub row: usize,
    /// Sine of the angle between the row and the span of the independent rows, ≥ 0. Accurate to about `ε κ`, κ the
    /// condition number of the independent rows.
    pub sine: f64,
    /// The rows and coefficients that it is the combination of, `a_row ≈ Σ coefficient · a_k`, by ascending index. All
    /// of them are independent rows. Empty for a row of zeros.
    pub combination: Vec<(usize, f64)>,
}

/// Rows of `A` that depend on others to within `tolerance`, the sine of the angle between a row and the span of the
/// independent rows. Which row of a dependent set is reported follows from the elimination order: the one eliminated
/// last, the same in every run.
///
/// `jacobian` holds entries (constraint, unknown) and `values` their values; entries may repeat (summed) or be `None`
/// (skipped). A row without entries, or of zeros, depends on nothing: its sine is zero and its combination empty.
///
/// Time and memory are those of one factorisation, plus for each dependent row a solve in its part of the structure. No
/// dense matrix is formed. Tolerances down to about 1e-12 can be told apart on well-conditioned rows: sines above 1e-5
/// come from the factorisation, smaller ones from the refined solves.
///
/// # Errors
/// Those of [`SaddlePattern::new`], and [`SparseError::NonFiniteMatrix`].
///
/// # Panics
/// When `values` and `jacobian` differ in length.
#[track_caller]
pub fn dependent_rows(
    n: usize,
    m: usize,
    jacobian: &[Option<(usize, usize)>],
    values: &[f64],
    tolerance: f64,
) -> Result<Vec<DependentRow>, SparseError> {
    assert_eq!(values.len(), jacobian.len(), "values of the Jacobian");
    let rows = NormalRows::new(n, m, jacobian, values)?;
    let mut found: Vec<DependentRow> =
        rows.zero.iter().map(|&row| DependentRow { row, sine: 0.0, combination: Vec::new() }).collect();

    let identity: Vec<_> = (0..n).map(|i| Some((i, i))).collect();
    let pattern = SaddlePattern::new(n, rows.index.len(), &[&identity], &rows.entries)?;
    let mut matrix = vec![0.0; pattern.entries() + 1];
    let slots = &pattern.slots;
    slots.leading_slots.iter().for_each(|&slot| matrix[slot as usize] = 1.0);
    for ((&upper, &lower), &value) in slots.upper.iter().zip(&slots.lower).zip(&rows.values) {
        matrix[upper as usize] = -value;
        matrix[lower as usize] = value;
    }
    let measured = if tolerance > SINE_MEASURED { tolerance.min(0.5) } else { SINE_MEASURED };
    let mut span = Span::new(&pattern, &matrix);
    span.factor(measured * measured).map_err(|row| SparseError::Singular { row: rows.original(row) })?;
    let mut kept: Vec<Outside> = Vec::new();
    for position in span.dropped() {
        let mut outside = span.outside(position);
        for other in &kept {
            outside.remove(other);
        }
        let sine = outside.part.iter().map(|(_, x)| x * x).sum::<f64>().sqrt();
        if sine > tolerance {
            kept.push(outside);
            continue;
        }
        let norm = rows.norm[outside.row];
        let mut combination: Vec<(usize, f64)> = outside
            .combination
            .iter()
            .filter(|(_, c)| c.abs() > COEFFICIENT_FLOOR)
            .map(|&(k, c)| (rows.index[k], c * norm / rows.norm[k]))
            .collect();
        combination.sort_unstable_by_key(|&(k, _)| k);
        found.push(DependentRow { row: rows.index[outside.row], sine, combination });
    }
    found.sort_by_key(|dependent| dependent.row);
    Ok(found)
}

/// The rows that are not zero, normalised.
struct NormalRows {
    /// Rows of zeros.
    zero: Vec<usize>,
    /// Original index of each row here.
    index: Vec<usize>,
    /// Original length of each row here.
    norm: Vec<f64>,
    entries: Vec<Option<(usize, usize)>>,
    values: Vec<f64>,
}

impl NormalRows {
    fn new(
        n: usize,
        m: usize,
        jacobian: &[Option<(usize, usize)>],
        values: &[f64],
    ) -> Result<Self, SparseError> {
        let mut triplets = Vec::with_capacity(jacobian.len());
        for (entry, (&place, &value)) in jacobian.iter().zip(values).enumerate() {
            let Some((row, column)) = place else { continue };
            if row >= m || column >= n {
                let list = EntryList::Jacobian;
                return Err(SparseError::EntryOutside { list, entry, row, column, rows: m, columns: n });
            }
            if !value.is_finite() {
                return Err(SparseError::NonFiniteMatrix { row: Row::Multiplier(row) });
            }
            triplets.push((row, column, value));
        }
        triplets.sort_by_key(|&(row, column, _)| (row, column));
        triplets.dedup_by(|next, first| {
            let same = (next.0, next.1) == (first.0, first.1);
            if same {
                first.2 += next.2;
            }
            same
        });
        // Scaled by the largest entry first: squares of tiny entries would vanish.
        let mut largest = vec![0.0_f64; m];
        for &(row, _, value) in &triplets {
            largest[row] = largest[row].max(value.abs());
        }
        let mut square = vec![0.0_f64; m];
        for &(row, _, value) in triplets.iter().filter(|&&(row, ..)| largest[row] > 0.0) {
            square[row] += (value / largest[row]).powi(2);
        }
        let (index, zero): (Vec<usize>, Vec<usize>) = (0..m).partition(|&row| largest[row] > 0.0);
        let mut compact = vec![0; m];
        index.iter().enumerate().for_each(|(at, &row)| compact[row] = at);
        triplets.retain(|&(row, _, value)| largest[row] > 0.0 && value != 0.0);
        Ok(Self {
            entries: triplets.iter().map(|&(row, column, _)| Some((compact[row], column))).collect(),
            values: triplets
                .iter()
                .map(|&(row, _, value)| value / largest[row] / square[row].sqrt())
                .collect(),
            norm: index.iter().map(|&row| largest[row] * square[row].sqrt()).collect(),
            index,
            zero,
        })
    }

    fn original(&self, row: Row) -> Row {
        match row {
            Row::Multiplier(j) => Row::Multiplier(self.index[j]),
            Row::Unknown(i) => Row::Unknown(i),
        }
    }
}
