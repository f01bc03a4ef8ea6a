//! SIGKILL at any time, a full disk, output that nobody takes, damaged checkpoints; `cargo xtask faults` tries more of each.

use std::fs::{self, OpenOptions};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Instant;

use serde_json::{Value, json};
use tg_report::{Formats, Results, ResultsWriter};

use crate::{run, scene, temporary, text, tg};

/// A run with many rows and checkpoints in a short time.
fn arguments<'a>(scene: &'a str, folder: &'a str) -> Vec<&'a str> {
    let settings = ["--duration", "0.04", "--step", "1e-5", "--checkpoint-every", "0.05", "--no-view"];
    [&["run", scene, "-o", folder][..], &settings].concat()
}

/// A run of a few rows, done; its arguments.
fn short_run<'a>(scene: &'a str, folder: &'a str) -> [&'a str; 7] {
    let line = ["run", scene, "--duration", "0.05", "-o", folder, "--no-view"];
    assert!(run(&line).status.success());
    line
}

/// What a run leaves, but for the time of day and for what is said only where it was begun anew.
fn content(folder: &str) -> (Vec<Vec<u64>>, [Vec<u8>; 2], Value) {
    let mut results = Results::open(Path::new(folder)).unwrap();
    let columns = results.table().unwrap().columns;
    let bits = columns.iter().map(|column| column.iter().map(|x| x.to_bits()).collect()).collect();
    let files =
        ["frames.ndjson", "checkpoint.json"].map(|name| fs::read(Path::new(folder).join(name)).unwrap());
    results.manifest.started = None;
    results.manifest.warnings.clear();
    (bits, files, serde_json::to_value(&results.manifest).unwrap())
}

/// A program of the shell; `$1` is `tg`, `$2` the scene, `$3` the folder.
fn shell(script: &str, scene: &str, folder: &str) -> Output {
    let line = ["-c", script, "sh", env!("CARGO_BIN_EXE_tg"), scene, folder];
    Command::new("bash").args(line).output().unwrap()
}

#[test]
fn killed_at_any_time_a_run_is_resumed_bit_for_bit() {
    let scene = scene("double_pendulum.toml");
    let (_keep, whole) = temporary("whole");
    let begin = Instant::now();
    assert!(run(&arguments(&scene, &whole)).status.success());
    let time = begin.elapsed();
    let whole = content(&whole);
    let mut killed = 0;
    for part in [0.0, 0.02, 0.05, 0.15, 0.3, 0.5, 0.7, 0.85, 0.95, 1.0] {
        let (_keep, folder) = temporary("out");
        let mut child =
            tg(&arguments(&scene, &folder)).stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(time.mul_f64(part));
        let _ = child.kill();
        killed += usize::from(child.wait().unwrap().code().is_none());
        if Path::new(&folder).join("run.json").exists() {
            let left = Results::open(Path::new(&folder)).unwrap().table().unwrap();
            for (left, whole) in left.columns.iter().zip(&whole.0) {
                assert!(left.iter().zip(whole).all(|(left, whole)| left.to_bits() == *whole), "{part}");
                assert!(left.len() <= whole.len(), "{part}");
            }
        }
        let resumed = run(&[&arguments(&scene, &folder)[..], &["--resume"]].concat());
        assert!(resumed.status.success(), "{part}: {}", text(&resumed.stderr));
        assert!(content(&folder) == whole, "killed after {part} of the time");
    }
    assert!(killed >= 3, "{killed}");
}

#[test]
#[cfg(target_os = "linux")]
fn a_full_disk_stops_a_run_that_goes_on_once_there_is_room() {
    let scene = scene("double_pendulum.toml");
    let (_keep, folder) = temporary("out");
    let full = shell(
        "trap '' XFSZ; ulimit -f 100; \"$1\" run \"$2\" -o \"$3\" --duration 0.04 --step 1e-5 --checkpoint-every 0.05 --no-view",
        &scene,
        &folder,
    );
    let message = text(&full.stderr);
    assert_eq!(full.status.code(), Some(1), "{message}");
    for part in ["cannot write", "journal.bin", "raise the limit", "--resume goes on from t ="] {
        assert!(message.contains(part), "{part} in {message}");
    }
    assert!(Results::open(Path::new(&folder)).unwrap().table().unwrap().rows() > 100);
    let resumed = run(&[&arguments(&scene, &folder)[..], &["--resume"]].concat());
    assert!(resumed.status.success(), "{}", text(&resumed.stderr));
    let (_keep, whole) = temporary("whole");
    assert!(run(&arguments(&scene, &whole)).status.success());
    assert!(content(&folder) == content(&whole));
}

#[test]
#[cfg(target_os = "linux")]
fn an_answer_that_cannot_be_printed_is_told_and_a_reader_that_goes_away_is_not() {
    let scene = scene("tower.toml");
    let full = shell("\"$1\" check \"$2\" >/dev/full", &scene, "");
    assert_eq!(full.status.code(), Some(1));
    assert!(text(&full.stderr).contains("the answer cannot be printed"), "{}", text(&full.stderr));
    let piped = shell("\"$1\" schema | true; exit ${PIPESTATUS[0]}", &scene, "");
    assert_eq!((piped.status.code(), text(&piped.stderr)), (Some(0), String::new()));
    let closed = shell("\"$1\" check nosuch.toml >&- 2>&-", &scene, "");
    assert_eq!(closed.status.code(), Some(2));
}

/// A checkpoint of another structure, or of nothing.
#[test]
fn a_checkpoint_that_does_not_fit_is_refused_and_the_rows_stay() {
    let (_keep, folder) = temporary("out");
    let scene = scene("tower.toml");
    let line = short_run(&scene, &folder);
    let results = Results::open(Path::new(&folder)).unwrap();
    let (rows, sound) = (results.table().unwrap().rows(), results.checkpoint::<Value>().unwrap().unwrap());
    let changed = |place: &str, value: Value| {
        let mut changed = sound.clone();
        *changed.pointer_mut(place).unwrap() = value;
        changed
    };
    let wrong = [
        (changed("/state/q", json!([1.0, 2.0])), "2 coordinates, the structure"),
        (changed("/state/v", json!([])), "0 velocities, the structure"),
        (changed("/state/lambda", json!([0.5])), "1 multipliers, the structure"),
        (changed("/state/t", json!(-1.0)), "its time is -1 s"),
        (changed("/state/t", json!(null)), "invalid type: null"),
        (changed("/method/step", json!(0.0)), "its step is 0 s"),
        (changed("/method/tolerance", json!(-1.0)), "its tolerance"),
        (changed("/method/scheme", json!("magic")), "magic"),
        (json!({}), "missing field"),
    ];
    for (checkpoint, says) in wrong {
        let mut writer =
            ResultsWriter::resume(Path::new(&folder), Formats::default(), f64::INFINITY).unwrap();
        writer.checkpoint(&checkpoint).unwrap();
        drop(writer);
        let output = run(&[&line[..], &["--resume"]].concat());
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{says}: {message}");
        assert!(message.contains(says) && message.contains("checkpoint.json"), "{says}: {message}");
        assert_eq!(Results::open(Path::new(&folder)).unwrap().table().unwrap().rows(), rows, "{says}");
    }
}

/// Two bytes of each file of a killed run, and its end, are no reason to panic; most are refused.
#[test]
fn damage_is_refused() {
    let (_keep, folder) = temporary("out");
    let scene = scene("tower.toml");
    let line = short_run(&scene, &folder);
    for name in ["run.json", "parts.json", "checkpoint.json", "trajectory/part-00000.parquet"] {
        let path = Path::new(&folder).join(name);
        let whole = fs::read(&path).unwrap();
        for at in [whole.len() / 3, whole.len() - 30] {
            let mut damaged = whole.clone();
            damaged[at] ^= 1;
            fs::write(&path, &damaged).unwrap();
            let output = run(&[&line[..], &["--resume"]].concat());
            let message = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{name}: {message}");
            assert!(message.contains(name), "{name}: {message}");
        }
        fs::write(&path, &whole).unwrap();
    }
    // What is a device stays one.
    let page = Path::new(&folder).join("page.html");
    OpenOptions::new().create(true).append(true).open(&page).unwrap();
    let view = |to: &str| run(&["view", &folder, "-o", to]);
    assert_eq!(view(page.to_str().unwrap()).status.code(), Some(0));
    assert!(fs::metadata(&page).unwrap().len() > 1000);
    if cfg!(target_os = "linux") {
        assert!(text(&view("/dev/full").stderr).contains("make room"));
    }
}
