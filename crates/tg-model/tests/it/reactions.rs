//! Reactions of a rod on a hinge against closed forms.

use tg_model::{Model, ModelBuilder, Reactions, Signal};

const MASS: f64 = 2.0;
const LENGTH: f64 = 0.8;
const G: f64 = 9.81;

/// A rod from a hinge at the origin, the hinge moving along x.
fn rod(to: [f64; 2], ground: Signal) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -G]).unwrap();
    let rod = b.bar("rod", MASS, [0.0, 0.0], to).unwrap();
    b.shake("hinge", rod.node(0), ground).unwrap();
    b.build().unwrap()
}

#[track_caller]
fn check(model: &Model<2>, t: f64, v: &[f64], expected: [f64; 2]) {
    let mut q = model.initial_coordinates();
    let mut moving = v.to_vec();
    model.mechanics().prescribe(t, &mut q, &mut moving);
    // The rod is carried along with its hinge.
    let shift = q[0] - model.initial_coordinates()[0];
    q[2] += shift;
    moving[2] += moving[0];
    let mut reactions = Reactions::new(model).unwrap();
    let found = reactions.at(t, &q, &moving).unwrap();
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - expected).abs() < 1e-8, "{found} against {expected}");
    }
}

#[test]
fn a_horizontal_rod_released_from_rest_weighs_a_quarter() {
    let model = rod([LENGTH, 0.0], Signal::Constant(0.0));
    check(&model, 0.0, &[0.0; 4], [0.0, MASS * G / 4.0]);
}

#[test]
fn a_swinging_rod_pulls_with_its_centripetal_force() {
    let model = rod([0.0, -LENGTH], Signal::Constant(0.0));
    let spin = 3.0;
    check(&model, 0.0, &[0.0, 0.0, spin * LENGTH, 0.0], [0.0, MASS * (G + spin * spin * LENGTH / 2.0)]);
}

#[test]
fn a_hinge_that_accelerates_moves_a_quarter_of_a_hanging_rod() {
    let (amplitude, frequency) = (0.01, 2.0);
    let model = rod([0.0, -LENGTH], Signal::sine(amplitude, frequency));
    let omega = std::f64::consts::TAU * frequency;
    let t: f64 = 0.1;
    let acceleration = -amplitude * omega * omega * (omega * t).sin();
    check(&model, t, &[0.0; 4], [MASS * acceleration / 4.0, MASS * G]);
}
