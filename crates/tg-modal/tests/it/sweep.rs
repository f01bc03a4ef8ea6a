//! Frequencies against a parameter.

use std::convert::Infallible;

use crate::support::{as_built, oscillator};
use tg_fixtures::spine;
use tg_modal::{SweepError, SweepOptions, sweep};
use tg_model::{CableLaw, Model, ModelBuilder};
use tg_tangent::Configuration;

/// Two beads that do not know of each other; the second one's cables have stiffness κ.
fn beads(stiffness: f64) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    oscillator(&mut b, "first", [0.0, 0.0], 1.0, &CableLaw::linear(100.0), 10.0);
    oscillator(&mut b, "second", [0.0, 2.0], 1.0, &CableLaw::linear(stiffness), 15.0);
    b.build().unwrap()
}

fn owned(model: Model<2>) -> Result<(Box<Model<2>>, Configuration), Infallible> {
    let at = as_built(&model);
    Ok((Box::new(model), at))
}

/// Frequencies along the cables cross at κ = 100, between or on the parameters.
#[test]
fn crossings_keep_identities() {
    for parameters in [vec![80.0, 90.0, 95.0, 103.0, 120.0], vec![80.0, 90.0, 100.0, 110.0, 120.0]] {
        let found = sweep(&parameters, &SweepOptions::new(4), |kappa| owned(beads(kappa))).unwrap();
        assert_eq!(found.parameters, parameters);
        assert!(found.ambiguous.is_empty() && found.requested.iter().all(|&asked| asked));
        let exact: [&dyn Fn(f64) -> f64; 4] = [&|_| 20.0, &|_| 30.0, &|kappa| 2.0 * kappa, &|_| 200.0];
        for (track, exact) in found.tracks.iter().zip(exact) {
            for ((value, mac), &kappa) in track.omega_squared.iter().zip(&track.mac).zip(&parameters) {
                assert!((value / exact(kappa) - 1.0).abs() < 1e-12, "{kappa} {value}");
                assert!((mac - 1.0).abs() < 1e-12, "{kappa} {mac}");
            }
        }
    }
}

/// The sweep begins at the crossing, where any basis is as good: the tracks take the shapes that come after.
#[test]
fn a_start_at_a_crossing_is_resolved() {
    let found = sweep(&[100.0, 110.0, 120.0], &SweepOptions::new(4), |kappa| owned(beads(kappa))).unwrap();
    assert!(found.ambiguous.is_empty() && found.parameters.len() == 3);
    let mut ends = [2, 3].map(|k| found.tracks[k].omega_squared[2]);
    ends.sort_by(f64::total_cmp);
    assert!((ends[0] - 200.0).abs() < 1e-10 && (ends[1] - 240.0).abs() < 1e-10);
    assert!(found.tracks.iter().flat_map(|track| &track.mac).all(|mac| (mac - 1.0).abs() < 1e-12));
}

/// A group that the count cuts is completed.
#[test]
fn a_group_is_followed_whole() {
    let found = sweep(&[100.0, 110.0], &SweepOptions::new(3), |kappa| owned(beads(kappa))).unwrap();
    assert_eq!(found.tracks.len(), 4);
}

/// A mode that rises above those followed is found among the spare ones.
#[test]
fn a_track_may_leave_the_lowest_modes() {
    let found = sweep(&[20.0, 60.0, 150.0], &SweepOptions::new(3), |kappa| owned(beads(kappa))).unwrap();
    let rising = &found.tracks[2];
    let exact = [40.0, 120.0, 300.0];
    assert!(rising.omega_squared.iter().zip(exact).all(|(v, e)| (v / e - 1.0).abs() < 1e-12));
}

/// A weak link makes the frequencies veer: ω² are the roots of a 2 by 2 matrix, shapes change places within a small
/// interval, and halving follows them there.
#[test]
fn veering_is_refined() {
    let (link_tension, length) = (1.0, 2.0);
    // Across the link only its tension counts: coupling T/l.
    let coupling = link_tension / length;
    let parameters = [90.0, 100.0, 110.0];
    let options = SweepOptions { halvings: 12, ..SweepOptions::new(4) };
    let held = |kappa: f64| {
        let mut b = ModelBuilder::<2>::new();
        let law = |k: f64| CableLaw::linear(k);
        let first = oscillator(&mut b, "first", [0.0, 0.0], 1.0, &law(100.0), 10.0);
        let second = oscillator(&mut b, "second", [0.0, 2.0], 1.0, &law(kappa), 15.0);
        b.cable("link", first.node(0), second.node(0), law(50.0), 2.0 - link_tension / 50.0).unwrap();
        for (name, bead, y) in [("below", first, -1.0), ("above", second, 3.0)] {
            let peg = b.anchor(name, [0.0, y]).unwrap();
            b.cable(name, peg, bead.node(0), law(50.0), 1.0 - link_tension / 50.0).unwrap();
        }
        owned(b.build().unwrap())
    };
    let found = sweep(&parameters, &options, held).unwrap();
    println!("{:?}", found.parameters);
    assert!(found.ambiguous.is_empty(), "{:?}", found.ambiguous);
    assert!(found.parameters.len() > parameters.len());
    let asked: Vec<f64> =
        found.parameters.iter().zip(&found.requested).filter(|p| *p.1).map(|p| *p.0).collect();
    assert_eq!(asked, parameters);
    for (k, &kappa) in found.parameters.iter().enumerate() {
        let (a, d) = (200.0 + coupling + link_tension, 2.0 * kappa + coupling + link_tension);
        let root = (0.25 * (a - d) * (a - d) + coupling * coupling).sqrt();
        // The lower branch stays the lower one. Beneath both are the two modes along the link.
        for (track, exact) in found.tracks[2..].iter().zip([0.5 * (a + d) - root, 0.5 * (a + d) + root]) {
            let value = track.omega_squared[k];
            assert!((value / exact - 1.0).abs() < 1e-12, "{kappa}: {value} {exact}");
        }
    }
    let least = found.tracks.iter().flat_map(|track| &track.mac).fold(1.0_f64, |a, &b| a.min(b));
    assert!(least >= options.least_mac, "{least}");
    let coarse = sweep(&parameters, &SweepOptions { halvings: 0, ..options }, held).unwrap();
    assert_eq!(coarse.parameters, parameters);
    assert!(!coarse.ambiguous.is_empty());
}

/// Bending pairs stay pairs while the prestress changes; frequencies are those found afresh.
#[test]
fn pairs_stay_together() {
    let tensions: Vec<f64> = (0..12).map(|k| 4.0 + f64::from(k)).collect();
    let at = |tension: f64| -> Result<_, Infallible> {
        let model = spine(3, tension, 0.0).unwrap().model;
        let at = as_built(&model);
        Ok((Box::new(model), at))
    };
    let found = sweep(&tensions, &SweepOptions::new(8), at).unwrap();
    assert!(found.ambiguous.is_empty());
    let least = found.tracks.iter().flat_map(|track| &track.mac).fold(1.0_f64, |a, &b| a.min(b));
    println!("{} parameters, least MAC {least:.4}", found.parameters.len());
    assert!(least >= 0.8);
    let pairs: Vec<bool> = found
        .tracks
        .windows(2)
        .map(|w| (w[0].omega_squared[0] / w[1].omega_squared[0] - 1.0).abs() < 1e-9)
        .collect();
    assert!(pairs.iter().any(|&pair| pair));
    for (k, _) in pairs.iter().enumerate().filter(|(_, pair)| **pair) {
        let [a, b] = [&found.tracks[k].omega_squared, &found.tracks[k + 1].omega_squared];
        assert!(a.iter().zip(b).all(|(a, b)| (a / b - 1.0).abs() < 1e-9), "{k}");
    }
}

#[test]
fn failures_name_the_parameter() {
    let none = |p: f64| -> Result<(Box<Model<2>>, Configuration), String> { Err(format!("nothing at {p}")) };
    let error = sweep(&[3.5], &SweepOptions::new(1), none).unwrap_err();
    assert!(matches!(error, SweepError::Equilibrium { parameter: 3.5, .. }));
    assert!(error.to_string().contains("nothing at 3.5"));
    let shrinking = |p: f64| {
        let mut b = ModelBuilder::<2>::new();
        oscillator(&mut b, "first", [0.0, 0.0], 1.0, &CableLaw::linear(100.0), 10.0);
        if p < 1.0 {
            oscillator(&mut b, "second", [0.0, 2.0], 1.0, &CableLaw::linear(100.0), 10.0);
        }
        owned(b.build().unwrap())
    };
    let error = sweep(&[0.0, 2.0], &SweepOptions::new(3), shrinking).unwrap_err();
    assert!(matches!(error, SweepError::Changed { parameter: 2.0, .. }), "{error}");
    let empty = sweep(&[], &SweepOptions::new(1), none).unwrap();
    assert!(empty.parameters.is_empty() && empty.tracks.is_empty());
}
