//! Choices of modelling that change nothing but rounding: coordinate type, joint, split of the planar J.

use crate::support::tower::{self, tower};
use crate::support::{SPLIT, corners, distance, double_pendulum, run, start, symplectic};
use tg_coords::CoordType::{Rrr, Rrrr, Rrrw, Rrv, Rrvw, Ruv, Ruvw};
use tg_coords::{CoordType, MassProperties, Member, Pose, Twist};
use tg_model::Joining::{Constrain, Share};
use tg_model::{Joining, ModelBuilder};

/// Corners of the triangle of example 1 every 0.1 s up to 1 s.
fn pendulum_path(coord_type: CoordType, joining: Joining, split: f64) -> Vec<f64> {
    let p = double_pendulum(coord_type, joining, split);
    let mut stepper = symplectic(&p.model);
    let mut state = start(&p.model, &mut stepper);
    let mut path = Vec::new();
    for k in 1..=10 {
        run(&mut stepper, &mut state, 1e-3, 0.1 * f64::from(k));
        path.extend(corners(&p.model, &[p.triangle], &state.q));
    }
    path
}

fn tower_path(setup: tower::Setup) -> Vec<f64> {
    let t = tower(setup);
    let mut stepper = symplectic(&t.model);
    let mut state = start(&t.model, &mut stepper);
    let mut path = Vec::new();
    for k in 1..=10 {
        run(&mut stepper, &mut state, 1e-3, 0.1 * f64::from(k));
        path.extend(corners(&t.model, &t.triangles, &state.q));
    }
    path
}

#[test]
fn example_1_does_not_depend_on_how_it_is_modelled() {
    let reference = pendulum_path(Ruv, Share, SPLIT);
    let variants = [
        (Rrv, Share, SPLIT),
        (Rrr, Share, SPLIT),
        (Ruv, Constrain, SPLIT),
        (Rrr, Constrain, SPLIT),
        (Ruv, Share, 0.0),
        (Rrv, Share, 1.0),
        (Rrr, Constrain, 0.5),
    ];
    for (coord_type, joining, split) in variants {
        let difference = distance(&pendulum_path(coord_type, joining, split), &reference);
        println!("{coord_type} {joining:?} {split}: {difference:.1e}");
        assert!(difference < 1e-12, "{coord_type} {joining:?} {split}: {difference:.1e}");
    }
}

#[test]
fn example_2_does_not_depend_on_how_it_is_modelled() {
    let reference = tower_path(tower::UN);
    let variants = [
        tower::Setup { types: [Rrr; 3], ..tower::UN },
        tower::Setup { types: [Rrv; 3], joining: Constrain, ..tower::UN },
        tower::Setup { types: [Ruv; 3], split: 0.3, ..tower::UN },
        tower::Setup { types: [Rrv, Rrr, Ruv], split: 1.0, joining: Constrain, ..tower::UN },
    ];
    for setup in variants {
        let difference = distance(&tower_path(setup), &reference);
        println!("{setup:?}: {difference:.1e}");
        assert!(difference < 1e-12, "{setup:?}: {difference:.1e}");
    }
}

/// A heavy top in space, hinged at a corner that is a basic point of every type.
fn top_path(coord_type: CoordType) -> Vec<f64> {
    let mass =
        MassProperties::from_principal_moments(0.3, [0.03, 0.02, 0.08].into(), [7e-4, 5e-4, 9e-4]).unwrap();
    let nodes = [[0.0, 0.0, 0.0], [0.1, 0.0, 0.0], [0.02, 0.1, 0.0], [0.0, 0.03, 0.1]];
    let points = Member::<3>::new(Rrrr, &nodes.map(Into::into), mass).unwrap();
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -9.81]).unwrap();
    // Away from the origin, where points and vectors would be the same numbers.
    let pose = Pose::from_axis_angle([0.3, -0.2, 0.7].into(), [1.0, 0.5, 0.0].into(), 0.6).unwrap();
    let top = b.member("top", points.with_type(coord_type).unwrap(), pose).unwrap();
    b.fix("tip", top.node(0)).unwrap();
    let model = b.build().unwrap();
    let q = model.initial_coordinates();
    let mut v = vec![0.0; q.len()];
    let twist = Twist::spatial([0.0; 3].into(), [1.0, -2.0, 9.0].into());
    model.set_twist(top, &twist, &q, &mut v).unwrap();
    let mut stepper = symplectic(&model);
    let mut state = tg_integrate::Stepper::start(&mut stepper, 0.0, &q, &v).unwrap();
    let mut path = Vec::new();
    for k in 1..=10 {
        run(&mut stepper, &mut state, 1e-3, 0.1 * f64::from(k));
        for local in nodes {
            path.extend(crate::support::position(&model, top.at(local), &state.q));
        }
    }
    path
}

#[test]
fn a_top_in_space_does_not_depend_on_its_coordinate_type() {
    let reference = top_path(Ruvw);
    for coord_type in [Rrvw, Rrrw, Rrrr] {
        let difference = distance(&top_path(coord_type), &reference);
        println!("{coord_type}: {difference:.1e}");
        assert!(difference < 1e-12, "{coord_type}: {difference:.1e}");
    }
}
