use tg_scene::{Built, import};

use super::{build, cables, folder, masses, near, refuses, space};

pub(super) const CROSS: &str = r#"{
  "name": "cross", "dim": 3,
  "source": { "repo": "example", "licence": "none" },
  "nodes": [[-1, 0, 0], [1, 0, 0], [0, -1, 0], [0, 1, 0], [0, 0, 2], [0, 0, 3]],
  "bars": [{ "nodes": [0, 1], "mass": 3.0 }, { "nodes": [2, 3], "mass": 1.0 }, { "nodes": [4, 5] }],
  "bodies": [{ "nodes": [0, 1, 2, 3], "bars": [0, 1] }],
  "cables": [
    { "nodes": [0, 4], "stiffness": 100, "damping": 2, "rest_length": 2.0, "tag": "stay" },
    { "nodes": [1, 4], "stiffness": 100, "damping": 2, "rest_length": 2.5, "tag": "stay" }
  ],
  "fixed": [{ "node": 5, "axes": [0, 1, 2] }]
}"#;

#[test]
fn a_welded_cross() {
    let imported = import(&folder("cross", &[("a.json", CROSS)]).join("a.json")).unwrap();
    let model = space(&imported).model;
    assert_eq!(masses(&model), [("body 0".to_string(), 4.0), ("bar 2".to_string(), 1.0)]);
    // Six of the body, two of the bar that hangs from node 5.
    assert_eq!(model.report().degrees_of_freedom(), 8);
    let inertia = model.member(model.members().next().unwrap()).mass_properties().inertia_matrix();
    // m l² / 12 of each bar, about the other's axis and about z.
    for (k, expected) in [1.0 / 3.0, 1.0, 4.0 / 3.0].into_iter().enumerate() {
        near(inertia[(k, k)], expected);
    }
    let cables = cables(&model);
    near(cables[0].2, 2.0);
    // Slack: 5^½ is shorter than 2.5.
    near(cables[1].1, 5.0_f64.sqrt());
    assert_eq!(imported.warnings.len(), 1, "{:?}", imported.warnings);
    assert!(imported.warnings[0].contains("1 bars have no mass"));
    assert!(imported.toml.contains("# repo: example\n") && imported.toml.contains("title = \"cross\""));
}

#[test]
fn a_body_with_stated_mass_in_the_plane() {
    let text = r#"{ "dim": 2, "nodes": [[0, 0], [1, 0], [0, 1]], "fixed": [{ "node": 0 }],
        "bodies": [{ "nodes": [0, 1, 2], "mass": 2, "com": [0.3, 0.3], "inertia_world": 0.1 }] }"#;
    let imported = import(&folder("plate", &[("a.json", text)]).join("a.json")).unwrap();
    let Built::Plane(structure) = build(&imported) else { panic!() };
    let model = &structure.model;
    assert_eq!(model.report().degrees_of_freedom(), 1);
    let mass = *model.member(model.members().next().unwrap()).mass_properties();
    near(mass.mass(), 2.0);
    near(mass.polar_moment(), 0.1);
}

#[test]
fn faults_are_named_with_their_place() {
    for (k, (from, to, place, part)) in [
        ("\"nodes\": [0, 4]", "\"nodes\": [0, 6]", ":8:20: ", "there is no node 6; there are 6, from 0"),
        ("\"nodes\": [0, 4]", "\"nodes\": [0, 0.5]", ":8:20: ", "there is no node 0.5"),
        ("\"nodes\": [0, 4]", "\"nodes\": [0]", ":8:16: ", "a pair of nodes is expected"),
        ("\"nodes\": [0, 4]", "\"nodes\": [0, 0]", ":8:5: ", "has the length 0"),
        ("\"stiffness\": 100", "\"stiffness\": -100", ":8:", "the stiffness is -100; it must be positive"),
        ("\"stiffness\": 100, ", "", ":8:5: ", "the key `stiffness` is missing"),
        ("[-1, 0, 0]", "[-1, 0]", ":4:13: ", "a node has 3 coordinates, not 2"),
        ("[-1, 0, 0]", "\"a\"", ":4:13: ", "a node [x, y, z] is expected, found `a`"),
        ("\"dim\": 3", "\"dim\": 4", ":2:", "2 or 3 dimensions, not 4"),
        ("\"bars\": [0, 1]", "\"bars\": [0, 0]", ":6:", "bar 0 is welded twice"),
        ("\"bars\": [0, 1]", "\"parts\": [0, 1]", ":6:14: ", "neither bars nor a mass"),
        ("\"mass\": 3.0", "\"mass\": 1e999", ":5:", "the mass"),
        ("\"axes\": [0, 1, 2]", "\"axes\": [3]", ":11:", "there is no axis 3"),
        ("\"nodes\": [[", "\"nods\": [[", ":1:1: ", "`nodes` is missing"),
        ("}\n  ],\n  \"fixed\"", "\n  ],\n  \"fixed\"", ":10:", ""),
    ]
    .into_iter()
    .enumerate()
    {
        assert!(CROSS.contains(from), "{from}");
        let path = folder(&format!("j{k}"), &[("a.json", &CROSS.replacen(from, to, 1))]).join("a.json");
        refuses(&path, &format!("a.json{place}"), &[part]);
    }
}
