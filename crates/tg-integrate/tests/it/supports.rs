//! Supports that jump, under a joint and under a cable.

use crate::support::{alpha, composition, explicit, fixed, symplectic};
use tg_integrate::{
    CompositionScheme, EmbeddedPair, Leapfrog, NewtonOptions, Run, RunError, State, StepFailure, Stepper,
};
use tg_model::{CableLaw, Joining, Model, ModelBuilder, Signal};

/// Between the ends of two steps of 1 ms.
const AT: f64 = 0.100_5;

/// A bar of 1 m on a hinge below it that moves sideways, without gravity; the coordinate of its tip's x.
fn hinged(offset: Signal) -> (Model<2>, usize) {
    let mut b = ModelBuilder::<2>::new();
    let ground = b.anchor("ground", [0.0, 0.0]).unwrap();
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.0, 1.0]).unwrap();
    b.joint("hinge", &[ground.into(), bar.node(0)], Joining::Share).unwrap();
    b.shake("jump", ground, offset).unwrap();
    let model = b.build().unwrap();
    let tip = 2 * model.member_node_ids(bar)[1];
    (model, tip)
}

fn leapfrog(model: &Model<2>) -> Leapfrog<'_> {
    Leapfrog::new(model, NewtonOptions::default()).unwrap()
}

fn steppers(model: &Model<2>) -> [Box<dyn Stepper + '_>; 8] {
    [
        Box::new(symplectic(model)),
        Box::new(alpha(model, 0.7)),
        Box::new(leapfrog(model)),
        Box::new(composition(model, CompositionScheme::Suzuki4)),
        Box::new(fixed(model, EmbeddedPair::DormandPrince5)),
        Box::new(fixed(model, EmbeddedPair::DormandPrince8)),
        Box::new(explicit(model, EmbeddedPair::DormandPrince5, 1e-8)),
        Box::new(explicit(model, EmbeddedPair::DormandPrince8, 1e-10)),
    ]
}

fn to_half_a_second(model: &Model<2>, stepper: &mut dyn Stepper) -> Result<State, RunError> {
    let (q, v) = (model.initial_coordinates(), model.velocities_at_rest());
    let mut state = stepper.start(0.0, &q, &v).unwrap();
    Run::new(1e-3, 0.5).go(stepper, &mut state).map(|_| state)
}

/// A hinge that begins to move with v gives the bar a quarter of its momentum m v, and it turns with 3v/2l: a ramp's kink
/// within a step.
#[test]
fn kick_of_a_hinge_turns_its_bar() {
    let (model, tip) = hinged(Signal::Ramp { from: 0.0, to: 10.0, start: AT, duration: 10.0 });
    let since = 0.5 - AT;
    for (k, mut stepper) in steppers(&model).into_iter().enumerate() {
        let state = to_half_a_second(&model, stepper.as_mut()).unwrap();
        let error = (state.q[tip] - (since - (1.5 * since).sin())).abs();
        println!("{k}: {error:e}");
        // Fixed steps give the kick where they end; error control finds it.
        let limit = [1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-6, 1e-8][k];
        assert!(error < limit, "{k}: {error:e}");
    }
}

/// The impulse of a jump in position has no bound.
#[test]
fn jump_of_a_hinge_in_position_is_refused() {
    let jump = || Signal::user(|t| (if t < AT { 0.0 } else { 0.1 }, 0.0));
    let (model, _) = hinged(jump());
    for (k, mut stepper) in steppers(&model).into_iter().enumerate() {
        let error = to_half_a_second(&model, stepper.as_mut()).unwrap_err();
        println!("{error}");
        // Of a composition, the beginning of its part.
        assert!((0.1..0.101).contains(&(error.failure.t + 1e-9)), "{error}");
        match &error.failure.failure {
            StepFailure::SupportJumps { coordinate, distance } if k < 6 => {
                assert!(coordinate.contains("bar") || coordinate.contains("ground"), "{coordinate}");
                assert!((distance - 0.1).abs() < 1e-12);
            }
            StepFailure::StepTooSmall { at, .. } if k >= 6 => assert!((at - AT).abs() < 1e-9),
            other => panic!("{k}: {other}"),
        }
    }
}

/// Under a cable it is another length, no more: x = d (1 - cos ω(t - t₀)).
#[test]
fn jump_under_a_cable_is_taken() {
    let mut b = ModelBuilder::<2>::new();
    let ground = b.anchor("ground", [0.0, 0.0]).unwrap();
    b.shake("jump", ground, Signal::user(|t| (if t < AT { 0.0 } else { 0.1 }, 0.0))).unwrap();
    let stone = b.particle("stone", 1.0, [1.0, 0.0]).unwrap();
    b.cable("spring", ground, stone.node(0), CableLaw::linear(100.0), 1.0).unwrap();
    let model = b.build().unwrap();
    let x = 2 * model.member_node_ids(stone)[0];
    let exact = 1.0 + 0.1 * (1.0 - (10.0 * (0.5 - AT)).cos());
    for (k, mut stepper) in steppers(&model).into_iter().enumerate() {
        let state = to_half_a_second(&model, stepper.as_mut()).unwrap();
        let error = (state.q[x] - exact).abs();
        println!("{k}: {error:e}");
        assert!(error < [1e-4, 1e-4, 1e-4, 1e-4, 1e-3, 1e-3, 1e-7, 1e-9][k], "{k}: {error:e}");
    }
}
