//! What commands write: results folders, views, plots, exports, imports.

use std::path::Path;

use tg_report::Results;

use crate::{json, run, scene, temporary, text};

#[test]
fn a_run_leaves_a_folder_that_opens() {
    let (_keep, folder) = temporary("tower");
    let document = json(&["run", &scene("tower.toml"), "--duration", "0.2", "-o", &folder]);
    assert_eq!(document["complete"], true);
    assert_eq!(document["summary"]["steps"], 200);
    let results = Results::open(Path::new(&folder)).unwrap();
    assert!(results.manifest.complete && results.manifest.interrupted.is_none());
    assert_eq!(results.table().unwrap().rows(), 201);
    assert_eq!(results.frames().unwrap().len(), 11);
    let html = std::fs::read_to_string(format!("{folder}/view.html")).unwrap();
    assert!(html.contains("triangle 7") && !html.contains("http-equiv=\"refresh\""));
    // Earlier results stay unless the user says otherwise.
    assert_eq!(run(&["run", &scene("tower.toml"), "-o", &folder]).status.code(), Some(2));
    assert_eq!(
        run(&["run", &scene("tower.toml"), "--duration", "0.01", "--force", "-o", &folder]).status.code(),
        Some(0)
    );
}

#[test]
fn plots_and_exports_of_a_run_are_written() {
    let (keep, folder) = temporary("tower");
    json(&["run", &scene("tower.toml"), "--duration", "0.3", "-o", &folder, "--no-view"]);
    assert!(!Path::new(&folder).join("view.html").exists());
    for what in ["tensions", "lengths", "energies", "energy-drift", "slack", "points", "snapshots"] {
        for form in ["svg", "png"] {
            let picture = keep.path().join(format!("{what}.{form}"));
            let output = run(&["plot", &folder, "--what", what, "-o", picture.to_str().unwrap()]);
            assert_eq!(output.status.code(), Some(0), "{what}.{form}: {}", text(&output.stderr));
            assert!(std::fs::metadata(&picture).unwrap().len() > 2000, "{what}.{form}");
        }
    }
    for (form, file) in
        [("csv", "trajectory.csv"), ("npy", "trajectory.npy"), ("vtk", "motion.pvd"), ("gltf", "motion.glb")]
    {
        assert_eq!(run(&["export", &folder, "--to", form]).status.code(), Some(0), "{form}");
        assert!(std::fs::metadata(Path::new(&folder).join(file)).unwrap().len() > 500, "{form}");
    }
    // What the results do not hold is not drawn.
    let output = run(&["plot", &folder, "--what", "reactions"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("channel"));
    json(&["view", &folder]);
}

#[test]
fn reactions_carry_the_weight_at_rest() {
    let (keep, folder) = temporary("still");
    let path = keep.path().join("still.toml");
    let bead = r#"
        version = 1
        dimension = 3
        gravity = [0, 0, "-g"]
        anchors.peg = [0, 0, 1]
        particles.bead = { at = [0, 0, 0], mass = 2 }
        cables.line = { ends = ["peg", "bead"], stiffness = 1000, tension = "2*g" }
        run = { duration = 0.01, step = 1e-3, channels = ["reactions", "poses", "rest_lengths", "solver"] }
    "#;
    std::fs::write(&path, bead).unwrap();
    json(&["run", path.to_str().unwrap(), "-o", &folder]);
    let table = Results::open(Path::new(&folder)).unwrap().table().unwrap();
    let names: Vec<&str> = table.channels.iter().map(|channel| channel.name.as_str()).collect();
    let upward = names.iter().position(|name| name.contains("reaction z")).unwrap();
    assert!(
        table.columns[upward].iter().all(|r| (r - 2.0 * 9.81).abs() < 1e-9),
        "{:?}",
        table.columns[upward]
    );
    assert_eq!(names.iter().filter(|name| name.starts_with("bead.pose")).count(), 7);
}

#[test]
fn an_accuracy_chooses_a_step_that_reaches_it() {
    let (_keep, folder) = temporary("tower");
    let scene = scene("tower.toml");
    json(&["run", &scene, "--duration", "0.5", "--accuracy", "1e-6", "-o", &folder]);
    let results = Results::open(Path::new(&folder)).unwrap();
    let step = results.manifest.settings["step"].as_f64().unwrap();
    assert!(!results.manifest.settings["step_chosen_by"]["trials"].as_array().unwrap().is_empty());
    let (_keep, fine) = temporary("fine");
    json(&["run", &scene, "--duration", "0.5", "--step", &format!("{}", step / 8.0), "-o", &fine]);
    let last = |folder: &str| {
        let table = Results::open(Path::new(folder)).unwrap().table().unwrap();
        let points = table.group("point");
        points.into_iter().map(|k| *table.columns[k].last().unwrap()).collect::<Vec<_>>()
    };
    let error = last(&folder).iter().zip(last(&fine)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(error < 1e-6 && error > 1e-8, "error {error} with step {step}");
}

#[test]
fn statics_modes_equilibria_and_sweeps_fill_folders_with_views() {
    let (keep, _) = temporary("");
    let folder = |name: &str| keep.path().join(name).to_str().unwrap().to_string();
    json(&["statics", &scene("icosahedron.toml"), "-o", &folder("statics")]);
    json(&["modes", &scene("tower_modal.toml"), "--damped", "-o", &folder("modes")]);
    json(&["equilibria", &scene("mechanism.toml"), "-o", &folder("equilibria")]);
    let sweep =
        ["sweep", &scene("tower_modal.toml"), "-p", "ratio", "--from", "0.9", "--to", "1", "--samples", "3"];
    json(&[&sweep[..], &["-o", &folder("sweep")]].concat());
    for (name, shapes, modes) in
        [("statics", 1, false), ("modes", 0, true), ("equilibria", 15, false), ("sweep", 0, false)]
    {
        let results = Results::open(Path::new(&folder(name))).unwrap();
        assert!(results.manifest.complete, "{name}");
        assert_eq!(results.shapes().unwrap().len(), shapes, "{name}");
        assert_eq!(results.modes().unwrap().is_some(), modes, "{name}");
        assert!(Path::new(&folder(name)).join("view.html").exists(), "{name}");
    }
    assert_eq!(run(&["plot", &folder("sweep"), "--what", "sweep"]).status.code(), Some(0));
    let table = Results::open(Path::new(&folder("sweep"))).unwrap().table().unwrap();
    assert_eq!(table.column("ratio").unwrap(), [0.9, 0.95, 1.0]);
}

#[test]
fn a_scene_is_shown_as_built() {
    let (_keep, page) = temporary("icosahedron.html");
    json(&["view", &scene("icosahedron.toml"), "-o", &page]);
    assert!(std::fs::read_to_string(page).unwrap().contains("bar 6"));
}

/// A three-bar prism whose twist is not that of its equilibrium, from CSV tables.
#[test]
fn an_imported_structure_relaxes_into_equilibrium() {
    let (keep, scene) = temporary("prism.toml");
    let mut nodes = "name,x,y,z\n".to_string();
    let (mut bars, mut cables) = ("from,to,mass\n".to_string(), "from,to,stiffness,rest\n".to_string());
    for i in 0..3 {
        let (bottom, top) =
            (f64::from(i) * 120.0_f64.to_radians(), (f64::from(i) * 120.0 + 140.0).to_radians());
        nodes += &format!("b{i},{},{},0\nt{i},{},{},1\n", bottom.cos(), bottom.sin(), top.cos(), top.sin());
        let next = (i + 1) % 3;
        bars += &format!("b{i},t{i},1\n");
        cables += &format!("b{i},b{next},1000,1.6\nt{i},t{next},1000,1.6\nb{next},t{i},1000,0.9\n");
    }
    for (name, content) in [("nodes.csv", &nodes), ("bars.csv", &bars), ("cables.csv", &cables)] {
        std::fs::write(keep.path().join(name), content).unwrap();
    }
    json(&["import", keep.path().to_str().unwrap(), "-o", &scene]);
    let document = json(&["statics", &scene, "--relax"]);
    assert!(document["imbalance"].as_f64().unwrap() < 1e-11);
    assert_eq!(document["stability"]["verdict"], "stable");
    // A self-stressed prism of three bars is twisted by 90° - 180°/3 against its cables' corners: 150° from b to t.
    let q: Vec<f64> = serde_json::from_value(document["coordinates"].clone()).unwrap();
    let centre = |k: usize| (0..3).map(|i| q[6 * i + k] / 3.0).sum::<f64>();
    let axis: Vec<f64> = (0..3).map(|k| centre(3 + k) - centre(k)).collect();
    assert!(axis[2].abs() > 0.5, "{axis:?}");
    let angle = |at: usize| {
        let (x, y) = (
            q[at] - centre(if at % 6 < 3 { 0 } else { 3 }),
            q[at + 1] - centre(if at % 6 < 3 { 1 } else { 4 }),
        );
        y.atan2(x)
    };
    let twist = (angle(3) - angle(0)).to_degrees().rem_euclid(360.0);
    assert!((twist - 150.0).abs() < 1e-3, "{twist}");
}
