//! Imports: numbers against hand calculations, faults against the line that they stand in.

mod mutations;
mod neutral;
mod ntrt;
mod published;
mod triples;

use std::path::{Path, PathBuf};

use tg_model::Model;
use tg_scene::{Built, ImportOptions, Imported, Language, SceneFile, Structure, import, import_with};

/// A new folder with some files.
fn folder(name: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("import").join(name);
    let _ = std::fs::remove_dir_all(&folder);
    for (file, text) in files {
        let path = folder.join(file);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    folder
}

fn build(imported: &Imported) -> Built {
    let file = SceneFile::parse(&imported.toml, Language::Toml, "imported.toml", ".".into());
    file.and_then(|file| file.build(&[])).unwrap_or_else(|error| panic!("{error}\n{}", imported.toml))
}

fn space(imported: &Imported) -> Structure<3> {
    let Built::Space(structure) = build(imported) else { panic!("{}", imported.toml) };
    *structure
}

/// Names, lengths and rest lengths of the cables as built.
fn cables<const D: usize>(model: &Model<D>) -> Vec<(String, f64, f64)> {
    let (q, v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
    let cable = |cable| {
        let state = model.cable(cable, &q, &v, &u);
        (model.cable_name(cable).to_string(), state.length, state.rest)
    };
    model.cables().map(cable).collect()
}

/// Mass of each member.
fn masses<const D: usize>(model: &Model<D>) -> Vec<(String, f64)> {
    let mass = |id| (model.member_name(id).to_string(), model.member(id).mass_properties().mass());
    model.members().map(mass).collect()
}

#[track_caller]
fn near(ours: f64, expected: f64) {
    assert!((ours - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{ours} is not {expected}");
}

/// The message must begin with the file, line and column and contain the parts.
#[track_caller]
fn refuses(path: &Path, place: &str, parts: &[&str]) {
    let error = import(path).unwrap_err().to_string();
    let (_, tail) = error.split_once(place).unwrap_or_else(|| panic!("{place} is not in {error}"));
    parts.iter().for_each(|part| assert!(tail.contains(part), "{part} is not in {error}"));
}

#[test]
fn unknown_formats_are_named() {
    let folder = folder(
        "unknown",
        &[("a.txt", "x"), ("other.csv", "x\n"), ("scene.json", r#"{"version": 1, "dimension": 3}"#)],
    );
    for (file, part) in [
        ("a.txt", "no import is known"),
        ("other.csv", "no import is known"),
        ("none.yaml", "check the path"),
        ("scene.json", "scene.json:1:1: this is a scene already"),
        ("", "nodes.csv"),
    ] {
        let error = import(&folder.join(file)).unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_scale_is_positive() {
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = ImportOptions { mass_scale: value, ..ImportOptions::default() };
        let error = import_with(Path::new("a.yaml"), &options).unwrap_err().to_string();
        assert!(error.starts_with("mass_scale is") && error.contains("positive"), "{error}");
    }
}
