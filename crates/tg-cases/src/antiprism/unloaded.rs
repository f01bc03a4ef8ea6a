//! The unloaded state by Yin's equations, which a small Newton iteration of its own solves.
//!
//! ```text
//! k_L (1 - L_0/L) R_B - 2 k_T (R_T - R_T0) sin(γ/2) = 0                        (32)
//! k_L (1 - L_0/L) R_T - 2 k_B (R_B - R_B0) sin(γ/2) = 0                        (33)
//! L² - L_s² - 2 R_B R_T (cos(α + γ) - cos α) = 0                               (34)
//! R_T0 = T_0 / (2 sin(γ/2)),  R_B0 = B_0 / (2 sin(γ/2)),  γ = 2π/n,  α = π/2 - π/n     (35), (36)
//! H² = L_s² - R_B² - R_T² - 2 R_B R_T sin(γ/2)                                  (41)
//! ```
//! The printed (39) and (40) give A_j the angle (j-1)γ + α; it is jγ + α.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Matrix3, Vector3};

use super::Parameters;
use crate::error::CaseError;

const MOST_ITERATIONS: usize = 60;
/// Newton steps relative to the strut's length below which nothing changes any more.
const SETTLED: f64 = 1e-15;

/// The unloaded state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unloaded {
    /// Circumradius R_B of the feet \[m\].
    pub bottom_radius: f64,
    /// Circumradius R_T of the tops \[m\].
    pub top_radius: f64,
    /// Length L of the lateral ties \[m\].
    pub lateral: f64,
    /// Height H \[m\].
    pub height: f64,
    /// γ, the angle between two struts \[rad\].
    pub gamma: f64,
    /// α, by which the top is turned \[rad\].
    pub alpha: f64,
    /// R_B0 and R_T0, where the polygons are at their free lengths \[m\].
    pub free_radii: [f64; 2],
}

impl Unloaded {
    /// E_j and A_j of strut `j`, from 0 \[m\].
    pub fn ends(&self, j: usize) -> [Vector3<f64>; 2] {
        let on = |radius: f64, angle: f64, z| Vector3::new(radius * angle.cos(), radius * angle.sin(), z);
        let angle = j as f64 * self.gamma;
        [
            on(self.bottom_radius, angle, 0.0),
            on(self.top_radius, angle + self.gamma + self.alpha, self.height),
        ]
    }
}

/// Solves Yin's equations from polygons a little beyond their free lengths.
///
/// # Errors
/// Fewer than three struts, or no solution with positive radii and height near there.
pub fn unloaded(parameters: &Parameters) -> Result<Unloaded, CaseError> {
    let Parameters { struts, length, top, bottom, lateral } = *parameters;
    let n = struts as f64;
    let (gamma, alpha) = (TAU / n, FRAC_PI_2 - PI / n);
    let s = (gamma / 2.0).sin();
    let free_radii = [bottom.free / (2.0 * s), top.free / (2.0 * s)];
    let turn = (alpha + gamma).cos() - alpha.cos();
    let squared_lateral = |rb: f64, rt: f64| length * length + 2.0 * rb * rt * turn;
    let (rb, rt) = (1.1 * free_radii[0], 1.1 * free_radii[1]);
    let mut x = Vector3::new(rb, rt, squared_lateral(rb, rt).max(0.0).sqrt());
    let mut settled = false;
    for _ in 0..MOST_ITERATIONS {
        let (rb, rt, l) = (x.x, x.y, x.z);
        let pull = lateral.stiffness * (1.0 - lateral.free / l);
        let steeper = lateral.stiffness * lateral.free / (l * l);
        let residual = Vector3::new(
            pull * rb - 2.0 * top.stiffness * (rt - free_radii[1]) * s,
            pull * rt - 2.0 * bottom.stiffness * (rb - free_radii[0]) * s,
            l * l - squared_lateral(rb, rt),
        );
        let jacobian = Matrix3::new(
            pull,
            -2.0 * top.stiffness * s,
            steeper * rb,
            -2.0 * bottom.stiffness * s,
            pull,
            steeper * rt,
            -2.0 * rt * turn,
            -2.0 * rb * turn,
            2.0 * l,
        );
        let Some(step) = jacobian.lu().solve(&residual) else { break };
        x -= step;
        if step.amax() <= SETTLED * length {
            settled = true;
            break;
        }
    }
    let (rb, rt, l) = (x.x, x.y, x.z);
    let height = (length * length - rb * rb - rt * rt - 2.0 * rb * rt * s).sqrt();
    if struts < 3 || !settled || !(rb > 0.0 && rt > 0.0 && l > 0.0 && height > 0.0) {
        return Err(CaseError::Unloaded { struts });
    }
    Ok(Unloaded { bottom_radius: rb, top_radius: rt, lateral: l, height, gamma, alpha, free_radii })
}
