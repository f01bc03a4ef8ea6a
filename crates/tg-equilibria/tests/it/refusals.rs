//! What has no polynomial form, or too many paths, is refused with the reason.

use std::sync::Arc;

use tg_equilibria::{EquilibriaError, EquilibriaOptions, Family, all_equilibria};
use tg_homotopy::HomotopyError;
use tg_model::{CableLaw, Joining, ModelBuilder, Redundancies, Tension, TensionLaw};

use crate::support::{Spring, add_springs, body, mechanism};

#[test]
fn too_many_paths_are_refused_with_their_number() {
    let model = mechanism([11.5, 11.5]);
    let options = EquilibriaOptions { max_paths: 50, ..EquilibriaOptions::default() };
    let error = all_equilibria(&model, &[11.5, 11.5], &options).unwrap_err();
    assert!(
        matches!(error, EquilibriaError::Homotopy(HomotopyError::TooManyPaths { paths: 78, limit: 50 })),
        "{error}"
    );
    assert!(error.to_string().contains("78"), "{error}");
}

#[test]
fn inputs_that_leave_the_family_are_refused() {
    let model = mechanism([11.5, 0.0]);
    let family = Family::new(&model, &[11.5, 0.0], &EquilibriaOptions::default()).unwrap();
    for u in [[0.0, 0.0], [11.5, 1.0]] {
        let error = family.query(&u).unwrap_err();
        assert!(matches!(error, EquilibriaError::OtherFamily { .. }), "{error}");
    }
    assert!(family.query(&[11.5, 0.0]).is_ok());
    let error = family.query(&[11.5]).unwrap_err();
    assert!(matches!(error, EquilibriaError::Inputs { found: 1, expected: 2 }), "{error}");
}

/// A bar that may turn about the line through its foot and the spring's hook.
#[test]
fn equilibria_in_families_are_refused() {
    let mut b = ModelBuilder::<3>::new();
    let ground = b.anchor("foot", [0.0; 3]).unwrap();
    let hook = b.anchor("hook", [0.0, 0.0, 2.0]).unwrap();
    let bar = b.bar("bar", 1.0, [0.0; 3], [0.6, 0.0, 0.8]).unwrap();
    b.joint("ball", &[ground.into(), bar.node(0)], Joining::Share).unwrap();
    b.cable("spring", hook, bar.node(1), CableLaw::linear(3.0), 0.5).unwrap();
    let model = b.build().unwrap();
    let error = all_equilibria(&model, &model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap_err();
    assert!(matches!(error, EquilibriaError::NotIsolated { count: 1 }), "{error}");
}

#[test]
fn a_hinge_between_bodies_of_space_is_refused() {
    let mut b = ModelBuilder::<3>::new();
    let first = body(&mut b, "first", [0.0; 3]);
    let second = body(&mut b, "second", [0.0; 3]);
    b.fix("foot", first.node(0)).unwrap();
    b.joint("point", &[first.at([1.0, 0.0, 0.0]), second.at([1.0, 0.0, 0.0])], Joining::Constrain).unwrap();
    b.joint("axis", &[first.at([1.0, 1.0, 0.0]), second.at([1.0, 1.0, 0.0])], Joining::Constrain).unwrap();
    b.redundancies(Redundancies::Drop);
    let spring = |from: [f64; 3], to: [f64; 3]| Spring { from, to, stiffness: 1.0, free: 0.0 };
    add_springs(&mut b, first, &[spring([0.2, 2.0, 0.4], [0.5, 0.0, 0.1])]);
    let ends = [([0.3, -1.0, 2.0], [0.2, 0.1, 0.7]), ([1.4, 0.3, -2.0], [0.9, 0.4, 0.2])];
    for (k, (from, to)) in ends.into_iter().enumerate() {
        let hook = b.anchor(&format!("hook {k}"), from).unwrap();
        b.cable(&format!("tie {k}"), hook, second.at(to), CableLaw::linear(2.0), 0.0).unwrap();
    }
    let model = b.build().unwrap();
    let error = all_equilibria(&model, &model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap_err();
    assert!(matches!(error, EquilibriaError::NotAlgebraic { .. }), "{error}");
    assert!(error.to_string().contains("more than a point"), "{error}");
}

/// T = 3 (d - L)², a law of the user's own.
struct Quadratic;

impl TensionLaw for Quadratic {
    fn tension(&self, length: f64, _: f64, rest: f64) -> Tension {
        let stretch = length - rest;
        Tension { force: 3.0 * stretch.powi(2), by_length: 6.0 * stretch, by_rate: 0.0 }
    }
    fn energy(&self, length: f64, rest: f64) -> f64 {
        (length - rest).powi(3)
    }
    fn damped(&self) -> bool {
        false
    }
}

#[test]
fn a_law_of_the_users_own_is_refused() {
    let mut b = ModelBuilder::<2>::new();
    let ground = b.anchor("foot", [0.0; 2]).unwrap();
    let hook = b.anchor("hook", [0.0, 2.0]).unwrap();
    let bar = b.bar("bar", 1.0, [0.0; 2], [0.6, 0.8]).unwrap();
    b.joint("hinge", &[ground.into(), bar.node(0)], Joining::Share).unwrap();
    b.cable("odd spring", hook, bar.node(1), CableLaw::User(Arc::new(Quadratic)), 0.5).unwrap();
    let model = b.build().unwrap();
    let error = all_equilibria(&model, &model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap_err();
    assert!(error.to_string().contains("the law of cable \"odd spring\""), "{error}");
}
