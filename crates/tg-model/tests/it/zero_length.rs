//! Springs of zero free length: linear in the coordinates, so that everything about them is known.

use nalgebra::Vector2;
use tg_model::{At, CableLaw, Joining, Mechanics, ModelBuilder};

use crate::support::{Random, assert_close, derivative, force, select, stiffness};

/// F = -κ JᵀJ q exactly, with or without slacking, since the length is never below zero.
#[test]
fn a_spring_of_zero_free_length_is_linear() {
    for law in [CableLaw::linear(50.0), CableLaw::slacking(50.0)] {
        let mut b = ModelBuilder::<3>::new();
        let anchor = b.anchor("hook", [0.0, 0.0, 2.0]).unwrap();
        let bar = b.bar("bar", 1.0, [1.0, 0.0, 0.0], [1.0, 0.2, 1.0]).unwrap();
        let spring = b.cable("spring", anchor, bar.node(1), law, 0.0).unwrap();
        let model = b.build().unwrap();
        let r = &mut Random::new(3);
        let u = model.inputs_at(0.0);
        let mut constant = None;
        for _ in 0..5 {
            let mut q = r.vector(model.sizes().coordinates, 2.0);
            model.prescribe(0.0, &mut q, &mut [0.0; 9]);
            let rest = vec![0.0; q.len()];
            let at = At { q: &q, v: &rest, u: &u, taut: None };
            let state = model.cable(spring, &q, &rest, &u);
            assert!((state.tension - 50.0 * state.length).abs() < 1e-12 && !state.slack);
            let energy = model.energy(&q, &rest, &u).elastic;
            assert!((energy - 25.0 * state.length.powi(2)).abs() < 1e-11);
            let free = model.free();
            let found = select(&stiffness(&model, at), free, free);
            let expected = -derivative(&q, 1e-2, |q| force(&model, At { q, v: &rest, u: &u, taut: None }));
            assert_close(&found, &select(&expected, free, free), 1e-10, "-∂F/∂q");
            let first = constant.get_or_insert_with(|| found.clone());
            assert_close(&found, first, 1e-13, "the same everywhere");
        }
    }
}

/// The balanced lamp: κ h b = m g a, and the arm rests at every angle.
#[test]
fn an_arm_on_a_spring_of_zero_free_length_rests_everywhere() {
    let (mass, g, length, height, at) = (2.0, 9.81, 0.8, 0.5, 0.3);
    let kappa = mass * g * 0.5 * length / (height * at);
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -g]).unwrap();
    let pivot = b.anchor("pivot", [0.0, 0.0]).unwrap();
    let hook = b.anchor("hook", [0.0, height]).unwrap();
    let arm = b.bar("arm", mass, [0.0, 0.0], [length, 0.0]).unwrap();
    b.joint("hinge", &[pivot.into(), arm.node(0)], Joining::Share).unwrap();
    b.cable("spring", hook, arm.at([at, 0.0]), CableLaw::linear(kappa), 0.0).unwrap();
    let model = b.build().unwrap();
    let u = model.inputs_at(0.0);
    for k in 0..16 {
        let (sin, cos) = (0.4 * f64::from(k)).sin_cos();
        let mut q = model.initial_coordinates();
        q[2..4].copy_from_slice(&[length * cos, length * sin]);
        let f = force(&model, At { q: &q, v: &[0.0; 6], u: &u, taut: None });
        let across = Vector2::new(f[2], f[3]).dot(&Vector2::new(-sin, cos));
        assert!(across.abs() < 1e-13, "{k}: {across:e}");
    }
}
