//! Example 1: short and long simulations of the double pendulum against two angles (Sec. 6.1).

use std::f64::consts::{PI, TAU};

use tg_coords::CoordType;
use tg_integrate::{GeneralizedAlpha, NewtonOptions, Run, State, StepReport, Symplectic};
use tg_model::Joining;

use super::mass_difference;
use crate::double_pendulum::{Choices, DoublePendulum};
use crate::error::CaseError;
use crate::plane::{SPLIT, triangle};
use crate::published::{EXACT, SCHEME, framework};
use crate::reference;
use crate::row::{Row, Rows};
use crate::simulate::{self, STEP, order, record, run};

/// Name of the case.
pub const NAME: &str = "example1";
const DIGITS: &str = "the scheme in 50 digits, data/multipliers.py";
const GEOMETRY: &str = "geometry page of the example";

/// Multipliers of the bar in the first five steps \[N/m\], printed by `data/multipliers.py`.
const MULTIPLIERS: [f64; 5] =
    [-2.054040559491528, -2.054536214793677, -2.055527538268306, -2.057014556862927, -2.058997314020902];

/// All rows.
///
/// # Errors
/// A model cannot be built or a run fails.
pub fn rows() -> Result<Vec<Row>, CaseError> {
    let mut rows = Rows::new(NAME);
    let pendulum = DoublePendulum::new(Choices::default())?;
    start(&mut rows, &pendulum)?;
    first_steps(&mut rows, &pendulum)?;
    trajectory(&mut rows, &pendulum)?;
    convergence(&mut rows, &pendulum)?;
    energy(&mut rows, &pendulum)?;
    invariances(&mut rows, &pendulum)?;
    Ok(rows.finish())
}

/// Counts, masses and energy at the start.
fn start(rows: &mut Rows, pendulum: &DoublePendulum) -> Result<(), CaseError> {
    let report = pendulum.model.report();
    rows.exact("free coordinates", (report.free, 6), GEOMETRY);
    rows.exact("constraints", (report.intrinsic + report.extrinsic, 4), GEOMETRY);
    rows.exact("degrees of freedom", (report.degrees_of_freedom(), 2), GEOMETRY);
    for (name, coord_type) in
        [("tri(ruv)", CoordType::Ruv), ("tri(rrv)", CoordType::Rrv), ("tri(rrr)", CoordType::Rrr)]
    {
        let body = triangle(coord_type, SPLIT)?;
        let published = &framework().example1.masses[name];
        let worst = mass_difference(body.mass_matrix(), published);
        rows.below(format!("mass matrix {name}, largest difference"), "kg", worst, EXACT, 1e-15);
    }
    let mut stepper = Symplectic::new(&pendulum.model, NewtonOptions::default())?;
    let state = simulate::start(&pendulum.model, &mut stepper)?;
    let energy = (pendulum.energy(&state), framework().example1.energy);
    rows.near("energy at the start", "J", energy, EXACT, 1e-15);
    Ok(())
}

/// The first five steps of the scheme at h = 1e-3.
fn first_steps(rows: &mut Rows, pendulum: &DoublePendulum) -> Result<(), CaseError> {
    let published = &framework().example1.first_steps;
    // Multipliers are compared with those of the scheme as printed, whose momentum keeps its normal part.
    let mut stepper = Symplectic::new(&pendulum.model, NewtonOptions::default())?.carrying_momentum();
    let mut state = simulate::start(&pendulum.model, &mut stepper)?;
    let mut multipliers = Vec::new();
    Run::new(STEP, 5.0 * STEP)
        .observe(&mut |state: &State, _: &StepReport| multipliers.push(state.lambda[0]))
        .go(&mut stepper, &mut state)?;
    let points = record(&pendulum.model, STEP, 5.0 * STEP, |state| {
        [pendulum.joint.eval(&state.q), pendulum.centre.eval(&state.q)]
    })?;
    for k in 1..=5 {
        for (name, ours, theirs) in [
            ("joint", points[k][0], published.joint[k]),
            ("triangle's mass centre", points[k][1], published.triangle_centroid[k]),
        ] {
            for (axis, d) in [("x", 0), ("y", 1)] {
                rows.near(format!("{name} {axis}, step {k}"), "m", (ours[d], theirs[d]), SCHEME, 1e-12);
            }
        }
        // A multiplier is a rounding of Φ (1e-18 m²) divided by h²/2 · A M⁻¹ Aᵀ: doubles resolve 1e-11. The
        // reference file's own values differ from the 50-digit ones by up to 1.6e-10.
        let name = format!("multiplier of the bar, step {k}");
        rows.near(&name, "N/m", (multipliers[k], MULTIPLIERS[k - 1]), DIGITS, 2e-11);
        rows.near(&name, "N/m", (multipliers[k], published.lambda_bar[k - 1]), SCHEME, 2e-10);
    }
    Ok(())
}

/// Four seconds at h = 1e-3 (Fig. 8).
fn trajectory(rows: &mut Rows, pendulum: &DoublePendulum) -> Result<(), CaseError> {
    let published = &framework().example1.exact;
    let truth = reference::DoublePendulum::paper().solve(&published.t)?;
    let mut worst = [0.0_f64; 2];
    for (k, state) in truth.states.iter().enumerate() {
        worst[0] = worst[0].max((state.theta[0] - published.theta1[k]).abs());
        worst[0] = worst[0].max((state.theta[1] - published.theta2[k]).abs());
        worst[1] = worst[1].max((state.omega[0] - published.omega1[k]).abs());
        worst[1] = worst[1].max((state.omega[1] - published.omega2[k]).abs());
    }
    rows.below("two-angle model to 4 s: largest error of the angles", "rad", worst[0], EXACT, 1e-11);
    rows.below("two-angle model to 4 s: largest error of the rates", "rad/s", worst[1], EXACT, 1e-10);
    let levels =
        [1, 2, 4, 8].map(|part| record(&pendulum.model, STEP / f64::from(part), 4.0, |s| pendulum.angles(s)));
    let [coarse, a, b, c] = levels;
    let (coarse, a, b, c) = (coarse?, a?, b?, c?);
    let mut largest = 0.0_f64;
    for (k, t) in published.t.iter().enumerate().skip(1) {
        let step = (t / STEP).round() as usize;
        for (name, i, exact) in [("θ1", 0, published.theta1[k]), ("θ2", 1, published.theta2[k])] {
            let error = |level: &[[f64; 2]], part: usize| wrap(level[part * step][i] - exact);
            largest = largest.max(error(&coarse, 1).abs());
            // Errors of h², then of h⁴, removed.
            let (fourth, finer) =
                (extrapolate(error(&a, 2), error(&b, 4), 4.0), extrapolate(error(&b, 4), error(&c, 8), 4.0));
            let value = exact + extrapolate(fourth, finer, 16.0);
            rows.near(
                format!("{name} at {t} s, h → 0 from h = 1e-3/2, /4, /8"),
                "rad",
                (value, exact),
                EXACT,
                1e-5,
            );
        }
    }
    rows.below(
        "h = 1e-3 to 4 s: largest error of θ seen",
        "rad",
        largest,
        "paper, Fig. 8: good agreement",
        0.1,
    );
    Ok(())
}

/// Richardson's extrapolation of two levels whose errors are in the ratio `ratio`.
fn extrapolate(coarse: f64, fine: f64, ratio: f64) -> f64 {
    (ratio * fine - coarse) / (ratio - 1.0)
}

/// Errors against the exact motion to 1 s and their order.
fn convergence(rows: &mut Rows, pendulum: &DoublePendulum) -> Result<(), CaseError> {
    let published = &framework().example1.errors["to 1 s"];
    let mut errors = Vec::new();
    // The reference errors are maxima over samples every 0.1 s.
    for (name, h) in [("1e-3", STEP), ("5e-4", STEP / 2.0), ("2.5e-4", STEP / 4.0)] {
        let error = error_to_1s(pendulum, h, 0.1)?;
        let pair = (error, published[name]);
        rows.near(format!("largest error of θ to 1 s, h = {name}"), "rad", pair, SCHEME, 0.1 * pair.1);
        errors.push(error_to_1s(pendulum, h, h)?);
    }
    rows.near("order of convergence", "1", (order(&errors), 2.0), "theory, second order", 0.05);
    Ok(())
}

/// Largest error of an angle over samples at regular times.
fn error_to_1s(pendulum: &DoublePendulum, h: f64, every: f64) -> Result<f64, CaseError> {
    let seen = record(&pendulum.model, h, 1.0, |state| (state.t, pendulum.angles(state)))?;
    let seen: Vec<_> = seen.into_iter().step_by((every / h).round() as usize).collect();
    let times: Vec<f64> = seen.iter().map(|(t, _)| *t).collect();
    let truth = reference::DoublePendulum::paper().solve(&times)?;
    let pairs = seen.iter().zip(&truth.states).flat_map(|((_, a), b)| a.iter().zip(b.theta));
    Ok(pairs.map(|(a, b)| wrap(a - b).abs()).fold(0.0, f64::max))
}

/// 500 s of mechanical energy by both schemes (Fig. 9).
fn energy(rows: &mut Rows, pendulum: &DoublePendulum) -> Result<(), CaseError> {
    let e0 = framework().example1.energy;
    let (mut worst, mut rate, mut changes) = (0.0_f64, 0.0_f64, Vec::new());
    run(&pendulum.model, STEP, 500.0, |state| {
        let relative = pendulum.energy(state) / e0 - 1.0;
        worst = worst.max(relative.abs());
        rate = rate.max(simulate::constraint_rate(&pendulum.model, state));
        changes.push(relative);
    })?;
    let drift = drift(&changes).abs();
    rows.below("symplectic, 500 s: largest |ΔE/E0| (6.4e-3 there)", "1", worst, GEOMETRY, 7e-3);
    rows.below("symplectic, 500 s: slope of ΔE/E0", "1/s", drift, "no drift", 1e-7);
    rows.below("symplectic, 500 s: largest |A q̇|", "m²/s", rate, "velocity constraints", 1e-10);
    let mut stepper = GeneralizedAlpha::new(&pendulum.model, 0.7, NewtonOptions::default())?;
    let mut state = simulate::start(&pendulum.model, &mut stepper)?;
    Run::new(STEP, 100.0).go(&mut stepper, &mut state)?;
    let loss = (pendulum.energy(&state) / e0 - 1.0) / 100.0;
    // The motion is chaotic: starts that differ by 1e-13 m/s lose 3.9e-4 to 5.4e-4 in this time.
    let pair = (loss, 4.1e-4);
    rows.near("generalised-α, ρ∞ = 0.7, 100 s: loss of |E0| per second", "1/s", pair, GEOMETRY, 1.5e-4);
    Ok(())
}

/// Slope of the line through the medians of 10 s \[1/s\]. Medians, because the energy error of this chaotic motion has
/// rare spikes: a line through all values scatters by 1e-7 between starts that differ by 1e-13 m/s, this one by 1e-8.
fn drift(changes: &[f64]) -> f64 {
    let block = (10.0 / STEP) as usize;
    let medians: Vec<f64> = changes
        .chunks_exact(block)
        .map(|values| {
            let mut sorted = values.to_vec();
            sorted.sort_by(f64::total_cmp);
            sorted[block / 2]
        })
        .collect();
    let middle = (medians.len() as f64 - 1.0) / 2.0;
    let mean = medians.iter().sum::<f64>() / medians.len() as f64;
    let (mut covariance, mut variance) = (0.0, 0.0);
    for (k, median) in medians.iter().enumerate() {
        let t = 10.0 * (k as f64 - middle);
        covariance += t * (median - mean);
        variance += t * t;
    }
    covariance / variance
}

/// What must not matter.
fn invariances(rows: &mut Rows, pendulum: &DoublePendulum) -> Result<(), CaseError> {
    let points = |choices| -> Result<Vec<[f64; 2]>, CaseError> {
        let pendulum = DoublePendulum::new(choices)?;
        record(&pendulum.model, STEP, 1.0, |state| pendulum.centre.eval(&state.q).into())
    };
    let base = points(Choices::default())?;
    let default = Choices::default();
    for (name, choices) in [
        ("type RRV", Choices { coord_type: CoordType::Rrv, ..default }),
        ("type RRR", Choices { coord_type: CoordType::Rrr, ..default }),
        ("extrinsic hinge", Choices { joining: Joining::Constrain, ..default }),
        ("planar J split evenly", Choices { split: 0.5, ..default }),
    ] {
        let apart = simulate::distance(&points(choices)?, &base);
        rows.below(format!("{name}: largest difference to 1 s"), "m", apart, "exact invariance", 1e-12);
    }
    let back = simulate::time_reversal(&pendulum.model, &pendulum.model.velocities_at_rest(), STEP, 1000)?;
    rows.below("1000 steps forward and back: distance from the start", "m", back, "time symmetry", 1e-9);
    Ok(())
}

/// An angle's difference within ±π.
fn wrap(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}
