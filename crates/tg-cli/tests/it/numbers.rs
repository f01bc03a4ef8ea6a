//! The program on the shipped scenes of the papers' examples against the same analyses of the cases crate's models, which
//! are built in code: equal to 1e-12. (That both have the same mechanics is shown in the cases crate.)

use std::path::Path;

use serde_json::Value;
use tg_cases::antiprism::{Antiprism, EXAMPLE_1, EXAMPLE_2, FORCE, Feet, Loads, MOMENTS};
use tg_cases::deployable::{self, Configuration, Deployable, statics};
use tg_cases::double_pendulum::{self, DoublePendulum};
use tg_cases::mechanism::{Case, Mechanism, Parameters};
use tg_cases::simulate::{STEP, run as simulate};
use tg_cases::tower::{self, Setup, Tower};
use tg_equilibria::{EquilibriaOptions, all_equilibria};
use tg_modal::{ModeOptions, modes};
use tg_model::{Form, Model};
use tg_report::Results;
use tg_statics::{Configuration as At, EquilibriumReport, Forward, ForwardOptions};

use crate::{json, scene, temporary};

const EXACT: f64 = 1e-12;

#[track_caller]
fn same(found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        assert!((found - expected).abs() <= EXACT * size, "number {k}: {found} against {expected}");
    }
}

/// The numbers under a key of each entry of a list.
fn numbers(document: &Value, list: &str, key: &str) -> Vec<f64> {
    document[list].as_array().unwrap().iter().filter_map(|entry| entry[key].as_f64()).collect()
}

/// Positions of a point in the program's run of a scene, and in a run of the model, by the size of the positions.
#[track_caller]
fn same_motion<const D: usize>(
    scene_name: &str,
    set: &[&str],
    (model, point): (&Model<D>, (&str, &Form<D>)),
    end: f64,
) {
    let (_keep, folder) = temporary("run");
    let (scene, duration) = (scene(scene_name), end.to_string());
    let mut arguments = vec!["run", &scene, "--duration", &duration, "-o", &folder, "--no-view"];
    set.iter().for_each(|set| arguments.extend(["--set", set]));
    json(&arguments);
    let results = Results::open(Path::new(&folder)).unwrap();
    let table = results.table().unwrap();
    let every = results.manifest.settings["every"].as_f64().unwrap_or(STEP);
    let (name, form) = point;
    let stride = (every / STEP).round() as usize;
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    let mut step = 0;
    simulate(model, STEP, end, |state| {
        if step % stride == 0 {
            expected.extend(form.eval(&state.q).iter().copied());
        }
        step += 1;
    })
    .unwrap();
    let columns: Vec<&[f64]> =
        ["x", "y", "z"][..D].iter().map(|axis| table.column(&format!("{name}.{axis}")).unwrap()).collect();
    for row in 0..table.rows() {
        found.extend(columns.iter().map(|column| column[row]));
    }
    same(&found, &expected);
}

#[test]
fn double_pendulum_moves_as_in_the_case() {
    let code = DoublePendulum::new(double_pendulum::Choices::default()).unwrap();
    let point = ("triangle 2.centre", &code.centre);
    same_motion("double_pendulum.toml", &[], (&code.model, point), 0.5);
    same_motion("double_pendulum.json", &[], (&code.model, point), 0.5);
}

#[test]
fn tower_moves_as_in_the_case() {
    for (setup, set) in [(Setup::Us, "auxiliary_ground=1"), (Setup::UsAux, "auxiliary_ground=0")] {
        let code = Tower::new(&tower::Choices::paper(setup)).unwrap();
        same_motion("tower.toml", &[set], (&code.model, ("triangle 3.centre", &code.centre3)), 0.5);
    }
}

#[test]
fn deployable_tower_moves_as_in_the_case() {
    let [initial, target] = Configuration::ALL.map(|state| statics::rest_lengths(state).unwrap());
    let choices = deployable::Choices::deployment(&initial, &target, 10.0).on_seismic_ground(0.5);
    let code = Deployable::new(&choices).unwrap();
    let point = ("tetrahedron 10.centre", &code.centres[3]);
    same_motion("deployable.toml", &["nu=0.5"], (&code.model, point), 0.2);
}

fn at<const D: usize>(model: &Model<D>) -> At {
    At::at(model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap()
}

#[test]
fn tower_has_the_frequencies_of_the_case() {
    for ratio in [0.95, 0.9] {
        let code = Tower::new(&tower::Choices::modal(ratio)).unwrap().model;
        let found = json(&["modes", &scene("tower_modal.toml"), "--set", &format!("ratio={ratio}")]);
        let expected: Vec<f64> =
            modes(&code, &at(&code), &ModeOptions::all()).unwrap().frequencies().collect();
        same(&numbers(&found, "modes", "frequency"), &expected);
    }
}

#[test]
fn deployable_tower_has_the_statics_and_frequencies_of_the_case() {
    for (state, set) in [(Configuration::Initial, "state=0"), (Configuration::Target, "state=1")] {
        let rest = statics::rest_lengths(state).unwrap();
        let code = Deployable::new(&deployable::Choices::still(state, &rest)).unwrap().model;
        let arguments = ["deployable.toml", "--set", set, "--set", "deploy=0"].map(String::from);
        let scene = scene(&arguments[0]);
        let with = |command: &'static str| {
            let mut list = vec![command, scene.as_str()];
            list.extend(arguments[1..].iter().map(String::as_str));
            json(&list)
        };
        let (q, u) = (code.initial_coordinates(), code.inputs_at(0.0));
        let expected = EquilibriumReport::new(&code, &q, &u).unwrap();
        let found = with("statics");
        assert!(found["imbalance"].as_f64().unwrap() < 1e-11);
        let tensions: Vec<f64> = expected.cables.iter().map(|(_, cable)| cable.tension).collect();
        same(&numbers(&found, "cables", "tension"), &tensions);
        let expected: Vec<f64> =
            modes(&code, &at(&code), &ModeOptions::new(20)).unwrap().frequencies().collect();
        same(&numbers(&with("modes"), "modes", "frequency"), &expected);
    }
}

#[test]
fn antiprisms_balance_their_loads_as_in_the_case() {
    let force = Loads::Force(FORCE, 1.0);
    let moments = Loads::JointMoments(MOMENTS.to_vec());
    for (name, parameters, feet, loads) in [
        ("antiprism_force.toml", &EXAMPLE_1, Feet::Sliding, &force),
        ("antiprism_moments.toml", &EXAMPLE_2, Feet::Fixed, &moments),
    ] {
        let code = Antiprism::new(parameters, feet, loads).unwrap().model;
        let (q, u) = (code.initial_coordinates(), code.inputs_at(0.0));
        let solved =
            Forward::new(&code, ForwardOptions { relax: false, ..ForwardOptions::default() }).solve(&q, &u);
        let expected = EquilibriumReport::new(&code, &solved.unwrap().configuration.q, &u).unwrap();
        // The load breaks the symmetry: rounding decides which of the equal struts gives way, so lengths are compared in
        // order of size.
        let sorted = |mut lengths: Vec<f64>| {
            lengths.sort_by(f64::total_cmp);
            lengths
        };
        let lengths = expected.cables.iter().map(|(_, cable)| cable.length).collect();
        let found = json(&["statics", &scene(name), "--solve"]);
        same(&sorted(numbers(&found, "cables", "length")), &sorted(lengths));
    }
}

#[test]
fn mechanism_has_the_equilibria_of_the_case() {
    for (case, set) in
        [(Case::Three, ["free_1=11.5", "free_2=11.5"]), (Case::Two, ["free_1=11.5", "free_2=0"])]
    {
        let code = Mechanism::new(&Parameters::paper(case)).unwrap().model;
        let report = all_equilibria(&code, &code.inputs_at(0.0), &EquilibriaOptions::default()).unwrap();
        let found = json(&["equilibria", &scene("mechanism.toml"), "--set", set[0], "--set", set[1]]);
        let physical: Vec<&Value> =
            found["equilibria"].as_array().unwrap().iter().filter(|e| e["physical"] == true).collect();
        let energies: Vec<f64> = physical.iter().map(|e| e["energy"].as_f64().unwrap()).collect();
        same(&energies, &report.physical().map(|e| e.energy).collect::<Vec<_>>());
        assert_eq!(found["stable"].as_u64().unwrap() as usize, report.stable().count());
        assert_eq!(found["certified"].as_u64().unwrap() as usize, report.certified);
    }
}
