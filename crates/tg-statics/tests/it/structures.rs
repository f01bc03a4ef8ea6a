//! Structures that others designed: relaxed to equilibrium, their self-stress, mechanisms, lengths, tensions and
//! frequencies are those that an independent program found. The files are not part of the project; where their folder
//! does not exist the test says so and skips.

use std::path::{Path, PathBuf};

use serde_json::Value;
use tg_model::{BuildError, CableId, CableLaw, Joining, Model, ModelBuilder, Place};
use tg_statics::{Configuration, Forward, ForwardOptions, Seek, SelfStress, Verdict, stability};
use tg_tangent::{EigenOptions, Metric, Sign, lowest};

struct Structure {
    model: Model<3>,
    cables: Vec<CableId>,
    analysis: Value,
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn list(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(number).collect()
}

/// Bars are rigid thin rods between their nodes; nodes of several bars are ball joints; cables slacken.
fn load(path: &Path) -> Result<Structure, BuildError> {
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let nodes: Vec<[f64; 3]> =
        file["nodes"].as_array().unwrap().iter().map(|x| list(x).try_into().unwrap()).collect();
    let ends = |part: &Value| [0, 1].map(|k| part["nodes"][k].as_u64().unwrap() as usize);
    let mut b = ModelBuilder::<3>::new();
    let mut places: Vec<Vec<Place<3>>> = vec![Vec::new(); nodes.len()];
    for fixed in file["fixed"].as_array().unwrap() {
        assert_eq!(fixed["axes"].as_array().unwrap().len(), 3, "only whole nodes are fixed");
        let node = fixed["node"].as_u64().unwrap() as usize;
        places[node].push(b.anchor(&format!("anchor {node}"), nodes[node])?.into());
    }
    for (k, bar) in file["bars"].as_array().unwrap().iter().enumerate() {
        let [from, to] = ends(bar);
        let mass = bar.get("mass").map_or(1.0, number);
        let id = b.bar(&format!("bar {k}"), mass, nodes[from], nodes[to])?;
        places[from].push(id.node(0));
        places[to].push(id.node(1));
    }
    for (node, places) in places.iter().enumerate().filter(|(_, places)| places.len() > 1) {
        b.joint(&format!("node {node}"), places, Joining::Share)?;
    }
    let mut cables = Vec::new();
    for (k, cable) in file["cables"].as_array().unwrap().iter().enumerate() {
        let [from, to] = ends(cable).map(|node| places[node][0]);
        let law = CableLaw::slacking(number(&cable["stiffness"]));
        cables.push(b.cable(&format!("cable {k}"), from, to, law, number(&cable["rest_length"]))?);
    }
    Ok(Structure { model: b.build()?, cables, analysis: file["analysis"].clone() })
}

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/structures");
    let Ok(entries) = std::fs::read_dir(&folder) else {
        println!("skipped: there is no folder of structures beside the project");
        return Vec::new();
    };
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "json"));
    files.sort();
    files
}

#[test]
fn relax_to_the_stated_equilibria() {
    for path in files() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let Structure { model, cables, analysis } = load(&path).unwrap();
        let stated = &analysis["relaxed_no_gravity"];
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));

        let given = Configuration::at(&model, &q, &u).unwrap();
        for (tolerance, key) in [(1e-9, "exact_tol_1e-9"), (1e-3, "loose_tol_1e-3")] {
            let found = SelfStress::with_tolerance(&model, &given, tolerance).unwrap();
            println!(
                "{name} as given: {} {} {}",
                found.rank.rank,
                found.states.len(),
                found.mechanisms.len()
            );
            println!("   {key} {}", analysis[key]);
        }
        let start = std::time::Instant::now();
        let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
        let found = Forward::new(&model, options).solve(&q, &u);
        let found = match found {
            Ok(f) => f,
            Err(e) => {
                println!("{name} FAIL {e}");
                continue;
            }
        };
        println!("{name} {:?} {:?}", found.report, start.elapsed());
        let at = &found.configuration;
        let self_stress = SelfStress::new(&model, at).unwrap();
        println!(
            "gap {:?} states {} ({}) mech {} ({})",
            self_stress.rank.gap(),
            self_stress.states.len(),
            stated["self_stress_states"],
            self_stress.mechanisms.len(),
            stated["internal_mechanisms"]
        );
        let states: Vec<_> = cables.iter().map(|&c| model.cable(c, &at.q, &q, &u)).collect();
        let apart = |a: Vec<f64>, b: Vec<f64>| {
            let size = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
            a.iter().zip(&b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
        };
        let lengths = apart(states.iter().map(|s| s.length).collect(), list(&stated["cable_lengths"]));
        let tensions = apart(states.iter().map(|s| s.tension).collect(), list(&stated["cable_tensions"]));
        println!("lengths {lengths:.1e} tensions {tensions:.1e}");
        let stability = stability(&model, at, 1).unwrap();
        println!(
            "{:?} {:?} rigid {} zero {}",
            stability.verdict, stability.counts, stability.rigid_motions, stated["zero_modes"]
        );
        assert_ne!(stability.verdict, Verdict::Unstable);
        let frequencies = list(&stated["frequencies_Hz_nonzero"]);
        let zero = stated["zero_modes"].as_u64().unwrap() as usize;
        let spectrum =
            lowest(&model, at, &EigenOptions::new(zero + frequencies.len(), Metric::Mass)).unwrap();
        let ours: Vec<f64> = spectrum
            .pairs
            .iter()
            .filter(|p| p.sign == Sign::Positive)
            .map(|p| p.value.sqrt() / std::f64::consts::TAU)
            .collect();
        let worst = ours.iter().zip(&frequencies).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
        let zeros =
            spectrum.pairs.iter().filter(|p| p.sign == Sign::Zero).map(|p| p.value.abs()).fold(0.0, f64::max);
        println!(
            "{} {} frequencies {worst:.1e} counts {:?} zeros {:.1e}",
            ours.len(),
            frequencies.len(),
            spectrum.counts,
            zeros / spectrum.largest
        );
    }
}
