//! Results folders with one foreign file: the first byte tells which, the others are its content. All is read, shown, and
//! gone on with. Nothing may panic, hang or take memory without measure. Under `cfg(fuzzing)` every checksum is zero, so that
//! what comes after them is reached.
#![no_main]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use tg_report::{
    CableFrame, CableOutline, Channel, Existing, Formats, Frame, Kind, Manifest, MemberOutline, Outline,
    Placement, ReportError, Results, ResultsWriter, View,
};

const FILES: [&str; 9] = [
    "run.json",
    "parts.json",
    "trajectory/part-00000.parquet",
    "journal.bin",
    "frames.ndjson",
    "checkpoint.json",
    "modes.json",
    "shapes.json",
    "plots.json",
];

/// A sound folder, and a copy for each input.
static FOLDERS: LazyLock<[PathBuf; 2]> = LazyLock::new(|| {
    let shared = Path::new("/dev/shm");
    let above = if shared.is_dir() { shared.to_owned() } else { std::env::temp_dir() };
    let folders =
        ["sound", "damaged"].map(|name| above.join(format!("tg-fuzz-{name}-{}", std::process::id())));
    fill(&folders[0]).expect("a folder");
    // The reader of Parquet may panic: its caller makes an error of it, where libFuzzer would end at once.
    let ends = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if !panic.location().is_some_and(|place| place.file().contains("/parquet-")) {
            ends(panic);
        }
    }));
    folders
});

/// A part with three rows, two more in the journal, two frames.
fn fill(path: &Path) -> Result<(), ReportError> {
    let mut outline = Outline::new(2);
    outline.members.push(MemberOutline::bar("mast", [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]], 0.02));
    outline.cables.push(CableOutline { name: "guy".into(), group: None });
    let mut manifest = Manifest::new(Kind::Run, "A mast");
    manifest.channels = vec![Channel::time(), Channel::new("guy.tension", "N", "tension")];
    manifest.outline = Some(outline);
    let formats = Formats::default();
    let mut writer = ResultsWriter::create(path, manifest, formats, Existing::Replace)?;
    (0..3).try_for_each(|k| writer.row(&[f64::from(k), 1.0]))?;
    for k in 0..2 {
        let mast = Placement::plane([0.0, 1.0], 0.1);
        let ends = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let guy = CableFrame { ends, tension: 50.0, length: 2.2, rest: 2.1, slack: false };
        writer.frame(&Frame { time: f64::from(k), poses: vec![mast], cables: vec![guy] })?;
    }
    writer.finish(|manifest| manifest.interrupted = Some("now".into()))?;
    // Goes on: the part stays, the journal begins.
    let mut writer = ResultsWriter::resume(path, formats, f64::INFINITY)?;
    (3..5).try_for_each(|k| writer.row(&[f64::from(k), 1.0]))?;
    writer.checkpoint(&serde_json::json!({ "t": 4.0 }))
}

fn look(path: &Path) -> Result<(), ReportError> {
    let results = Results::open(path)?;
    let _ = results.table();
    let _ = results.frames();
    let _ = results.checkpoint::<serde_json::Value>();
    let _ = View::of(&results).and_then(|view| view.html());
    let mut writer = ResultsWriter::resume(path, Formats { csv: true, npy: true }, 3.5)?;
    let _ = writer.row(&[4.0, 1.0]);
    writer.finish(|_| ())?;
    Results::open(path)?.table().map(|_| ())
}

/// A part with some bytes changed, three bytes for each: two for the place, one for the change. From nothing a fuzzer makes no
/// Parquet file.
fn edited(part: &[u8], edits: &[u8]) -> Vec<u8> {
    let mut part = part.to_vec();
    for edit in edits.chunks_exact(3) {
        let place = usize::from(u16::from_le_bytes([edit[0], edit[1]])) % part.len();
        part[place] ^= edit[2];
    }
    part
}

fuzz_target!(|data: &[u8]| {
    let Some((which, content)) = data.split_first() else { return };
    let [sound, damaged] = &*FOLDERS;
    fs::remove_dir_all(damaged).ok();
    fs::create_dir_all(damaged.join("trajectory")).expect("a folder");
    for entry in ["trajectory", "."].iter().flat_map(|at| fs::read_dir(sound.join(at)).expect("a folder")) {
        let path = entry.expect("an entry").path();
        if path.is_file() {
            fs::copy(&path, damaged.join(path.strip_prefix(sound).expect("a path"))).expect("a copy");
        }
    }
    let file = FILES[usize::from(*which) % FILES.len()];
    let content = if file.ends_with("parquet") {
        &edited(&fs::read(sound.join(file)).expect("a part"), content)
    } else {
        content
    };
    fs::write(damaged.join(file), content).expect("a file");
    if let Err(error) = look(damaged) {
        assert!(!error.to_string().is_empty());
    }
});
