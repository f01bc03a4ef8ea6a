//! Motions that errors are told by.

use tg_scene::Scheme;
use tg_trade::{Method, Quantity, Reference, Subject};

use crate::pendulum::{END, error, model, tip};

#[test]
fn a_reference_is_as_exact_as_it_says() {
    let (model, tips) = (model(), tip());
    let rest = model.velocities_at_rest();
    let subject = Subject::new(&model, &rest, END);
    let reference = Reference::new(&subject, 1.0).unwrap();
    let uncertainty = reference.uncertainty[Quantity::Positions];
    assert!(uncertainty > 0.0 && uncertainty < 1e-9, "{uncertainty}");
    let off = error(&reference.motion, &tips);
    assert!(off <= uncertainty, "{off} against {uncertainty}");
    // The other way, which shares no time stepping, agrees.
    let (_, apart) = reference.check.unwrap();
    assert!(apart[Quantity::Positions] < 1e-7, "{apart:?}");
    assert!(apart[Quantity::Tensions] < 1e-5, "{apart:?}");
}

#[test]
fn errors_against_a_reference_are_those_against_the_truth() {
    let (model, tips) = (model(), tip());
    let rest = model.velocities_at_rest();
    let subject = Subject::new(&model, &rest, END);
    let reference = Reference::new(&subject, 1.0).unwrap();
    let coarse = subject.motion(&Method::fixed(Scheme::Symplectic, END / 256.0)).unwrap();
    let (told, true_error) = (reference.errors(&coarse)[Quantity::Positions], error(&coarse, &tips));
    assert!((told / true_error - 1.0).abs() < 1e-4, "{told} against {true_error}");
    assert!(reference.errors(&coarse)[Quantity::Energy] > 0.0);
    // Other times: nothing can be said.
    let other = subject.motion(&Method::fixed(Scheme::Symplectic, END / 100.0)).unwrap();
    assert!(reference.errors(&other)[Quantity::Positions].is_infinite());
}
