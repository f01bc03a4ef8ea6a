//! The constraint Jacobian as an operator: products with the values that [`Mechanics::jacobian`] fills.

use crate::mechanics::Mechanics;

/// Pattern of A in the form of the hot loops: runs of entries of one constraint.
#[derive(Clone, Debug)]
pub struct Jacobian {
    /// Constraint and end of each run.
    runs: Vec<(u32, u32)>,
    columns: Vec<u32>,
}

impl Jacobian {
    /// The pattern of a system.
    pub fn new(mechanics: &dyn Mechanics) -> Self {
        let pattern = mechanics.jacobian_pattern();
        let mut runs: Vec<(u32, u32)> = Vec::new();
        for (at, &(row, _)) in pattern.iter().enumerate() {
            match runs.last_mut() {
                Some((last, end)) if *last as usize == row => *end = at as u32 + 1,
                _ => runs.push((row as u32, at as u32 + 1)),
            }
        }
        Self { runs, columns: pattern.iter().map(|&(_, column)| column as u32).collect() }
    }

    /// `out ← A x`, one number per constraint. The largest Σ |a| |x| of a run of entries: what rounding is relative to.
    pub fn product(&self, values: &[f64], x: &[f64], out: &mut [f64]) -> f64 {
        out.fill(0.0);
        let (mut start, mut largest) = (0, 0.0_f64);
        for &(row, end) in &self.runs {
            let entries = start..end as usize;
            let terms = self.columns[entries.clone()].iter().zip(&values[entries]);
            let (sum, size) = terms
                .map(|(&column, a)| a * x[column as usize])
                .fold((0.0, 0.0), |(sum, size), term| (sum + term, size + f64::abs(term)));
            out[row as usize] += sum;
            // Faster than `f64::max`, which looks for NaN.
            largest = if size > largest { size } else { largest };
            start = end as usize;
        }
        largest
    }

    /// `out ← Aᵀ y` over the full coordinates.
    pub fn transposed(&self, values: &[f64], y: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        let mut start = 0;
        for &(row, end) in &self.runs {
            let entries = start..end as usize;
            let y = y[row as usize];
            for (&column, a) in self.columns[entries.clone()].iter().zip(&values[entries]) {
                out[column as usize] += a * y;
            }
            start = end as usize;
        }
    }
}
