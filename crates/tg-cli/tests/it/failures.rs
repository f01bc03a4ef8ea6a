//! Exit codes and messages: 2 for bad input, 1 for an analysis that fails.

use crate::{run, scene, temporary, text};

/// A scene of its own in a file.
fn write(name: &str, content: &str) -> (tempfile::TempDir, String) {
    let (folder, path) = temporary(name);
    std::fs::write(&path, content).unwrap();
    (folder, path)
}

#[test]
fn a_mistake_in_a_scene_is_shown_in_its_line() {
    let (_folder, path) = write("slip.toml", "version = 1\ndimension = 3\nbarrs = {}\n");
    let output = run(&["check", &path]);
    let messages = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    for part in ["unknown key `barrs`", "slip.toml:3:1", "barrs = {}", "^^^^^", "did you mean `bars`?"] {
        assert!(messages.contains(part), "{part} in {messages}");
    }
}

#[test]
fn machines_get_the_mistake_as_one_document() {
    let (_folder, path) = write("slip.json", r#"{ "version": 1, "dimension": 3, "gravity": [0, 0] }"#);
    let output = run(&["check", &path, "--json"]);
    assert_eq!(output.status.code(), Some(2));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["error"]["kind"], "scene");
    assert_eq!(document["error"]["line"], 1);
    assert_eq!(document["error"]["column"], 44);
}

#[test]
fn what_is_no_scene_or_no_result_is_bad_input() {
    let (_folder, path) = write("notes.txt", "not a scene");
    for arguments in [
        vec!["check", &path],
        vec!["check", "there is no such file.toml"],
        vec!["view", "there is no such folder"],
        vec!["plot", "there is no such folder"],
        vec!["modes", &scene("tower.toml"), "--set", "nosuch=1"],
        vec!["modes", &scene("tower.toml"), "--set", "alpha=one"],
        vec!["run", &scene("tower.toml"), "--step", "-1"],
        vec!["sweep", &scene("tower.toml"), "-p", "nosuch", "--from", "0", "--to", "1"],
        vec!["statics", &scene("tower.toml"), "--unknown", "tension"],
        vec!["fly"],
    ] {
        let output = run(&arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!output.stderr.is_empty(), "{arguments:?}");
    }
}

#[test]
fn an_infeasible_request_fails_with_code_one() {
    let scene = scene("deployable.toml");
    let output =
        run(&["statics", &scene, "--inverse", "--least-tension", "1", "--greatest-tension", "1.001"]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("tension"), "{}", text(&output.stderr));
}

#[test]
fn a_structure_with_too_many_equilibria_is_refused_with_code_one() {
    let output = run(&["equilibria", &scene("mechanism.toml"), "--max-paths", "3"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stderr).contains("path"), "{}", text(&output.stderr));
}

/// A cable that is reeled in against a bar that cannot move: no step has a solution in the end, or none is balanced.
#[test]
fn a_run_that_fails_keeps_what_it_has() {
    let (_folder, path) = write(
        "torn.toml",
        r#"
        version = 1
        dimension = 2
        anchors.peg = [0, 0]
        particles.bead = { at = [1, 0], mass = 1e-9 }
        cables.line = { ends = ["peg", "bead"], stiffness = 1e9, rest = { ramp = { from = 1, to = 0, duration = 1e-3 } } }
        run = { duration = 1, step = 0.1 }
        "#,
    );
    let (_results, folder) = temporary("out");
    let output = run(&["run", &path, "-o", &folder]);
    let code = output.status.code();
    assert!(code == Some(0) || code == Some(1), "{}", text(&output.stderr));
    let manifest: serde_json::Value =
        serde_json::from_slice(&std::fs::read(format!("{folder}/run.json")).unwrap()).unwrap();
    assert_eq!(manifest["complete"], code == Some(0));
}
