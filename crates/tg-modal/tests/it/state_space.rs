//! State matrices: eigenvalues and static gain.

use std::sync::Arc;

use crate::support::{all_modes, as_built, equilibrium, mast};
use tg_fixtures::spine;
use tg_modal::{Input, ModeOptions, Output, SupportMotion, damped, modes, point_weights, state_space};
use tg_model::{CableLaw, ModelBuilder, Tension, TensionLaw};
use tg_tangent::dense;
use tg_tangent::faer::linalg::solvers::Solve;
use tg_tangent::faer::{Mat, c64};

#[test]
fn eigenvalues_are_the_damped_modes() {
    let spine = spine(2, 8.0, 2.0).unwrap();
    let at = as_built(&spine.model);
    let found = all_modes(&spine.model, &at);
    let damped = damped(&spine.model, &at, &found).unwrap();
    let linear = state_space(&spine.model, &at, &found, &[], &[]).unwrap();
    let (mut values, _) = dense::eigen(&linear.a).unwrap();
    let largest = values.iter().fold(0.0_f64, |a, s| a.max(s.norm()));
    for mode in &damped {
        let mut take = |s: c64| {
            let distance = |k: &usize| (values[*k] - s).norm();
            let nearest = (0..values.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap();
            let error = distance(&nearest) / largest;
            assert!(error < 1e-12, "{s} {error:.1e}");
            values.swap_remove(nearest);
        };
        take(mode.eigenvalue);
        if mode.eigenvalue.im > 0.0 {
            take(mode.eigenvalue.conj());
        }
    }
    assert!(values.is_empty());
}

/// -C A⁻¹ B + D against differences of nonlinear equilibria.
#[test]
fn static_gain_is_the_change_of_the_equilibrium() {
    let mast = mast(2.0, 0.0);
    let model = &mast.model;
    let u = model.inputs_at(0.0);
    let at = equilibrium(model, &model.initial_coordinates(), &u);
    let found = all_modes(model, &at);
    let mut inputs: Vec<Input> = (0..3).map(|cable| Input::rest_length(model, cable).unwrap()).collect();
    inputs.push(Input::Parameter { name: "wind x".into(), index: 3 });
    inputs.push(Input::Parameter { name: "wind y".into(), index: 4 });
    let peg = mast.supports[1];
    inputs.push(Input::Ground(SupportMotion::quasi_static(model, &at, "peg", &[(peg, 1.0)]).unwrap()));
    let x = point_weights(model, mast.bar.node(1), 0).unwrap();
    let mut outputs = vec![Output::displacement("tip x", &x), Output::velocity("tip x rate", &x)];
    outputs.extend((0..3).map(|cable| Output::length(model, cable, &at).unwrap()));
    outputs.extend(mast.cables.iter().map(|&cable| Output::tension(model, cable, &at).unwrap()));
    let linear = state_space(model, &at, &found, &inputs, &outputs).unwrap();
    assert_eq!(linear.inputs[0], "rest length of left");
    assert_eq!(linear.inputs[5..], ["peg displacement", "peg velocity", "peg acceleration"]);
    assert_eq!(linear.outputs[2], "length of left");
    assert_eq!(linear.outputs[7], "tension of string");
    assert_eq!((linear.b.ncols(), linear.d.nrows()), (8, 8));

    let gain: Mat<f64> = &linear.d - &linear.c * linear.a.partial_piv_lu().solve(&linear.b);
    let rest = vec![0.0; at.q.len()];
    let measure = |column: usize, h: f64| -> Vec<f64> {
        let (mut q, mut u) = (at.q.clone(), u.clone());
        if column < 5 {
            u[column] += h
        } else {
            q[peg] += h
        }
        let moved = equilibrium(model, &q, &u);
        let states: Vec<_> = mast.cables.iter().map(|&c| model.cable(c, &moved.q, &rest, &u)).collect();
        let mut values = vec![model.form(mast.bar.node(1)).unwrap().eval(&moved.q)[0], 0.0];
        values.extend(states.iter().map(|state| state.length));
        values.extend(states.iter().map(|state| state.tension));
        values
    };
    for column in 0..6 {
        let h = if column == 3 || column == 4 { 1e-2 } else { 1e-4 };
        let difference = |h: f64| -> Vec<f64> {
            let (plus, minus) = (measure(column, h), measure(column, -h));
            plus.iter().zip(&minus).map(|(p, m)| (p - m) / (2.0 * h)).collect()
        };
        let (coarse, fine) = (difference(2.0 * h), difference(h));
        for (row, name) in linear.outputs.iter().enumerate() {
            let nonlinear = (4.0 * fine[row] - coarse[row]) / 3.0;
            // Relative to the largest gain of outputs of this unit by this input or a rest length.
            let of_unit = (0..8).filter(|r| (r / 5) == (row / 5));
            let gains = of_unit.flat_map(|r| [0, 1, 2, column].map(|c| gain[(r, c)].abs()));
            let error = (gain[(row, column)] - nonlinear).abs() / gains.fold(0.0, f64::max);
            println!("{name} by {}: {nonlinear:.6e} {error:.1e}", linear.inputs[column]);
            assert!(error < 1e-8, "{name} {error:.1e}");
        }
    }
}

#[test]
fn few_modes_make_a_small_model() {
    let spine = spine(3, 8.0, 1.0).unwrap();
    let at = as_built(&spine.model);
    let found = modes(&spine.model, &at, &ModeOptions::new(4)).unwrap();
    let ground = Input::Ground(SupportMotion::translation(&spine.model, &at, 0).unwrap());
    let top = point_weights(&spine.model, spine.bodies[2].mass_centre(), 0).unwrap();
    let linear =
        state_space(&spine.model, &at, &found, &[ground], &[Output::displacement("top", &top)]).unwrap();
    assert_eq!((linear.a.nrows(), linear.b.ncols()), (8, 3));
    // The point moves with the ground, and a translation drives by its acceleration alone.
    assert!((linear.d[(0, 0)] - 1.0).abs() < 1e-14);
    for row in 0..8 {
        assert!(linear.b[(row, 0)] == 0.0 && linear.b[(row, 1)].abs() < 1e-12);
    }
}

/// A stiffening law that is linear in neither length nor rest length, with damping.
struct Stiffening;

impl TensionLaw for Stiffening {
    fn tension(&self, length: f64, rate: f64, rest: f64) -> Tension {
        let strain = length / rest - 1.0;
        Tension {
            force: 50.0 * strain + 400.0 * strain.powi(3) + 2.0 * rate,
            by_length: (50.0 + 1200.0 * strain * strain) / rest,
            by_rate: 2.0,
        }
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        let strain = length / rest - 1.0;
        rest * (25.0 * strain * strain + 100.0 * strain.powi(4))
    }

    fn damped(&self) -> bool {
        true
    }
}

#[test]
fn a_user_law_is_differentiated() {
    let mut b = ModelBuilder::<2>::new();
    let bead = b.particle("bead", 0.4, [0.0, 0.0]).unwrap();
    let mut cables = Vec::new();
    for (name, x, rest) in [("left", -1.0, 0.7), ("right", 1.0, 0.7)] {
        let peg = b.anchor(name, [x, 0.0]).unwrap();
        cables.push(b.cable(name, peg, bead.node(0), CableLaw::User(Arc::new(Stiffening)), rest).unwrap());
    }
    let model = b.build().unwrap();
    let at = as_built(&model);
    let found = all_modes(&model, &at);
    let inputs = [Input::rest_length(&model, 0).unwrap()];
    let outputs: Vec<_> = cables.iter().map(|&cable| Output::tension(&model, cable, &at).unwrap()).collect();
    let linear = state_space(&model, &at, &found, &inputs, &outputs).unwrap();
    // The bead shares the change between two equal cables: f_l = f_r = ½ ∂f/∂μ δμ.
    let strain = 1.0 / 0.7 - 1.0;
    let by_rest = -(50.0 + 1200.0 * strain * strain) / 0.49;
    let gain: Mat<f64> = &linear.d - &linear.c * linear.a.partial_piv_lu().solve(&linear.b);
    assert!((linear.d[(0, 0)] / by_rest - 1.0).abs() < 1e-11);
    assert!((gain[(0, 0)] / (0.5 * by_rest) - 1.0).abs() < 1e-11);
    assert!((gain[(1, 0)] / (0.5 * by_rest) - 1.0).abs() < 1e-11);
    // ∂f/∂l̇ = 2 in the columns of ξ̇; along the cables the shape is m^-½.
    assert!((linear.c.subcols(2, 2).norm_max() / (2.0 / 0.4_f64.sqrt()) - 1.0).abs() < 1e-13);
}
