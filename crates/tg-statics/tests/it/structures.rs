//! Structures that others designed: relaxed to equilibrium, their self-stress, mechanisms, lengths, tensions and
//! frequencies are those that an independent program found. The files are not part of the project; where their folder
//! does not exist the test says so and skips.

use std::path::{Path, PathBuf};

use serde_json::Value;
use tg_model::{BuildError, CableId, CableLaw, Joining, Model, ModelBuilder, Place};
use tg_statics::{Configuration, Forward, ForwardOptions, Seek, SelfStress, Verdict, stability};
use tg_tangent::{EigenOptions, Method, Metric, Sign, lowest};

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

fn largest_difference(ours: &[f64], theirs: &[f64]) -> f64 {
    assert_eq!(ours.len(), theirs.len());
    let size = theirs.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    ours.iter().zip(theirs).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
}

/// Counts at a tolerance that only exact zeros pass; a looser one asks for the metric of the matrix, in which programs
/// differ, and the gap is the answer then.
fn check_counts(name: &str, found: &SelfStress, stated: &Value) {
    assert_eq!(found.rank.rank as u64, stated["rank"], "{name}: rank, gap {:?}", found.rank.gap());
    assert_eq!(found.states.len() as u64, stated["self_stress_states"], "{name}: states of self-stress");
    assert_eq!(found.mechanisms.len() as u64, stated["internal_mechanisms"], "{name}: mechanisms");
}

#[test]
fn relax_to_the_stated_equilibria() {
    for path in files() {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let Structure { model, cables, analysis } = load(&path).unwrap();
        let stated = &analysis["relaxed_no_gravity"];
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
        let given = Configuration::at(&model, &q, &u).unwrap();
        check_counts(&name, &SelfStress::new(&model, &given).unwrap(), &analysis["exact_tol_1e-9"]);

        let options = ForwardOptions { seek: Seek::Stable, ..ForwardOptions::default() };
        let found = Forward::new(&model, options).solve(&q, &u).unwrap();
        let at = &found.configuration;
        assert!(found.report.residual < 1e-12, "{name}: {:?}", found.report);
        let self_stress = SelfStress::new(&model, at).unwrap();
        check_counts(&name, &self_stress, stated);
        let (counted, not) = self_stress.rank.gap();
        assert!(counted.unwrap() > 1e-3 && not.is_none_or(|s| s < 1e-14), "{name}: {:?}", (counted, not));

        let states: Vec<_> = cables.iter().map(|&c| model.cable(c, &at.q, &q, &u)).collect();
        let lengths: Vec<f64> = states.iter().map(|s| s.length).collect();
        let tensions: Vec<f64> = states.iter().map(|s| s.tension).collect();
        // Lengths are stated with nine decimals.
        assert!(largest_difference(&lengths, &list(&stated["cable_lengths"])) < 2e-9, "{name}: lengths");
        assert!(largest_difference(&tensions, &list(&stated["cable_tensions"])) < 1e-11, "{name}: tensions");

        let stability = stability(&model, at, 1).unwrap();
        assert_eq!(stability.verdict, Verdict::Stable, "{name}: {:?}", stability.counts);
        assert_eq!(stability.counts.zero as u64, stated["zero_modes"], "{name}");

        let frequencies = list(&stated["frequencies_Hz_nonzero"]);
        for method in [Method::Dense, Method::Sparse] {
            let count = stability.counts.zero + frequencies.len();
            let options = EigenOptions { method, ..EigenOptions::new(count, Metric::Mass) };
            let spectrum = lowest(&model, at, &options).unwrap();
            let positive = spectrum.pairs.iter().filter(|pair| pair.sign == Sign::Positive);
            let ours: Vec<f64> = positive.map(|pair| pair.value.sqrt() / std::f64::consts::TAU).collect();
            let worst = ours.iter().zip(&frequencies).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max);
            assert_eq!(ours.len(), frequencies.len(), "{name}");
            assert!(worst < 1e-11, "{name}, {method:?}: frequencies differ by {worst:.1e}");
            let zeros = spectrum.pairs.iter().filter(|pair| pair.sign == Sign::Zero);
            assert!(
                zeros.map(|pair| pair.value.abs() / spectrum.largest).fold(0.0, f64::max) < 1e-14,
                "{name}"
            );
        }
        println!("{name}: {:?}", found.report);
    }
}
