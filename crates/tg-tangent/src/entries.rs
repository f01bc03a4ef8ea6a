//! A sparse matrix over the free coordinates as a list of entries.

use faer::Mat;

/// Entries (row, column, value) of a matrix over the free coordinates, or over constraints and free coordinates; entries
/// may repeat and are summed.
#[derive(Clone, Debug, Default)]
pub struct Entries {
    rows: usize,
    columns: usize,
    list: Vec<(u32, u32, f64)>,
}

impl Entries {
    /// A matrix of this size from entries; an entry without row or column (at a prescribed coordinate) falls out.
    pub fn new(
        rows: usize,
        columns: usize,
        list: impl IntoIterator<Item = (Option<usize>, Option<usize>, f64)>,
    ) -> Self {
        let inside = |(r, c, value): (Option<usize>, Option<usize>, f64)| Some((r? as u32, c? as u32, value));
        Self { rows, columns, list: list.into_iter().filter_map(inside).collect() }
    }

    /// All entries (row, column, value).
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize, f64)> {
        self.list.iter().map(|&(r, c, value)| (r as usize, c as usize, value))
    }

    /// `y += a X x`.
    pub fn add_product(&self, a: f64, x: &[f64], y: &mut [f64]) {
        for &(r, c, value) in &self.list {
            y[r as usize] += a * value * x[c as usize];
        }
    }

    /// `y += a Xᵀ x`.
    pub fn add_transposed_product(&self, a: f64, x: &[f64], y: &mut [f64]) {
        for &(r, c, value) in &self.list {
            y[c as usize] += a * value * x[r as usize];
        }
    }

    /// The dense matrix.
    pub fn dense(&self) -> Mat<f64> {
        let mut dense = Mat::zeros(self.rows, self.columns);
        for (r, c, value) in self.iter() {
            dense[(r, c)] += value;
        }
        dense
    }

    /// `X B`, dense.
    pub fn times(&self, b: &Mat<f64>) -> Mat<f64> {
        let mut product = Mat::zeros(self.rows, b.ncols());
        for column in 0..b.ncols() {
            for (r, c, value) in self.iter() {
                product[(r, column)] += value * b[(c, column)];
            }
        }
        product
    }
}
