//! Errors from differences: a scheme of order p with steps n times shorter has an error n^p times smaller.

/// Error of a motion from its distance to one with steps half as long.
pub(crate) fn error_from_half(distance: f64, order: f64) -> f64 {
    distance / (1.0 - 0.5_f64.powf(order))
}

/// The order that two distances show, which belong to numbers of steps that differ: between one, as where cables go
/// slack, and the order of the scheme.
pub(crate) fn observed_order(coarse: (f64, f64), fine: (f64, f64), most: f64) -> f64 {
    let ((n, d), (m, e)) = (coarse, fine);
    let order = (d / e).ln() / (m / n).ln();
    if order.is_nan() { 1.0 } else { order.clamp(1.0, most) }
}
