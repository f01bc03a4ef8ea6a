//! Ctrl-C, kill and `--resume`.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use tg_report::{Results, Table};

use crate::{json, run, scene, temporary, text, tg};

const DURATION: &str = "60";

/// A long run in the background, some way into it.
fn started(folder: &str) -> Child {
    let scene = scene("tower.toml");
    let mut command =
        tg(&["run", &scene, "--set", "auxiliary_ground=0", "--duration", DURATION, "-o", folder]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let begin = Instant::now();
    while rows(folder) < 500 && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    child
}

fn rows(folder: &str) -> usize {
    Results::open(Path::new(folder)).and_then(|results| results.table()).map_or(0, |table| table.rows())
}

fn signal(child: &Child, name: &str) {
    assert!(Command::new("kill").args([name, &child.id().to_string()]).status().unwrap().success());
}

fn table(folder: &str) -> Table {
    Results::open(Path::new(folder)).unwrap().table().unwrap()
}

/// A shorter run that is not interrupted, and the interrupted one resumed to the same end.
#[track_caller]
fn resumes_bit_for_bit(folder: &str) {
    let (_keep, whole) = temporary("whole");
    let scene = scene("tower.toml");
    let end = Results::open(Path::new(folder)).unwrap().table().unwrap();
    let end = format!("{}", end.column("time").unwrap().last().unwrap() + 0.05);
    let arguments = ["run", &scene, "--set", "auxiliary_ground=0", "--duration", &end, "-o"];
    json(&[&arguments[..], &[folder, "--resume"]].concat());
    json(&[&arguments[..], &[&whole]].concat());
    let (resumed, whole) = (table(folder), table(&whole));
    assert_eq!(resumed.rows(), whole.rows());
    assert_eq!(resumed.columns, whole.columns);
}

#[test]
fn an_interrupt_stops_at_a_step_and_the_run_can_go_on() {
    let (_keep, folder) = temporary("out");
    let child = started(&folder);
    signal(&child, "-INT");
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(text(&output.stderr).contains("--resume"));
    let results = Results::open(Path::new(&folder)).unwrap();
    assert!(!results.manifest.complete);
    assert_eq!(results.manifest.interrupted.as_deref(), Some("stopped by Ctrl-C"));
    assert!(Path::new(&folder).join("view.html").exists());
    resumes_bit_for_bit(&folder);
}

#[test]
fn a_killed_run_loses_nothing_written() {
    let (_keep, folder) = temporary("out");
    let mut child = started(&folder);
    let seen = rows(&folder);
    child.kill().unwrap();
    child.wait().unwrap();
    let left = rows(&folder);
    assert!(left >= seen && seen >= 500, "{left} rows of {seen}");
    json(&["view", &folder]);
    resumes_bit_for_bit(&folder);
}

#[test]
fn results_of_another_scene_are_not_resumed() {
    let (_keep, folder) = temporary("out");
    json(&["run", &scene("tower.toml"), "--duration", "0.01", "-o", &folder]);
    let output = run(&["run", &scene("double_pendulum.toml"), "-o", &folder, "--resume"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("another scene"));
}
