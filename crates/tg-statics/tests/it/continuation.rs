//! Continuation against closed forms: a two-bar truss of springs with its folds and its pitchfork, a string that goes
//! slack.

use approx::assert_relative_eq;
use tg_model::{CableLaw, Model, ModelBuilder};
use tg_statics::{BranchEnd, ContinuationOptions, EventKind, InputFamily, StiffnessFamily, continuation};

const STIFFNESS: f64 = 100.0;

/// A particle at (0, h) on two springs to (±a, 0), unstressed; a unit load downwards.
fn truss(a: f64, h: f64) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    let apex = b.particle("apex", 1.0, [0.0, h]).unwrap();
    for (name, x) in [("left", -a), ("right", a)] {
        let foot = b.anchor(name, [x, 0.0]).unwrap();
        let law = CableLaw::linear(STIFFNESS);
        b.cable(&format!("{name} spring"), foot, apex.node(0), law, (a * a + h * h).sqrt()).unwrap();
    }
    b.load("load", apex.node(0), [0.0, -1.0], 1.0).unwrap();
    b.build().unwrap()
}

#[test]
fn a_shallow_truss_snaps_through_two_limit_points() {
    let (a, h) = (1.0, 0.3);
    let model = truss(a, h);
    let family = InputFamily::load_factor(&model, &model.inputs_at(0.0));
    let options = ContinuationOptions { behind: 1.0, ..ContinuationOptions::default() };
    let branch = continuation(&family, &model.initial_coordinates(), (0.0, 5.0), &options).unwrap();
    let rest = (a * a + h * h).sqrt();
    let length = (rest * a * a).cbrt();
    let y = (length * length - a * a).sqrt();
    let load = 2.0 * STIFFNESS * (rest / length - 1.0) * y;
    for e in &branch.events {
        println!("{:?} {} {:?}", e.kind, e.parameter, e.negative);
    }
    println!("{load} {y} {:?} points {}", branch.end, branch.points.len());
    assert_eq!(branch.end, BranchEnd::Reached);
    assert_eq!(branch.events.len(), 2);
    for (event, sign) in branch.events.iter().zip([1.0, -1.0]) {
        assert_eq!(event.kind, EventKind::LimitPoint);
        assert_relative_eq!(event.parameter, sign * load, max_relative = 1e-10);
        assert_relative_eq!(event.configuration.q[1], sign * y, max_relative = 1e-7);
    }
    assert!(branch.events[0].loses_stability());
    assert_eq!(branch.events[1].negative, (1, 0));
}

#[test]
fn a_steep_truss_bifurcates_before_its_limit_point() {
    let (a, h) = (1.0, 3.0);
    let model = truss(a, h);
    let family = InputFamily::load_factor(&model, &model.inputs_at(0.0));
    let branch =
        continuation(&family, &model.initial_coordinates(), (0.0, 400.0), &ContinuationOptions::default())
            .unwrap();
    let rest = (a * a + h * h).sqrt();
    // K_xx = 0: l³ = L₀ (l² - a²), the root near L₀.
    let mut length = rest;
    for _ in 0..100 {
        let f = length.powi(3) - rest * (length * length - a * a);
        length -= f / (3.0 * length * length - 2.0 * rest * length);
    }
    let load = 2.0 * STIFFNESS * (rest / length - 1.0) * (length * length - a * a).sqrt();
    for e in &branch.events {
        println!("{:?} {} {:?}", e.kind, e.parameter, e.negative);
    }
    println!("{load} {:?} points {}", branch.end, branch.points.len());
    assert_eq!(branch.events[0].kind, EventKind::Bifurcation);
    assert!(branch.events[0].loses_stability());
    assert_relative_eq!(branch.events[0].parameter, load, max_relative = 1e-9);
    assert_eq!(branch.events[1].kind, EventKind::LimitPoint);
}

/// A particle between two prestressed slacking cables on a vertical line; a unit load upwards.
fn string() -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    let bead = b.particle("bead", 1.0, [0.0, 1.0]).unwrap();
    for (name, y) in [("bottom", 0.0), ("top", 2.0)] {
        let end = b.anchor(name, [0.0, y]).unwrap();
        b.cable(&format!("{name} cable"), end, bead.node(0), CableLaw::slacking(STIFFNESS), 0.9).unwrap();
    }
    b.load("lift", bead.node(0), [0.0, 1.0], 1.0).unwrap();
    b.build().unwrap()
}

#[test]
fn a_cable_goes_slack_where_its_tension_ends() {
    let model = string();
    let family = InputFamily::load_factor(&model, &model.inputs_at(0.0));
    let branch =
        continuation(&family, &model.initial_coordinates(), (0.0, 30.0), &ContinuationOptions::default())
            .unwrap();
    for e in &branch.events {
        println!("{:?} {} {:?}", e.kind, e.parameter, e.negative);
    }
    assert_eq!(branch.events.len(), 1);
    assert_eq!(branch.events[0].kind, EventKind::Slack { cable: "cable \"top cable\"".into() });
    assert_relative_eq!(branch.events[0].parameter, 20.0, max_relative = 1e-10);
    let last = branch.points.last().unwrap();
    assert_relative_eq!(last.parameter, 30.0);
    assert_relative_eq!(last.configuration.q[1], 0.9 + 30.0 / STIFFNESS, max_relative = 1e-12);
}

#[test]
fn stiffness_and_rest_length_are_parameters() {
    let model = string();
    let cables: Vec<_> = model.cables().collect();
    let u = model.inputs_at(0.0);
    let options = ContinuationOptions::default();
    // κ_b (y - 0.9) = κ_t (1.1 - y) + 1, with the unit load.
    let start = 1.0 + 1.0 / (2.0 * STIFFNESS);
    let mut q = model.initial_coordinates();
    q[1] = start;
    let family = StiffnessFamily::new(&model, &cables[..1], &u);
    let branch = continuation(&family, &q, (STIFFNESS, 300.0), &options).unwrap();
    let y = branch.points.last().unwrap().configuration.q[1];
    assert_relative_eq!(y, (300.0 * 0.9 + STIFFNESS * 1.1 + 1.0) / (300.0 + STIFFNESS), max_relative = 1e-12);

    let family = InputFamily::rest_length(&model, &u, 0);
    let branch = continuation(&family, &q, (0.9, 0.5), &options).unwrap();
    let y = branch.points.last().unwrap().configuration.q[1];
    assert_relative_eq!(y, (0.5 + 1.1 + 1.0 / STIFFNESS) / 2.0, max_relative = 1e-12);
    assert_eq!(branch.end, BranchEnd::Reached);
}
