//! The compliant mechanism: random ones against the two-angle model, two modules in series, and key numbers.

use std::array::from_fn;

use nalgebra::Vector2;
use tg_cases::antiprism::{Antiprism, EXAMPLE_2, Feet, Loads};
use tg_cases::mechanism::{Case, FORCE, Mechanism, Parameters, Series};
use tg_cases::reference::mechanism::wrapped;
use tg_cases::verify::mechanism::agreement::agreement;
use tg_cases::verify::mechanism::homotopy::Comparison;
use tg_cases::verify::mechanism::{Expected, expected, sweep, twin};
use tg_equilibria::{EquilibriaOptions, all_equilibria};
use tg_model::Mechanics;
use tg_statics::Configuration;

/// Rounded to nanometres, nanojoules or nanodegrees; no negative zero.
fn rounded(x: f64) -> String {
    format!("{:.9}", (x * 1e9).round() / 1e9 + 0.0)
}

#[test]
fn random_mechanisms_agree_with_the_two_angle_model() {
    let (mut total, mut worst) = (0, [0.0_f64; 4]);
    for seed in 0..60 {
        let parameters = Parameters::random(seed);
        let expected = Expected::of(&parameters).unwrap();
        assert_eq!(expected.undecided, 0, "seed {seed}: {parameters:?}");
        let index = expected.equilibria.iter().map(|e| if e.negative == 1 { -1 } else { 1 }).sum::<i32>();
        let peaks = expected.cones.iter().filter(|cone| cone.excess > 0.0).count();
        assert_eq!(index + peaks as i32, 0, "seed {seed}: {expected:?}");
        assert!(expected.stable() > 0, "seed {seed}: a potential has a minimum");
        let found = agreement(&parameters, &expected).unwrap();
        assert_eq!(found.verdicts, 0, "seed {seed}");
        let homotopy = Comparison::of(&parameters, &expected).unwrap();
        assert!(homotopy.agrees(), "seed {seed}: {homotopy:?}");
        let all = [found.residual, found.offset, found.energy, found.angles];
        worst = from_fn(|i| worst[i].max(all[i]));
        total += expected.all().count();
    }
    assert!(total > 1000, "{total}");
    // Residual [N], that of short springs per stiffness [m], energy, angles [rad].
    let bounds = [1e-12, 1e-14, 1e-13, 1e-15];
    assert!(worst.iter().zip(bounds).all(|(worst, bound)| *worst < bound), "{worst:?}");
}

#[test]
fn the_potential_is_the_same_at_any_angles() {
    for seed in 0..20 {
        let parameters = Parameters::random(seed);
        let (mechanism, twin) = (Mechanism::new(&parameters).unwrap(), twin(&parameters));
        let model = &mechanism.model;
        let angles = [0.7 * seed as f64, 2.0 - 1.3 * seed as f64];
        let q = mechanism.coordinates(angles);
        let energy = model.energy(&q, &model.velocities_at_rest(), &model.inputs_at(0.0)).potential();
        let theirs = twin.potential(angles);
        assert!((energy - theirs).abs() < 1e-13 * theirs, "seed {seed}: {energy} {theirs}");
        let mut phi = vec![0.0; model.sizes().constraints];
        model.constraints(&q, &mut phi);
        assert!(phi.iter().all(|phi| phi.abs() < 1e-13));
        let [four, six, five] = twin.points(angles);
        let forms = [&mechanism.module.four, &mechanism.module.six, &mechanism.module.five];
        for (form, point) in forms.into_iter().zip([four, six, five]) {
            assert!((form.eval(&q) - point).norm() < 1e-13);
        }
        let back = mechanism.angles(&q);
        assert!((0..2).all(|i| wrapped(back[i] - angles[i]).abs() < 1e-13));
    }
}

/// V of two modules in their four angles: each sees its own angles relative to the body it stands on.
fn series_potential(parameters: &Parameters, force: [f64; 2], angles: [f64; 4]) -> f64 {
    let twin = twin(parameters);
    let [a, b, c, d] = angles;
    let turned = |p: Vector2<f64>| nalgebra::Rotation2::new(b) * p;
    let tip = twin.points([a, b])[0] + turned(twin.points([c - b, d - b])[2]);
    twin.potential([a, b]) + twin.potential([c - b, d - b]) - Vector2::from(force).dot(&tip)
}

#[test]
fn two_modules_in_series_do_the_work_of_their_angles() {
    let mut all: Vec<Parameters> = Case::ALL.map(Parameters::paper).to_vec();
    all.extend((0..4).map(Parameters::random));
    for parameters in all {
        let series = Series::new(&parameters, FORCE).unwrap();
        let model = &series.model;
        assert_eq!(model.report().degrees_of_freedom(), 4);
        let (u, rest) = (model.inputs_at(0.0), model.velocities_at_rest());
        for k in 0..5 {
            let angles: [f64; 4] =
                from_fn(|i| wrapped(1.3 * f64::from(k) + 0.9 * i as f64 * (1.0 + f64::from(k))));
            let q = series.coordinates(angles);
            let mut phi = vec![0.0; model.sizes().constraints];
            model.constraints(&q, &mut phi);
            assert!(phi.iter().all(|phi| phi.abs() < 1e-12), "{phi:?}");
            let back = series.angles(&q);
            assert!((0..4).all(|i| wrapped(back[i] - angles[i]).abs() < 1e-13));
            let theirs = series_potential(&parameters, FORCE, angles);
            let ours = model.energy(&q, &rest, &u).potential();
            assert!((ours - theirs).abs() < 1e-12 * theirs.abs().max(1.0), "{ours} {theirs}");
            // Virtual work of the forces along each angle.
            let mut force = vec![0.0; q.len()];
            model.force(tg_model::At { q: &q, v: &rest, u: &u, taut: None }, &mut force);
            let h = 1e-5;
            for i in 0..4 {
                let shifted = |by: f64| from_fn(|j| if i == j { angles[j] + by } else { angles[j] });
                let potential = |by: f64| series_potential(&parameters, FORCE, shifted(by));
                let slope = (potential(h) - potential(-h)) / (2.0 * h);
                let (up, down) = (series.coordinates(shifted(h)), series.coordinates(shifted(-h)));
                let work: f64 =
                    force.iter().zip(up.iter().zip(&down)).map(|(f, (a, b))| f * (a - b) / (2.0 * h)).sum();
                assert!((work + slope).abs() < 1e-4, "{i} {work} {slope}");
            }
        }
    }
}

/// Without load and from an equilibrium of each module, the whole is in equilibrium.
#[test]
fn two_unloaded_modules_rest_where_each_does() {
    let parameters = Parameters::paper(Case::Two);
    let series = Series::new(&parameters, [0.0; 2]).unwrap();
    let single = expected(Case::Two).unwrap().equilibria;
    for lower in &single {
        for upper in &single {
            let [a, b] = lower.angles;
            let q = series.coordinates([a, b, b + upper.angles[0], b + upper.angles[1]]);
            let at = Configuration::at(&series.model, &q, &series.model.inputs_at(0.0)).unwrap();
            assert!(at.residual.iter().all(|r| r.abs() < 1e-11), "{:?}", at.residual);
        }
    }
}

/// The count that homotopies in two public packages give; too slow for every run.
#[test]
#[ignore = "1330 paths, 15 s"]
fn two_modules_with_a_free_length_have_532_solutions() {
    let series = Series::new(&Parameters::paper(Case::Two), FORCE).unwrap();
    let u = series.model.inputs_at(0.0);
    let report = all_equilibria(&series.model, &u, &EquilibriaOptions::default()).unwrap();
    assert!(report.accounts_for_all() && report.certified == 532, "{report}");
}

/// The antiprism has a polynomial form, but far too many paths.
#[test]
fn an_antiprism_is_refused_with_an_estimate() {
    let structure = Antiprism::new(&EXAMPLE_2, Feet::Fixed, &Loads::None).unwrap();
    let u = structure.model.inputs_at(0.0);
    let error = all_equilibria(&structure.model, &u, &EquilibriaOptions::default()).unwrap_err().to_string();
    assert!(error.contains("560402432 paths"), "{error}");
}

#[test]
fn equilibria_and_folds() {
    let mut lines = Vec::new();
    for case in Case::ALL {
        for e in &expected(case).unwrap().equilibria {
            let numbers = [e.angles[0].to_degrees(), e.angles[1].to_degrees(), e.energy].map(rounded);
            let kind = ["stable", "saddle", "maximum"][e.negative];
            lines.push(format!("{}: {} {kind}", case.name(), numbers.join(" ")));
        }
    }
    for fold in sweep::paper().unwrap().folds {
        let numbers = [fold.rest, fold.angles[0].to_degrees(), fold.angles[1].to_degrees()].map(rounded);
        lines.push(format!("fold: {}", numbers.join(" ")));
    }
    insta::assert_snapshot!(lines.join("\n"));
}
