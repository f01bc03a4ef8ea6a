//! Closed forms for the scenes that have no model in code.

use std::f64::consts::PI;

use tg_model::{Mechanics, Model};
use tg_statics::{EquilibriumReport, Forward, ForwardOptions, Verdict, stability};
use tg_tangent::Configuration;

use super::spatial;

/// Tensions, axial forces of bars, and how far from balance, as built.
fn as_built(model: &Model<3>) -> EquilibriumReport<3> {
    EquilibriumReport::new(model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap()
}

fn verdict(model: &Model<3>) -> Verdict {
    let at = Configuration::at(model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap();
    stability(model, &at, 1).unwrap().verdict
}

fn assert_near(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-12 * b.abs(), "{a} {b}");
}

/// Bars of length L at distances L/2, cables of L √(3/8), bars under √6 times the tension.
#[test]
fn icosahedron() {
    for (length, tension) in [(1.0, 100.0), (2.5, 7.0)] {
        let model = spatial("icosahedron.toml", &[("L", length), ("tension", tension)]);
        assert_eq!(model.report().degrees_of_freedom(), 30);
        let q = model.initial_coordinates();
        let bars: Vec<_> = model.members().map(|bar| model.member_nodes(bar, &q)).collect();
        for pair in bars.chunks(2) {
            let [a, b] = [&pair[0], &pair[1]].map(|bar| bar[1] - bar[0]);
            assert_near(a.norm(), length);
            assert_near(a.dot(&b), length * length);
            assert_near((pair[1][0] - pair[0][0]).norm(), length / 2.0);
            assert!((pair[1][0] - pair[0][0]).dot(&a).abs() < 1e-12);
        }
        let report = as_built(&model);
        assert!(report.imbalance < 1e-12, "{}", report.imbalance);
        assert_eq!(report.cables.len(), 24);
        for (_, cable) in &report.cables {
            assert_near(cable.length, length * 0.375_f64.sqrt());
            assert_near(cable.tension, tension);
        }
        assert_eq!(report.members.len(), 6);
        for bar in &report.members {
            assert_near(bar.axial.unwrap(), -(6.0_f64.sqrt()) * tension);
        }
        assert_eq!(verdict(&model), Verdict::Stable);
    }
}

/// Each stage is turned by 90° - 180°/3; the bars carry -√3 q times their length; another twist has no balance.
#[test]
fn prism_mast() {
    let (q, r, h) = (400.0, 0.3_f64, 0.5_f64);
    let model = spatial("prism_mast.toml", &[]);
    assert_eq!((model.members().len(), model.cables().len()), (96, 192));
    // Three free corners in each of 32 rings, 96 lengths.
    assert_eq!(model.report().degrees_of_freedom(), 9 * 32 - 96);
    let report = as_built(&model);
    assert!(report.imbalance < 1e-12, "{}", report.imbalance);
    // From corner to corner over an angle of 150° and one of 30°.
    let [bar, vertical] =
        [150.0, 30.0_f64].map(|angle| (2.0 * r * r * (1.0 - (angle * PI / 180.0).cos()) + h * h).sqrt());
    for member in &report.members {
        let axial = member.axial.unwrap();
        assert!((axial + 3.0_f64.sqrt() * q * bar).abs() < 1e-10 * q, "{}: {axial}", member.name);
    }
    for (name, cable) in &report.cables {
        let expected = if name.starts_with("vertical") {
            3.0_f64.sqrt() * q * vertical
        } else {
            (if name.starts_with("ring 32") { q } else { 2.0 * q }) * 3.0_f64.sqrt() * r
        };
        assert_near(cable.tension, expected);
    }
    let corners = |k: usize| {
        let bar = model.members().nth(k).unwrap();
        model.member_nodes(bar, &model.initial_coordinates())
    };
    // The bar leads from a corner to that after the next one's: 30° and 120° further.
    let [foot, top]: [_; 2] = corners(0).try_into().unwrap();
    let turn = (top.y.atan2(top.x) - foot.y.atan2(foot.x)).to_degrees() - 120.0;
    assert_near(turn, 90.0 - 180.0 / 3.0);
    assert_eq!(verdict(&model), Verdict::Stable);
    let wrong = spatial("prism_mast.toml", &[("twist", 31.0 * PI / 180.0)]);
    assert!(as_built(&wrong).imbalance > 1e-3);
}

/// The mast stands under its weight, and its feet have the accelerations of the file.
#[test]
fn seismic_mast() {
    let model = spatial("seismic.toml", &[]);
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let standing = Forward::new(&model, ForwardOptions::default()).solve(&q, &u).unwrap();
    assert_eq!(stability(&model, &standing.configuration, 1).unwrap().verdict, Verdict::Stable);
    assert_eq!(model.report().degrees_of_freedom(), 9 * 4 - 12);
    // All verticals are alike as built, and the weight only changes them by millimetres.
    let (r, h) = (0.3_f64, 0.5_f64);
    let vertical = (r * r * (2.0 - 3.0_f64.sqrt()) + h * h).sqrt();
    for cable in model.cables().filter(|&cable| model.cable_name(cable).starts_with("vertical")) {
        assert_near(model.cable_form(cable).eval(&q).norm(), vertical);
        let loaded = model.cable_form(cable).eval(&standing.configuration.q).norm();
        assert!((loaded - vertical).abs() < 5e-3, "{loaded} {vertical}");
    }
    let foot = |t: f64| {
        let (mut q, mut v) = (q.clone(), vec![0.0; q.len()]);
        model.prescribe(t, &mut q, &mut v);
        let foot = model.members().next().unwrap();
        [model.member_nodes(foot, &q)[0].x, model.member_nodes(foot, &v)[0].x]
    };
    let text = include_str!("../../../../../scenes/ground_motion.csv");
    let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let record: Vec<[f64; 2]> = rows
        .map(|row| {
            let (t, a) = row.split_once(',').unwrap();
            [t.parse().unwrap(), a.parse().unwrap()]
        })
        .collect();
    let h = 1e-3;
    let mut peak = 0.0_f64;
    for &[t, a] in &record[1..record.len() - 1] {
        let acceleration = (foot(t + h)[1] - foot(t - h)[1]) / (2.0 * h);
        // A central difference smooths the kink of the acceleration at the sample.
        assert!((acceleration - a).abs() < 0.1, "{t}: {acceleration} {a}");
        peak = peak.max(a.abs());
    }
    assert_eq!(peak, 3.0);
    let end = record.last().unwrap()[0];
    assert!(foot(end + 1.0)[1] == 0.0 && foot(end + 1.0)[0] == foot(end + 2.0)[0]);
}
