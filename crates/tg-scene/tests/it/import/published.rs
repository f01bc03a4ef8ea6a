//! Structures that others designed. The files are no part of the project; where their folder does not exist the test says so and
//! skips.

use std::path::Path;

use tg_scene::import;

use super::{cables, space};

#[test]
fn all_build_with_the_counts_and_rest_lengths_of_their_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/structures");
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("skipped: there is no folder of structures beside the project");
        return;
    };
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    assert!(!paths.is_empty());
    for path in paths {
        let file: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let list = |key: &str| file[key].as_array().unwrap();
        let imported = import(&path).unwrap();
        let model = space(&imported).model;
        let name = path.display();
        let welded: usize =
            list("bodies").iter().map(|body| body["bars"].as_array().map_or(0, Vec::len)).sum();
        assert_eq!(model.members().len(), list("bars").len() - welded + list("bodies").len(), "{name}");
        assert_eq!(model.cables().len(), list("cables").len(), "{name}");
        for (cable, (_, length, rest)) in list("cables").iter().zip(cables(&model)) {
            let number = |key: &str| cable[key].as_f64().unwrap();
            assert!((length - number("length")).abs() < 1e-9 * length, "{name}");
            assert!((rest - number("rest_length")).abs() < 1e-12 * length, "{name}");
        }
        for (bar, id) in list("bars").iter().zip(model.members()) {
            let mass = model.member(id).mass_properties().mass();
            let expected = bar["mass"].as_f64().unwrap_or_else(|| bar["length"].as_f64().unwrap());
            assert!((mass / expected - 1.0).abs() < 1e-12, "{name}");
        }
        println!("{name}: {} warnings {:?}", imported.warnings.len(), imported.warnings);
    }
}
