//! Fewer points with the same picture.

use super::Plot;

impl Plot {
    /// The plot with at most about `most` points: the first and the last stay, and of each run of points between them two,
    /// which take every curve's least and greatest value there in the order in which it has them. No peak is lost; it moves
    /// by less than a run.
    pub fn thinned(&self, most: usize) -> Self {
        let rows = self.at.len();
        let buckets = most.saturating_sub(2) / 2;
        if rows <= most || buckets == 0 {
            return self.clone();
        }
        // Rows 1..rows - 1 in equal runs.
        let inner = rows - 2;
        let bounds: Vec<(usize, usize)> = (0..buckets)
            .map(|b| (1 + b * inner / buckets, 1 + (b + 1) * inner / buckets))
            .filter(|(from, to)| from < to)
            .collect();
        let mut thin = self.clone();
        thin.at =
            ends(&self.at, bounds.iter().map(|&(from, to)| [self.at[from], self.at[from.midpoint(to)]]));
        for (series, full) in thin.series.iter_mut().zip(&self.series) {
            series.values =
                ends(&full.values, bounds.iter().map(|&(from, to)| extremes(&full.values[from..to])));
        }
        thin
    }
}

/// The first value, pairs, the last value.
fn ends(all: &[f64], pairs: impl Iterator<Item = [f64; 2]>) -> Vec<f64> {
    let (first, last) = (all.first().copied(), all.last().copied());
    first.into_iter().chain(pairs.flatten()).chain(last).collect()
}

/// Least and greatest value in their order; NaN where there is none.
fn extremes(values: &[f64]) -> [f64; 2] {
    let mut least: Option<(usize, f64)> = None;
    let mut greatest: Option<(usize, f64)> = None;
    for (k, &x) in values.iter().enumerate().filter(|(_, x)| !x.is_nan()) {
        if least.is_none_or(|(_, y)| x < y) {
            least = Some((k, x));
        }
        if greatest.is_none_or(|(_, y)| x > y) {
            greatest = Some((k, x));
        }
    }
    match (least, greatest) {
        (Some((i, a)), Some((j, b))) if i <= j => [a, b],
        (Some((_, a)), Some((_, b))) => [b, a],
        _ => [f64::NAN; 2],
    }
}
