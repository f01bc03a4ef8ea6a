//! Closed forms: of the motion, and of the scheme itself.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::support::{alpha, pendulum, position, run, start, symplectic};
use tg_coords::{CoordType, MassProperties, Member, Pose, Twist};
use tg_integrate::Stepper;
use tg_model::{CableLaw, Model, ModelBuilder};

/// Arithmetic-geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    while (a - b).abs() > 1e-15 * a {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    a
}

/// Period of a rod's swing as measured: twice the time between two passages of the vertical, found by Hermite's cubic
/// in the step where x changes sign.
fn measured_period(length: f64, angle: f64, h: f64) -> f64 {
    let (model, rod) = pendulum(length, angle);
    let tip = model.form(rod.node(1)).unwrap();
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let mut passages = Vec::new();
    while passages.len() < 2 {
        let before = state.clone();
        stepper.step(&mut state, h).unwrap();
        let (x0, x1) = (tip.eval(&before.q)[0], tip.eval(&state.q)[0]);
        if x0 * x1 < 0.0 {
            let (v0, v1) = (h * tip.eval(&before.v)[0], h * tip.eval(&state.v)[0]);
            passages.push(before.t + h * hermite_root(x0, x1, v0, v1));
        }
    }
    2.0 * (passages[1] - passages[0])
}

/// Root of the cubic with values x0, x1 and slopes v0, v1 at 0 and 1, by bisection.
fn hermite_root(x0: f64, x1: f64, v0: f64, v1: f64) -> f64 {
    let value = |s: f64| {
        let r = 1.0 - s;
        r * r * ((1.0 + 2.0 * s) * x0 + s * v0) + s * s * ((1.0 + 2.0 * r) * x1 - r * v1)
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle) * x0 > 0.0 { low = middle } else { high = middle }
    }
    low
}

/// T = 2π/(ω0 AGM(1, cos θ0/2)), ω0² = 3g/2L for a thin rod hinged at its end.
#[test]
fn pendulum_has_the_period_of_the_elliptic_integral() {
    for angle in [0.5, 1.5, 2.8] {
        let length = 0.4_f64;
        let omega = (1.5 * 9.81 / length).sqrt();
        let exact = 2.0 * PI / (omega * agm(1.0, (0.5_f64 * angle).cos()));
        let [a, b, c] = [2e-3, 1e-3, 5e-4].map(|h| measured_period(length, angle, h) - exact);
        let (first, second) = ((4.0 * b - a) / 3.0, (4.0 * c - b) / 3.0);
        println!("{angle}: T {exact}, errors {a:.2e} {b:.2e} {c:.2e}, extrapolated {first:.1e} {second:.1e}");
        assert!(((a / b).log2() - 2.0).abs() < 0.02, "order {}", (a / b).log2());
        assert!(second.abs() < 1e-8 * exact, "extrapolated period is off by {second:.1e}");
    }
}

/// Constant forces are integrated exactly at any step: a thrown particle and a thrown bar that does not turn.
#[test]
fn free_fall_is_exact() {
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.3, 0.0, -9.81]).unwrap();
    let particle = b.particle("stone", 2.0, [1.0, 2.0, 3.0]).unwrap();
    let bar = b.bar("bar", 0.5, [0.0, 0.0, 0.0], [0.2, 0.1, -0.3]).unwrap();
    b.load("push", bar.mass_centre(), [0.0, 1.0, 0.0], 1.0).unwrap();
    let model = b.build().unwrap();
    let mut v = model.velocities_at_rest();
    for place in [particle.node(0), bar.node(0), bar.node(1)] {
        let node = model.form(place).unwrap().terms()[0].0;
        v[3 * node..3 * node + 3].copy_from_slice(&[1.0, -2.0, 4.0]);
    }
    for h in [1e-3, 0.07, 1.0] {
        let mut symplectic = symplectic(&model);
        let mut alpha = alpha(&model, 0.7);
        let steppers: [&mut dyn Stepper; 2] = [&mut symplectic, &mut alpha];
        for stepper in steppers {
            let mut state = stepper.start(0.0, &model.initial_coordinates(), &v).unwrap();
            run(stepper, &mut state, h, 1.4);
            let fall = |x: f64, v: f64, a: f64| x + v * state.t + 0.5 * a * state.t * state.t;
            let stone = position(&model, particle.node(0), &state.q);
            let tip = position(&model, bar.node(1), &state.q);
            let expected = [fall(1.0, 1.0, 0.3), fall(2.0, -2.0, 0.0), fall(3.0, 4.0, -9.81)];
            assert!(crate::support::distance(&stone, &expected) < 2e-13, "h = {h}: {stone:?} {expected:?}");
            let expected = [fall(0.2, 1.0, 0.3), fall(0.1, -2.0, 2.0), fall(-0.3, 4.0, -9.81)];
            assert!(crate::support::distance(&tip, &expected) < 2e-13, "h = {h}: {tip:?} {expected:?}");
        }
    }
}

/// In a steady spin with angular velocity ω the skew part of (53a), `(ΔR - I) J/h = Ω J + symmetric`, leaves
/// `sin φ = ω h` for the angle φ of a step: the discrete motion turns by asin(ω h) and keeps ω.
#[test]
fn steady_spin_turns_by_the_discrete_angle() {
    let (omega, h, steps) = (20.0_f64, 1e-3_f64, 500);
    let angle = f64::from(steps) * (omega * h).asin();

    let mut b = ModelBuilder::<2>::new();
    let plate = b
        .member("plate", crate::support::triangle(CoordType::Rrv, 0.75), Pose::planar(0.0, 0.0, 0.0))
        .unwrap();
    let model = b.build().unwrap();
    let mut v = model.velocities_at_rest();
    // The mass centre rests.
    let twist = Twist::planar([omega * 0.05 / 3.0, -omega * 0.05].into(), omega);
    model.set_twist(plate, &twist, &model.initial_coordinates(), &mut v).unwrap();
    let mut stepper = symplectic(&model);
    let mut state = stepper.start(0.0, &model.initial_coordinates(), &v).unwrap();
    (0..steps).for_each(|_| assert_eq!(stepper.step(&mut state, h).unwrap().substeps, 1));
    let turned = model.pose(plate, &state.q).unwrap().pose.angle();
    let error = (turned - angle + PI).rem_euclid(2.0 * PI) - PI;
    assert!(error.abs() < 1e-11, "plate: {error:.1e}");
    let now = model.twist(plate, &state.q, &state.v).unwrap().angular_velocity();
    assert!((now - omega).abs() < 1e-11, "plate: {now}");

    // About each principal axis of a body in space; the step is short of the instability of the middle axis.
    for axis in 0..3 {
        let mass = MassProperties::from_principal_moments(0.3, [0.0; 3].into(), [7e-4, 5e-4, 9e-4]).unwrap();
        let nodes = [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]];
        let body = Member::new(CoordType::Ruvw, &nodes.map(Into::into), mass).unwrap();
        let mut b = ModelBuilder::<3>::new();
        let body = b.member("body", body, Pose::identity()).unwrap();
        let model = b.build().unwrap();
        let mut v = model.velocities_at_rest();
        let mut spin = [0.0; 3];
        spin[axis] = omega;
        let twist = Twist::spatial([0.0; 3].into(), spin.into());
        model.set_twist(body, &twist, &model.initial_coordinates(), &mut v).unwrap();
        let mut stepper = symplectic(&model);
        let mut state = stepper.start(0.0, &model.initial_coordinates(), &v).unwrap();
        (0..steps).for_each(|_| assert_eq!(stepper.step(&mut state, h).unwrap().substeps, 1));
        let rotation = model.pose(body, &state.q).unwrap().pose.rotation;
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        let (sin, cos) = angle.sin_cos();
        let error = (rotation[(j, j)] - cos).abs().max((rotation[(k, j)] - sin).abs());
        println!("axis {axis}: {error:.1e}");
        assert!(error < 1e-10, "axis {axis}: {error:.1e}");
    }
}

/// A particle of mass m on a two-way spring κ along a line, released at rest off its balance.
fn oscillator(mass: f64, stiffness: f64, offset: f64) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    let wall = b.anchor("wall", [0.0, 0.0]).unwrap();
    let block = b.particle("block", mass, [1.0 + offset, 0.0]).unwrap();
    b.support("rail", block.node(0), 1, 0.0).unwrap();
    b.cable("spring", wall, block.node(0), CableLaw::linear(stiffness), 1.0).unwrap();
    b.build().unwrap()
}

/// On a linear spring the scheme is the midpoint rule: x_k = a cos(k φ) with tan(φ/2) = ω h/2, whatever the step.
#[test]
fn spring_has_the_dispersion_of_the_scheme() {
    let (mass, stiffness, offset) = (0.25, 100.0, 0.3);
    let omega = f64::sqrt(stiffness / mass);
    let model = oscillator(mass, stiffness, offset);
    for h in [1e-3, 0.02, 0.3] {
        let mut stepper = symplectic(&model);
        let mut state = start(&model, &mut stepper);
        let phase = 2.0 * (0.5 * omega * h).atan();
        let block = model.members().next().unwrap();
        let i = 2 * model.form(block.node(0)).unwrap().terms()[0].0;
        for k in 1..=300 {
            stepper.step(&mut state, h).unwrap();
            let expected = 1.0 + offset * (f64::from(k) * phase).cos();
            assert!((state.q[i] - expected).abs() < 1e-11, "h = {h}, step {k}: {}", state.q[i] - expected);
        }
    }
}

/// Released at 90°, the rod rests at -90° after half a period.
#[test]
fn pendulum_swings_to_the_other_side() {
    let length = 0.05 * 2.0_f64.sqrt();
    let (model, rod) = pendulum(length, FRAC_PI_2);
    let half = PI / ((1.5 * 9.81 / length).sqrt() * agm(1.0, (0.25 * PI).cos()));
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    run(&mut stepper, &mut state, 1e-5, half);
    let tip = position(&model, rod.node(1), &state.q);
    println!("{tip:?}");
    assert!((tip[0] + length).abs() < 1e-8 && tip[1].abs() < 1e-7, "{tip:?}");
}
