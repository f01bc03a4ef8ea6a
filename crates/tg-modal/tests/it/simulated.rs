//! Modes and linear models against small-amplitude runs of the nonlinear structure.

use crate::support::{all_modes, as_built, displaced, equilibrium, mass_product, mast, relative};
use tg_fixtures::spine;
use tg_integrate::{NewtonOptions, Run, State, Stepper, Symplectic};
use tg_modal::{DampedKind, Input, Output, SupportMotion, damped, participation, state_space};
use tg_model::{Mechanics, Model, ModelBuilder, Signal};
use tg_tangent::faer::Mat;

/// Options with which Newton's method ends at rounding.
fn exact() -> NewtonOptions {
    NewtonOptions { tolerance: 1e-14, ..NewtonOptions::default() }
}

fn end_of_run(mechanics: &dyn Mechanics, q: &[f64], v: &[f64], end: f64, h: f64) -> State {
    let mut stepper = Symplectic::new(mechanics, exact()).unwrap();
    let mut state = stepper.start(0.0, q, v).unwrap();
    Run::new(h, end).go(&mut stepper, &mut state).unwrap();
    state
}

/// Re(φ exp(s t)) against runs from ±ε φ: even orders of ε cancel between the signs, h² by extrapolation.
fn check_motion<const D: usize>(model: &Model<D>, at: &tg_tangent::Configuration, tolerance: f64) {
    let found = damped(model, at, &all_modes(model, at)).unwrap();
    let picked = [0, found.len() / 2];
    for mode in picked.map(|k| &found[k]) {
        assert_eq!(mode.kind, DampedKind::Oscillating);
        let s = mode.eigenvalue;
        let end = 1.3 * std::f64::consts::TAU / s.im;
        let size = mode.shape.iter().fold(0.0_f64, |a, x| a.max(x.norm()));
        let motion = |amplitude: f64, h: f64| {
            let q = displaced(model, &at.q, |i| amplitude * mode.shape[i].re);
            let v: Vec<f64> = mode.shape.iter().map(|x| amplitude * (s * x).re).collect();
            end_of_run(model, &q, &v, end, h).q
        };
        let difference = |h: f64| -> Vec<f64> {
            let amplitude = 2e-5 / size;
            let (plus, minus) = (motion(amplitude, h), motion(-amplitude, h));
            plus.iter().zip(&minus).map(|(p, m)| (p - m) / (2.0 * amplitude)).collect()
        };
        let h = end / 400.0;
        let (coarse, fine) = (difference(h), difference(0.5 * h));
        let simulated: Vec<f64> = coarse.iter().zip(&fine).map(|(c, f)| (4.0 * f - c) / 3.0).collect();
        let linear: Vec<f64> = mode.shape.iter().map(|x| (x * (s * end).exp()).re).collect();
        let error = relative(&simulated, &linear);
        println!("s = {s:.4}: {error:.1e} after {end:.3} s");
        assert!(error < tolerance, "{error:.1e}");
    }
}

#[test]
fn free_vibrations_are_those_of_the_nonlinear_structure() {
    let undamped = spine(3, 8.0, 0.0).unwrap();
    check_motion(&undamped.model, &as_built(&undamped.model), 1e-6);
    let damped = spine(3, 8.0, 1.5).unwrap();
    check_motion(&damped.model, &as_built(&damped.model), 1e-6);
    let mast = mast(1.0, 0.0);
    let at = equilibrium(&mast.model, &mast.model.initial_coordinates(), &mast.model.inputs_at(0.0));
    check_motion(&mast.model, &at, 1e-6);
}

/// All supports shaken by a sin Ωt: each mode's exact answer, ξ̈ + ω² ξ = Γ a Ω² sin Ωt from rest, added up.
#[test]
fn shaken_ground_by_participation_factors() {
    let (amplitude, drive) = (1e-5, 9.0);
    let shaken = shaken_pair(amplitude, drive);
    let at = equilibrium(&shaken, &shaken.initial_coordinates(), &shaken.inputs_at(0.0));
    let found = all_modes(&shaken, &at);
    let motion = SupportMotion::translation(&shaken, &at, 0).unwrap();
    let parts = participation(&shaken, &at, &found, &motion).unwrap();
    let end = 0.7;
    let mut linear: Vec<f64> = motion.influence.iter().map(|r| r * amplitude * (drive * end).sin()).collect();
    for (mode, part) in found.list.iter().zip(&parts.list) {
        let omega = mode.omega_squared.sqrt();
        let steady = part.factor * amplitude * drive * drive / (mode.omega_squared - drive * drive);
        // The structure is at rest: ξ̇(0) = -Γ a Ω.
        let free = -(part.factor * amplitude * drive + steady * drive) / omega;
        let xi = steady * (drive * end).sin() + free * (omega * end).sin();
        linear.iter_mut().zip(&mode.shape).for_each(|(x, phi)| *x += xi * phi);
    }
    let run = |amplitude: f64, h: f64| {
        let model = shaken_pair(amplitude, drive);
        end_of_run(&model, &at.q, &model.velocities_at_rest(), end, h).q
    };
    // Even orders of the amplitude cancel between the signs, h² by extrapolation.
    let [coarse, fine] = [800.0, 1600.0].map(|steps| {
        let (plus, minus) = (run(amplitude, end / steps), run(-amplitude, end / steps));
        plus.iter().zip(&minus).map(|(p, m)| 0.5 * (p - m)).collect::<Vec<_>>()
    });
    let simulated: Vec<f64> = coarse.iter().zip(&fine).map(|(c, f)| (4.0 * f - c) / 3.0).collect();
    let error = relative(&simulated, &linear);
    println!("shaken ground {error:.1e}");
    assert!(error < 1e-6, "{error:.1e}");
}

/// Two bars between shaken pegs.
fn shaken_pair(amplitude: f64, drive: f64) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    let mut chain = Vec::new();
    let shake = |b: &mut ModelBuilder<2>, name: &str, at: [f64; 2]| {
        let peg = b.anchor(name, at).unwrap();
        let motion = Signal::sine(amplitude, drive / std::f64::consts::TAU);
        b.shake(&format!("{name} shaker"), peg, motion).unwrap();
        peg
    };
    let left = shake(&mut b, "left", [0.0, 0.0]);
    let right = shake(&mut b, "right", [3.0, 0.5]);
    for (name, x, y) in [("first", 1.0, 0.0), ("second", 2.0, 0.25)] {
        chain.push(b.bar(name, 1.2, [x, y], [x, y + 0.8]).unwrap());
    }
    let law = tg_model::CableLaw::slacking(120.0);
    let mut cable = |name: &str, from: tg_model::Place<2>, to: tg_model::Place<2>| {
        b.cable(name, from, to, law.clone(), 0.7).unwrap();
    };
    cable("a", left.into(), chain[0].node(0));
    cable("b", left.into(), chain[0].node(1));
    cable("c", chain[0].node(0), chain[1].node(0));
    cable("d", chain[0].node(1), chain[1].node(1));
    cable("e", chain[1].node(0), right.into());
    cable("f", chain[1].node(1), right.into());
    b.build().unwrap()
}

/// The foot alone is shaken, with damping: the state matrices stepped in small steps against the nonlinear run.
#[test]
fn state_space_follows_a_shaken_foot() {
    let (amplitude, hertz) = (1e-5, 0.8);
    let mast = mast(3.0, Signal::sine(amplitude, hertz));
    let model = &mast.model;
    let at = equilibrium(model, &model.initial_coordinates(), &model.inputs_at(0.0));
    let found = all_modes(model, &at);
    let motion = SupportMotion::quasi_static(model, &at, "foot", &[(mast.supports[0], 1.0)]).unwrap();
    let tip = model.form(mast.bar.node(1)).unwrap().terms()[0].0 * 2;
    let mut outputs =
        vec![Output::displacement("tip x", &[(tip, 1.0)]), Output::velocity("tip y rate", &[(tip + 1, 1.0)])];
    outputs.extend(mast.cables.iter().map(|&cable| Output::tension(model, cable, &at).unwrap()));
    let linear = state_space(model, &at, &found, &[Input::Ground(motion.clone())], &outputs).unwrap();
    assert_eq!(linear.inputs, ["foot displacement", "foot velocity", "foot acceleration"]);

    let end = 1.5;
    let omega = std::f64::consts::TAU * hertz;
    let input = |t: f64| {
        let (s, c) = (omega * t).sin_cos();
        Mat::from_fn(3, 1, |k, _| amplitude * [s, omega * c, -omega * omega * s][k])
    };
    let mut v = model.velocities_at_rest();
    let mut stepper = Symplectic::new(model, exact()).unwrap();
    let start = stepper.start(0.0, &at.q, &v).unwrap();
    v.copy_from_slice(&start.v);
    // ξ̇(0) = Φᵀ M (q̇ - r ṡ) over all coordinates.
    let relative_v: Vec<f64> =
        v.iter().zip(&motion.influence).map(|(v, r)| v - r * amplitude * omega).collect();
    let k = found.list.len();
    let mut x = Mat::from_fn(2 * k, 1, |row, _| {
        if row < k { 0.0 } else { mass_product(model, &found.list[row - k].shape, &relative_v) }
    });
    let steps = 6000;
    let h = end / f64::from(steps);
    let rate = |x: &Mat<f64>, t: f64| &linear.a * x + &linear.b * input(t);
    for n in 0..steps {
        let t = h * f64::from(n);
        let k1 = rate(&x, t);
        let k2 = rate(&(&x + &k1 * (0.5 * h)), t + 0.5 * h);
        let k3 = rate(&(&x + &k2 * (0.5 * h)), t + 0.5 * h);
        let k4 = rate(&(&x + &k3 * h), t + h);
        x += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
    }
    let y = &linear.c * &x + &linear.d * input(end);

    let measured = |amplitude: f64, h: f64| -> Vec<f64> {
        let moved = crate::support::mast(3.0, Signal::sine(amplitude, hertz)).model;
        let state = end_of_run(&moved, &at.q, &moved.velocities_at_rest(), end, h);
        let mut values = vec![state.q[tip], state.v[tip + 1]];
        let tension = |&cable| moved.cable(cable, &state.q, &state.v, &at.u).tension;
        values.extend(mast.cables.iter().map(tension));
        values
    };
    let [coarse, fine] = [1e-3, 5e-4].map(|h| {
        let (plus, minus) = (measured(amplitude, h), measured(-amplitude, h));
        plus.iter().zip(&minus).map(|(p, m)| 0.5 * (p - m)).collect::<Vec<_>>()
    });
    for (k, name) in linear.outputs.iter().enumerate() {
        let simulated = (4.0 * fine[k] - coarse[k]) / 3.0;
        let error = (simulated - y[(k, 0)]).abs() / simulated.abs();
        println!("{name}: {simulated:.6e} {:.6e} {error:.1e}", y[(k, 0)]);
        assert!(error < 1e-5, "{name} {error:.1e}");
    }
}
