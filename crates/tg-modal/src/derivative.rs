//! Directional derivatives by extrapolated central differences.

/// Halvings of the step.
const ROWS: usize = 14;

/// f'(0) of a vector function by Ridders' method: central differences at steps h, h/2, h/4, …, extrapolated to zero
/// (Richardson), the entry of the table with the least estimated error. Not finite where f is not.
///
/// Linear functions come out exact to rounding; smooth ones lose about three digits to it.
pub(crate) fn central(h: f64, mut f: impl FnMut(f64) -> Vec<f64>) -> Vec<f64> {
    let mut difference = |h: f64| -> Vec<f64> {
        let (after, before) = (f(h), f(-h));
        after.iter().zip(&before).map(|(a, b)| (a - b) / (2.0 * h)).collect()
    };
    let distance = |a: &[f64], b: &[f64]| {
        let gap = |(a, b): (&f64, &f64)| if (a - b).is_nan() { f64::INFINITY } else { (a - b).abs() };
        a.iter().zip(b).map(gap).fold(0.0_f64, f64::max)
    };
    let mut step = h;
    let mut row = vec![difference(step)];
    let (mut best, mut error) = (row[0].clone(), f64::INFINITY);
    for _ in 1..ROWS {
        step *= 0.5;
        let mut next = vec![difference(step)];
        let mut factor = 4.0;
        for k in 0..row.len() {
            let finer = &next[k];
            let extrapolated: Vec<f64> =
                finer.iter().zip(&row[k]).map(|(b, a)| (factor * b - a) / (factor - 1.0)).collect();
            let estimate = distance(&extrapolated, finer).max(distance(&extrapolated, &row[k]));
            if estimate < error {
                (best, error) = (extrapolated.clone(), estimate);
            }
            next.push(extrapolated);
            factor *= 4.0;
        }
        row = next;
    }
    best
}
