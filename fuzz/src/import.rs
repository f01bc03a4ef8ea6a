//! Imports from any bytes: tables of nodes, bars and cables, NTRT's YAML, neutral JSON. The first byte tells which; tables are
//! parted by the byte 0. Nothing may panic, hang or take memory without measure; what is imported is a scene that can be
//! read.
#![no_main]

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use tg_scene::{ImportError, Language, SceneFile, import};

/// A folder of this process.
static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
    let shared = Path::new("/dev/shm");
    let above = if shared.is_dir() { shared.to_owned() } else { std::env::temp_dir() };
    let folder = above.join(format!("tg-fuzz-import-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("a folder");
    folder
});

fuzz_target!(|data: &[u8]| {
    let Some((kind, rest)) = data.split_first() else { return };
    let files = match kind % 3 {
        0 => ["nodes.csv", "bars.csv", "cables.csv"].iter().zip(rest.split(|byte| *byte == 0)).collect(),
        1 => vec![(&"structure.yaml", rest)],
        _ => vec![(&"structure.json", rest)],
    };
    for name in ["nodes.csv", "bars.csv", "cables.csv"] {
        let _ = fs::remove_file(FOLDER.join(name));
    }
    for (name, bytes) in &files {
        fs::write(FOLDER.join(name), bytes).expect("a file");
    }
    match import(&FOLDER.join(files[0].0)) {
        Ok(imported) => {
            let scene = SceneFile::parse(&imported.toml, Language::Toml, "imported", FOLDER.clone());
            assert!(scene.is_ok(), "{:?}\n{}", scene.err(), imported.toml);
        }
        Err(ImportError::Mistake(mistake)) => {
            assert!(mistake.line >= 1 && mistake.column >= 1 && !mistake.message.is_empty());
            assert!(!mistake.render(true).is_empty());
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
});
