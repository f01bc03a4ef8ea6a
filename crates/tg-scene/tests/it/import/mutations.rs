//! No text makes an import panic; what is imported is TOML that can be read.

use std::path::Path;

use tg_scene::{Language, SceneFile, import};

use super::folder;
use super::neutral::CROSS;
use super::ntrt::KITE;
use super::triples::{BARS, CABLES, NODES};

/// Texts made from one: cut at each place, one character removed, one replaced, one piece taken out or said twice.
fn mutants(text: &str) -> Vec<String> {
    let mut all = Vec::new();
    for (at, c) in text.char_indices() {
        let (before, after) = (&text[..at], &text[at + c.len_utf8()..]);
        all.push(before.to_string());
        all.push(format!("{before}{after}"));
        let other = ["9", "-", "[", "\"", ",", ":", "{", "\n", "é", "/", ".", "#"][at % 12];
        all.push(format!("{before}{other}{after}"));
        // Places far apart, the same in each run.
        let (elsewhere, _) = text.char_indices().nth(at * 7919 % text.chars().count()).unwrap();
        all.push(format!("{before}{}", &text[elsewhere..]));
    }
    all
}

/// Imports each mutant; gives how many were accepted, and refused.
fn try_all(folder: &Path, file: &str, text: &str, start: &str) -> [usize; 2] {
    let mut counts = [0, 0];
    for mutant in mutants(text) {
        std::fs::write(folder.join(file), &mutant).unwrap();
        match import(&folder.join(start)) {
            Ok(imported) => {
                counts[0] += 1;
                if let Err(error) = SceneFile::parse(&imported.toml, Language::Toml, "scene", ".".into()) {
                    panic!("{error}\nof {mutant}");
                }
            }
            Err(error) => {
                counts[1] += 1;
                assert!(error.to_string().contains(file) || file.ends_with("csv"), "{error}\nof {mutant}");
            }
        }
    }
    counts
}

#[test]
fn of_each_format() {
    let tables = [("nodes.csv", NODES), ("bars.csv", BARS), ("cables.csv", CABLES)];
    for (k, (file, text)) in tables.into_iter().enumerate() {
        let path = folder(&format!("mutants{k}"), &tables);
        let [accepted, refused] = try_all(&path, file, text, "nodes.csv");
        assert!(accepted > 10 && refused > 10, "{file}: {accepted} {refused}");
    }
    for (file, text) in [("kite.yaml", KITE), ("cross.json", CROSS)] {
        let [accepted, refused] =
            try_all(&folder(&format!("mutants-{file}"), &[(file, text)]), file, text, file);
        assert!(accepted > 10 && refused > 10, "{file}: {accepted} {refused}");
    }
}
