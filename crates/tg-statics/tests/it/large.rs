//! Statics of large structures: the prism mast of the benchmarks.

use tg_fixtures::mast;
use tg_model::Model;
use tg_statics::{
    Configuration, Forward, ForwardOptions, Given, InverseError, InverseStatics, Request, Unknown,
};

/// Cables of a stage, all of them at its upper level.
const CABLES: usize = 12;

fn scene(stages: usize) -> (Model<3>, Vec<f64>, Vec<f64>) {
    let model = mast(stages).unwrap().model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    (model, q, u)
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let size = b.iter().fold(0.0_f64, |m, b| m.max(b.abs()));
    a.iter().zip(b).fold(0.0_f64, |m, (a, b)| m.max((a - b).abs())) / size
}

#[test]
fn sparse_and_dense_inverse_statics_agree() {
    let (model, q, u) = scene(32);
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    for unknown in [Unknown::Tension, Unknown::ForceDensity, Unknown::RestLength] {
        let request = Request::new(unknown).give(5, Given::Tension(11.0)).tie(&[12, 14, 16]).tie(&[20, 21]);
        let set = inverse.solutions(&request).unwrap();
        let sparse = inverse.solve(&request).unwrap();
        assert!(sparse.set.null_space.is_empty());
        assert_eq!((sparse.set.rank.rank, sparse.set.freedom), (set.rank.rank, set.freedom));
        assert!(largest_difference(&sparse.set.particular, &set.particular) < 1e-9);

        let wish: Vec<f64> = (0..u.len()).map(|c| 0.2 + 0.01 * (c as f64).sin()).collect();
        let closest = inverse.solve(&request.closest_to(&wish)).unwrap();
        let x: Vec<f64> = match unknown {
            Unknown::Tension => closest.tensions.clone(),
            Unknown::ForceDensity => closest.force_densities.clone(),
            Unknown::RestLength => closest.rest_lengths.clone(),
        };
        // What is left of the wish is orthogonal to the directions in which the solution may change.
        for z in &set.null_space {
            let along: f64 = z.iter().zip(x.iter().zip(&wish)).map(|(z, (x, w))| z * (x - w)).sum();
            assert!(along.abs() < 1e-8, "{unknown:?} {along:e}");
        }
        let held = Configuration::at(&model, &q, &closest.inputs(&u)).unwrap();
        assert!(held.imbalance().0 < 1e-11 || !closest.pushing.is_empty());
    }
}

#[test]
fn bounds_hold_in_a_tall_mast() {
    let (model, q, u) = scene(64);
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    let request = Request::new(Unknown::Tension).tension_between(1.0, 200.0);
    for request in [request.clone(), request.clone().least_total_tension()] {
        let answer = inverse.solve(&request).unwrap();
        assert!(answer.tensions.iter().all(|&f| f > 1.0 - 1e-4 && f < 200.0));
        let held = Configuration::at(&model, &q, &answer.inputs(&u)).unwrap();
        assert!(held.imbalance().0 < 1e-9);
    }
    match inverse.solve(&request.tension_between(100.0, 101.0)) {
        Err(InverseError::Infeasible { violated }) => assert!(!violated.is_empty()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_no_cable_resists_is_named() {
    let (model, q, u) = scene(32);
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    // Bars alone do not hold the top.
    let top = (CABLES * 31..CABLES * 32)
        .fold(Request::new(Unknown::Tension), |request, cable| request.give(cable, Given::Tension(0.0)));
    match inverse.solve(&top) {
        Err(InverseError::NotHeld { coordinate, .. }) => {
            assert!(coordinate.contains("bar 31."), "{coordinate}")
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_mast_of_512_stages_is_held_and_settles() {
    let (model, q, u) = scene(512);
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    let answer = inverse.solve(&Request::new(Unknown::RestLength).closest_to(&u)).unwrap();
    assert!(answer.pushing.is_empty());
    assert_eq!((answer.set.rank.rank, answer.set.freedom), (6 * 512, 6 * 512));
    let held = Configuration::at(&model, &q, &answer.inputs(&u)).unwrap();
    assert!(held.imbalance().0 < 1e-11, "{:?}", held.imbalance());

    let found = Forward::new(&model, ForwardOptions::default()).solve(&q, &u).unwrap();
    assert!(found.report.residual < 1e-10 && found.report.relaxation_steps == 0);
}
