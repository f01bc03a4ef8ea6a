//! Map from entry lists to matrix slots: values in the caller's fixed order are added straight to where the compressed
//! rows hold them, without a search and without an allocation.
//!
//! The compressed rows hold `K = [H, −A₀ᵀ; A₁, 0]` in elimination order: the residual runs through memory in one
//! direction. One slot more than there are entries, the last, receives the values of `None` entries.

use crate::order::Rows;

/// Compressed rows of `K` and the slot of every entry of the caller's lists.
#[derive(Clone, Debug, Default)]
pub(crate) struct SlotMap {
    /// Compressed rows in elimination order.
    pub(crate) rows: Rows,
    /// For each leading group, the slot of each of its entries.
    pub(crate) leading: Vec<Vec<u32>>,
    /// Slot of each Jacobian entry in the block `−A₀ᵀ`.
    pub(crate) upper: Vec<u32>,
    /// Slot of each Jacobian entry in the block `A₁`.
    pub(crate) lower: Vec<u32>,
    /// All slots of `H`.
    pub(crate) leading_slots: Vec<u32>,
    /// True when an entry of `A` repeats, so that its slots must be cleared before values are added.
    pub(crate) jacobian_repeats: bool,
}

impl SlotMap {
    /// `rows`: pattern in elimination order; `position`: variable → position, multipliers from `n` on.
    pub(crate) fn new(
        n: usize,
        rows: Rows,
        position: &[u32],
        leading: &[&[Option<(usize, usize)>]],
        jacobian: &[Option<(usize, usize)>],
    ) -> Self {
        let none = rows.column().len() as u32;
        let slot = |row: usize, column: usize| {
            let row = position[row] as usize;
            let at = rows.row(row).partition_point(|&c| c < position[column]);
            (rows.start()[row] + at) as u32
        };
        let map = |list: &[Option<(usize, usize)>], find: &dyn Fn(usize, usize) -> u32| -> Vec<u32> {
            list.iter().map(|entry| entry.map_or(none, |(row, column)| find(row, column))).collect()
        };
        let leading: Vec<Vec<u32>> = leading.iter().map(|group| map(group, &slot)).collect();
        let upper = map(jacobian, &|j, i| slot(i, n + j));
        let lower = map(jacobian, &|j, i| slot(n + j, i));
        let mut is_marked = vec![false; rows.column().len() + 1];
        leading.iter().flatten().for_each(|&slot| is_marked[slot as usize] = true);
        let leading_slots = (0..none).filter(|&slot| is_marked[slot as usize]).collect();
        is_marked.fill(false);
        let jacobian_repeats =
            upper.iter().any(|&slot| slot != none && std::mem::replace(&mut is_marked[slot as usize], true));
        Self { leading, upper, lower, leading_slots, jacobian_repeats, rows }
    }

    /// Entries of `K`, the slot of `None` not counted.
    pub(crate) fn entries(&self) -> usize {
        self.rows.column().len()
    }

    /// `(K x)_i` and `(|K| |x|)_i` for each row in elimination order.
    pub(crate) fn products<'a>(
        &'a self,
        values: &'a [f64],
        x: &'a [f64],
    ) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.rows.start().windows(2).map(move |bounds| {
            let columns = &self.rows.column()[bounds[0]..bounds[1]];
            let terms = columns.iter().zip(&values[bounds[0]..bounds[1]]).map(|(&c, &v)| v * x[c as usize]);
            terms.fold((0.0, 0.0), |(sum, magnitude), term: f64| (sum + term, magnitude + term.abs()))
        })
    }

    /// Diagonal value of a row, zero where there is none.
    pub(crate) fn diagonal(&self, values: &[f64], row: usize) -> f64 {
        let columns = self.rows.row(row);
        let at = columns.partition_point(|&c| (c as usize) < row);
        match columns.get(at) {
            Some(&c) if c as usize == row => values[self.rows.start()[row] + at],
            _ => 0.0,
        }
    }

    /// The row of the first value that is not finite.
    pub(crate) fn non_finite_row(&self, values: &[f64]) -> Option<usize> {
        let slot = values[..self.entries()].iter().position(|v| !v.is_finite())?;
        Some(self.rows.start().partition_point(|&start| start <= slot) - 1)
    }
}
