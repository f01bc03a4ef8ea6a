//! The program as its users meet it: a process with arguments, an exit code, stdout and stderr.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod failures;
mod faults;
mod generated;
mod interrupted;
mod numbers;
mod outputs;
mod schemes;
mod sweeps;

use std::path::PathBuf;
use std::process::{Command, Output};

use serde_json::Value;

/// The program with arguments.
fn tg(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_tg"));
    command.args(arguments);
    command
}

fn run(arguments: &[&str]) -> Output {
    tg(arguments).output().unwrap()
}

/// A scene that is shipped.
fn scene(name: &str) -> String {
    let scenes = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    scenes.join(name).to_str().unwrap().into()
}

/// Runs with `--json` to success, and reads the one document on stdout.
#[track_caller]
fn json(arguments: &[&str]) -> Value {
    let output = run(&[&["--json"], arguments].concat());
    let messages = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {messages}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// A folder that vanishes with the test, and a path in it.
fn temporary(name: &str) -> (tempfile::TempDir, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name).to_str().unwrap().to_string();
    (folder, path)
}
