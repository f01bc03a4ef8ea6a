//! Words of errors, reports and parameters; names of systems that have none.

use crate::support::mixed::Cubic;
use std::sync::Arc;
use tg_model::{
    At, BuildError, CableLaw, Entry, Features, HessianEntry, Mechanics, ModelBuilder, ProjectionError,
    Projector, Redundancy, Signal, Sizes,
};

/// A bead on the circle x² + y² = 1, without any name.
struct Bead {
    mass: [Entry; 2],
}

fn bead(mass: f64) -> Bead {
    Bead { mass: [0, 1].map(|i| Entry { row: i, col: i, value: mass }) }
}

impl Mechanics for Bead {
    fn sizes(&self) -> Sizes {
        Sizes { coordinates: 2, constraints: 1, inputs: 0, switches: 0 }
    }
    fn features(&self) -> Features {
        Features::default()
    }
    fn size(&self) -> f64 {
        1.0
    }
    fn free(&self) -> &[usize] {
        &[0, 1]
    }
    fn mass(&self) -> &[Entry] {
        &self.mass
    }
    fn stiffness_pattern(&self) -> &[(usize, usize)] {
        &[]
    }
    fn damping_pattern(&self) -> &[(usize, usize)] {
        &[]
    }
    fn jacobian_pattern(&self) -> &[(usize, usize)] {
        &[(0, 0), (0, 1)]
    }
    fn constraint_hessian(&self) -> &[HessianEntry] {
        const CIRCLE: HessianEntry = HessianEntry { constraint: 0, row: 0, col: 0, value: 2.0 };
        &[CIRCLE, HessianEntry { row: 1, col: 1, ..CIRCLE }]
    }
    fn constraint_scales(&self) -> &[f64] {
        &[1.0]
    }
    fn prescribe(&self, _: f64, _: &mut [f64], _: &mut [f64]) {}
    fn prescribed_acceleration(&self, _: f64, _: &mut [f64]) {}
    fn inputs(&self, _: f64, _: &mut [f64]) {}
    fn force(&self, _: At<'_>, f: &mut [f64]) {
        f.fill(0.0);
    }
    fn stiffness(&self, _: At<'_>, _: &mut [f64]) {}
    fn damping(&self, _: At<'_>, _: &mut [f64]) {}
    fn constraints(&self, q: &[f64], phi: &mut [f64]) {
        phi[0] = q[0] * q[0] + q[1] * q[1] - 1.0;
    }
    fn jacobian(&self, q: &[f64], values: &mut [f64]) {
        values.copy_from_slice(&[2.0 * q[0], 2.0 * q[1]]);
    }
    fn active_set(&self, _: At<'_>, _: &mut [bool]) {}
    fn potential(&self, _: &[f64], _: &[f64]) -> f64 {
        0.0
    }
    fn force_scale(&self, _: At<'_>) -> f64 {
        0.0
    }
}

#[test]
fn a_system_without_names_is_known_by_its_numbers() {
    let system = bead(1.0);
    assert_eq!(system.coordinate_name(7), "coordinate 7");
    assert_eq!(system.constraint_name(8), "constraint 8");
    assert_eq!(system.switch_name(9), "switch 9");
    assert!(system.cables_at(0).is_empty());
    let culprit = |system: &Bead, q: [f64; 2]| {
        let result = Projector::new(system).and_then(|mut p| p.velocity(&q, &mut [1.0, 2.0]));
        let Err(ProjectionError::Solver { culprit, .. }) = result else { panic!("{result:?}") };
        culprit
    };
    // At the centre the circle has no normal; a bead without mass goes anywhere.
    assert_eq!(culprit(&system, [0.0, 0.0]), "constraint 0");
    assert!(culprit(&bead(0.0), [1.0, 0.0]).starts_with("coordinate "));
    let error = Projector::new(&system).unwrap().position(&mut [f64::NAN, 0.0]).unwrap_err();
    assert!(error.to_string().contains("constraint 0 is still violated"), "{error}");
}

fn redundancy(implied_by: &[&str]) -> Redundancy {
    let implied_by = implied_by.iter().map(ToString::to_string).collect();
    Redundancy { constraint: "strut".into(), implied_by, sine: 0.0 }
}

#[test]
fn redundancies_name_six_causes_at_most() {
    let names = ["a", "b", "c", "d", "e", "f", "g", "h"];
    let expected = [
        (0, "strut is implied by the supports (no free coordinate changes it here)"),
        (1, "strut is implied by a"),
        (6, "strut is implied by a, b, c, d, e, f"),
        (7, "strut is implied by a, b, c, d, e, f and 1 more"),
        (8, "strut is implied by a, b, c, d, e, f and 2 more"),
    ];
    for (count, words) in expected {
        assert_eq!(redundancy(&names[..count]).to_string(), words);
    }
    let text = |list: Vec<Redundancy>| BuildError::Redundant { list, tolerance: 1e-8 }.to_string();
    let one = text(vec![redundancy(&["a"])]);
    assert!(one.contains("1 redundant constraint ") && one.contains("strut is implied by a"), "{one}");
    let two = text(vec![redundancy(&["a"]), redundancy(&["b"])]);
    let both = "strut is implied by a; strut is implied by b";
    assert!(two.contains("2 redundant constraints") && two.contains(both), "{two}");
}

/// What a person sees who prints a structure's parameters.
#[test]
fn signals_and_laws_print_their_parameters() {
    let sine = Signal::Sine { amplitude: 0.5, frequency: 2.0, phase: 0.25 };
    let table = Signal::table(vec![0.0, 1.0, 2.0], vec![0.0; 3]).unwrap();
    for (signal, words) in [
        (Signal::Constant(1.5), "Constant(1.5)"),
        (Signal::ramp(1.0, 2.0, 4.0), "Ramp(1 → 2 from 0 s in 4 s)"),
        (sine.clone(), "Sine(0.5·sin(2π·2·t + 0.25))"),
        (table.clone(), "Table(3 samples)"),
        (Signal::Sum(vec![1.0.into(), 2.0.into()]), "Sum([Constant(1), Constant(2)])"),
        (Signal::user(|t| (t, 1.0)), "User(..)"),
    ] {
        assert_eq!(format!("{signal:?}"), words);
    }
    for (law, words) in [
        (CableLaw::linear(3.0).with_damping(0.5), "Linear(κ = 3, η = 0.5)"),
        (CableLaw::slacking(3.0).with_damping(0.5), "Slacking(κ = 3, η = 0.5)"),
        (CableLaw::User(Arc::new(Cubic { a: 1.0, b: 0.0, c: 0.0 })), "User(..)"),
    ] {
        assert_eq!(format!("{law:?}"), words);
        let mut b = ModelBuilder::<2>::new();
        let balls = [0.0, 1.0].map(|x| b.particle(&format!("{x}"), 1.0, [x, 0.0]).unwrap());
        b.cable("tie", balls[0].node(0), balls[1].node(0), law, 1.0).unwrap();
        let whole = format!("{:?}", b.build().unwrap());
        assert!(whole.contains(words) && whole.contains("UserLaw") == (words == "User(..)"), "{whole}");
    }
}

#[test]
fn signals_are_equal_where_every_parameter_is() {
    let ramp = |from, to, start, duration| Signal::Ramp { from, to, start, duration };
    let sine = |amplitude, frequency, phase| Signal::Sine { amplitude, frequency, phase };
    let table = |t: f64, x: f64| Signal::table(vec![0.0, t], vec![0.0, x]).unwrap();
    let different = [
        1.0.into(),
        2.0.into(),
        ramp(0.0, 1.0, 2.0, 3.0),
        ramp(9.0, 1.0, 2.0, 3.0),
        ramp(0.0, 9.0, 2.0, 3.0),
        ramp(0.0, 1.0, 9.0, 3.0),
        ramp(0.0, 1.0, 2.0, 9.0),
        sine(1.0, 2.0, 3.0),
        sine(9.0, 2.0, 3.0),
        sine(1.0, 9.0, 3.0),
        sine(1.0, 2.0, 9.0),
        table(1.0, 1.0),
        table(2.0, 1.0),
        table(1.0, 2.0),
        Signal::Sum(vec![1.0.into()]),
        Signal::Sum(vec![2.0.into()]),
        Signal::Sum(vec![1.0.into(), 1.0.into()]),
        Signal::user(|t| (t, 1.0)),
        Signal::user(|t| (t, 1.0)),
    ];
    for (i, a) in different.iter().enumerate() {
        for (j, b) in different.iter().enumerate() {
            assert_eq!(*a == b.clone(), i == j, "{a:?} and {b:?}");
        }
    }
}
