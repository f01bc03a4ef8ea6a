//! The program as maintainers and CI call it.
#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::process::{Command, Output};

fn xtask(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_xtask")).args(arguments).output().unwrap()
}

#[test]
fn the_layers_hold() {
    let output = xtask(&["layers"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
fn headings_that_the_code_cites_are_there() {
    let output = xtask(&["cites"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stdout));
}

#[test]
fn verify_prints_one_json_document() {
    let output = xtask(&["verify", "--case", "example1", "--json"]);
    assert!(output.status.success());
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["failed"], 0);
    let rows = document["rows"].as_array().unwrap();
    assert_eq!(document["passed"], rows.len());
    assert!(rows.iter().all(|row| row["case"] == "example1" && row["pass"] == true));
}

#[test]
fn verify_prints_tables() {
    let output = xtask(&["verify", "--case", "example1"]);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("quantity") && text.contains("numbers hold"), "{text}");
}

#[test]
fn an_unknown_case_is_bad_input() {
    let output = xtask(&["verify", "--case", "example9"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("there are example1"));
}

/// What `instructions` counts: it must not fail for the first time under callgrind.
#[test]
fn every_scheme_steps_every_structure() {
    let output = xtask(&["counted-steps"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).unwrap();
    for scene in ["mast, N = 8", "mast, N = 32", "example 3"] {
        let schemes = text.lines().filter(|line| line.contains(scene)).count();
        assert!(schemes >= 3, "{scene}: {schemes} schemes");
    }
}
