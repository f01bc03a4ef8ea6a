//! Distances between struts as segments.
//!
//! ```text
//! nearest points p + s u and r + t v of two lines: (r + t v - p - s u) ⊥ u, v
//! ```

use nalgebra::Vector3;

use super::Antiprism;

/// Least distance between two struts \[m\].
pub(super) fn clearance(antiprism: &Antiprism, q: &[f64]) -> f64 {
    let n = antiprism.struts.len();
    let pairs = (0..n).flat_map(|j| (j + 1..n).map(move |k| (j, k)));
    pairs.map(|(j, k)| Nearest::of(antiprism, j, k, q).distance).fold(f64::INFINITY, f64::min)
}

/// How two struts lie to each other.
pub(super) struct Nearest {
    /// Distance between the segments \[m\].
    pub(super) distance: f64,
    /// Whether the nearest points of the two straight lines are inside both struts.
    pub(super) inside: bool,
    /// Six times the volume between them, signed: changes sign when they pass each other \[m³\].
    pub(super) side: f64,
}

impl Nearest {
    pub(super) fn of(antiprism: &Antiprism, j: usize, k: usize, q: &[f64]) -> Self {
        let ([p, p_end], [r, r_end]) = (antiprism.ends(j, q), antiprism.ends(k, q));
        let (u, v, gap) = (p_end - p, r_end - r, r - p);
        let (uu, uv, vv) = (u.norm_squared(), u.dot(&v), v.norm_squared());
        let (ug, vg) = (u.dot(&gap), v.dot(&gap));
        let determinant = uu * vv - uv * uv;
        let (s, t) = ((ug * vv - vg * uv) / determinant, (ug * uv - vg * uu) / determinant);
        let within = |x: f64| (0.0..=1.0).contains(&x);
        let inside = within(s) && within(t);
        let lines = (gap + v * t - u * s).norm();
        let ends = [
            to_segment(&p, &r, &v),
            to_segment(&p_end, &r, &v),
            to_segment(&r, &p, &u),
            to_segment(&r_end, &p, &u),
        ];
        let distance = if inside { lines } else { ends.into_iter().fold(f64::INFINITY, f64::min) };
        Self { distance, inside, side: gap.dot(&u.cross(&v)) }
    }
}

/// Distance of a point from a segment.
fn to_segment(point: &Vector3<f64>, from: &Vector3<f64>, along: &Vector3<f64>) -> f64 {
    let share = ((point - from).dot(along) / along.norm_squared()).clamp(0.0, 1.0);
    (from + along * share - point).norm()
}
