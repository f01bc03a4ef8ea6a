//! The motion within a step: the quintic Hermite interpolant of positions, velocities and accelerations at its ends.
//!
//! ```text
//! q(t_n + θh) = q_n + h q̇_n θ + ½ h² q̈_n θ² + c_3 θ³ + c_4 θ⁴ + c_5 θ⁵,   q̇ = dq/dθ / h
//! ```
//! The error is O(h⁶) in q and vanishes with the third power of the distance from either end.

/// Writes the packed state at θ from packed states `y` = [q; q̇] and their rates `k` = [q̇; q̈] at both ends.
pub(crate) fn interpolate(
    theta: f64,
    h: f64,
    (y0, k0): (&[f64], &[f64]),
    (y1, k1): (&[f64], &[f64]),
    out: &mut [f64],
) {
    let n = y0.len() / 2;
    let (q_out, v_out) = out.split_at_mut(n);
    for i in 0..n {
        let (v0, v1) = (h * y0[n + i], h * y1[n + i]);
        let (a0, a1) = (0.5 * h * h * k0[n + i], 0.5 * h * h * k1[n + i]);
        // What the first three terms leave of q, h q̇ and ½ h² q̈ at θ = 1.
        let position = y1[i] - y0[i] - v0 - a0;
        let velocity = v1 - v0 - 2.0 * a0;
        let acceleration = a1 - a0;
        let c3 = 10.0 * position - 4.0 * velocity + acceleration;
        let c4 = -15.0 * position + 7.0 * velocity - 2.0 * acceleration;
        let c5 = 6.0 * position - 3.0 * velocity + acceleration;
        q_out[i] = y0[i] + theta * (v0 + theta * (a0 + theta * (c3 + theta * (c4 + theta * c5))));
        let slope = theta * (2.0 * a0 + theta * (3.0 * c3 + theta * (4.0 * c4 + theta * 5.0 * c5)));
        v_out[i] = (v0 + slope) / h;
    }
}
