//! Order of convergence on positions, by Richardson: successive halvings of the step.

use crate::support::tower::{self, tower};
use crate::support::{alpha, at_end, corners, distance, example1, order, start, symplectic};
use tg_integrate::Stepper;

/// Positions of the triangle of example 1 after one second.
fn pendulum_end(stepper: impl Fn(&tg_model::Model<2>) -> Box<dyn Stepper + '_>, h: f64) -> Vec<f64> {
    let p = example1();
    let state = at_end(&p.model, stepper(&p.model).as_mut(), h, 1.0);
    corners(&p.model, &[p.triangle], &state.q)
}

fn tower_end(
    setup: tower::Setup,
    stepper: impl Fn(&tg_model::Model<2>) -> Box<dyn Stepper + '_>,
    h: f64,
) -> Vec<f64> {
    let t = tower(setup);
    let state = at_end(&t.model, stepper(&t.model).as_mut(), h, 1.0);
    corners(&t.model, &t.triangles, &state.q)
}

/// Orders from each three of four successive steps.
fn orders(h: f64, end: impl Fn(f64) -> Vec<f64>) -> [f64; 2] {
    let runs: Vec<_> = (0..4).map(|k| end(h / f64::from(1 << k))).collect();
    [order([&runs[0], &runs[1], &runs[2]]), order([&runs[1], &runs[2], &runs[3]])]
}

fn second(name: &str, orders: [f64; 2]) {
    println!("{name}: {orders:.4?}");
    for order in orders {
        assert!((order - 2.0).abs() <= 0.05, "{name}: {orders:?}");
    }
}

#[test]
fn symplectic_scheme_is_of_second_order() {
    second("example 1", orders(1e-3, |h| pendulum_end(|m| Box::new(symplectic(m)), h)));
    second("UN", orders(1e-3, |h| tower_end(tower::UN, |m| Box::new(symplectic(m)), h)));
    second("DN", orders(1e-3, |h| tower_end(tower::DN, |m| Box::new(symplectic(m)), h)));
}

#[test]
fn generalised_alpha_is_of_second_order() {
    // The more a scheme damps, the later its order shows: ρ∞ = 0 needs steps of 1e-5 s in example 1.
    for (rho, h) in [(0.5, 2.5e-4), (0.7, 5e-4), (0.9, 5e-4)] {
        let example1 = orders(h, |h| pendulum_end(|m| Box::new(alpha(m, rho)), h));
        second(&format!("example 1, ρ∞ = {rho}"), example1);
    }
    for (rho, h) in [(0.0, 2.5e-4), (0.7, 5e-4)] {
        let un = orders(h, |h| tower_end(tower::UN, |m| Box::new(alpha(m, rho)), h));
        second(&format!("UN, ρ∞ = {rho}"), un);
    }
}

/// Undamped slacking has kinks in the force: still about second order, with an erratic constant. The error against a
/// fine run falls by 16 with a step divided by four, within a factor of three.
#[test]
fn undamped_slacking_keeps_about_second_order() {
    let end = |h| tower_end(tower::US_AUX, |m| Box::new(symplectic(m)), h);
    let fine = end(3.125e-5);
    let errors = [2e-3, 5e-4, 1.25e-4].map(|h| distance(&end(h), &fine));
    println!("{errors:?}");
    for pair in errors.windows(2) {
        assert!(pair[0] / pair[1] > 16.0 / 3.0, "{errors:?}");
    }
}

/// Example 1 against framework reference values (minimal-coordinate, high-precision model): θ1 and θ2 at 1 s, and the
/// scheme's own error there, 0.0025186, 0.0006277 and 0.0001568 rad (largest over the first second).
#[test]
fn example_1_converges_to_the_minimal_coordinate_model() {
    let exact = [0.3640123860387474_f64, -1.0906605155143851_f64];
    let p = example1();
    let joint = p.model.form(p.bar.node(1)).unwrap();
    let centre = p.model.form(p.triangle.mass_centre()).unwrap();
    let error = |h: f64| {
        let state = at_end(&p.model, &mut symplectic(&p.model), h, 1.0);
        let (joint, centre) = (joint.eval(&state.q), centre.eval(&state.q));
        let arm = centre - joint;
        let angles = [joint[0].atan2(-joint[1]), arm[0].atan2(-arm[1])];
        distance(&angles, &exact)
    };
    let [a, b, c] = [1e-3, 5e-4, 2.5e-4].map(error);
    println!("{a:.3e} {b:.3e} {c:.3e}");
    assert!(a <= 0.0025187 && b <= 0.0006278 && c <= 0.0001569);
    assert!(((a / b).log2() - 2.0).abs() < 0.05 && ((b / c).log2() - 2.0).abs() < 0.05);
}

/// Example 2, UN and US: mass centre of triangle 3 at 0.8 s (framework reference values, minimal-coordinate,
/// high-precision model). The scheme's error at h = 1e-3 is 2.6e-5 to 2 s (UN) and 2.3e-4 to 1.2 s (US).
#[test]
fn example_2_converges_to_the_minimal_coordinate_model() {
    let cases = [
        (tower::UN, [0.02450121681862, 0.1116166889514], 2.6e-5),
        (tower::US, [0.0337022140612, 0.1141768766901], 2.3e-4),
    ];
    for (setup, exact, allowed) in cases {
        let t = tower(setup);
        let centre = t.model.form(t.triangles[0].mass_centre()).unwrap();
        let error = |h: f64| {
            let state = at_end(&t.model, &mut symplectic(&t.model), h, 0.8);
            let centre = centre.eval(&state.q);
            distance(&[centre[0], centre[1]], &exact)
        };
        let (coarse, fine) = (error(1e-3), error(1.25e-4));
        println!("{coarse:.2e} {fine:.2e}");
        assert!(coarse <= allowed && fine < 0.05 * allowed, "{coarse:e} {fine:e}");
    }
}

/// Framework reference values of the scheme's first steps at h = 1e-3: joint of example 1.
#[test]
fn first_steps_are_those_of_the_scheme() {
    let p = example1();
    let joint = p.model.form(p.bar.node(1)).unwrap();
    let mut stepper = symplectic(&p.model);
    let mut state = start(&p.model, &mut stepper);
    let expected = [
        [0.04999835611356144, -0.0500016438323931],
        [0.04999342501320557, -0.05000657412229909],
        [0.04998520837725302, -0.05001478724819893],
    ];
    for expected in expected {
        stepper.step(&mut state, 1e-3).unwrap();
        let joint = joint.eval(&state.q);
        assert!(distance(&[joint[0], joint[1]], &expected) < 1e-15);
    }
}
