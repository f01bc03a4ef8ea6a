//! A state written and read back continues bit for bit, and so does a run in several parts.

use crate::support::tower::{self, tower};
use crate::support::{alpha, example1, run, start, symplectic};
use tg_integrate::{State, Stepper};
use tg_model::Model;

type Make = for<'m> fn(&'m Model<2>) -> Box<dyn Stepper + 'm>;
const SCHEMES: [(&str, Make); 3] = [
    ("symplectic", |m| Box::new(symplectic(m))),
    ("momentum as printed", |m| Box::new(symplectic(m).carrying_momentum())),
    ("generalised-alpha", |m| Box::new(alpha(m, 0.7))),
];

fn bits(state: &State) -> Vec<u64> {
    let numbers = [&[state.t, state.t_rest], &state.q[..], &state.v, &state.lambda, &state.memory];
    numbers.concat().into_iter().map(f64::to_bits).collect()
}

/// Whole runs against runs in parts, each part with a new stepper from a state read back from JSON.
fn parts(name: &str, model: &Model<2>, h: f64, ends: &[f64]) {
    for (scheme, make) in SCHEMES {
        let mut whole = start(model, make(model).as_mut());
        run(make(model).as_mut(), &mut whole, h, ends[ends.len() - 1]);

        let mut text = serde_json::to_string(&start(model, make(model).as_mut())).unwrap();
        for &end in ends {
            let mut state: State = serde_json::from_str(&text).unwrap();
            run(make(model).as_mut(), &mut state, h, end);
            text = serde_json::to_string(&state).unwrap();
        }
        let last: State = serde_json::from_str(&text).unwrap();
        assert_eq!(bits(&last), bits(&whole), "{name}, {scheme}");

        // One stepper, several calls: nothing but the state is carried.
        let mut stepper = make(model);
        let mut state = start(model, stepper.as_mut());
        for &end in ends {
            run(stepper.as_mut(), &mut state, h, end);
        }
        assert_eq!(bits(&state), bits(&whole), "{name}, {scheme}, one stepper");
    }
}

#[test]
fn runs_in_parts_are_the_whole_run_bit_for_bit() {
    parts("example 1", &example1().model, 1e-3, &[0.1, 0.25, 0.7, 1.0]);
    parts("UN", &tower(tower::UN).model, 1e-3, &[0.3, 0.5]);
    parts("US", &tower(tower::US).model, 1e-3, &[0.123, 0.4, 0.8]);
}

/// Also across steps that are divided and held against their law.
#[test]
fn the_remedy_keeps_no_memory() {
    let model = tower(tower::DAMPED_SLACKING).model;
    let mut whole = start(&model, &mut symplectic(&model));
    let summary = run(&mut symplectic(&model), &mut whole, 2e-3, 1.6);
    assert!(summary.divided > 0);
    let mut state = start(&model, &mut symplectic(&model));
    for k in 1..=8 {
        run(&mut symplectic(&model), &mut state, 2e-3, 0.2 * f64::from(k));
    }
    assert_eq!(bits(&state), bits(&whole));
}
