//! The regular prism, whose twist, forces, self-stress and mechanism are known in closed form.

use approx::assert_relative_eq;
use tg_fixtures::prism;
use tg_model::CableLaw;
use tg_statics::{
    Configuration, Forward, ForwardOptions, InverseStatics, PrestressStability, Request, SelfStress, Unknown,
    Verdict, prestress_stability, stability,
};

#[test]
fn one_self_stress_one_mechanism() {
    for n in 3..8 {
        let prism = prism(n, 10.0, 0.0, CableLaw::slacking).unwrap();
        let q = prism.model.initial_coordinates();
        let u = prism.model.inputs_at(0.0);
        let at = Configuration::at(&prism.model, &q, &u).unwrap();
        assert!(at.imbalance().0 < 1e-13, "{:?}", at.imbalance());
        let analysis = SelfStress::new(&prism.model, &at).unwrap();
        println!("{n} {:?} {:?} {}", analysis.rank.gap(), analysis.states.len(), analysis.mechanisms.len());
        assert_eq!(analysis.states.len(), 1);
        assert_eq!(analysis.rigid_motions.len(), 6);
        println!("{:?}", prestress_stability(&prism.model, &at, &analysis).unwrap());
        let s = stability(&prism.model, &at, 8).unwrap();
        println!("{:?} {:?} {}", s.verdict, s.counts, s.rigid_motions);
        println!("{:?}", s.lowest.iter().map(|p| p.value).collect::<Vec<_>>());
    }
}

#[test]
fn round_trip() {
    let prism = prism(3, 10.0, 0.0, CableLaw::slacking).unwrap();
    let q = prism.model.initial_coordinates();
    let u = prism.model.inputs_at(0.0);
    let inverse = InverseStatics::new(&prism.model, &q, &u).unwrap();
    let answer = inverse.solve(&Request::new(Unknown::RestLength).closest_to(&u)).unwrap();
    for row in answer.cutting_list() {
        println!("{row}");
    }
    let mut far = q.clone();
    far.iter_mut().enumerate().for_each(|(i, x)| *x += 0.1 * (i as f64 * 1.7).sin());
    let forward = Forward::new(&prism.model, ForwardOptions::default());
    let found = forward.solve(&far, &answer.inputs(&u)).unwrap();
    println!("{:?}", found.report);
    let cables: Vec<f64> =
        prism.cables.iter().map(|&c| prism.model.cable(c, &found.configuration.q, &q, &u).tension).collect();
    println!("{cables:?} {:?}", prism.forces);
}
