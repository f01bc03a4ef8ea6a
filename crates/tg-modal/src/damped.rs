//! Damped modes.
//!
//! ```text
//! (s² 𝓜 + s 𝓒 + 𝓚) ξ = 0                                                        from (42)
//! ξ = X η,  Xᵀ𝓜X = I,  Xᵀ𝓚X = Ω²:   d/dt [w η; η̇] = [0, w; -Ω²/w, -Xᵀ𝓒X] [w η; η̇]
//! ```
//! The first-order form is written in undamped modes and w ≈ Ω scales it, so that displacements and velocities have one
//! size and an undamped structure gives a skew matrix.

use std::f64::consts::PI;

use tg_model::Mechanics;
use tg_tangent::faer::c64;
use tg_tangent::{Configuration, dense};

use crate::error::ModalError;
use crate::modal::Modal;
use crate::modes::Modes;

/// Backward error above which a damped mode is refused; those of the tests stay below 1e-14.
const INACCURATE: f64 = 1e-10;
/// Part of the largest |s| up to which a positive real part is rounding: undamped modes of the structures in the tests
/// come out with 1e-15.
const ROUNDING: f64 = 1e-12;

/// What a damped mode does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DampedKind {
    /// A pair s, s̄ with Re s ≤ 0: a vibration that decays, or stays where there is no damping.
    Oscillating,
    /// A real s < 0: a motion that decays without oscillating, one mode for each real eigenvalue. The decaying partner of
    /// an unstable mode is one too.
    Overdamped,
    /// |s|² within [`Modes::zero_limit`], one for each eigenvalue: a free rigid motion is a double zero and listed twice.
    Zero,
    /// Re s > 0: growth, without oscillation where s is real.
    Unstable,
}

/// One damped mode: a conjugate pair of eigenvalues, or a single real or zero one.
#[derive(Clone, Debug)]
pub struct DampedMode {
    /// s \[1/s\], Im s ≥ 0: free motions are Re(φ exp(s t)).
    pub eigenvalue: c64,
    /// |s| / 2π \[Hz\]; the undamped frequency where damping is proportional.
    pub frequency: f64,
    /// Im s / 2π \[Hz\], that of the zero crossings.
    pub damped_frequency: f64,
    /// ζ = -Re s / |s|: 0 undamped, 1 for a real decaying mode, negative for an unstable one; 0 for a zero mode.
    pub damping_ratio: f64,
    /// What the mode does.
    pub kind: DampedKind,
    /// φ over the full coordinates, zero at prescribed ones, φᴴ M φ = 1; its largest component is real and positive.
    pub shape: Vec<c64>,
    /// Normwise backward error: |(s² + s 𝓒 + Ω²) η| / ((|s|² + |s||𝓒| + |Ω²|) |η|).
    pub residual: f64,
}

/// The damped modes about the equilibrium `at`, |s| ascending: 2 eigenvalues for each of the `undamped` modes, a
/// conjugate pair of which is one damped mode.
///
/// Damped modes are combinations of the `undamped` ones: exact where these are complete ([`Modes::is_complete`]),
/// otherwise those of the structure that can move in the listed shapes only. The matrix is dense, of twice their number.
///
/// # Errors
/// The modes are of another structure, no convergence, or a mode that does not satisfy its equation.
pub fn damped(
    mechanics: &dyn Mechanics,
    at: &Configuration,
    undamped: &Modes,
) -> Result<Vec<DampedMode>, ModalError> {
    let system = Modal::new(mechanics, at, undamped)?;
    let k = undamped.list.len();
    let w = system.scales(undamped.zero_limit);
    let (values, vectors) = dense::eigen(&system.first_order(&w))?;
    let largest = values.iter().fold(0.0_f64, |a, s| a.max(s.norm()));
    let mut modes = Vec::new();
    for (column, &s) in values.iter().enumerate().filter(|(_, s)| s.im >= 0.0) {
        let from_displacement: Vec<c64> = (0..k).map(|i| vectors[(i, column)] / w[i]).collect();
        let from_velocity: Vec<c64> = (0..k).map(|i| vectors[(i + k, column)] / s).collect();
        let candidates = [from_displacement, from_velocity].map(|eta| (system.residual(s, &eta), eta));
        let best = candidates.into_iter().filter(|(r, _)| r.is_finite()).min_by(|a, b| a.0.total_cmp(&b.0));
        let (residual, eta) = best.unwrap_or((f64::INFINITY, Vec::new()));
        if residual > INACCURATE {
            return Err(ModalError::InaccurateMode { re: s.re, im: s.im, residual });
        }
        let shape = system.shape(undamped, &eta);
        if s.norm_sqr() <= undamped.zero_limit {
            let zero = zero_mode(s.re, shape, residual);
            modes.extend(std::iter::repeat_n(zero, if s.im > 0.0 { 2 } else { 1 }));
        } else {
            modes.push(DampedMode {
                eigenvalue: s,
                frequency: s.norm() / (2.0 * PI),
                damped_frequency: s.im / (2.0 * PI),
                damping_ratio: -s.re / s.norm(),
                kind: kind(s, ROUNDING * largest),
                shape,
                residual,
            });
        }
    }
    let key = |mode: &DampedMode| (mode.eigenvalue.norm(), mode.eigenvalue.re);
    modes.sort_by(|a, b| {
        let (a, b) = (key(a), key(b));
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    Ok(modes)
}

/// Rounding may split a multiple zero into tiny pairs, whose imaginary parts mean nothing.
fn zero_mode(re: f64, shape: Vec<c64>, residual: f64) -> DampedMode {
    DampedMode {
        eigenvalue: c64::new(re, 0.0),
        frequency: re.abs() / (2.0 * PI),
        damped_frequency: 0.0,
        damping_ratio: 0.0,
        kind: DampedKind::Zero,
        shape,
        residual,
    }
}

fn kind(s: c64, rounding: f64) -> DampedKind {
    if s.re > rounding {
        DampedKind::Unstable
    } else if s.im > 0.0 {
        DampedKind::Oscillating
    } else {
        DampedKind::Overdamped
    }
}
