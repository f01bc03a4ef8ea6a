//! What is refused, and how it is named.

use crate::support::{all_modes, as_built, equilibrium, mast, oscillator};
use tg_fixtures::{prism, spine};
use tg_modal::{Input, ModalError, ModeOptions, Output, SupportMotion, modes, participation, state_space};
use tg_model::{CableLaw, Mechanics, ModelBuilder};
use tg_tangent::Configuration;

#[test]
fn no_equilibrium_names_the_coordinate_and_the_imbalance() {
    let mast = mast(0.0, 0.0);
    let error = modes(&mast.model, &as_built(&mast.model), &ModeOptions::all()).unwrap_err();
    let ModalError::NotInEquilibrium { coordinate, imbalance, tolerance } = &error else { panic!("{error}") };
    assert!(*imbalance > *tolerance && *tolerance == 1e-8);
    assert!(coordinate.contains("mast") || coordinate.contains("bob"), "{coordinate}");
    assert!(error.to_string().contains(coordinate.as_str()));
}

#[test]
fn a_violated_constraint_is_named() {
    let prism = prism(3, 20.0, 0.0, CableLaw::slacking).unwrap();
    let mut q = prism.model.initial_coordinates();
    q.iter_mut().for_each(|x| *x *= 1.001);
    let at = Configuration::at(&prism.model, &q, &prism.model.inputs_at(0.0)).unwrap();
    let error = modes(&prism.model, &at, &ModeOptions::all()).unwrap_err();
    let ModalError::Inconsistent { constraint, residual, .. } = &error else { panic!("{error}") };
    assert!(constraint.contains("bar"), "{constraint}");
    assert!(*residual > 1e-3);
}

#[test]
fn support_motions_must_move_supports() {
    let mast = mast(0.0, 0.0);
    let at = equilibrium(&mast.model, &mast.model.initial_coordinates(), &mast.model.inputs_at(0.0));
    let free = mast.model.free()[0];
    let refused = |direction: &[(usize, f64)]| {
        SupportMotion::quasi_static(&mast.model, &at, "push", direction).unwrap_err()
    };
    assert!(matches!(refused(&[(free, 1.0)]), ModalError::NotPrescribed { .. }));
    assert!(matches!(refused(&[]), ModalError::NoSupportMoves { .. }));
    assert!(matches!(refused(&[(10_000, 1.0)]), ModalError::NoSuch { what: "coordinate", .. }));
    let error = SupportMotion::translation(&mast.model, &at, 2).unwrap_err();
    assert!(matches!(error, ModalError::NoSuch { what: "axis", count: 2, .. }));
}

/// Cables without tension hold a particle along them only.
#[test]
fn a_mechanism_has_no_quasi_static_response() {
    let mut b = ModelBuilder::<2>::new();
    oscillator(&mut b, "bead", [0.0, 0.0], 1.0, &CableLaw::linear(100.0), 0.0);
    let model = b.build().unwrap();
    let at = as_built(&model);
    let prescribed = (0..model.sizes().coordinates).find(|i| !model.free().contains(i)).unwrap();
    let error = SupportMotion::quasi_static(&model, &at, "shake", &[(prescribed, 1.0)]).unwrap_err();
    assert!(matches!(error, ModalError::NoQuasiStaticResponse { zero: 1, .. }), "{error}");
}

#[test]
fn wrong_sizes_are_refused() {
    let (small, large) = (spine(1, 8.0, 0.0).unwrap(), spine(2, 8.0, 0.0).unwrap());
    let at = as_built(&small.model);
    let found = all_modes(&small.model, &at);
    let motion = SupportMotion::translation(&large.model, &as_built(&large.model), 0).unwrap();
    let refused = participation(&small.model, &at, &found, &motion).unwrap_err();
    assert!(matches!(refused, ModalError::Length { .. }));
    let refuse = |inputs: &[Input], outputs: &[Output]| {
        state_space(&small.model, &at, &found, inputs, outputs).unwrap_err()
    };
    assert!(matches!(refuse(&[Input::Ground(motion)], &[]), ModalError::Length { .. }));
    let parameter = Input::Parameter { name: "none".into(), index: 99 };
    assert!(matches!(refuse(&[parameter], &[]), ModalError::NoSuch { what: "input", .. }));
    let output = Output::displacement("none", &[(999, 1.0)]);
    assert!(matches!(refuse(&[], &[output]), ModalError::NoSuch { what: "coordinate", .. }));
    assert!(Input::rest_length(&small.model, 6).is_err());
}
