//! Steps and tolerances chosen for an accuracy.

use std::sync::atomic::AtomicBool;

use tg_scene::Scheme;
use tg_trade::{ChoiceError, LOOKS, Method, Subject, choose};

use crate::pendulum::{END, error, model, tip};

#[test]
fn what_is_chosen_is_as_exact_as_asked_and_as_estimated() {
    let (model, tips) = (model(), tip());
    let rest = model.velocities_at_rest();
    let subject = Subject::new(&model, &rest, END);
    for scheme in Scheme::ALL {
        // At 1e-7 those of second order take 65 thousand steps, whose rounding must not add up.
        for accuracy in [1e-3, 1e-5, 1e-7] {
            // Looks are where the truth is known.
            let method = Method::fixed(scheme, END / f64::from(LOOKS));
            let choice = choose(&subject, accuracy, &method);
            let choice = choice.unwrap_or_else(|error| panic!("{scheme} at {accuracy}: {error}"));
            let motion = subject.motion(&choice.method).unwrap();
            let error = error(&motion, &tips);
            assert!(error <= accuracy, "{scheme} at {accuracy}: {error}");
            let ratio = choice.error / error;
            assert!((0.2..5.0).contains(&ratio), "{scheme} at {accuracy}: {} for {error}", choice.error);
            // Not much finer than need be, unless it is the coarsest.
            let coarsest = choice.trials.len() == 1;
            assert!(coarsest || error > 0.01 * accuracy, "{scheme} at {accuracy}: {error}");
        }
    }
}

#[test]
fn what_cannot_be_reached_is_refused() {
    let model = model();
    let rest = model.velocities_at_rest();
    let subject = Subject::new(&model, &rest, END);
    for accuracy in [0.0, -1e-3, f64::NAN, f64::INFINITY] {
        let refused = choose(&subject, accuracy, &Method::fixed(Scheme::Symplectic, 1e-3));
        assert!(matches!(refused, Err(ChoiceError::Accuracy(_))), "{accuracy}");
    }
    let below = choose(&subject, 1e-18, &Method::fixed(Scheme::RungeKutta8, 1e-2)).unwrap_err();
    assert!(below.to_string().contains("rounding may leave of these positions, 6e-14 m"), "{below}");
    let beyond = choose(&subject, 1e-13, &Method::fixed(Scheme::RungeKutta8, 1e-2)).unwrap_err();
    assert!(matches!(beyond, ChoiceError::Unreached { .. }), "{beyond}");
    assert!(beyond.to_string().contains("tolerance down to 1e-13"), "{beyond}");
    let hurried = subject.limited(1e-9);
    let late = choose(&hurried, 1e-6, &Method::fixed(Scheme::Symplectic, 1e-3)).unwrap_err();
    assert!(matches!(late, ChoiceError::TooLong(_)), "{late}");
    let flag = AtomicBool::new(true);
    let stopped = choose(&subject.cancel_on(&flag), 1e-6, &Method::fixed(Scheme::Leapfrog, 1e-3));
    assert!(matches!(stopped, Err(ChoiceError::Cancelled)));
}
