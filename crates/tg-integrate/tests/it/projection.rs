//! What the projection of the momentum changes, and that it does its work at every step.

use crate::support::prism::{self, prisms};
use crate::support::tower::{self, tower};
use crate::support::{constraint_rate, distance, example1, run, start, symplectic};
use tg_integrate::Stepper;
use tg_model::Mechanics;

/// Largest difference in q over one second between the scheme with projection and as printed, seen at every step.
fn difference(mechanics: &dyn Mechanics, q: &[f64], v: &[f64]) -> f64 {
    let mut projecting = symplectic(mechanics);
    let mut carrying = symplectic(mechanics).carrying_momentum();
    let mut a = projecting.start(0.0, q, v).unwrap();
    let mut b = carrying.start(0.0, q, v).unwrap();
    let mut worst = 0.0_f64;
    for _ in 0..1000 {
        projecting.step(&mut a, 1e-3).unwrap();
        carrying.step(&mut b, 1e-3).unwrap();
        worst = worst.max(distance(&a.q, &b.q));
    }
    worst
}

#[test]
fn coordinates_do_not_feel_the_projection() {
    let p = example1().model;
    let un = tower(tower::UN).model;
    let dn = tower(tower::DN).model;
    let standing = prisms(prism::STANDING).model;
    let cases: [(&dyn Mechanics, Vec<f64>, Vec<f64>); 4] = [
        (&p, p.initial_coordinates(), p.velocities_at_rest()),
        (&un, un.initial_coordinates(), un.velocities_at_rest()),
        (&dn, dn.initial_coordinates(), dn.velocities_at_rest()),
        (&standing, standing.initial_coordinates(), standing.velocities_at_rest()),
    ];
    for (k, (mechanics, q, v)) in cases.iter().enumerate() {
        let worst = difference(*mechanics, q, v);
        println!("case {k}: {worst:.2e}");
        assert!(worst < 1e-12, "case {k}: {worst:.2e}");
    }
}

/// The momentum as printed keeps a normal part that alternates; the multipliers show it, so the flag does something.
#[test]
fn carried_momentum_differs_in_the_multipliers() {
    let model = tower(tower::UN).model;
    let (mut projecting, mut carrying) = (symplectic(&model), symplectic(&model).carrying_momentum());
    let (mut a, mut b) = (start(&model, &mut projecting), start(&model, &mut carrying));
    assert_eq!(b.memory.len(), a.memory.len() + model.free().len());
    run(&mut projecting, &mut a, 1e-3, 0.5);
    run(&mut carrying, &mut b, 1e-3, 0.5);
    let size = a.lambda.iter().fold(0.0_f64, |l, x| l.max(x.abs()));
    let difference = distance(&a.lambda, &b.lambda);
    println!("λ {size:.2e} differs by {difference:.2e}");
    assert!(difference > 1e-6 * size);
}

#[test]
fn velocities_satisfy_the_constraints_at_every_step() {
    let p = example1().model;
    let un = tower(tower::UN).model;
    let us = tower(tower::US_AUX).model;
    let floating = prisms(prism::Setup { count: 3, ..prism::FLOATING }).model;
    let cases: [(&dyn Mechanics, Vec<f64>, Vec<f64>); 4] = [
        (&p, p.initial_coordinates(), p.velocities_at_rest()),
        (&un, un.initial_coordinates(), un.velocities_at_rest()),
        (&us, us.initial_coordinates(), us.velocities_at_rest()),
        (&floating, floating.initial_coordinates(), kicked(&floating.initial_coordinates())),
    ];
    for (k, (mechanics, q, v)) in cases.iter().enumerate() {
        let mut stepper = symplectic(*mechanics);
        let mut state = stepper.start(0.0, q, v).unwrap();
        let mut worst = constraint_rate(*mechanics, &state);
        for _ in 0..1000 {
            stepper.step(&mut state, 1e-3).unwrap();
            worst = worst.max(constraint_rate(*mechanics, &state));
        }
        println!("case {k}: {worst:.2e}");
        assert!(worst <= 1e-10, "case {k}: {worst:.2e}");
    }
}

/// Velocities that violate the constraints: the start projects them.
fn kicked(q: &[f64]) -> Vec<f64> {
    (0..q.len()).map(|i| (i as f64 * 1.7).sin()).collect()
}
