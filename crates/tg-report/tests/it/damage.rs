//! Files with wrong bits, cut off, or with pieces of themselves elsewhere: what is read is what was written, or its beginning,
//! or an error that names a file. Nothing panics.

use std::fs;
use std::path::Path;

use tempfile::tempdir;
use tg_report::{Existing, Formats, Kind, Manifest, ReportError, Results, ResultsWriter, Table, View};

use crate::sample;

/// Rows in a closed part, and in all.
const ROWS: [usize; 2] = [20, 33];
const FRAMES: usize = 4;

/// A folder of a run that was killed after it was resumed: a part, a journal, frames, a checkpoint.
fn killed(path: &Path) {
    let mut manifest = Manifest::new(Kind::Run, "Sample");
    manifest.channels = sample::channels();
    manifest.outline = Some(sample::outline());
    let mut writer = ResultsWriter::create(path, manifest, Formats::default(), Existing::Keep).unwrap();
    (0..ROWS[0]).for_each(|k| writer.row(&sample::row(k)).unwrap());
    writer.finish(|_| ()).unwrap();
    let mut writer = ResultsWriter::resume(path, Formats::default(), f64::INFINITY).unwrap();
    (ROWS[0]..ROWS[1]).for_each(|k| writer.row(&sample::row(k)).unwrap());
    sample::frames(FRAMES).iter().for_each(|frame| writer.frame(frame).unwrap());
    writer.checkpoint(&serde_json::json!({ "t": 0.25 })).unwrap();
}

/// Random numbers (xorshift), the same in each run.
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % limit.max(1) as u64) as usize
    }

    /// A damaged copy.
    fn damage(&mut self, bytes: &[u8]) -> Vec<u8> {
        let mut damaged = bytes.to_vec();
        let (at, other) = (self.below(bytes.len()), self.below(bytes.len()));
        match self.below(4) {
            0 => damaged.truncate(at),
            1 => damaged[at] = self.below(256) as u8,
            2 => damaged.splice(at..at.max(other), []).for_each(drop),
            _ => damaged[at] ^= 1 << self.below(8),
        }
        damaged
    }
}

#[test]
fn of_a_folder_is_refused_or_left_out() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    killed(path);
    let whole = sample::table(ROWS[1]);
    assert_eq!(Results::open(path).unwrap().table().unwrap(), whole);
    let manifest = Results::open(path).unwrap().manifest;
    let mut random = Random(1);
    let mut counts = [0; 2];
    for name in [
        "run.json",
        "parts.json",
        "trajectory/part-00000.parquet",
        "journal.bin",
        "frames.ndjson",
        "checkpoint.json",
    ] {
        let sound = fs::read(path.join(name)).unwrap();
        for _ in 0..250 {
            let damaged = random.damage(&sound);
            fs::write(path.join(name), &damaged).unwrap();
            let read = Results::open(path).and_then(|results| {
                let rows = results.table()?;
                Ok((rows, results.frames()?, results.checkpoint::<serde_json::Value>()?, results.manifest))
            });
            match read {
                Ok((rows, frames, checkpoint, read)) => {
                    assert!(rows == sample::table(rows.rows()) && rows.rows() >= ROWS[0], "{name}");
                    assert_eq!(frames, sample::frames(frames.len()), "{name}");
                    assert_eq!(checkpoint.unwrap()["t"], 0.25, "{name}");
                    assert_eq!(read, manifest, "{name}");
                    counts[0] += 1;
                }
                Err(error) => {
                    let error = error.to_string();
                    assert!(error.contains(name) || error.contains("run.json"), "{name}: {error}");
                    counts[1] += 1;
                }
            }
        }
        fs::write(path.join(name), &sound).unwrap();
    }
    assert!(counts[0] > 100 && counts[1] > 700, "{counts:?}");
}

/// These have no checksum beside them: numbers may be others, but nothing panics.
#[test]
fn of_files_alone_never_panics() {
    let folder = tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let table = sample::table(20);
    table.write_parquet(&path("a.parquet")).unwrap();
    table.write_csv(&path("a.csv")).unwrap();
    table.write_npy(&path("a.npy")).unwrap();
    let mut random = Random(2);
    let mut try_out = |name: &str, read: fn(&Path) -> Result<Table, ReportError>| {
        let sound = fs::read(path(name)).unwrap();
        let mut refused = 0;
        for _ in 0..700 {
            fs::write(path(name), random.damage(&sound)).unwrap();
            refused += usize::from(read(&path(name)).is_err());
        }
        assert!(refused > 100, "{name}: {refused}");
    };
    try_out("a.parquet", Table::read_parquet);
    try_out("a.csv", Table::read_csv);
    try_out("a.npy", Table::read_npy);
}

#[test]
fn what_vanishes_is_told() {
    for name in ["run.json", "parts.json", "trajectory/part-00000.parquet", "journal.bin", "frames.ndjson"] {
        let folder = tempdir().unwrap();
        killed(folder.path());
        fs::remove_file(folder.path().join(name)).unwrap();
        let view = Results::open(folder.path()).and_then(|results| View::of(&results));
        let message = view.unwrap_err().to_string();
        assert!(message.contains(name), "{message}");
        let resumed = ResultsWriter::resume(folder.path(), Formats::default(), f64::INFINITY);
        let message = resumed.map(|_| ()).unwrap_err().to_string();
        assert!(message.contains(name), "{message}");
    }
}

/// Killed before anything was computed a folder is no obstacle.
#[test]
fn a_folder_that_was_hardly_begun_is_begun_again() {
    let folder = tempdir().unwrap();
    killed(folder.path());
    fs::remove_file(folder.path().join("run.json")).unwrap();
    let create = |existing| {
        let manifest = Manifest::new(Kind::Run, "Sample");
        ResultsWriter::create(folder.path(), manifest, Formats::default(), existing).map(|_| ())
    };
    // Each of these tells that something was computed.
    for name in ["checkpoint.json", "trajectory/part-00000.parquet", "journal.bin", "frames.ndjson"] {
        let message = create(Existing::Replace).unwrap_err().to_string();
        assert!(message.contains("no results"), "{message}");
        fs::remove_file(folder.path().join(name)).unwrap();
    }
    create(Existing::Keep).unwrap();
}
