//! Prescribed coordinates and inputs as functions of time.

use std::f64::consts::TAU;

use approx::assert_relative_eq;
use tg_model::{CableLaw, Form, Mechanics, Model, ModelBuilder, Place, Signal};

fn only_node(form: Form<3>) -> usize {
    assert_eq!(form.terms().len(), 1);
    form.terms()[0].0
}

/// Anchors at rest and shaken, a bar with one supported component, a supported base vector, a driven material point.
fn driven() -> (Model<3>, [usize; 5]) {
    let mut b = ModelBuilder::<3>::new();
    let still = b.anchor("still", [1.0, 2.0, 3.0]).unwrap();
    let shaken = b.anchor("shaken", [4.0, 5.0, 6.0]).unwrap();
    let bar = b.bar("bar", 1.0, [0.0, 0.0, 0.0], [0.0, 0.0, 2.0]).unwrap();
    let rod = b
        .member(
            "rod",
            tg_coords::Member::thin_rod(1.0, [0.0; 3].into(), [1.0, 0.0, 0.0].into())
                .unwrap()
                .with_type(tg_coords::CoordType::Ru)
                .unwrap(),
            tg_coords::Pose::translation([0.0, 7.0, 0.0].into()),
        )
        .unwrap();
    b.shake("quake", shaken, Signal::sine(0.1, 2.0)).unwrap();
    b.support("rail", bar.node(0), 2, 0.25).unwrap();
    b.support("twist", rod.node(1), 1, Signal::ramp(0.0, 0.5, 2.0)).unwrap();
    b.support("lift", bar.at([0.0, 0.0, 0.5]), 0, Signal::ramp(0.0, 1.0, 4.0)).unwrap();
    b.cable("long", still, bar.node(1), CableLaw::linear(1.0), 0.7).unwrap();
    b.cable("reel", shaken, bar.node(1), CableLaw::linear(1.0), Signal::ramp(0.6, 0.2, 4.0)).unwrap();
    b.load("push", bar.node(0), [1.0, -2.0, 3.0], Signal::sine(2.0, 0.25)).unwrap();
    b.load("dead", rod.node(0), [0.5, 0.0, -0.5], 2.0).unwrap();
    let model = b.build().unwrap();
    let node = |place: Place<3>| only_node(model.form(place).unwrap());
    let nodes = [node(still.into()), node(shaken.into()), node(bar.node(0)), node(rod.node(1))];
    let nodes = [nodes[0], nodes[1], nodes[2], nodes[3], model.sizes().coordinates / 3 - 1];
    (model, nodes)
}

#[test]
fn supports_prescribe_their_components_and_no_others() {
    let (model, [still, shaken, bar, rod, hidden]) = driven();
    let n = model.sizes().coordinates;
    let (mut q, mut v) = (vec![7e7; n], vec![8e8; n]);
    let t = 0.3;
    model.prescribe(t, &mut q, &mut v);
    let mut expected = vec![(7e7, 8e8); n];
    let (s, c) = (TAU * 2.0 * t).sin_cos();
    for (d, x) in [1.0, 2.0, 3.0].into_iter().enumerate() {
        expected[still * 3 + d] = (x, 0.0);
    }
    expected[shaken * 3] = (4.0 + 0.1 * s, 0.1 * TAU * 2.0 * c);
    expected[shaken * 3 + 1] = (5.0, 0.0);
    expected[shaken * 3 + 2] = (6.0, 0.0);
    expected[bar * 3 + 2] = (0.25, 0.0);
    expected[rod * 3 + 1] = (0.25 * t, 0.25);
    // The hidden base of the support at a material point.
    expected[hidden * 3] = (0.25 * t, 0.25);
    expected[hidden * 3 + 1] = (0.0, 0.0);
    expected[hidden * 3 + 2] = (0.5, 0.0);
    for (i, (x, rate)) in expected.iter().enumerate() {
        assert_relative_eq!(q[i], *x, epsilon = 1e-14);
        assert_relative_eq!(v[i], *rate, epsilon = 1e-14);
    }
    let free: Vec<usize> = (0..n).filter(|&i| expected[i].0 == 7e7).collect();
    assert_eq!(model.free(), free);
    let features = model.features();
    assert!(features.moving_supports && features.driven_inputs && !features.damping);
}

#[test]
fn prescribed_rates_and_accelerations_are_derivatives() {
    let (model, _) = driven();
    let n = model.sizes().coordinates;
    let at = |t: f64| {
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        model.prescribe(t, &mut q, &mut v);
        (q, v)
    };
    let (t, h) = (0.7, 1e-4);
    let ((after, faster), (before, slower), (_, rate)) = (at(t + h), at(t - h), at(t));
    let mut acceleration = vec![0.0; n];
    model.prescribed_acceleration(t, &mut acceleration);
    for i in 0..n {
        assert_relative_eq!(rate[i], (after[i] - before[i]) / (2.0 * h), epsilon = 1e-5);
        assert_relative_eq!(acceleration[i], (faster[i] - slower[i]) / (2.0 * h), epsilon = 1e-3);
    }
    assert!(acceleration.iter().any(|a| a.abs() > 1.0));
}

#[test]
fn initial_state_holds_the_prescribed_values_at_time_zero() {
    let (model, [_, shaken, bar, rod, hidden]) = driven();
    let (q, v) = (model.initial_coordinates(), model.velocities_at_rest());
    assert_eq!(q[bar * 3 + 2], 0.25, "a constant offset counts from the start");
    assert_eq!((q[shaken * 3], q[rod * 3], q[rod * 3 + 1]), (4.0, 1.0, 0.0));
    let mut rates = vec![0.0; v.len()];
    rates[shaken * 3] = 0.1 * TAU * 2.0;
    rates[rod * 3 + 1] = 0.25;
    rates[hidden * 3] = 0.25;
    for (v, rate) in v.iter().zip(rates) {
        assert_relative_eq!(*v, rate, epsilon = 1e-15);
    }
}

#[test]
fn inputs_are_rest_lengths_then_force_components() {
    let (model, _) = driven();
    let s = (TAU * 0.25 * 0.5).sin() * 2.0;
    let expected = [0.7, 0.6 - 0.1 * 0.5, s, -2.0 * s, 3.0 * s, 1.0, 0.0, -1.0];
    let found = model.inputs_at(0.5);
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert_relative_eq!(*found, expected, epsilon = 1e-15);
    }
    let mut u = vec![f64::NAN; model.sizes().inputs];
    model.inputs(9.0, &mut u);
    assert_relative_eq!(u[1], 0.2);
    assert_eq!(u[0], 0.7);
}

#[test]
fn nothing_driven_means_no_such_feature() {
    let mut b = ModelBuilder::<2>::new();
    let peg = b.anchor("peg", [0.0, 1.0]).unwrap();
    let ball = b.particle("ball", 1.0, [0.0, 0.0]).unwrap();
    b.support("offset", peg, 0, Signal::Sum(vec![0.1.into(), 0.2.into()])).unwrap();
    b.cable("tie", peg, ball.node(0), CableLaw::linear(1.0), 0.7).unwrap();
    b.load("dead", ball.node(0), [0.0, -1.0], 1.0).unwrap();
    let model = b.build().unwrap();
    let features = model.features();
    assert!(!features.moving_supports && !features.driven_inputs);
    assert_relative_eq!(model.initial_coordinates()[2], 0.3);
}

#[test]
fn a_moved_anchor_carries_what_is_shared_with_it() {
    let mut b = ModelBuilder::<2>::new();
    let peg = b.anchor("peg", [1.0, 0.0]).unwrap();
    let bar = b.bar("bar", 1.0, [1.0, 0.0], [1.0, 1.0]).unwrap();
    b.joint("foot", &[bar.node(0), peg.into()], tg_model::Joining::Share).unwrap();
    b.shake("quake", peg, Signal::sine(0.5, 1.0)).unwrap();
    let model = b.build().unwrap();
    assert_eq!(model.form(bar.node(0)).unwrap(), model.form(peg).unwrap());
    let (mut q, mut v) = (model.initial_coordinates(), model.velocities_at_rest());
    model.prescribe(0.25, &mut q, &mut v);
    assert_relative_eq!(model.member_nodes(bar, &q)[0], nalgebra::Vector2::new(1.5, 0.0), epsilon = 1e-14);
    assert_eq!(model.free().len(), 2);
}
