//! Sweeps: what they find does not depend on the number of threads, motions are those of `tg run`.

use std::path::Path;

use serde_json::Value;
use tg_report::Results;

use crate::{json, run, scene, temporary, text};

/// The same document with one thread and with two.
#[track_caller]
fn for_any_number_of_threads(arguments: &[&str]) -> Value {
    let one = json(&[arguments, &["--threads", "1"]].concat());
    assert_eq!(one, json(&[arguments, &["--threads", "2"]].concat()));
    one
}

#[test]
fn sweeps_do_not_depend_on_the_number_of_threads() {
    let [tower, modal, mechanism] = ["tower.toml", "tower_modal.toml", "mechanism.toml"].map(scene);
    let range = |from, to| ["--from", from, "--to", to, "--samples", "4"];
    let motion = ["sweep", &tower, "-p", "alpha", "--what", "motion"];
    for_any_number_of_threads(&[&motion[..], &range("0.9", "0.98")].concat());
    for_any_number_of_threads(&[&["sweep", &modal, "-p", "ratio"], &range("0.88", "1")[..]].concat());
    let equilibria = ["sweep", &mechanism, "-p", "free_2", "--what", "equilibria"];
    for_any_number_of_threads(&[&equilibria[..], &range("0", "3")].concat());
}

#[test]
fn a_sweep_of_motions_finds_what_runs_find() {
    let (_keep, folder) = temporary("sweep");
    let tower = scene("tower.toml");
    let sweep = ["sweep", &tower, "-p", "amplitude", "--from", "0", "--to", "0.01", "--samples", "3"];
    let document = json(&[&sweep[..], &["--what", "motion", "-o", &folder]].concat());
    let (_keep, single) = temporary("run");
    json(&["run", &tower, "--set", "amplitude=0.005", "-o", &single, "--no-view"]);
    let table = Results::open(Path::new(&single)).unwrap().table().unwrap();
    let tensions: Vec<f64> =
        table.group("tension").into_iter().flat_map(|k| table.columns[k].clone()).collect();
    let largest = tensions.iter().copied().fold(f64::MIN, f64::max);
    let smallest = tensions.iter().copied().fold(f64::MAX, f64::min);
    let slack = table.group("slack");
    let slack_rows = (1..table.rows()).filter(|&row| slack.iter().any(|&k| table.columns[k][row] == 1.0));
    let share = slack_rows.count() as f64 / (table.rows() - 1) as f64;
    let sample = &document["samples"][1];
    assert_eq!(sample["value"], 0.005);
    assert_eq!(sample["failure"], Value::Null);
    assert_eq!(sample["largest_tension"]["value"], largest);
    let cable = sample["largest_tension"]["of"].as_str().unwrap();
    assert!(table.column(&format!("{cable}.tension")).unwrap().contains(&largest), "{cable}");
    assert_eq!(sample["smallest_tension"]["value"], smallest);
    assert!((sample["slack_share"].as_f64().unwrap() - share).abs() < 1e-9, "{sample}");
    assert_eq!(sample["energy_at_end"], *table.column("total energy").unwrap().last().unwrap());
    // The farthest point of all members is at least as far as those watched.
    let moved = |name: &str| {
        let [x, y] = ["x", "y"].map(|axis| table.column(&format!("{name}.{axis}")).unwrap());
        x.iter().zip(y).map(|(a, b)| (a - x[0]).hypot(b - y[0])).fold(0.0, f64::max)
    };
    let displacement = sample["largest_displacement"]["value"].as_f64().unwrap();
    assert!(displacement > 0.0 && displacement > moved("triangle 7.p1").max(moved("triangle 7.p2")) - 1e-12);
    let results = Results::open(Path::new(&folder)).unwrap();
    assert_eq!(results.table().unwrap().column("largest tension").unwrap()[1], largest);
    assert!(Path::new(&folder).join("view.html").exists());
    assert_eq!(run(&["plot", &folder, "--what", "sweep"]).status.code(), Some(0));
}

/// A bar without mass at the first value, and a cable too stiff for an explicit step at the last.
#[test]
fn a_run_that_fails_leaves_the_others() {
    let (keep, folder) = temporary("sweep");
    let path = keep.path().join("bead.toml");
    let bead = r#"
        version = 1
        dimension = 2
        gravity = [0, "-g"]
        parameters.m = 1
        anchors.peg = [0, 0]
        bars.rod = { ends = [[0, -1], [1, -1]], mass = "m" }
        cables.line = { ends = ["peg", "rod.from"], stiffness = "10^(6*m - 3)", rest = 1 }
        run = { duration = 0.1, step = 1e-2, scheme = "leapfrog" }
    "#;
    std::fs::write(&path, bead).unwrap();
    let range = ["--from", "0", "--to", "2", "--samples", "3", "--what", "motion", "-o", &folder];
    let output = run(&[&["--json", "sweep", path.to_str().unwrap(), "-p", "m"], &range[..]].concat());
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("2 of 3 runs failed"), "{}", text(&output.stderr));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let samples = document["samples"].as_array().unwrap();
    assert!(samples[0]["failure"].as_str().unwrap().contains("must be positive"), "{document}");
    assert!(samples[0]["end"].is_null());
    assert!(samples[1]["failure"].is_null() && samples[1]["end"] == 0.1, "{document}");
    assert!(samples[2]["failure"].is_string() && samples[2]["end"].as_f64().unwrap() < 0.1, "{document}");
    let table = Results::open(Path::new(&folder)).unwrap().table().unwrap();
    let tensions = table.column("largest tension").unwrap();
    assert!(tensions[0].is_nan() && tensions[1] > 1.0 && tensions[2].is_nan());
    let output = run(&[&["sweep", path.to_str().unwrap(), "-p", "m"], &range[..], &["--force"]].concat());
    assert!(text(&output.stdout).contains("failed: after "), "{}", text(&output.stdout));
}

#[test]
fn a_sweep_of_motions_needs_a_parameter_and_a_run() {
    let (keep, _) = temporary("");
    let path = keep.path().join("still.toml");
    std::fs::write(
        &path,
        "version = 1\ndimension = 2\nparameters.m = 1\nparticles.p = { at = [0, 0], mass = \"m\" }\n",
    )
    .unwrap();
    let range = ["--from", "1", "--to", "2", "--what", "motion"];
    for (scene, parameter, message) in [
        (path.to_str().unwrap().to_string(), "m", "no [run] section"),
        (scene("tower.toml"), "nosuch", "no parameter `nosuch`"),
    ] {
        let output = run(&[&["sweep", &scene, "-p", parameter], &range[..]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains(message), "{}", text(&output.stderr));
    }
}
