//! Checkpoints with foreign numbers: the first byte tells the scheme; then ten bytes each, two for the place of a number in the
//! state, eight for what it becomes. Three steps from there end in states or in errors with words; nothing may panic or hang.
#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use tg_integrate::{
    Composition, CompositionScheme, EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, RungeKutta,
    StartError, State, Stepper, Symplectic, Tolerances,
};
use tg_model::{CableLaw, Joining, Model, ModelBuilder, Signal};

const STEP: f64 = 1e-2;

/// Two bars on a moving support, a damped cable that goes slack, a rest length that is reeled in.
static MODEL: LazyLock<Model<2>> = LazyLock::new(|| {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).expect("a direction");
    let pivot = b.anchor("pivot", [0.0, 0.0]).expect("an anchor");
    let peg = b.anchor("peg", [2.0, 0.5]).expect("an anchor");
    b.support("ground", pivot, 0, Signal::sine(0.01, 1.0)).expect("a support");
    let upper = b.bar("upper", 1.0, [0.0, 0.0], [1.0, 0.0]).expect("a bar");
    let lower = b.bar("lower", 1.0, [1.0, 0.0], [1.0, -1.0]).expect("a bar");
    b.joint("hinge", &[pivot.into(), upper.node(0)], Joining::Share).expect("a joint");
    b.joint("knee", &[upper.node(1), lower.node(0)], Joining::Constrain).expect("a joint");
    let law = CableLaw::slacking(100.0).with_damping(0.5);
    b.cable("guy", peg, lower.node(1), law, Signal::ramp(1.7, 1.5, 1.0)).expect("a cable");
    b.build().expect("a model")
});

fn stepper(which: u8) -> Result<Box<dyn Stepper>, StartError> {
    let options = NewtonOptions::default();
    let tolerances = Tolerances { most_substeps: 1000, ..Tolerances::default() };
    let model: &'static Model<2> = &MODEL;
    Ok(match which % 8 {
        0 => Box::new(Symplectic::new(model, options)?),
        1 => Box::new(Symplectic::new(model, options)?.carrying_momentum()),
        2 => Box::new(GeneralizedAlpha::new(model, 0.7, options)?),
        3 => Box::new(Leapfrog::new(model, options)?),
        4 => Box::new(Composition::new(model, CompositionScheme::Suzuki4, options)?),
        5 => Box::new(RungeKutta::fixed(model, EmbeddedPair::DormandPrince5)?),
        6 => Box::new(RungeKutta::new(model, EmbeddedPair::DormandPrince5, tolerances)?),
        _ => Box::new(RungeKutta::new(model, EmbeddedPair::DormandPrince8, tolerances)?),
    })
}

/// What a run carries after two steps.
fn sound(stepper: &mut dyn Stepper) -> State {
    let (q, v) = (MODEL.initial_coordinates(), MODEL.velocities_at_rest());
    let mut state = stepper.start(0.0, &q, &v).expect("a start");
    (0..2).for_each(|_| drop(stepper.step(&mut state, STEP).expect("a step")));
    state
}

/// The number at a place of a state.
fn at(state: &mut State, place: usize) -> &mut f64 {
    let State { t, t_rest, q, v, lambda, memory } = state;
    let mut all: Vec<&mut f64> =
        [t, t_rest].into_iter().chain(q).chain(v).chain(lambda).chain(memory).collect();
    let count = all.len();
    all.swap_remove(place % count)
}

fuzz_target!(|data: &[u8]| {
    let Some((&which, edits)) = data.split_first() else { return };
    let mut stepper = stepper(which).expect("a stepper");
    let mut state = sound(stepper.as_mut());
    for edit in edits.chunks_exact(10) {
        let (place, number) = edit.split_at(2);
        let number = f64::from_le_bytes(number.try_into().expect("eight bytes"));
        *at(&mut state, usize::from(u16::from_le_bytes([place[0], place[1]]))) = number;
    }
    // As a checkpoint is written and read; numbers that are none are not written.
    let Ok(read) = serde_json::from_str::<State>(&serde_json::to_string(&state).expect("text")) else { return };
    state = read;
    for _ in 0..3 {
        if let Err(error) = stepper.step(&mut state, STEP) {
            assert!(!error.to_string().is_empty());
            return;
        }
    }
});
