//! A parallelogram at its change point: all bars on one line, two branches of motion meet.

use std::f64::consts::PI;

use crate::support::{composition, explicit, fixed, symplectic};
use tg_integrate::{CompositionScheme, EmbeddedPair, Run, Stepper};
use tg_model::{Joining, Model, ModelBuilder};

/// Crank and rocker of 1 m, coupler of 2 m, the crank `before` its change point; full velocities of 1 rad/s, the coupler's end.
fn parallelogram(before: f64) -> (Model<2>, Vec<f64>, usize) {
    let (y, x) = (PI - before).sin_cos();
    let mut b = ModelBuilder::<2>::new();
    let left = b.anchor("left", [0.0, 0.0]).unwrap();
    let right = b.anchor("right", [2.0, 0.0]).unwrap();
    let crank = b.bar("crank", 1.0, [0.0, 0.0], [x, y]).unwrap();
    let coupler = b.bar("coupler", 1.0, [x, y], [2.0 + x, y]).unwrap();
    let rocker = b.bar("rocker", 1.0, [2.0, 0.0], [2.0 + x, y]).unwrap();
    for (name, places) in [
        ("left hinge", [left.into(), crank.node(0)]),
        ("right hinge", [right.into(), rocker.node(0)]),
        ("left knee", [crank.node(1), coupler.node(0)]),
        ("right knee", [rocker.node(1), coupler.node(1)]),
    ] {
        b.joint(name, &places, Joining::Share).unwrap();
    }
    let model = b.build().unwrap();
    let mut v = model.velocities_at_rest();
    let nodes = model.member_node_ids(coupler).to_vec();
    nodes.iter().for_each(|node| v[2 * node..2 * node + 2].copy_from_slice(&[-y, x]));
    (model, v, 2 * nodes[1])
}

/// Whether steps of 0.01 s end near the change point or on it: a scheme goes on along its branch, or says that it cannot.
#[test]
fn change_point_is_passed_or_refused() {
    let mut passed = 0;
    for miss in [5e-3, 1e-3, 1e-5, 1e-8, 1e-12, 0.0] {
        let (model, v, end) = parallelogram(1.0 + miss);
        let steppers: [Box<dyn Stepper + '_>; 6] = [
            Box::new(symplectic(&model)),
            Box::new(composition(&model, CompositionScheme::Suzuki4)),
            Box::new(composition(&model, CompositionScheme::KahanLi6)),
            Box::new(fixed(&model, EmbeddedPair::DormandPrince8)),
            Box::new(explicit(&model, EmbeddedPair::DormandPrince5, 1e-8)),
            Box::new(explicit(&model, EmbeddedPair::DormandPrince8, 1e-10)),
        ];
        for (k, mut stepper) in steppers.into_iter().enumerate() {
            let mut state = stepper.start(0.0, &model.initial_coordinates(), &v).unwrap();
            match Run::new(0.01, 1.5).go(stepper.as_mut(), &mut state) {
                Ok(_) => {
                    let angle = PI - 1.0 - miss + 1.5;
                    let error = (state.q[end] - 2.0 - angle.cos()).hypot(state.q[end + 1] - angle.sin());
                    assert!(error < 1e-3, "{k} at {miss:e}: {error:e}");
                    passed += 1;
                }
                Err(error) => {
                    println!("{k} at {miss:e}: {error}");
                    assert!((error.failure.t - 1.0).abs() < 0.03, "{k} at {miss:e}: {error}");
                }
            }
        }
    }
    assert!(passed > 10, "{passed}");
}
