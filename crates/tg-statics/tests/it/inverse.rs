//! Inverse statics: solution sets, choices in them, bounds; each answer is held against the forces themselves.

use std::sync::Arc;

use approx::assert_relative_eq;
use tg_fixtures::{prism, spine};
use tg_model::{CableLaw, Model, ModelBuilder, Tension, TensionLaw};
use tg_statics::{
    Configuration, Forward, ForwardOptions, Given, InverseError, InverseStatics, Request, Unknown,
};

/// A bead of weight 10 N on three strings in a plane: one more than needed.
fn bead(law: impl Fn() -> CableLaw) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -10.0]).unwrap();
    let bead = b.particle("bead", 1.0, [0.0, 0.0]).unwrap();
    for (name, end) in [("left", [-3.0, 4.0]), ("middle", [0.0, 5.0]), ("right", [3.0, 4.0])] {
        let end = b.anchor(name, end).unwrap();
        b.cable(&format!("{name} string"), end, bead.node(0), law(), 5.0).unwrap();
    }
    b.build().unwrap()
}

fn imbalance(model: &Model<2>, u: &[f64]) -> f64 {
    Configuration::at(model, &model.initial_coordinates(), u).unwrap().imbalance().0
}

#[test]
fn the_solution_set_of_a_bead_on_three_strings() {
    let model = bead(|| CableLaw::slacking(100.0));
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    let set = inverse.solutions(&Request::new(Unknown::Tension)).unwrap();
    // 2·0.8 a + m = 10: the null space is (1, -1.6, 1).
    assert_eq!((set.rank.rank, set.null_space.len()), (2, 1));
    let z = &set.null_space[0];
    assert_relative_eq!(z[1] / z[0], -1.6, max_relative = 1e-13);
    assert_relative_eq!(z[2] / z[0], 1.0, max_relative = 1e-13);
    // Minimum norm is orthogonal to it: (1.6, 1, 1.6)·10/(1.6² + 1 + ..) with a = 0.8 k, m = k.
    let k = 10.0 / (2.0 * 0.8 * 0.8 + 1.0);
    for (f, expected) in set.particular.iter().zip([0.8 * k, k, 0.8 * k]) {
        assert_relative_eq!(*f, expected, max_relative = 1e-13);
    }
    let answer = inverse.solve(&Request::new(Unknown::RestLength).closest_to(&[4.9; 3])).unwrap();
    assert!(answer.pushing.is_empty());
    assert!(imbalance(&model, &answer.inputs(&u)) < 1e-12);
    let row = &answer.cutting_list()[0];
    assert_relative_eq!(row.strain, row.tension / 100.0 / row.rest_length, max_relative = 1e-12);
}

#[test]
fn given_values_ties_and_goals() {
    let model = bead(|| CableLaw::slacking(100.0));
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    let given = inverse.solve(&Request::new(Unknown::ForceDensity).give(1, Given::Tension(2.0))).unwrap();
    for (f, expected) in given.tensions.iter().zip([5.0, 2.0, 5.0]) {
        assert_relative_eq!(*f, expected, max_relative = 1e-12);
    }
    assert!(given.set.null_space.is_empty());
    let rest = inverse.solve(&Request::new(Unknown::RestLength).give(1, Given::RestLength(4.98))).unwrap();
    assert_relative_eq!(rest.tensions[1], 2.0, max_relative = 1e-11);
    assert_relative_eq!(rest.rest_lengths[0], 4.95, max_relative = 1e-12);
    // All three alike: 2.6 f = 10.
    let tied = inverse.solve(&Request::new(Unknown::Tension).tie(&[0, 1, 2])).unwrap();
    for f in &tied.tensions {
        assert_relative_eq!(*f, 10.0 / 2.6, max_relative = 1e-13);
    }
    let wanted = [4.0, 4.0, 4.0];
    let closest = inverse.solve(&Request::new(Unknown::Tension).closest_to(&wanted)).unwrap();
    let apart: Vec<f64> = closest.tensions.iter().zip(wanted).map(|(f, w)| f - w).collect();
    let z = &closest.set.null_space[0];
    assert!(apart.iter().zip(z).map(|(a, z)| a * z).sum::<f64>().abs() < 1e-12, "not the nearest");
}

#[test]
fn bounds_are_met_or_named() {
    let model = bead(|| CableLaw::slacking(100.0));
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    let request = Request::new(Unknown::Tension).tension_between(3.6, 5.0);
    let answer = inverse.solve(&request).unwrap();
    // Minimum norm would be 3.51, 4.39, 3.51; the bound 3.6 is active at the sides.
    assert_relative_eq!(answer.tensions[0], 3.6, max_relative = 1e-6);
    assert_relative_eq!(answer.tensions[1], 10.0 - 1.6 * 3.6, max_relative = 1e-6);
    assert!(imbalance(&model, &answer.inputs(&u)) < 1e-12, "a bounded answer balances exactly");
    // The middle string is shortest for what it lifts: least total tension loads it until the sides are at their bound.
    let least = Request::new(Unknown::Tension).tension_between(1.0, 20.0).least_total_tension();
    let answer = inverse.solve(&least).unwrap();
    assert_relative_eq!(answer.tensions[0], 1.0, max_relative = 1e-6);
    assert_relative_eq!(answer.tensions[1], 8.4, max_relative = 1e-6);
    let own = least.cable_tension_between(1, 0.0, 6.0);
    assert_relative_eq!(inverse.solve(&own).unwrap().tensions[1], 6.0, max_relative = 1e-6);
    assert!(matches!(
        inverse.solve(&Request::new(Unknown::Tension).least_total_tension()),
        Err(InverseError::Program(_))
    ));
    let Err(InverseError::Infeasible { violated }) =
        inverse.solve(&Request::new(Unknown::Tension).tension_between(4.0, 10.0))
    else {
        panic!("2.6 · 4 N exceed the weight")
    };
    println!("{violated:?}");
    assert!(!violated.is_empty() && violated.iter().all(|(_, f, bound)| f < bound && *bound == 4.0));
    assert!(matches!(
        inverse.solve(&Request::new(Unknown::Tension).tension_between(2.0, 1.0)),
        Err(InverseError::EmptyBounds { .. })
    ));
    // Without freedom left, bounds are checked.
    let fixed = Request::new(Unknown::Tension).give(1, Given::Tension(2.0));
    assert!(inverse.solve(&fixed.clone().tension_between(1.0, 6.0)).is_ok());
    assert!(matches!(inverse.solve(&fixed.tension_between(3.0, 6.0)), Err(InverseError::Infeasible { .. })));
}

#[test]
fn what_no_cable_holds_is_said() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -10.0]).unwrap();
    let bead = b.particle("bead", 1.0, [0.0, 0.0]).unwrap();
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let end = b.anchor(name, [x, 0.0]).unwrap();
        b.cable(&format!("{name} string"), end, bead.node(0), CableLaw::slacking(1.0), 1.0).unwrap();
    }
    let model = b.build().unwrap();
    let inverse = InverseStatics::new(&model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap();
    let Err(error @ InverseError::NotHeld { residual, .. }) = inverse.solve(&Request::new(Unknown::Tension))
    else {
        panic!("level strings hold no weight")
    };
    assert_relative_eq!(residual, 1.0, max_relative = 1e-12);
    assert!(error.to_string().contains("y component"), "{error}");
    for (request, what) in [
        (Request::new(Unknown::Tension).give(7, Given::Tension(1.0)), "no cable 7"),
        (Request::new(Unknown::Tension).tie(&[0, 1]).tie(&[1]), "bound twice"),
        (Request::new(Unknown::Tension).closest_to(&[1.0]), "1 values"),
    ] {
        let error = inverse.solutions(&request).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    }
}

/// f = c (l/μ - 1)³: stiffens, not linear in μ.
struct Cubic;

impl TensionLaw for Cubic {
    fn tension(&self, length: f64, _rate: f64, rest: f64) -> Tension {
        let strain = length / rest - 1.0;
        Tension { force: 1e4 * strain.powi(3), by_length: 3e4 * strain.powi(2) / rest, by_rate: 0.0 }
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        2.5e3 * (length / rest - 1.0).powi(4) * rest
    }

    fn damped(&self) -> bool {
        false
    }
}

#[test]
fn a_users_law_gets_its_rest_lengths_too() {
    let model = bead(|| CableLaw::User(Arc::new(Cubic)));
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let inverse = InverseStatics::new(&model, &q, &u).unwrap();
    let answer = inverse.solve(&Request::new(Unknown::ForceDensity)).unwrap();
    assert!(imbalance(&model, &answer.inputs(&u)) < 1e-11);
    let rest = 5.0 / (1.0 + (answer.tensions[1] / 1e4).cbrt());
    assert_relative_eq!(answer.rest_lengths[1], rest, max_relative = 1e-13);
    assert!(matches!(inverse.solve(&Request::new(Unknown::RestLength)), Err(InverseError::NotLinear { .. })));
}

#[test]
fn inverse_then_forward_is_a_round_trip() {
    let trip = |model: &dyn tg_model::Tensioned, q: &[f64], u: &[f64], answer: &[f64]| {
        let inputs: Vec<f64> = answer.iter().chain(&u[answer.len()..]).copied().collect();
        let mut far = q.to_vec();
        for (k, &i) in model.free().iter().enumerate() {
            far[i] += 0.01 * (1.0 + k as f64).sin();
        }
        let found = Forward::new(model, ForwardOptions::default()).solve(&far, &inputs).unwrap();
        (found.configuration.q, found.report)
    };
    let spine = spine(4, 8.0, 0.0).unwrap();
    let (q, u) = (spine.model.initial_coordinates(), spine.model.inputs_at(0.0));
    let inverse = InverseStatics::new(&spine.model, &q, &u).unwrap();
    let bounds = Request::new(Unknown::RestLength).tension_between(5.0, 30.0);
    let answer = inverse.solve(&bounds).unwrap();
    assert!(answer.pushing.is_empty());
    let (found, report) = trip(&spine.model, &q, &u, &answer.rest_lengths);
    let apart = found.iter().zip(&q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    println!("{report:?} {apart:.1e}");
    assert!(apart < 1e-10, "{apart:.1e}");

    // A prism on a plane comes back up to where it stands: lengths are what is held.
    let prism = prism(3, 40.0, 9.81, CableLaw::slacking).unwrap();
    let (q, u) = (prism.model.initial_coordinates(), prism.model.inputs_at(0.0));
    let Err(error) =
        InverseStatics::new(&prism.model, &q, &u).unwrap().solve(&Request::new(Unknown::RestLength))
    else {
        panic!("at the twist of 30° the prism carries no load but its self-stress")
    };
    assert!(matches!(error, InverseError::NotHeld { .. }), "{error}");
    let loaded = Forward::new(&prism.model, ForwardOptions::default()).solve(&q, &u).unwrap().configuration;
    let inverse = InverseStatics::new(&prism.model, &loaded.q, &u).unwrap();
    let answer = inverse.solve(&Request::new(Unknown::RestLength).closest_to(&u)).unwrap();
    for (found, given) in answer.rest_lengths.iter().zip(&u) {
        assert_relative_eq!(*found, *given, max_relative = 1e-10);
    }
    let (found, _) = trip(&prism.model, &loaded.q, &u, &answer.rest_lengths);
    for &cable in &prism.cables {
        let length = |q: &[f64]| prism.model.cable(cable, q, &loaded.q, &u).length;
        assert_relative_eq!(length(&found), length(&loaded.q), max_relative = 1e-10);
    }
}
