//! Cable laws by hand: signs, law (30) branch by branch, the frozen active set, energies, idle cables.

use std::sync::Arc;

use crate::support::mixed::{Cubic, Mixed, Plane, Spatial, mixed, random_state};
use crate::support::{Random, active_set, force};
use approx::assert_relative_eq;
use tg_model::{At, CableId, CableLaw, Mechanics, Model, ModelBuilder, TensionLaw};

/// A particle at (3, 4) tied to an anchor at the origin: length 5, direction (0.6, 0.8).
fn tied(law: CableLaw) -> (Model<2>, CableId) {
    let mut b = ModelBuilder::<2>::new();
    let peg = b.anchor("peg", [0.0, 0.0]).unwrap();
    let ball = b.particle("ball", 1.0, [3.0, 4.0]).unwrap();
    let cable = b.cable("tie", peg, ball.node(0), law, 4.0).unwrap();
    (b.build().unwrap(), cable)
}

/// Velocity of the ball alone that lengthens the tie at a rate (and turns it, which must not matter).
fn velocity(rate: f64) -> [f64; 4] {
    [0.6 * rate - 0.8 * 7.0, 0.8 * rate + 0.6 * 7.0, 0.0, 0.0]
}

#[test]
fn a_stretched_cable_pulls_its_ends_together() {
    let (model, cable) = tied(CableLaw::linear(10.0));
    let (q, v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
    assert_eq!(q, [3.0, 4.0, 0.0, 0.0]);
    let state = model.cable(cable, &q, &v, &u);
    assert_eq!((state.length, state.rest, state.rate, state.slack), (5.0, 4.0, 0.0, false));
    assert_relative_eq!(state.tension, 10.0);
    let f = force(&model, At { q: &q, v: &v, u: &u, taut: None });
    for (found, expected) in f.iter().zip([-6.0, -8.0, 6.0, 8.0]) {
        assert_relative_eq!(*found, expected, epsilon = 1e-14);
    }
}

/// Force on the ball along the cable (positive when the cable pulls), tension, slackness, active set.
fn pull(law: CableLaw, rest: f64, rate: f64, taut: Option<bool>) -> (f64, f64, bool, Vec<bool>) {
    let (model, cable) = tied(law);
    let (q, v, u) = (model.initial_coordinates(), velocity(rate), [rest]);
    let frozen = taut.map(|taut| vec![taut; model.sizes().switches]);
    let at = At { q: &q, v: &v, u: &u, taut: frozen.as_deref() };
    let f = force(&model, at);
    assert_relative_eq!(0.8 * f[0], 0.6 * f[1], epsilon = 1e-12);
    let state = model.cable(cable, &q, &v, &u);
    assert_relative_eq!(state.rate, rate, epsilon = 1e-14);
    (-0.6 * f[0] - 0.8 * f[1], state.tension, state.slack, active_set(&model, at))
}

#[test]
fn each_branch_of_the_slacking_law() {
    let (kappa, eta) = (10.0, 2.0);
    let damped = CableLaw::slacking(kappa).with_damping(eta);
    // (rest length, rate of length, tension, taut); l = 5.
    let cases = [
        (4.0, 1.0, 10.0 + 2.0, true),
        (4.0, -4.0, 10.0 - 8.0, true),
        (4.0, -6.0, 0.0, false), // long, but f⁺ = -2
        (6.0, 6.0, 0.0, false),  // f⁺ = 2, but short
        (6.0, 0.0, 0.0, false),
        (6.0, -1.0, 0.0, false),
        (5.0, 0.0, 0.0, true), // both at their limits
    ];
    for (rest, rate, tension, taut) in cases {
        let (force, reported, slack, set) = pull(damped.clone(), rest, rate, None);
        assert_relative_eq!(force, tension, epsilon = 1e-12);
        assert_relative_eq!(reported, tension, epsilon = 1e-12);
        assert_eq!((slack, set), (!taut, vec![taut]), "μ = {rest}, l̇ = {rate}");
    }
    for (rest, rate, tension, taut) in [(4.0, -6.0, 10.0, true), (6.0, 6.0, 0.0, false)] {
        let (force, reported, slack, set) = pull(CableLaw::slacking(kappa), rest, rate, None);
        assert_relative_eq!(force, tension, epsilon = 1e-12);
        assert_relative_eq!(reported, tension, epsilon = 1e-12);
        assert_eq!((slack, set), (!taut, vec![taut]));
    }
    // The two-way law has no switch and pushes.
    for (rest, rate, tension) in [(4.0, -6.0, -2.0), (6.0, 6.0, 2.0), (6.0, 0.0, -10.0)] {
        let (force, reported, slack, set) = pull(CableLaw::linear(kappa).with_damping(eta), rest, rate, None);
        assert_relative_eq!(force, tension, epsilon = 1e-12);
        assert_relative_eq!(reported, tension, epsilon = 1e-12);
        assert_eq!((slack, set), (false, vec![]));
    }
}

#[test]
fn a_user_law_is_used_as_given() {
    let law = || Arc::new(Cubic { a: 3.0, b: 2.0, c: 0.5 });
    let (force, reported, slack, set) = pull(CableLaw::User(law()), 4.0, 6.0, None);
    let expected = 3.0 + 2.0 + 0.5 * 6.0 * 2.0;
    assert_relative_eq!(force, expected, epsilon = 1e-12);
    assert_relative_eq!(reported, expected, epsilon = 1e-12);
    assert_eq!((slack, set), (false, vec![]));
    let (model, _) = tied(CableLaw::User(law()));
    assert!(model.features().damping && !model.damping_pattern().is_empty());
    assert!(law().damped());
    let (model, _) = tied(CableLaw::User(Arc::new(Cubic { a: 1.0, b: 1.0, c: 0.0 })));
    assert!(!model.features().damping && model.damping_pattern().is_empty());
}

#[test]
fn a_frozen_active_set_overrides_the_law() {
    let law = CableLaw::slacking(10.0).with_damping(2.0);
    assert_relative_eq!(pull(law.clone(), 6.0, -1.0, Some(true)).0, -12.0, epsilon = 1e-12);
    assert_relative_eq!(pull(law.clone(), 4.0, -6.0, Some(true)).0, -2.0, epsilon = 1e-12);
    assert_eq!(pull(law, 4.0, 1.0, Some(false)).0, 0.0);
    assert_relative_eq!(pull(CableLaw::slacking(10.0), 6.0, 0.0, Some(true)).0, -10.0, epsilon = 1e-12);
    // Laws without a switch do not look at the flags.
    let (model, _) = tied(CableLaw::linear(10.0));
    let q = model.initial_coordinates();
    let f = force(&model, At { q: &q, v: &[0.0; 4], u: &[4.0], taut: Some(&[]) });
    assert_relative_eq!(f[0], -6.0, epsilon = 1e-12);
}

#[test]
fn each_flag_belongs_to_the_switch_that_is_named() {
    let mixed: Mixed<3> = mixed::<Spatial, 3>(3, true);
    let model = &mixed.model;
    let (q, v, u) = random_state(&mixed, &mut Random::new(4));
    let switches = model.sizes().switches;
    let slacking = |(_, law): &&(CableId, CableLaw)| matches!(law, CableLaw::Slacking { .. });
    let cables: Vec<_> = mixed.cables.iter().filter(slacking).collect();
    assert_eq!(switches, cables.len());
    let slack = vec![false; switches];
    let forces = |taut: &[bool]| force(model, At { q: &q, v: &v, u: &u, taut: Some(taut) });
    let none = forces(&slack);
    for k in 0..switches {
        let mut flags = slack.clone();
        flags[k] = true;
        let one = forces(&flags);
        let (id, law) = cables[k];
        assert_eq!(model.switch_name(k), format!("cable \"{}\"", model.cable_name(*id)));
        let CableLaw::Slacking { stiffness, damping } = *law else { unreachable!() };
        let form = model.cable_form(*id);
        let (l, rate) = (form.eval(&q), form.eval(&v));
        let index = mixed.cables.iter().position(|(other, _)| other == id).unwrap();
        let f = stiffness * (l.norm() - u[index]) + damping * l.dot(&rate) / l.norm();
        let mut expected = none.clone();
        for &(node, w) in form.terms() {
            for d in 0..3 {
                expected[node * 3 + d] -= w * f * l[d] / l.norm();
            }
        }
        for (found, expected) in one.iter().zip(&expected) {
            assert_relative_eq!(*found, *expected, epsilon = 1e-11);
        }
    }
}

#[test]
fn active_set_is_that_of_the_formula_for_every_cable() {
    for seed in 0..8 {
        let mixed: Mixed<2> = mixed::<Plane, 2>(seed, true);
        let (q, v, u) = random_state(&mixed, &mut Random::new(seed));
        let mut expected = Vec::new();
        for (k, (id, law)) in mixed.cables.iter().enumerate() {
            let form = mixed.model.cable_form(*id);
            let l = form.eval(&q);
            let rate = l.dot(&form.eval(&v)) / l.norm();
            if let CableLaw::Slacking { stiffness, damping } = *law {
                let taut = l.norm() >= u[k] && stiffness * (l.norm() - u[k]) + damping * rate >= 0.0;
                assert_eq!(mixed.model.cable(*id, &q, &v, &u).slack, !taut);
                expected.push(taut);
            }
        }
        assert_eq!(active_set(&mixed.model, At { q: &q, v: &v, u: &u, taut: None }), expected);
    }
}

#[test]
fn elastic_energy_of_each_law() {
    let cubic = Arc::new(Cubic { a: 3.0, b: 2.0, c: 0.5 });
    let cases = [
        (CableLaw::linear(10.0), 3.0, 20.0),
        (CableLaw::linear(10.0).with_damping(9.0), 6.0, 5.0),
        (CableLaw::slacking(10.0), 3.0, 20.0),
        (CableLaw::slacking(10.0), 6.0, 0.0),
        (CableLaw::slacking(10.0).with_damping(9.0), 3.0, 20.0),
        (CableLaw::slacking(10.0).with_damping(9.0), 6.0, 0.0),
        (CableLaw::User(cubic), 3.0, 6.0 + 8.0),
    ];
    for (law, rest, expected) in cases {
        let (model, _) = tied(law.clone());
        let energy = model.energy(&model.initial_coordinates(), &velocity(1.0), &[rest]);
        assert_relative_eq!(energy.elastic, expected, epsilon = 1e-12);
        assert_eq!((energy.gravity, energy.load), (0.0, 0.0), "{law:?}");
    }
}

#[test]
fn cables_between_prescribed_points_are_idle() {
    let mut b = ModelBuilder::<2>::new();
    let pegs = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]].map(|x| b.anchor(&format!("peg {}", x[0]), x).unwrap());
    let ball = b.particle("ball", 1.0, [0.0, 1.0]).unwrap();
    b.support("lift", pegs[1], 1, tg_model::Signal::sine(0.3, 1.0)).unwrap();
    let idle = b.cable("clothes line", pegs[0], pegs[1], CableLaw::slacking(5.0), 0.5).unwrap();
    let live = b.cable("live", pegs[0], ball.node(0), CableLaw::slacking(7.0), 0.5).unwrap();
    let model = b.build().unwrap();
    assert_eq!(model.report().idle_cables, ["clothes line"]);
    assert!(model.report().to_string().contains("clothes line"));
    assert_eq!((model.sizes().switches, model.sizes().inputs), (1, 2));
    assert_eq!(model.switch_name(0), "cable \"live\"");
    let (q, v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
    // Its state can still be asked for; the equations do not contain it.
    assert_relative_eq!(model.cable(idle, &q, &v, &u).tension, 2.5);
    assert_relative_eq!(model.cable(live, &q, &v, &u).tension, 3.5);
    assert_relative_eq!(model.energy(&q, &v, &u).elastic, 0.5 * 7.0 * 0.25);
    let f = force(&model, At { q: &q, v: &v, u: &u, taut: None });
    let expected = [0.0, -3.5, 0.0, 3.5, 0.0, 0.0, 0.0, 0.0];
    assert_eq!(f, expected);
    assert_eq!(model.stiffness_pattern(), [(0, 0), (0, 1), (1, 0), (1, 1)]);
}

#[test]
fn only_damped_laws_have_a_velocity_tangent() {
    for (law, damped) in [
        (CableLaw::linear(1.0), false),
        (CableLaw::slacking(1.0), false),
        (CableLaw::linear(1.0).with_damping(0.0), false),
        (CableLaw::linear(1.0).with_damping(0.1), true),
        (CableLaw::slacking(1.0).with_damping(0.1), true),
    ] {
        let (model, _) = tied(law);
        assert_eq!(model.features().damping, damped);
        assert_eq!(model.damping_pattern().is_empty(), !damped);
    }
}

#[test]
fn a_cable_without_length_lengthens_as_fast_as_its_ends_part() {
    let (model, cable) = tied(CableLaw::linear(10.0));
    let state = model.cable(cable, &[0.0; 4], &velocity(1.0), &[0.0]);
    assert_eq!(state.length, 0.0);
    assert_relative_eq!(state.rate, 50.0_f64.sqrt(), max_relative = 1e-15);
}

#[test]
fn forces_at_rest_length_are_known_no_better_than_those_of_a_taut_cable() {
    let (model, _) = tied(CableLaw::linear(10.0));
    let (q, v) = (model.initial_coordinates(), model.velocities_at_rest());
    let scale = |rest: f64| model.force_scale(At { q: &q, v: &v, u: &[rest], taut: None });
    assert_relative_eq!(scale(4.0), 10.0);
    // 1e-4 κ l, and nothing of what is slack.
    assert_relative_eq!(scale(5.0), 5e-3);
    let (slack, _) = tied(CableLaw::slacking(10.0));
    assert_eq!(slack.force_scale(At { q: &q, v: &v, u: &[6.0], taut: None }), 0.0);
}
