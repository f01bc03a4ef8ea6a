//! Length of the step, scheme by scheme.

use std::f64::consts::FRAC_PI_2;

use tg_integrate::State;
use tg_model::{Joining, ModelBuilder};

use super::axis::{Axis, Probe};
use super::scheme::Scheme;
use super::verdict::Verdict;
use crate::TaskError;

/// Steps in which a probe is done \[1\], and the time that it lasts at least if that many do \[s\].
const MOST_STEPS: f64 = 5e3;
const LEAST_TIME: f64 = 2.0;
/// Angle of the start \[rad\] from the downward vertical, and g \[m/s²\].
const ANGLE: f64 = 1.0;
const GRAVITY: f64 = 9.81;

/// Why it ends.
const FIXED: &str = "Fixed steps have no estimate of their error. The observer `Turning` tells when there are fewer than twenty \
                     of them a period, and `tg run` warns of more than a radian a step; beyond that the iteration for the \
                     end of a step finds none. Steps under error control are divided as the tolerance asks.";

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    Scheme::ALL
        .map(|scheme| Axis {
            title: title(scheme),
            setup: "A bar of 1 m on a hinge swings from rest at 1 rad for 2 s, or 5000 steps, or five, ω = 3.8 rad/s; \
                    its tip's distance \
                    from the motion in Jacobi's elliptic functions. The limit is the scheme's order, (hω)^p ωt m, but at \
                    most 0.05 m, and rounding of 4ε m a step; under error control ten times the tolerance.",
            probes: [1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0, 10.0, 1e3]
                .map(|h: f64| Probe::new(format!("{h:.0e}"), move |_| swing(scheme, h)))
                .into(),
            cause: FIXED,
        })
        .into()
}

fn title(scheme: Scheme) -> &'static str {
    match scheme {
        Scheme::Symplectic => "Step of the symplectic scheme, s",
        Scheme::GeneralizedAlpha => "Step of generalised-α, s",
        Scheme::Leapfrog => "Step of leapfrog, s",
        Scheme::Composition(_) if scheme.order() == 4 => "Step of the composition of order 4, s",
        Scheme::Composition(_) => "Step of the composition of order 6, s",
        Scheme::Fixed(_) if scheme.order() == 5 => "Step of Runge–Kutta 5, s",
        Scheme::Fixed(_) => "Step of Runge–Kutta 8, s",
        Scheme::Controlled(..) if scheme.order() == 5 => "Step of Runge–Kutta 5 under error control, s",
        Scheme::Controlled(..) => "Step of Runge–Kutta 8 under error control, s",
    }
}

/// The largest distance of the tip from the closed form, and its limit.
fn swing(scheme: Scheme, h: f64) -> Verdict {
    let omega = (1.5 * GRAVITY).sqrt();
    let end = LEAST_TIME.min(MOST_STEPS * h).max(5.0 * h);
    let run = || -> Result<_, TaskError> {
        let mut b = ModelBuilder::<2>::new();
        b.gravity([0.0, -GRAVITY])?;
        let pivot = b.anchor("pivot", [0.0, 0.0])?;
        let bar = b.bar("bar", 1.0, [0.0, 0.0], [ANGLE.sin(), -ANGLE.cos()])?;
        b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
        let model = b.build()?;
        let tip = model.form(bar.node(1))?;
        let off = |state: &State| {
            let angle = pendulum_angle(omega * state.t);
            let tip = tip.eval(&state.q);
            (tip.x - angle.sin()).hypot(tip.y + angle.cos())
        };
        scheme.follow(&model, &model.velocities_at_rest(), (h, end), off)
    };
    Verdict::of_motion(run(), scheme.bound(omega, (h, end)))
}

/// Angle of the pendulum after ω t: sin(θ/2) = k sn(ω t + K, k), k = sin(θ₀/2).
fn pendulum_angle(phase: f64) -> f64 {
    let k = (0.5 * ANGLE).sin();
    let (means, quarter) = arithmetic_geometric(k);
    let amplitude = jacobi_amplitude(phase + quarter, &means);
    2.0 * (k * amplitude.sin()).asin()
}

/// The pairs (a, c) of the arithmetic-geometric mean for modulus k, and K(k) (Abramowitz, Stegun, 17.6).
fn arithmetic_geometric(k: f64) -> (Vec<(f64, f64)>, f64) {
    let (mut a, mut b) = (1.0_f64, (1.0 - k * k).sqrt());
    let mut means = vec![(a, k)];
    while (a - b).abs() > f64::EPSILON * a {
        (a, b, means) = {
            let c = 0.5 * (a - b);
            let (next, b) = (0.5 * (a + b), (a * b).sqrt());
            means.push((next, c));
            (next, b, means)
        };
    }
    (means, FRAC_PI_2 / a)
}

/// am(u, k) by the descending means (Abramowitz, Stegun, 16.4).
fn jacobi_amplitude(u: f64, means: &[(f64, f64)]) -> f64 {
    let (last, steps) = (means[means.len() - 1].0, means.len() - 1);
    let mut angle = last * u * f64::from(1_u32 << steps);
    for &(a, c) in means[1..].iter().rev() {
        angle = 0.5 * (angle + (c / a * angle.sin()).asin());
    }
    angle
}
