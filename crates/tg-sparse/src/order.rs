//! Static elimination order of the saddle-point matrix.
//!
//! Approximate minimum degree (Amestoy, Davis, Duff 1996) on the graph of the unknowns, `H + AᵀA`: unknowns that share
//! a constraint are neighbours. Then each multiplier comes right after the last of its unknowns. With this order every
//! leading principal submatrix has the form `[H_k, −A_kᵀ; A_k, 0]`, where `A_k` holds complete rows of `A`. It is
//! regular when `H` is definite and `A` has full row rank, so elimination needs no pivoting: the pivots are those of
//! `H` and of `A H⁻¹ Aᵀ`. (Minimum degree on the indefinite matrix puts multipliers first, whose pivots are zero.)

use crate::error::SparseError;

/// A constraint with more unknowns than this enters the graph as a path through its unknowns instead of all pairs. That
/// only makes the order a little worse; all pairs would take quadratic memory.
const LONGEST_CLIQUE: usize = 128;

/// Rows of a pattern, sorted and without repetition.
#[derive(Clone, Debug, Default)]
pub(crate) struct Rows {
    start: Vec<usize>,
    column: Vec<u32>,
}

impl Rows {
    /// From (row, column) pairs that are sorted and distinct.
    #[cfg(test)]
    pub(crate) fn from_sorted(rows: usize, pairs: &[(u32, u32)]) -> Self {
        let mut start = vec![0; rows + 1];
        for &(row, _) in pairs {
            start[row as usize + 1] += 1;
        }
        for row in 0..rows {
            start[row + 1] += start[row];
        }
        Self { start, column: pairs.iter().map(|&(_, column)| column).collect() }
    }

    /// From (row, column) pairs in any order, which may repeat: counting sort by column, then by row.
    pub(crate) fn from_pairs(rows: usize, columns: usize, pairs: &[(u32, u32)]) -> Self {
        let mut start = vec![0; columns + 1];
        pairs.iter().for_each(|&(_, column)| start[column as usize + 1] += 1);
        (0..columns).for_each(|column| start[column + 1] += start[column]);
        let mut by_column = vec![0; pairs.len()];
        for &(row, column) in pairs {
            by_column[start[column as usize]] = row;
            start[column as usize] += 1;
        }
        // `start` now holds where each column ends.
        let visit = |each: &mut dyn FnMut(usize, u32)| {
            let mut seen_in = vec![u32::MAX; rows];
            let mut from = 0;
            for (column, &end) in start[..columns].iter().enumerate() {
                for &row in &by_column[from..end] {
                    let seen_in = &mut seen_in[row as usize];
                    if *seen_in != column as u32 {
                        *seen_in = column as u32;
                        each(row as usize, column as u32);
                    }
                }
                from = end;
            }
        };
        let mut row_start = vec![0; rows + 1];
        visit(&mut |row, _| row_start[row + 1] += 1);
        (0..rows).for_each(|row| row_start[row + 1] += row_start[row]);
        let (mut next, mut sorted) = (row_start.clone(), vec![0; row_start[rows]]);
        visit(&mut |row, column| {
            sorted[next[row]] = column;
            next[row] += 1;
        });
        Self { start: row_start, column: sorted }
    }

    pub(crate) fn row(&self, row: usize) -> &[u32] {
        &self.column[self.start[row]..self.start[row + 1]]
    }

    pub(crate) fn start(&self) -> &[usize] {
        &self.start
    }

    pub(crate) fn column(&self) -> &[u32] {
        &self.column
    }

    pub(crate) fn len(&self) -> usize {
        self.start.len() - 1
    }
}

/// Elimination order: position → variable, where variables 0..n are unknowns and n..n+m multipliers.
///
/// `leading` is the symmetric pattern of `H`, `jacobian` that of `A`, where no row is empty.
pub(crate) fn elimination_order(leading: &Rows, jacobian: &Rows) -> Result<Vec<u32>, SparseError> {
    let n = leading.len();
    let order = order_unknowns(leading, jacobian)?;
    let mut position = vec![0_u32; n];
    for (at, &unknown) in order.iter().enumerate() {
        position[unknown as usize] = at as u32;
    }
    // Multipliers by the position of their last unknown; among equals by index (the sort is stable).
    let mut multipliers: Vec<(u32, u32)> = (0..jacobian.len())
        .filter_map(|j| {
            let last = jacobian.row(j).iter().map(|&i| position[i as usize]).max()?;
            Some((last, j as u32))
        })
        .collect();
    multipliers.sort_by_key(|&(last, _)| last);
    let mut waiting = multipliers.into_iter().peekable();
    let mut result = Vec::with_capacity(n + jacobian.len());
    for (at, &unknown) in order.iter().enumerate() {
        result.push(unknown);
        while let Some((_, j)) = waiting.next_if(|&(last, _)| last as usize == at) {
            result.push(n as u32 + j);
        }
    }
    Ok(result)
}

fn order_unknowns(leading: &Rows, jacobian: &Rows) -> Result<Vec<u32>, SparseError> {
    let n = leading.len();
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    for j in 0..jacobian.len() {
        let row = jacobian.row(j);
        if row.len() <= LONGEST_CLIQUE {
            for (at, &a) in row.iter().enumerate() {
                pairs.extend(row[at + 1..].iter().map(|&b| (a, b)));
            }
        } else {
            pairs.extend(row.windows(2).map(|pair| (pair[0], pair[1])));
        }
    }
    for i in 0..n {
        pairs.extend(leading.row(i).iter().filter(|&&c| c as usize > i).map(|&c| (i as u32, c)));
    }
    // The diagonal does not matter to the order, but amd's own debug assertion counts on it.
    pairs.extend((0..n as u32).map(|i| (i, i)));
    // The upper triangle is enough: the ordering works on the sum of its argument and the transpose.
    let graph = Rows::from_pairs(n, n, &pairs);
    drop(pairs);
    let start: Vec<i64> = graph.start().iter().map(|&s| s as i64).collect();
    let index: Vec<i64> = graph.column().iter().map(|&c| i64::from(c)).collect();
    let (order, _, _) = amd::order(n as i64, &start, &index, &amd::Control::default())
        .map_err(|_| SparseError::Ordering { unknowns: n })?;
    Ok(order.into_iter().map(|i| i as u32).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_multiplier_follows_its_last_unknown() -> Result<(), SparseError> {
        let leading = Rows::from_sorted(4, &[(0, 0), (0, 1), (1, 0), (1, 1), (2, 2), (3, 3)]);
        let jacobian = Rows::from_sorted(2, &[(0, 2), (0, 3), (1, 1)]);
        let order = elimination_order(&leading, &jacobian)?;
        let at = |variable: u32| order.iter().position(|&v| v == variable);
        assert_eq!(order.len(), 6);
        assert_eq!(at(4), at(2).max(at(3)).map(|last| last + 1));
        assert_eq!(at(5), at(1).map(|last| last + 1));
        Ok(())
    }

    #[test]
    fn pairs_come_out_sorted_and_distinct() {
        let rows = Rows::from_pairs(3, 4, &[(2, 3), (0, 1), (2, 0), (0, 1), (2, 3), (0, 0)]);
        assert_eq!((rows.row(0), rows.row(1), rows.row(2)), (&[0, 1][..], &[][..], &[0, 3][..]));
        assert_eq!(Rows::from_pairs(0, 0, &[]).len(), 0);
    }

    #[test]
    fn the_hub_of_a_star_comes_late() -> Result<(), SparseError> {
        let mut pairs: Vec<(u32, u32)> = (1..20).flat_map(|i| [(0, i), (i, 0)]).collect();
        pairs.sort_unstable();
        let order = elimination_order(&Rows::from_sorted(20, &pairs), &Rows::from_sorted(0, &[]))?;
        assert!(order.iter().position(|&v| v == 0) >= Some(18));
        Ok(())
    }
}
