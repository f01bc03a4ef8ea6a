//! Runs that several cases share.

use tg_integrate::{NewtonOptions, Run, State, StepReport, Stepper, Summary, Symplectic};
use tg_model::Model;

use crate::error::CaseError;

/// Step of the paper's simulations \[s\].
pub const STEP: f64 = 1e-3;

/// Runs the symplectic scheme from the initial configuration at rest, showing every accepted state.
///
/// # Errors
/// The run cannot start, or fails.
pub fn run<const D: usize>(
    model: &Model<D>,
    h: f64,
    end: f64,
    watch: impl FnMut(&State),
) -> Result<Summary, CaseError> {
    run_from(model, &model.velocities_at_rest(), h, end, watch)
}

/// As [`run`], from full velocities, which are projected.
///
/// # Errors
/// The run cannot start, or fails.
pub fn run_from<const D: usize>(
    model: &Model<D>,
    v: &[f64],
    h: f64,
    end: f64,
    mut watch: impl FnMut(&State),
) -> Result<Summary, CaseError> {
    let mut stepper = Symplectic::new(model, NewtonOptions::default())?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), v)?;
    Ok(Run::new(h, end)
        .observe(&mut |state: &State, _: &StepReport| watch(state))
        .go(&mut stepper, &mut state)?)
}

/// The initial configuration, free coordinates at rest.
///
/// # Errors
/// The start is not consistent.
pub fn start<const D: usize>(model: &Model<D>, stepper: &mut dyn Stepper) -> Result<State, CaseError> {
    Ok(stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?)
}

/// What `look` sees at every step, the start included.
///
/// # Errors
/// The run cannot start, or fails.
pub fn record<const D: usize, T>(
    model: &Model<D>,
    h: f64,
    end: f64,
    look: impl Fn(&State) -> T,
) -> Result<Vec<T>, CaseError> {
    let mut seen = Vec::new();
    run(model, h, end, |state| seen.push(look(state)))?;
    Ok(seen)
}

/// Runs from the initial configuration at rest until `height` has become negative, at the latest until `end`, showing
/// every accepted state; the time of the crossing \[s\], interpolated linearly.
///
/// # Errors
/// The run cannot start, or fails before the crossing.
pub fn until_negative<const D: usize>(
    model: &Model<D>,
    h: f64,
    end: f64,
    height: impl Fn(&State) -> f64,
    mut watch: impl FnMut(&State),
) -> Result<Option<f64>, CaseError> {
    let mut stepper = Symplectic::new(model, NewtonOptions::default())?;
    let mut state = start(model, &mut stepper)?;
    let (mut before, mut crossing) = ((state.t, height(&state)), None);
    Run::new(h, end)
        .observe(&mut |state: &State, _: &StepReport| watch(state))
        .stop_when(|state| {
            let now = (state.t, height(state));
            if now.1 < 0.0 {
                crossing = Some(before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1));
            }
            before = now;
            crossing.is_some()
        })
        .go(&mut stepper, &mut state)?;
    Ok(crossing)
}

/// Observed order of convergence from errors at successive halvings of the step: the mean slope.
pub fn order(errors: &[f64]) -> f64 {
    match (errors.first(), errors.last()) {
        (Some(first), Some(last)) if errors.len() > 1 => (first / last).log2() / (errors.len() - 1) as f64,
        _ => f64::NAN,
    }
}

/// Runs `steps` steps forward from full velocities, reverses the velocities, and runs as many back: the largest distance of a coordinate
/// from its start.
///
/// # Errors
/// A run cannot start, or fails.
pub fn time_reversal<const D: usize>(
    model: &Model<D>,
    v: &[f64],
    h: f64,
    steps: u32,
) -> Result<f64, CaseError> {
    let mut stepper = Symplectic::new(model, NewtonOptions::default())?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), v)?;
    let origin = state.q.clone();
    for direction in [1.0, 2.0] {
        Run::new(h, direction * f64::from(steps) * h).go(&mut stepper, &mut state)?;
        state.v.iter_mut().for_each(|v| *v = -*v);
    }
    Ok(state.q.iter().zip(&origin).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
}

/// Largest |A q̇| over all constraints at a state.
pub fn constraint_rate<const D: usize>(model: &Model<D>, state: &State) -> f64 {
    let mechanics = model.mechanics();
    let mut values = vec![0.0; mechanics.jacobian_pattern().len()];
    mechanics.jacobian(&state.q, &mut values);
    let mut rates = vec![0.0; mechanics.sizes().constraints];
    for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(&values) {
        rates[row] += a * state.v[i];
    }
    rates.into_iter().fold(0.0, |worst, rate| worst.max(rate.abs()))
}

/// Largest distance between two sequences of points.
pub fn distance<const N: usize>(ours: &[[f64; N]], theirs: &[[f64; N]]) -> f64 {
    let apart =
        |(a, b): (&[f64; N], &[f64; N])| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    ours.iter().zip(theirs).map(apart).fold(0.0, f64::max)
}
