use std::f64::consts::PI;

use nalgebra::Vector3;
use tg_model::{CableLaw, Model};
use tg_scene::{ImportOptions, import, import_with};

use super::{cables, folder, masses, near, refuses, space};

/// Two rods across each other, four strings around them.
pub(super) const KITE: &str = "\
# lengths in decimetres
nodes:
  west: [-3, 0, 0]
  east: [3, 0, 0]
  south: [0, 0, -4]
  north: [0, 0.5, 4]

pair_groups:
  rod long:
    - [south, north]
  rod:
    - [west, east]
  rim/low tendon:
    - [west, south]
    - [south, east]
  tendon:
    - [east, north]
    - [north, west]

builders:
  rod:
    class: tgRodInfo
    parameters: { density: 0.5, radius: 0.2, friction: 0.9 }
  tendon:
    class: tgBasicActuatorInfo
    parameters:
      stiffness: 800
      damping: 7
      pretension: 40
      max_tension: 1.0e4
";

fn position(model: &Model<3>, place: &str) -> Vector3<f64> {
    let (name, end) = place.rsplit_once('.').unwrap();
    let id = model.members().find(|id| model.member_name(*id) == name).unwrap();
    let nodes = model.member_nodes(id, &model.initial_coordinates());
    nodes[usize::from(end == "to")]
}

#[test]
fn rods_and_strings() {
    let imported = import(&folder("kite", &[("kite.yaml", KITE)]).join("kite.yaml")).unwrap();
    assert_eq!(imported.warnings, [""; 0]);
    let structure = space(&imported);
    let masses = masses(&structure.model);
    assert_eq!(masses.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["rod 1", "rod 2"]);
    near(masses[0].1, 0.5 * PI * 0.04 * 64.25_f64.sqrt());
    near(masses[1].1, 0.5 * PI * 0.04 * 6.0);
    let cables = cables(&structure.model);
    assert_eq!(cables.len(), 4);
    for (cable, length) in cables.iter().zip([5.0, 5.0, 25.25_f64.sqrt(), 25.25_f64.sqrt()]) {
        near(cable.1, length);
        near(cable.2, length - 0.05);
    }
    let groups: Vec<_> = structure.groups.iter().map(|group| group.as_deref().unwrap()).collect();
    assert_eq!(groups, ["rim/low tendon", "rim/low tendon", "tendon", "tendon"]);
    assert!(imported.toml.contains("# gravity = [0, -9.81, 0]"), "{}", imported.toml);
    assert!(
        imported.toml.contains("tendon = { stiffness = 800, damping = 7, tension = 40 }"),
        "{}",
        imported.toml
    );
    assert_eq!(structure.model.report().degrees_of_freedom(), 10);
}

#[test]
fn decimetres_to_si() {
    let path = folder("kite-si", &[("kite.yml", KITE)]).join("kite.yml");
    let options = ImportOptions { length_scale: 0.1, force_scale: 0.1, ..ImportOptions::default() };
    let model = space(&import_with(&path, &options).unwrap()).model;
    near(masses(&model)[1].1, 0.5 * PI * 0.04 * 6.0);
    near(cables(&model)[0].2, 0.495);
    let law = model.cable_law(model.cables().next().unwrap());
    assert_eq!(format!("{law:?}"), format!("{:?}", CableLaw::slacking(800.0).with_damping(7.0)));
}

/// An angle of two rods of length 2 and a third rod apart from it.
const ANGLE: &str = "\
nodes: { a: [0, 0, 0], origin: [2, 0, 0], c.d: [2, 2, 0], e: [0, 0, 3], f: [2, 0, 3] }
pair_groups:
  rod: [[a, origin], [c.d, origin], [e, f]]
  string: [[a, e], [origin, f], [c.d, f]]
builders:
  rod: { class: tgRodInfo, parameters: { density: 2, radius: 0.1 } }
  string: { class: tgKinematicContactCableInfo, parameters: { stiffness: 100, motor_inertia: 3 } }
";

#[test]
fn rods_that_touch_are_one_body() {
    // A full stop in a node's name would be a path there; here it is none.
    let text = ANGLE.replace("c.d", "c d");
    let imported = import(&folder("angle", &[("angle.yaml", &text)]).join("angle.yaml")).unwrap();
    let model = space(&imported).model;
    let m = 2.0 * PI * 0.01 * 2.0;
    let masses = masses(&model);
    assert_eq!([&masses[0].0, &masses[1].0], ["body 1", "rod 1"]);
    near(masses[0].1, 2.0 * m);
    near(masses[1].1, m);
    assert_eq!(model.report().degrees_of_freedom(), 6 + 5);
    let id = model.members().next().unwrap();
    let inertia = model.member(id).mass_properties().inertia_matrix();
    let (along, across) = (m * 0.01 / 2.0, m * (3.0 * 0.01 + 4.0) / 12.0);
    // The mass centre (1.5, 0.5, 0) is (-0.5, -0.5) from one rod's and (0.5, 0.5) from the other's.
    let expected = [
        [along + across + 0.5 * m, -0.5 * m, 0.0],
        [-0.5 * m, along + across + 0.5 * m, 0.0],
        [0.0, 0.0, 2.0 * across + m],
    ];
    for (row, expected) in expected.iter().enumerate() {
        (0..3).for_each(|column| near(inertia[(row, column)], expected[column]));
    }
    let pose = model.pose(id, &model.initial_coordinates()).unwrap().pose;
    let centre = pose.apply_point(&model.member(id).mass_properties().centre());
    near((centre - Vector3::new(1.5, 0.5, 0.0)).norm(), 0.0);
    // Strings end where their nodes are.
    for (cable, length) in cables(&model).iter().zip([3.0, 3.0, 13.0_f64.sqrt()]) {
        near(cable.1, length);
        near(cable.2, length);
    }
    for part in [
        "1 groups of rods that share nodes",
        "`string` leaves these to the toolkit's defaults: damping 10, pretension 0",
    ] {
        assert!(imported.warnings.iter().any(|warning| warning.contains(part)), "{:?}", imported.warnings);
    }
}

#[test]
fn rods_without_mass_are_held() {
    let text = KITE.replace(
        "  tendon:\n    class",
        "  long: { class: tgRodInfo, parameters: { density: 0 } }\n  tendon:\n    class",
    );
    let imported = import(&folder("held", &[("held.yaml", &text)]).join("held.yaml")).unwrap();
    let model = space(&imported).model;
    assert_eq!(masses(&model).len(), 1);
    assert_eq!(model.report().degrees_of_freedom(), 5);
    assert!(
        imported.warnings.iter().any(|w| w.contains("the simulator holds those still")),
        "{:?}",
        imported.warnings
    );
    assert!(
        imported.toml.contains("[anchors]\nsouth = [0, 0, -4]\nnorth = [0, 0.5, 4]\n"),
        "{}",
        imported.toml
    );
}

#[test]
fn boxes_are_bodies() {
    let text = "nodes: { a: [0, 0, 0], b: [0, 3, 0] }\npair_groups: { box: [[a, b]] }\n\
        builders: { box: { class: tgBoxInfo, parameters: { width: 0.5, height: 1, density: 2 } } }\n";
    let model = space(&import(&folder("box", &[("box.yaml", text)]).join("box.yaml")).unwrap()).model;
    // Half width 0.5 along x, half height 1 along z, length 3 along y.
    let mass = *model.member(model.members().next().unwrap()).mass_properties();
    near(mass.mass(), 2.0 * 1.0 * 2.0 * 3.0);
    for (k, expected) in [9.0 + 4.0, 1.0 + 4.0, 1.0 + 9.0].into_iter().enumerate() {
        near(mass.inertia_matrix()[(k, k)], 12.0 * expected / 12.0);
    }
}

/// A prism over an equilateral triangle of side 2, its height 1 along y.
fn prism() -> String {
    let h = 3.0_f64.sqrt();
    format!(
        "nodes:\n  b1: [-1, 0, 0]\n  b2: [1, 0, 0]\n  b3: [0, 0, {h}]\n  t1: [-1, 1, 0]\n  t2: [1, 1, 0]\n  t3: [0, 1, {h}]\n\
pair_groups:\n  rod: [[b1, t2], [b2, t3], [b3, t1]]\n  \
string: [[b1, b2], [b2, b3], [b3, b1], [t1, t2], [t2, t3], [t3, t1], [b1, t1], [b2, t2], [b3, t3]]\n\
builders:\n  rod: {{ class: tgRodInfo, parameters: {{ density: 1, radius: 0.1 }} }}\n"
    )
}

#[test]
fn substructures_are_turned_scaled_and_shifted() {
    let top = "\
substructures:
  one/two/three:
    path: parts/prism.yaml
    rotation: { axis: [0, 0, 2], angle: 90, reference: [0, 0, 0] }
    scale: 2
    offset: [0, 0, 10]
    translation: [100, 0, 0]
bond_groups:
  one/two/three/node_node:
    string:
      - [b1, t1]
builders:
  one string: { class: tgBasicActuatorInfo, parameters: { stiffness: 500, damping: 1, pretension: 10 } }
  string: { class: tgBasicActuatorInfo, parameters: { stiffness: 1000, damping: 1, pretension: 10 } }
  two string: { class: tgBasicActuatorInfo, parameters: { stiffness: 2000, damping: 1, pretension: 10 } }
";
    let path = folder("three", &[("top.yaml", top), ("parts/prism.yaml", &prism())]);
    let imported = import(&path.join("top.yaml")).unwrap();
    let model = space(&imported).model;
    assert_eq!((model.members().len(), model.cables().len()), (9, 2 + 27));
    // After the turn the centroid is (-1/2, 0, 1/√3); then twice as far from it.
    let centroid = Vector3::new(-0.5, 0.0, 1.0 / 3.0_f64.sqrt());
    let place = |x: [f64; 3], copy: f64| {
        let turned = Vector3::new(-x[1], x[0], x[2]);
        centroid + (turned - centroid) * 2.0 + Vector3::new(100.0, 0.0, 10.0 * copy)
    };
    for copy in 0..3 {
        let from = position(&model, &format!("rod {}.from", 3 * copy + 1));
        let to = position(&model, &format!("rod {}.to", 3 * copy + 1));
        near((from - place([-1.0, 0.0, 0.0], copy as f64)).norm(), 0.0);
        near((to - place([1.0, 1.0, 0.0], copy as f64)).norm(), 0.0);
    }
    let cables = cables(&model);
    // Bonds first: b1 of one structure to t1 of the next, 2 along and 10 across; they have the tags of both.
    near(cables[0].1, 104.0_f64.sqrt());
    near(cables[0].2, 104.0_f64.sqrt() - 10.0 / 2000.0);
    near(cables[1].2, 104.0_f64.sqrt() - 10.0 / 2000.0);
    // The builder added last that fits: the general one hides that of `one`, that of `two` hides the general one.
    near(cables[2].2, 4.0 - 10.0 / 1000.0);
    near(cables[11].2, 4.0 - 10.0 / 2000.0);
    near(cables[20].2, 4.0 - 10.0 / 1000.0);
    assert!(imported.toml.contains("\"two/b1\" = "), "{}", imported.toml);
    assert!(imported.toml.contains("Imported from top.yaml, prism.yaml."));
}

#[test]
fn node_edge_bonds_fit_and_replace_strings() {
    let top = "\
substructures:
  low: { path: prism.yaml }
  high:
    path: prism.yaml
    rotation: { axis: [1, 2, 3], angle: 77 }
    scale: 0.5
    translation: [5, -6, 7]
bond_groups:
  string:
    low/high/node_edge:
      - [t2/t3, b1]
      - [t3/t1, b2]
      - [t1/t2, b3]
";
    let path = folder("edge", &[("top.yaml", top), ("prism.yaml", &prism())]).join("top.yaml");
    let model = space(&import(&path).unwrap()).model;
    // 9 of each, less three edges and three strings between the nodes, more two for each bond.
    assert_eq!((model.members().len(), model.cables().len()), (6, 9 + 9 - 3 - 3 + 6));
    let cables = cables(&model);
    // Bottom nodes of the upper prism lie in the middle of the edges, of length 2.
    cables[..6].iter().for_each(|cable| near(cable.1, 1.0));
    // Rods of the upper prism from b1, in the middle of t2 and t3, to t2, which is half as far up.
    let h = 3.0_f64.sqrt();
    near((position(&model, "rod 4.from") - Vector3::new(0.5, 1.0, h / 2.0)).norm(), 0.0);
    near((position(&model, "rod 4.to") - Vector3::new(-0.5, 1.5, h / 2.0)).norm(), 0.0);
    // Six horizontal ones of length 2 and 1 are left, and the verticals.
    let count = |length: f64| cables[6..].iter().filter(|cable| (cable.1 - length).abs() < 1e-12).count();
    assert_eq!([count(2.0), count(1.0), count(0.5)], [3, 3 + 3, 3]);
}

/// The kite with one text replaced is refused at a place.
#[track_caller]
fn wrong(name: &str, replaced: [&str; 2], place: &str, parts: &[&str]) {
    assert!(KITE.contains(replaced[0]));
    let text = KITE.replacen(replaced[0], replaced[1], 1);
    let path = folder(name, &[("kite.yaml", text.as_str())]).join("kite.yaml");
    refuses(&path, &format!("kite.yaml:{place}: "), parts);
}

#[test]
fn faults_are_named_with_their_place() {
    wrong("y1", ["pair_groups", "pairs"], "8:1", &["unknown key `pairs`", "`pair_groups`"]);
    wrong("y2", ["[-3, 0, 0]", "[-3, 0]"], "3:9", &["a node [x, y, z] is expected: 3 numbers, not 2"]);
    wrong("y3", ["[-3, 0, 0]", "[-3, 0, nan]"], "3:17", &["a number is expected, found `nan`"]);
    wrong("y4", ["[-3, 0, 0]", "[-3, 0, 0"], "4:7", &["this is no YAML"]);
    wrong("y5", ["east: [3", "west: [3"], "4:3", &["`west` is given twice"]);
    wrong("y6", ["[west, south]", "[west, sotuh]"], "14:14", &["no node `sotuh`", "did you mean `south`?"]);
    wrong("y7", ["[west, south]", "[west]"], "14:7", &["a pair has two nodes, not 1"]);
    wrong("y8", ["[west, south]", "[west, west]"], "14:7", &["with itself"]);
    wrong("y9", ["[south, east]", "[south, west]"], "15:7", &["already"]);
    wrong(
        "y10",
        ["tgRodInfo", "tgRodsInfo"],
        "22:12",
        &["`tgRodsInfo` is not known", "did you mean `tgRodInfo`?"],
    );
    wrong("y11", ["density: 0.5", "desnity: 0.5"], "23:19", &["unknown key `desnity`", "`density`"]);
    wrong("y12", ["density: 0.5", "density: -1"], "23:28", &["`density` is -1; it must not be negative"]);
    wrong("y13", ["stiffness: 800", "stiffness: 0"], "27:18", &["`stiffness` is 0; it must be positive"]);
    wrong("y14", ["stiffness: 800", "stiffness: hard"], "27:18", &["`stiffness` is expected, found `hard`"]);
    wrong(
        "y15",
        ["pretension: 40", "pretension: 4000"],
        "24:3",
        &["shortens a string of length 5 by pretension / stiffness = 5", "less than 4000"],
    );
    wrong("y16", ["    class: tgBasicActuatorInfo\n", ""], "24:3", &["`tendon` has no class"]);
    wrong(
        "y17",
        ["  rod:\n    - [west, east]\n", ""],
        "12:7",
        &["a string ends in the node `west`, where no rod ends"],
    );
    wrong(
        "y18",
        ["[3, 0, 0]", "[-3, 0, 0]"],
        "12:7",
        &["`west` and `east` of the pair are at the same place"],
    );
}

#[test]
fn pairs_without_builder_are_left_out() {
    let text = KITE.replace("  tendon:\n    class", "  other:\n    class");
    let imported = import(&folder("loose", &[("loose.yaml", &text)]).join("loose.yaml")).unwrap();
    assert_eq!(space(&imported).model.cables().len(), 0);
    for part in ["`rim/low tendon` have no builder", "`tendon` have no builder"] {
        assert!(imported.warnings.iter().any(|warning| warning.contains(part)), "{:?}", imported.warnings);
    }
}

#[test]
fn faults_of_substructures_and_bonds() {
    let prism = prism();
    for (k, (top, place, part)) in [
        ("substructures:\n  a: { path: top.yaml }\n", "top.yaml:2:14: ", "substructure of itself"),
        ("substructures:\n  a: { path: none.yaml }\n", "top.yaml:2:14: ", "there is no file"),
        ("substructures:\n  a: { scale: 2 }\n", "top.yaml:2:6: ", "`path` is missing"),
        ("substructures:\n  a/a: { path: prism.yaml }\n", "top.yaml:2:3: ", "no name of its own"),
        ("substructures:\n  a: { path: prism.yaml, turn: 2 }\n", "top.yaml:2:26: ", "unknown key `turn`"),
        ("substructures:\n  a: { path: prism.yaml, scale: 0 }\n", "top.yaml:2:33: ", "must be positive"),
        (
            "substructures:\n  a: { path: prism.yaml, rotation: { axis: [0, 0, 0], angle: 1 } }\n",
            "top.yaml:2:44: ",
            "axis of the rotation is zero",
        ),
        ("BONDS  string: { a//node_node: [[b1, b1]] }\n", "top.yaml:4:13: ", "no substructure ``"),
        ("BONDS  string: { a/c/node_node: [[b1, b1]] }\n", "top.yaml:4:13: ", "no substructure `c`"),
        ("BONDS  string: { a/b/node_nod: [[b1, b1]] }\n", "top.yaml:4:13: ", "did you mean `node_node`?"),
        ("BONDS  string: { other: [[b1, b1]] }\n", "top.yaml:4:13: ", "tags are nested in tags"),
        (
            "BONDS  a/b/node_node: { c/d/node_node: [[b1, b1]] }\n",
            "top.yaml:4:20: ",
            "bonds are nested in bonds",
        ),
        ("BONDS  string: { a/node_node: [[b1, b1]] }\n", "top.yaml:4:13: ", "two structures or more"),
        ("BONDS  string: { a/b/node_edge: [[b1, t1/t2]] }\n", "top.yaml:4:28: ", "three pairs or more"),
        (
            "BONDS  string: { a/b/node_edge: [[b1, t1], [b2, t1/t2], [b3, t2/t3]] }\n",
            "top.yaml:4:29: ",
            "a node and an edge",
        ),
        (
            "BONDS  string: { a/b/node_edge: [[t1, b1/t2], [t2, b2/b3], [t3, b3/b1]] }\n",
            "top.yaml:4:",
            "the edge of a node_edge bond is a rod",
        ),
        (
            "BONDS  string: { a/b/node_edge: [[b1, b1/b2], [b1, b2/b3], [b1, b3/b1]] }\n",
            "top.yaml:4:13: ",
            "lie in a line",
        ),
    ]
    .into_iter()
    .enumerate()
    {
        let top = top.replace(
            "BONDS",
            "substructures:\n  a/b: { path: prism.yaml, offset: [0, 3, 0] }\nbond_groups:\n",
        );
        let path = folder(&format!("s{k}"), &[("top.yaml", &top), ("prism.yaml", &prism)]).join("top.yaml");
        refuses(&path, place, &[part]);
    }
}
