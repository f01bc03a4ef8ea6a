//! Checks of a start and of a step that all schemes share.

use tg_model::{Mechanics, Projector, Sizes};

use crate::error::{StartError, StepError, StepFailure};
use crate::state::State;

/// Scaled violation of a constraint above which a start counts as not assembled: a thousand times the rounding of
/// hand-written coordinates, a millionth of what a misplaced member shows.
pub(crate) const ASSEMBLED: f64 = 1e-9;

/// A state with prescribed components in place, finite and of the right size.
pub(crate) fn start(mechanics: &dyn Mechanics, t: f64, q: &[f64], v: &[f64]) -> Result<State, StartError> {
    let sizes = mechanics.sizes();
    for (what, x) in [("coordinates", q), ("velocities", v)] {
        if x.len() != sizes.coordinates {
            return Err(StartError::Length { what, got: x.len(), expected: sizes.coordinates });
        }
    }
    if !t.is_finite() {
        return Err(StartError::Parameter { name: "start time", value: t, must: "be finite" });
    }
    let (mut q, mut v) = (q.to_vec(), v.to_vec());
    mechanics.prescribe(t, &mut q, &mut v);
    match q.iter().zip(&v).position(|(q, v)| !q.is_finite() || !v.is_finite()) {
        Some(i) => Err(StartError::NotFinite(mechanics.coordinate_name(i))),
        None => Ok(State { t, q, v, lambda: vec![0.0; sizes.constraints], ..State::default() }),
    }
}

/// Checks the constraints and projects the velocities.
pub(crate) fn project(projector: &mut Projector<'_>, mut state: State) -> Result<State, StartError> {
    let (worst, residual) = projector.constraint_residual(&state.q);
    if residual > ASSEMBLED || residual.is_nan() {
        let constraint = projector.mechanics().constraint_name(worst);
        return Err(StartError::Inconsistent { constraint, residual });
    }
    projector.velocity(&state.q, &mut state.v)?;
    Ok(state)
}

/// Refuses a step that is not positive and finite, and a state whose vectors are not those of the system's sizes and of
/// the scheme's memory.
pub(crate) fn step(state: &State, h: f64, sizes: Sizes, memory: usize) -> Result<(), StepError> {
    let refuse = |failure| Err(StepError { t: state.t, h, residual: f64::NAN, failure });
    if !(h.is_finite() && h > 0.0) {
        return refuse(StepFailure::BadStep);
    }
    let vectors = [
        ("coordinates", &state.q, sizes.coordinates),
        ("velocities", &state.v, sizes.coordinates),
        ("multipliers", &state.lambda, sizes.constraints),
        ("numbers in memory", &state.memory, memory),
    ];
    match vectors.into_iter().find(|(_, vector, expected)| vector.len() != *expected) {
        None => Ok(()),
        Some((what, vector, expected)) => {
            refuse(StepFailure::ForeignState { what, got: vector.len(), expected })
        }
    }
}

/// Sum of all coordinates and velocities beyond which a motion counts as unbounded: of such a coordinate the rounding is a metre.
const UNBOUNDED: f64 = 1e15;

/// Refuses what an explicit scheme came to, if it is not finite or has no bound. `explicit` schemes have no residual that would
/// say so.
pub(crate) fn bounded(mechanics: &dyn Mechanics, q: &[f64], v: &[f64]) -> Result<(), StepFailure> {
    let sum: f64 = q.iter().zip(v).map(|(q, v)| q.abs() + v.abs()).sum();
    if sum < UNBOUNDED { Ok(()) } else { Err(unbounded(mechanics, q, v)) }
}

#[cold]
fn unbounded(mechanics: &dyn Mechanics, q: &[f64], v: &[f64]) -> StepFailure {
    let sizes = || q.iter().zip(v).map(|(q, v)| q.abs() + v.abs()).enumerate();
    // A number that is none weighs most.
    let (worst, size) =
        sizes().fold(
            (0, 0.0),
            |most, (i, size)| if size <= most.1 || f64::is_nan(most.1) { most } else { (i, size) },
        );
    let (name, cables) = (mechanics.coordinate_name(worst), mechanics.cables_at(worst));
    if size.is_finite() {
        StepFailure::Unbounded { size, worst: name, cables }
    } else {
        StepFailure::NotFinite { worst: name, cables }
    }
}
