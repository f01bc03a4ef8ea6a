//! Time stepping schemes: all of them give the motion, go on bit for bit, and reach an accuracy.

use std::path::Path;

use tg_report::{Results, Table};
use tg_scene::Scheme;

use crate::{json, run, scene, temporary, text};

/// A folder with a run of the tower, its guys' anchors at rest.
fn tower(arguments: &[&str]) -> (tempfile::TempDir, String) {
    let (keep, folder) = temporary("tower");
    let scene = scene("tower.toml");
    let fixed = ["run", &scene, "--set", "auxiliary_ground=0", "--no-view", "-o", &folder];
    json(&[&fixed[..], arguments].concat());
    (keep, folder)
}

fn table(folder: &str) -> Table {
    Results::open(Path::new(folder)).unwrap().table().unwrap()
}

/// Largest difference of the watched points at the end \[m\].
fn apart(a: &Table, b: &Table) -> f64 {
    let last = |table: &Table| -> Vec<f64> {
        table.group("point").into_iter().map(|k| *table.columns[k].last().unwrap()).collect()
    };
    assert_eq!(a.column("time").unwrap().last(), b.column("time").unwrap().last());
    last(a).iter().zip(last(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn all_schemes_give_the_motion_of_the_symplectic_one_at_a_small_step() {
    let (_keep, small) = tower(&["--duration", "0.1", "--step", "1e-5"]);
    let expected = table(&small);
    for scheme in Scheme::ALL {
        let name = scheme.to_string();
        let (step, tolerance) = if scheme.order() == 2 { ("1e-4", 5e-8) } else { ("1e-3", 1e-8) };
        let (_keep, folder) = tower(&["--duration", "0.1", "--step", step, "--scheme", &name]);
        let error = apart(&table(&folder), &expected);
        assert!(error < tolerance, "{name}: {error}");
        let manifest = Results::open(Path::new(&folder)).unwrap().manifest;
        assert_eq!(manifest.settings["scheme"], *name);
        if scheme.controls_error() {
            let arguments = ["--duration", "0.1", "--scheme", &name, "--step", "0.05", "--tolerance", "1e-9"];
            let (_keep, folder) = tower(&arguments);
            let table = table(&folder);
            assert_eq!(table.rows(), 3);
            let error = apart(&table, &expected);
            assert!(error < 1e-9, "{name} under error control: {error}");
        }
    }
}

#[test]
fn every_scheme_goes_on_bit_for_bit() {
    for scheme in Scheme::ALL {
        let name = scheme.to_string();
        let mut arguments = vec!["--step", "2e-3", "--scheme", &name];
        if scheme.controls_error() {
            arguments.extend(["--tolerance", "1e-6"]);
        }
        let with = |duration| [&["--duration", duration], &arguments[..]].concat();
        let (_keep, whole) = tower(&with("0.4"));
        let (_keep, resumed) = tower(&with("0.2"));
        let scene = scene("tower.toml");
        // The scheme and its tolerance need not be said again.
        json(&[
            "run",
            &scene,
            "--set",
            "auxiliary_ground=0",
            "--duration",
            "0.4",
            "-o",
            &resumed,
            "--resume",
        ]);
        let (whole, resumed) = (table(&whole), table(&resumed));
        assert_eq!(whole.rows(), 201);
        assert_eq!(resumed.columns, whole.columns, "{name}");
    }
}

#[test]
fn a_run_does_not_go_on_with_another_scheme() {
    let (_keep, folder) = tower(&["--duration", "0.01", "--scheme", "leapfrog"]);
    let scene = scene("tower.toml");
    let again =
        ["run", &scene, "--set", "auxiliary_ground=0", "-o", &folder, "--resume", "--scheme", "symplectic"];
    let output = run(&again);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("with the scheme leapfrog"), "{}", text(&output.stderr));
}

#[test]
fn an_accuracy_is_reached_by_schemes_of_any_order() {
    let accuracy = 1e-6;
    let exact = ["--duration", "0.5", "--scheme", "runge-kutta-8", "--tolerance", "1e-12", "--step", "0.5"];
    let (_keep, exact) = tower(&exact);
    for (scheme, chosen) in [
        ("generalized-alpha", "step"),
        ("leapfrog", "step"),
        ("composition-4", "step"),
        ("composition-6", "step"),
        ("runge-kutta-5", "tolerance"),
        ("runge-kutta-8", "tolerance"),
    ] {
        let (_keep, folder) = tower(&["--duration", "0.5", "--scheme", scheme, "--accuracy", "1e-6"]);
        let error = apart(&table(&folder), &table(&exact));
        let settings = Results::open(Path::new(&folder)).unwrap().manifest.settings;
        let trials = settings["step_chosen_by"]["trials"].as_array().unwrap();
        assert!(trials.iter().all(|trial| trial[chosen].is_number()), "{scheme}: {trials:?}");
        assert!(settings[chosen].is_number());
        assert!(error < accuracy && error > 1e-5 * accuracy, "{scheme}: {error} after {settings}");
    }
}

#[test]
fn a_scene_chooses_its_scheme_and_tolerance() {
    let (keep, folder) = temporary("still");
    let path = keep.path().join("swing.toml");
    let bead = r#"
        version = 1
        dimension = 2
        gravity = [0, "-g"]
        anchors.peg = [0, 0]
        bars.rod = { ends = ["peg", [1, 0]], mass = 1 }
        joints.hinge = { places = ["peg", "rod.from"] }
        run = { duration = 0.5, scheme = "runge-kutta-8", tolerance = 1e-9, frame_rate = 20 }
    "#;
    std::fs::write(&path, bead).unwrap();
    json(&["run", path.to_str().unwrap(), "-o", &folder]);
    let results = Results::open(Path::new(&folder)).unwrap();
    assert_eq!(results.manifest.settings["scheme"], "runge-kutta-8");
    assert_eq!(results.manifest.settings["tolerance"], 1e-9);
    // No step is given: a row for each picture.
    let table = results.table().unwrap();
    assert_eq!(table.rows(), 11);
    assert!(table.column("total energy").unwrap().iter().all(|energy| energy.abs() < 1e-8));
    // Another scheme has another way of stepping: a step is missing then.
    let output = run(&["run", path.to_str().unwrap(), "-o", &folder, "--force", "--scheme", "leapfrog"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("the run has no step"), "{}", text(&output.stderr));
}

#[test]
fn what_does_not_fit_a_scheme_is_bad_input() {
    let tower = scene("tower.toml");
    for (arguments, message) in [
        (vec!["--tolerance", "1e-6"], "the scheme symplectic has no error control"),
        (vec!["--tolerance", "1e-6", "--scheme", "leapfrog"], "the scheme leapfrog has no error control"),
        (vec!["--tolerance", "0", "--scheme", "runge-kutta-5"], "a positive number is expected"),
        (vec!["--scheme", "leapfrogs"], "leapfrog"),
        (
            vec!["--accuracy", "1e-6", "--tolerance", "1e-6", "--scheme", "runge-kutta-5"],
            "cannot be used with",
        ),
    ] {
        let output = run(&[&["run", &tower], &arguments[..]].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(message), "{arguments:?}: {}", text(&output.stderr));
    }
}
