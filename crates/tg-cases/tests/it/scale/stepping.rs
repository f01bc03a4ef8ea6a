//! Time stepping by every scheme.

use tg_integrate::{
    Composition, CompositionScheme, EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, Run, RungeKutta,
    Stepper, Symplectic, Tolerances,
};
use tg_model::Model;

use super::structures::crane;
use super::{Outcome, Units, assert_similar, per};

/// Coordinates, velocities and energy of the crane after half a unit of time; where steps are chosen, in a few long ones.
fn path(
    units: Units,
    step: f64,
    stepper: impl for<'m> Fn(&'m Model<3>, Units) -> Outcome<Box<dyn Stepper + 'm>>,
) -> Outcome<Vec<Vec<f64>>> {
    let model = crane(units)?;
    let mut stepper = stepper(&model, units)?;
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
    Run::new(step * units.time, 0.5 * units.time).go(stepper.as_mut(), &mut state)?;
    let energy = model.energy(&state.q, &state.v, &model.inputs_at(state.t)).total();
    Ok(vec![
        per(units.length, state.q),
        per(units.length / units.time, state.v),
        per(units.energy(), [energy]),
    ])
}

#[test]
fn symplectic() {
    assert_similar("symplectic", |units| {
        path(units, 2e-3, |model, _| Ok(Box::new(Symplectic::new(model, NewtonOptions::default())?)))
    });
}

#[test]
fn generalized_alpha() {
    assert_similar("generalised-α", |units| {
        path(units, 2e-3, |model, _| {
            Ok(Box::new(GeneralizedAlpha::new(model, 0.8, NewtonOptions::default())?))
        })
    });
}

#[test]
fn leapfrog() {
    assert_similar("leapfrog", |units| {
        path(units, 2e-3, |model, _| Ok(Box::new(Leapfrog::new(model, NewtonOptions::default())?)))
    });
}

#[test]
fn compositions() {
    for scheme in [CompositionScheme::Suzuki4, CompositionScheme::KahanLi6] {
        assert_similar(&format!("{scheme:?}"), |units| {
            path(units, 4e-3, |model, _| {
                Ok(Box::new(Composition::new(model, scheme, NewtonOptions::default())?))
            })
        });
    }
}

#[test]
fn runge_kutta_with_fixed_steps() {
    for pair in [EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8] {
        assert_similar(&format!("{pair:?}, fixed"), |units| {
            path(units, 2e-3, |model, _| Ok(Box::new(RungeKutta::fixed(model, pair)?)))
        });
    }
}

#[test]
fn runge_kutta_under_error_control() {
    for pair in [EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8] {
        assert_similar(&format!("{pair:?}, controlled"), |units| {
            path(units, 0.1, |model, _| {
                Ok(Box::new(RungeKutta::new(model, pair, Tolerances::relative(1e-8))?))
            })
        });
    }
}
