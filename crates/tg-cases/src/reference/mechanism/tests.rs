//! Derivatives against differences, intervals against points, the search against the topology of the torus.

use std::f64::consts::TAU;

use super::number::Number;
use super::*;

fn paper(rest: [f64; 2]) -> Model {
    Model {
        fixed: [[0.0, 0.0], [3.19, 0.0], [-2.55, 4.93]],
        bar: 9.0,
        body: [[4.25, 0.0], [-0.3, -3.45]],
        stiffness: [2.81; 2],
        rest,
    }
}

fn grid() -> impl Iterator<Item = [f64; 2]> {
    (0..12).flat_map(|i| (0..12).map(move |j| [0.51 * f64::from(i) - 3.0, 0.53 * f64::from(j) - 3.1]))
}

#[test]
fn derivatives_are_those_of_the_potential() {
    for rest in [[0.0, 0.0], [11.5, 0.0], [-11.5, 7.0]] {
        let model = Model { fixed: [[0.3, -0.2], [3.19, 0.4], [-2.55, 4.93]], ..paper(rest) };
        for at in grid() {
            let (gradient, hessian, h) = (model.gradient(at), model.hessian(at), 1e-5);
            for i in 0..2 {
                let shifted = |by: f64| std::array::from_fn(|k| if k == i { at[k] + by } else { at[k] });
                let slope = (model.potential(shifted(h)) - model.potential(shifted(-h))) / (2.0 * h);
                assert!((slope - gradient[i]).abs() < 1e-5, "{at:?} {i} {slope} {}", gradient[i]);
                let rate = (model.gradient(shifted(h)) - model.gradient(shifted(-h))) / (2.0 * h);
                let bound = 1e-5 * (1.0 + hessian.amax());
                assert!((rate - hessian.column(i)).amax() < bound, "{at:?} {i}");
            }
        }
    }
}

#[test]
fn intervals_enclose_every_point() {
    let model = paper([11.5, 11.5]);
    for at in grid() {
        let around = at.map(|x| Interval::new(x - 0.03, x + 0.02));
        let Jet { value, .. } = model.squared(1).at(around);
        let (gradient, hessian) = model.derivatives(around, model.rest.map(Interval::from));
        for step in [[-0.03, -0.03], [0.02, -0.01], [0.0, 0.0], [0.02, 0.02]] {
            let point = [at[0] + step[0], at[1] + step[1]];
            assert!(value.contains(model.squared(1).at(point).value));
            if value.low > 0.0 {
                let (g, h) = model.derivatives(point, model.rest);
                assert!((0..2).all(|i| gradient[i].contains(g[i])), "{at:?}");
                assert!((0..3).all(|i| hessian[i].contains(h[i])), "{at:?}");
            }
        }
    }
}

#[test]
fn interval_operations_round_outward() {
    let third = Interval::from(1.0) / Interval::from(3.0);
    assert!(third.low < 1.0 / 3.0 && 1.0 / 3.0 < third.high);
    assert!((third * Interval::from(3.0)).contains(1.0));
    assert_eq!(Interval::new(-1.0, 2.0).square(), Interval::new(0.0, 4.0_f64.next_up()));
    assert_eq!(
        Interval::new(-1.0, 1.0) / Interval::new(-1.0, 1.0),
        Interval::new(-f64::INFINITY, f64::INFINITY)
    );
    let (sin, cos) = Interval::new(1.0, 4.0).sin_cos();
    assert!(sin.contains(1.0) && sin.contains(4.0_f64.sin()) && !sin.contains(-0.76));
    assert!(cos.contains(-1.0) && cos.contains(1.0_f64.cos()) && !cos.contains(0.55));
    let (sin, cos) = Interval::new(-4.0, TAU).sin_cos();
    assert_eq!([sin, cos], [Interval::new(-1.0, 1.0); 2]);
}

/// Peaks, saddles and pits of a function on a torus: +1, -1, +1 sum to zero (Poincaré and Hopf), cones with an extremum
/// counted as such.
#[test]
fn indices_sum_to_zero_on_every_branch() {
    for rest in [[0.0, 0.0], [11.5, 0.0], [11.5, 11.5], [3.0, 9.0], [0.0, 6.5]] {
        for (signs, model) in paper(rest).branches() {
            let found = model.search().unwrap();
            assert!(found.undecided.is_empty(), "{rest:?} {signs:?}");
            let smooth = found.equilibria.iter().map(|e| if e.negative == 1 { -1 } else { 1 });
            let cones = model.cones().iter().filter(|cone| cone.excess > 0.0).count();
            assert_eq!(smooth.sum::<i32>() + cones as i32, 0, "{rest:?} {signs:?}");
        }
    }
}

#[test]
fn a_cone_has_no_length() {
    let model = paper([11.5, 11.5]);
    let cones = model.cones();
    assert_eq!(cones.len(), 2);
    for cone in cones {
        assert!(model.lengths(cone.angles)[cone.spring] < 1e-14);
    }
}

#[test]
fn equilibria_do_not_hide_on_sides_of_boxes() {
    // By symmetry both angles of all equilibria are 0 or π, where the search halves its boxes.
    let model = Model {
        fixed: [[0.0; 2], [3.0, 0.0], [-2.0, 0.0]],
        bar: 5.0,
        body: [[2.0, 0.0], [-1.0, 0.0]],
        stiffness: [1.0, 2.0],
        rest: [0.0, 0.0],
    };
    let found = model.search().unwrap();
    assert!(found.undecided.is_empty());
    assert!(found.equilibria.len() >= 4);
    for e in &found.equilibria {
        assert!(model.gradient(e.angles).amax() < 1e-13);
    }
    for corner in [[0.0, 0.0], [0.0, TAU / 2.0], [TAU / 2.0, 0.0], [TAU / 2.0, TAU / 2.0]] {
        let near = |e: &&Equilibrium| (0..2).all(|i| wrapped(e.angles[i] - corner[i]).abs() < 1e-12);
        assert_eq!(found.equilibria.iter().filter(near).count(), 1, "{corner:?}");
    }
}

#[test]
fn a_continuum_of_equilibria_stays_undecided() {
    let found = Model { stiffness: [0.0, 2.81], ..paper([0.0, 0.0]) }.search().unwrap();
    assert!(found.undecided.is_empty());
    // The end of spring 2 is the hinge: γ2 is free.
    let swivel = Model { body: [[0.0, 0.0], [0.0, 0.0]], ..paper([0.0, 0.0]) };
    assert!(!swivel.search().unwrap().undecided.is_empty());
}

#[test]
fn a_start_far_from_any_equilibrium_is_refused_or_converges() {
    let model = paper([11.5, 11.5]);
    for at in grid() {
        match model.equilibrium(at) {
            Ok(found) => assert!(model.gradient(found.angles).amax() < 1e-9),
            Err(ReferenceError::Equilibrium { residual }) => assert!(residual > 0.0 || residual.is_nan()),
            Err(other) => panic!("{other}"),
        }
    }
}

#[test]
fn a_fold_separates_two_counts() {
    let model = paper([1.0, 0.0]);
    let sweep = model.sweep((10.5, 12.5), 20).unwrap();
    assert_eq!((sweep.counts.as_slice(), sweep.undecided), ([4, 6, 4].as_slice(), 0));
    for (fold, sides) in sweep.folds.iter().zip(sweep.counts.windows(2)) {
        let counts =
            [-1e-9, 1e-9].map(|by| model.with_rest(fold.rest + by).search().unwrap().equilibria.len());
        assert_eq!(counts, *sides, "{fold:?}");
    }
}
