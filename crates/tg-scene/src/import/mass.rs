//! Mass properties of rods and boxes in space, and of what is welded from them.
//!
//! ```text
//! along e, length l:   cylinder  I = m (3 r² + l²)/12 (1 - e eᵀ) + m r²/2 e eᵀ
//! welded:              m = Σ m_k,   c = Σ m_k c_k / m,   I = Σ [I_k + m_k (|d|² 1 - d dᵀ)],   d = c_k - c
//! ```

use nalgebra::{Matrix3, Vector3};

/// Mass \[kg\], mass centre \[m\] and inertia about it \[kg m²\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Mass {
    pub(super) mass: f64,
    pub(super) centre: Vector3<f64>,
    pub(super) inertia: Matrix3<f64>,
}

/// A uniform cylinder between two points.
pub(super) fn cylinder(mass: f64, radius: f64, from: &Vector3<f64>, to: &Vector3<f64>) -> Mass {
    let span = to - from;
    let along = span.normalize() * span.normalize().transpose();
    let across = Matrix3::identity() - along;
    let r2 = radius * radius;
    let inertia = across * (mass * (3.0 * r2 + span.norm_squared()) / 12.0) + along * (mass * r2 / 2.0);
    Mass { mass, centre: (from + to) / 2.0, inertia }
}

/// A uniform box between two points; `axes` are the directions of its width and height.
pub(super) fn cuboid(
    mass: f64,
    [width, height]: [f64; 2],
    axes: [Vector3<f64>; 2],
    from: &Vector3<f64>,
    to: &Vector3<f64>,
) -> Mass {
    let span = to - from;
    let second = (span * span.transpose()
        + axes[0] * axes[0].transpose() * (width * width)
        + axes[1] * axes[1].transpose() * (height * height))
        * (mass / 12.0);
    Mass { mass, centre: (from + to) / 2.0, inertia: Matrix3::identity() * second.trace() - second }
}

/// All of them as one body; `None` of nothing.
pub(super) fn weld(parts: &[Mass]) -> Option<Mass> {
    let mass: f64 = parts.iter().map(|part| part.mass).sum();
    if parts.is_empty() {
        return None;
    }
    let centre = parts.iter().map(|part| part.centre * part.mass).sum::<Vector3<f64>>() / mass;
    let about = |part: &Mass| {
        let d = part.centre - centre;
        part.inertia + (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * part.mass
    };
    Some(Mass { mass, centre, inertia: parts.iter().map(about).sum() })
}
