//! Results folders: finished, cut off, continued.

use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::Path;
use std::process::Command;

use serde_json::json;
use tempfile::tempdir;
use tg_report::{Existing, Formats, Kind, Manifest, PART_ROWS, ReportError, Results, ResultsWriter, Table};

use crate::sample;

fn manifest() -> Manifest {
    let mut manifest = Manifest::new(Kind::Run, "Sample");
    manifest.channels = sample::channels();
    manifest.outline = Some(sample::outline());
    manifest
}

fn start(path: &Path) -> ResultsWriter {
    ResultsWriter::create(path, manifest(), Formats::default(), Existing::Keep).unwrap()
}

#[test]
fn a_finished_folder_has_everything() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a/b");
    let all = Formats { csv: true, npy: true };
    let mut writer = ResultsWriter::create(&path, manifest(), all, Existing::Keep).unwrap();
    let rows = PART_ROWS + 100;
    (0..rows).for_each(|k| writer.row(&sample::row(k)).unwrap());
    sample::frames(5).iter().for_each(|f| writer.frame(f).unwrap());
    writer.document("notes", &json!({"a": 1})).unwrap();
    writer.checkpoint(&json!({"time": 2.5})).unwrap();
    writer.finish(|m| m.summary = json!({"steps": rows})).unwrap();

    let results = Results::open(&path).unwrap();
    assert!(results.manifest.complete);
    assert_eq!(results.manifest.summary["steps"], rows);
    assert_eq!(results.manifest.documents, ["notes"]);
    let table = results.table().unwrap();
    assert_eq!(table, sample::table(rows));
    assert_eq!(results.frames().unwrap(), sample::frames(5));
    assert_eq!(results.document::<serde_json::Value>("notes").unwrap().unwrap()["a"], 1);
    assert_eq!(results.checkpoint::<serde_json::Value>().unwrap().unwrap()["time"], 2.5);
    assert!(results.modes().unwrap().is_none() && results.shapes().unwrap().is_empty());
    assert_eq!(Table::read_csv(&path.join("trajectory.csv")).unwrap().columns, table.columns);
    assert_eq!(Table::read_npy(&path.join("trajectory.npy")).unwrap().columns, table.columns);
    // Data frames read the folder of parts as a whole: nothing else may be in it.
    let parts: Vec<_> =
        fs::read_dir(path.join("trajectory")).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert!(
        parts.len() > 1 && parts.iter().all(|name| name.to_string_lossy().ends_with(".parquet")),
        "{parts:?}"
    );
    assert!(!path.join("journal.bin").exists());
}

#[test]
fn what_was_interrupted_says_so() {
    let folder = tempdir().unwrap();
    start(folder.path()).finish(|m| m.interrupted = Some("Ctrl-C".into())).unwrap();
    let results = Results::open(folder.path()).unwrap();
    assert!(!results.manifest.complete);
    assert_eq!(results.manifest.interrupted.as_deref(), Some("Ctrl-C"));
    assert_eq!(results.table().unwrap().rows(), 0);
}

#[test]
fn a_dropped_writer_loses_nothing_and_torn_ends_are_left_out() {
    let folder = tempdir().unwrap();
    let mut writer = start(folder.path());
    (0..70).for_each(|k| writer.row(&sample::row(k)).unwrap());
    sample::frames(3).iter().for_each(|f| writer.frame(f).unwrap());
    assert_eq!(Results::open(folder.path()).unwrap().table().unwrap(), sample::table(70), "while it runs");
    drop(writer);
    let torn = |name: &str, bytes: &[u8]| {
        let file = OpenOptions::new().append(true).open(folder.path().join(name));
        file.unwrap().write_all(bytes).unwrap();
    };
    torn("journal.bin", &[1; 13]);
    torn("frames.ndjson", b"{\"time\":0.3,\"poses\":[[0.1,");
    let results = Results::open(folder.path()).unwrap();
    assert!(!results.manifest.complete);
    assert_eq!(results.table().unwrap(), sample::table(70));
    assert_eq!(results.frames().unwrap(), sample::frames(3));

    let mut writer = ResultsWriter::resume(folder.path(), Formats::default(), f64::INFINITY).unwrap();
    writer.row(&sample::row(70)).unwrap();
    writer.frame(&sample::frames(4)[3]).unwrap();
    writer.finish(|_| ()).unwrap();
    let results = Results::open(folder.path()).unwrap();
    assert_eq!(results.table().unwrap(), sample::table(71));
    assert_eq!(results.frames().unwrap(), sample::frames(4));
}

/// Run by the next test as a process of its own.
#[test]
#[ignore = "ends its process"]
fn writes_until_it_is_killed() {
    let path = std::env::var_os("TG_REPORT_TEST_FOLDER").unwrap();
    let mut writer = start(Path::new(&path));
    for k in 0..PART_ROWS + 77 {
        writer.row(&sample::row(k)).unwrap();
    }
    writer.frame(&sample::frame(0.0)).unwrap();
    std::process::abort();
}

#[test]
fn a_killed_program_loses_nothing() {
    let folder = tempdir().unwrap();
    let mut child = Command::new(std::env::current_exe().unwrap());
    child.args(["--ignored", "--exact", "folder::writes_until_it_is_killed"]);
    child.env("TG_REPORT_TEST_FOLDER", folder.path());
    assert!(!child.output().unwrap().status.success());
    let results = Results::open(folder.path()).unwrap();
    let rows = PART_ROWS + 77;
    assert_eq!(results.table().unwrap(), sample::table(rows));
    assert_eq!(results.frames().unwrap().len(), 1);
    // Other programs see the parts alone.
    let parts = || {
        let folder = fs::read_dir(folder.path().join("trajectory")).unwrap();
        folder.map(|e| Table::read_parquet(&e.unwrap().path()).unwrap().rows()).sum::<usize>()
    };
    let left = rows - parts();
    assert!(left > 0);
    assert_eq!((results.recover().unwrap(), parts()), (left, rows));
    assert_eq!(results.table().unwrap(), sample::table(rows));
    assert_eq!(results.recover().unwrap(), 0);
}

#[test]
fn no_row_counts_twice_if_killed_between_part_and_journal() {
    let folder = tempdir().unwrap();
    let mut writer = start(folder.path());
    (0..20).for_each(|k| writer.row(&sample::row(k)).unwrap());
    drop(writer);
    sample::table(20).write_parquet(&folder.path().join("trajectory/part-00000.parquet")).unwrap();
    assert_eq!(Results::open(folder.path()).unwrap().table().unwrap(), sample::table(20));
    ResultsWriter::resume(folder.path(), Formats::default(), f64::INFINITY).unwrap().finish(|_| ()).unwrap();
    assert_eq!(Results::open(folder.path()).unwrap().table().unwrap(), sample::table(20));
}

#[test]
fn resuming_drops_what_is_later() {
    for (kept, killed) in [(31, true), (PART_ROWS / 2, false), (PART_ROWS + 10, true), (0, false)] {
        let folder = tempdir().unwrap();
        let mut writer = start(folder.path());
        (0..PART_ROWS + 50).for_each(|k| writer.row(&sample::row(k)).unwrap());
        sample::frames(30).iter().for_each(|f| writer.frame(f).unwrap());
        if !killed {
            writer.finish(|_| ()).unwrap();
        } else {
            drop(writer);
        }
        let time = sample::row(kept)[0] - 0.005;
        let mut writer = ResultsWriter::resume(folder.path(), Formats::default(), time).unwrap();
        let results = Results::open(folder.path()).unwrap();
        assert_eq!(results.table().unwrap(), sample::table(kept));
        assert!(!results.manifest.complete);
        let frames = results.frames().unwrap();
        assert_eq!(frames, sample::frames(30).into_iter().filter(|f| f.time <= time).collect::<Vec<_>>());
        (kept..kept + 5).for_each(|k| writer.row(&sample::row(k)).unwrap());
        writer.finish(|_| ()).unwrap();
        assert_eq!(Results::open(folder.path()).unwrap().table().unwrap(), sample::table(kept + 5));
    }
}

#[test]
fn nothing_is_overwritten_unasked() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    let create = |existing| ResultsWriter::create(path, manifest(), Formats::default(), existing).map(|_| ());
    fs::write(path.join("thesis.tex"), "precious").unwrap();
    for existing in [Existing::Keep, Existing::Replace] {
        assert!(matches!(create(existing), Err(ReportError::Foreign { found, .. }) if found == "thesis.tex"));
    }
    fs::remove_file(path.join("thesis.tex")).unwrap();

    let mut writer = start(path);
    writer.row(&sample::row(0)).unwrap();
    writer.frame(&sample::frame(0.0)).unwrap();
    writer.document("modes", &0).unwrap();
    writer.finish(|_| ()).unwrap();
    fs::write(path.join("notes.txt"), "precious").unwrap();
    assert!(matches!(create(Existing::Keep), Err(ReportError::Exists { .. })));
    assert_eq!(Results::open(path).unwrap().table().unwrap().rows(), 1);
    create(Existing::Replace).unwrap();
    let results = Results::open(path).unwrap();
    assert!(results.table().unwrap().rows() == 0 && results.frames().unwrap().is_empty());
    assert!(!path.join("modes.json").exists());
    assert_eq!(fs::read_to_string(path.join("notes.txt")).unwrap(), "precious");
}

#[test]
fn mistakes_are_named() {
    let folder = tempdir().unwrap();
    assert!(matches!(Results::open(folder.path()), Err(ReportError::NotResults { .. })));
    fs::write(folder.path().join("run.json"), "{\"format\": \"another\"}").unwrap();
    assert!(matches!(Results::open(folder.path()), Err(ReportError::NotResults { .. })));
    fs::remove_file(folder.path().join("run.json")).unwrap();
    let mut writer = start(folder.path());
    assert!(matches!(writer.row(&[0.0]), Err(ReportError::Count { got: 1, expected: 8, .. })));
    let mut short = sample::frame(0.0);
    short.cables.pop();
    assert!(matches!(writer.frame(&short), Err(ReportError::Count { got: 2, expected: 3, .. })));
    for name in ["run", "checkpoint", "../up", "", "A", "a.b"] {
        assert!(matches!(writer.document(name, &0), Err(ReportError::DocumentName { .. })), "{name}");
    }
    drop(writer);
    let mut manifest = manifest();
    manifest.channels[2].name = "time".into();
    let twice = ResultsWriter::create(folder.path(), manifest, Formats::default(), Existing::Replace);
    assert!(matches!(twice, Err(ReportError::Channel { index: 2, .. })));
}
