use std::f64::consts::PI;

use tg_model::CableLaw;
use tg_scene::{Built, ImportOptions, import, import_with};

use super::{build, cables, folder, masses, near, refuses, space};

pub(super) const NODES: &str = "\
# a mast on a ball joint, stayed by three guys; a weight hangs from its top
name, x, y, z, fixed, mass
foot, 0, 0, 0, xyz,
top, 0, 0, 2, ,
east, 1, 0, 0, XYZ,
north, 0, 1, 0, all,
weight, 0.5, 0.5, 1, , 0.25
";
pub(super) const BARS: &str = "name,from,to,density,radius\nmast,foot,top,7850,0.01\n";
pub(super) const CABLES: &str = "\
to;from;group;EA;k;rest;pretension;force_density;c
top;east;guys;;2000;2.1;;;5
top;north;guys;;2000;;20;;5
weight;top;;1e5;;;;40;
";

#[test]
fn a_stayed_mast() {
    let path = folder("mast", &[("nodes.csv", NODES), ("bars.csv", BARS), ("cables.csv", CABLES)]);
    let imported = import(&path).unwrap();
    assert_eq!(imported.warnings, [""; 0]);
    assert_eq!(imported, import(&path.join("bars.csv")).unwrap());
    assert!(
        imported.toml.starts_with("# Imported from nodes.csv, bars.csv, cables.csv.\n"),
        "{}",
        imported.toml
    );
    assert!(imported.toml.contains("guys = { stiffness = 2000, damping = 5 }"), "{}", imported.toml);
    let structure = space(&imported);
    let model = &structure.model;
    // Two of the mast, three of the weight.
    assert_eq!(model.report().degrees_of_freedom(), 5);
    let masses = masses(model);
    assert_eq!([&masses[0].0, &masses[1].0], ["weight", "mast"]);
    near(masses[0].1, 0.25);
    near(masses[1].1, 7850.0 * PI * 1e-4 * 2.0);
    let cables = cables(model);
    near(cables[0].1, 5.0_f64.sqrt());
    near(cables[0].2, 2.1);
    near(cables[1].2, 5.0_f64.sqrt() - 20.0 / 2000.0);
    let length = 1.5_f64.sqrt();
    near(cables[2].2, length / (1.0 + 40.0 * length / 1e5));
    assert_eq!(structure.groups, [Some("guys".into()), Some("guys".into()), None]);
}

#[test]
fn scales_make_si_units() {
    let path = folder("scaled", &[("nodes.csv", NODES), ("bars.csv", BARS), ("cables.csv", CABLES)]);
    let options = ImportOptions { length_scale: 0.1, force_scale: 10.0, mass_scale: 2.0 };
    let imported = import_with(&path, &options).unwrap();
    assert!(imported.toml.contains("# Units of the file: 0.1 m, 10 N, 2 kg, 1 s."));
    let model = space(&imported).model;
    let masses = masses(&model);
    near(masses[0].1, 0.5);
    near(masses[1].1, 2.0 * 7850.0 * PI * 1e-4 * 2.0);
    let cables = cables(&model);
    near(cables[0].2, 0.21);
    near(cables[1].2, 0.1 * (5.0_f64.sqrt() - 20.0 / 2000.0));
    near(cables[2].2, 0.1 * 1.5_f64.sqrt() / (1.0 + 40.0 * 1.5_f64.sqrt() / 1e5));
    let law = model.cable_law(model.cables().next().unwrap());
    let expected = CableLaw::slacking(2000.0 * 10.0 / 0.1).with_damping(5.0 * 10.0 / 0.1);
    assert_eq!(format!("{law:?}"), format!("{expected:?}"));
}

#[test]
fn bars_that_share_a_node_are_joined_in_the_plane() {
    let nodes = "id,x,y,fixed\na,0,0,xy\nb,1,0,\nc,2,0,y\nunused,9,9,\n";
    let bars = "from,to,name\na,b,b\nb,c,{rod}\n";
    let path = folder("plane", &[("x_nodes.csv", nodes), ("x_bars.csv", bars)]);
    let imported = import(&path.join("x_nodes.csv")).unwrap();
    let Built::Plane(structure) = build(&imported) else { panic!() };
    // Two bars of the plane, less two of the anchor, two of the joint, one of the support.
    assert_eq!(structure.model.report().degrees_of_freedom(), 1);
    let masses = masses(&structure.model);
    assert_eq!(masses.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["bar b", "(rod)"]);
    masses.iter().for_each(|(_, mass)| near(*mass, 1.0));
    for part in [
        "no x_cables.csv",
        "2 bars have no mass; a line density of 1 kg/m",
        "left out, as nothing uses them: unused",
    ] {
        assert!(imported.warnings.iter().any(|warning| warning.contains(part)), "{:?}", imported.warnings);
        assert!(imported.toml.contains(part));
    }
}

#[test]
fn repeated_constraints_are_dropped_and_said() {
    let nodes = "name,x,y,fixed\na,0,0,xy\nb,1,0,\n";
    let bars = "from,to,mass\na,b,1\na,b,1\n";
    let imported = import(&folder("closed", &[("nodes.csv", nodes), ("bars.csv", bars)])).unwrap();
    assert!(
        imported.warnings.iter().any(|w| w.contains("redundancies are dropped")),
        "{:?}",
        imported.warnings
    );
    let Built::Plane(structure) = build(&imported) else { panic!() };
    assert_eq!(structure.model.report().degrees_of_freedom(), 1);
}

/// The same files, with one text replaced, are refused at a place.
#[track_caller]
fn wrong(name: &str, replaced: [&str; 2], place: &str, parts: &[&str]) {
    let all = [("nodes.csv", NODES), ("bars.csv", BARS), ("cables.csv", CABLES)];
    assert!(all.iter().any(|(_, text)| text.contains(replaced[0])));
    let all = all.map(|(file, text)| (file, text.replacen(replaced[0], replaced[1], 1)));
    let path = folder(name, &all.each_ref().map(|(file, text)| (*file, text.as_str())));
    refuses(&path, place, parts);
}

#[test]
fn faults_are_named_with_their_line() {
    let n = "nodes.csv:";
    wrong(
        "w1",
        ["name, x", "nmae, x"],
        &format!("{n}2:1: "),
        &["unknown column `nmae`", "did you mean `name`?"],
    );
    wrong("w2", ["name, x, y, z", "name, x, x, z"], &format!("{n}2:1: "), &["`x` is there twice"]);
    wrong(
        "w3",
        ["name, x, y, z, fixed", "name, mass, y, z, fixed"],
        &format!("{n}2:1: "),
        &["`mass` is there twice"],
    );
    wrong(
        "w4",
        ["top, 0, 0, 2, ,", "top, 0, zero, 2, ,"],
        &format!("{n}4:1: "),
        &["`y`: `zero` is no number"],
    );
    wrong("w5", ["top, 0, 0, 2, ,", "top, 0, 0, , ,"], &format!("{n}4:1: "), &["`z` is missing here"]);
    wrong("w6", ["top, 0", "foot, 0"], &format!("{n}4:1: "), &["\"foot\" is there twice"]);
    wrong("w7", ["xyz", "xyw"], &format!("{n}3:1: "), &["no axis `w`", "letters of \"xyz\""]);
    wrong("w8", ["top, 0, 0, 2, ,", "top, 0, 0, inf, ,"], &format!("{n}4:1: "), &["`inf` is no number"]);
    wrong("w9", ["top, 0, 0, 2, ,", "top, 0, 0, 2, , , 3"], &format!("{n}4:1: "), &["7 cells, the header 6"]);
    wrong("w10", ["0.25", "-0.25"], &format!("{n}7:1: "), &["`mass` is -0.25; it must be positive"]);
    wrong(
        "w11",
        [", , 0.25", ", x,"],
        "cables.csv:4:1: ",
        &["\"weight\", which only cables hold", "give the node a mass"],
    );
    wrong("w12", ["mast,foot,top", "mast,foot,pot"], "bars.csv:2:1: ", &["no node \"pot\"", "known here"]);
    wrong(
        "w13",
        ["mast,foot,top,7850,0.01", "mast,foot,top,7850,"],
        "bars.csv:2:1: ",
        &["needs the bar's radius"],
    );
    wrong(
        "w14",
        ["mast,foot,top", "mast,foot,foot"],
        "bars.csv:2:1: ",
        &["has the length 0", "must be apart"],
    );
    wrong("w15", ["2.1;;;5", ";;;5"], "cables.csv:2:1: ", &["no rest length"]);
    wrong("w16", ["2.1;;;5", "2.1;3;;5"], "cables.csv:2:1: ", &["`rest` and `tension` are both given"]);
    wrong("w17", ["1e5", ""], "cables.csv:4:1: ", &["no stiffness"]);
    wrong("w18", ["2.1;;;5", "2.1;;;-5"], "cables.csv:2:1: ", &["`damping` is -5"]);
    wrong("w19", ["name, x, y, z, fixed, mass\n", ""], &format!("{n}2:1: "), &["unknown column `foot`"]);
    wrong("w20", ["name,from,to,density,radius\n", ""], "bars.csv:1:1: ", &["unknown column `mast`"]);
}

#[test]
fn tables_without_content() {
    refuses(&folder("e1", &[("nodes.csv", "")]), "nodes.csv:1:1: ", &["the table is empty", "name, x, y"]);
    refuses(&folder("e2", &[("nodes.csv", "name,x,y\n")]), "nodes.csv:1:1: ", &["no nodes"]);
    refuses(&folder("e3", &[("nodes.csv", "name,x\na,1\n")]), "nodes.csv:1:1: ", &["no column `y`"]);
    refuses(
        &folder("e4", &[("nodes.csv", "1,2,3\n")]),
        "nodes.csv:1:1: ",
        &["`1` is no name", "header line"],
    );
    refuses(
        &folder("e5", &[("nodes.csv", "name,x,y,fixed\na,1,2,xy\n")]),
        "nodes.csv:2:1: ",
        &["nothing here has a mass"],
    );
    refuses(
        &folder("e6", &[("nodes.csv", "name,x,y,fixed\na,1,2,x\n")]),
        "nodes.csv:2:1: ",
        &["held in part"],
    );
    refuses(&folder("e7", &[("nodes.csv", "name,x,y\n\"a,1,2\n")]), "nodes.csv:", &["`x` is missing"]);
}
