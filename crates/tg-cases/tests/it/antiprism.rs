//! Key numbers of the antiprisms' load paths, and the generator's refusals.

use tg_cases::antiprism::path::{examples, past_fold};
use tg_cases::antiprism::{Antiprism, EXAMPLE_1, EXAMPLE_2, Feet, Loads, MOMENTS, Parameters, Tie};
use tg_cases::simulate::record;
use tg_integrate::State;

#[test]
fn load_paths() {
    let mut lines = Vec::new();
    for (name, structure) in examples().unwrap() {
        let path = past_fold(&structure).unwrap();
        lines.push(format!("{name}: {} points, {:?}", path.points.len(), path.end));
        for event in &path.events {
            // Where two eigenvalues pass zero together, beside a singular point, five digits are certain.
            lines.push(format!("{:?} at {:.4}, {:?}", event.kind, event.factor, event.negative));
        }
        for point in path.points.iter().step_by(7) {
            let least = |ties: &[f64]| ties.iter().copied().fold(f64::INFINITY, f64::min);
            let [top, bottom, lateral] = [0, 1, 2].map(|kind| least(&point.tensions[kind]));
            let clearance = point.clearance * 1e3;
            lines.push(format!(
                "{:.4}: {} negative, {clearance:.3} mm apart, at least {top:.3} {bottom:.3} {lateral:.3} N",
                point.factor, point.negative
            ));
        }
    }
    insta::assert_snapshot!(lines.join("\n"));
}

#[test]
fn impossible_antiprisms_are_refused() {
    let refused = |parameters: Parameters| {
        Antiprism::new(&parameters, Feet::Sliding, &Loads::None).unwrap_err().to_string()
    };
    assert!(refused(Parameters { struts: 2, ..EXAMPLE_1 }).contains("at least three struts"));
    // Polygons that no strut spans.
    let wide = Tie { stiffness: 500.0, free: 0.2 };
    assert!(refused(Parameters { top: wide, bottom: wide, ..EXAMPLE_1 }).contains("no unloaded state"));
}

/// A force at the middle of a strut pulls half at each end.
#[test]
fn forces_act_where_the_paper_puts_them() {
    let loads = Loads::Force([1.0, 2.0, 3.0], 0.25);
    let structure = Antiprism::new(&EXAMPLE_1, Feet::Sliding, &loads).unwrap();
    let (q, u) = (structure.model.initial_coordinates(), structure.inputs(1.0));
    let rest = vec![0.0; q.len()];
    let load = structure.model.energy(&q, &rest, &u).load;
    let expected: f64 = (0..3)
        .map(|j| {
            let [foot, top] = structure.ends(j, &q);
            let point = foot * 0.75 + top * 0.25;
            -(point.x + 2.0 * point.y + 3.0 * point.z)
        })
        .sum();
    assert!((load - expected).abs() < 1e-14);
}

/// Moments about a universal joint's axes are conservative: a run keeps its energy to the square of its step.
#[test]
fn a_run_under_moments_keeps_its_energy() {
    let moments = MOMENTS.map(|m| m.map(|m| 0.3 * m)).to_vec();
    let structure = Antiprism::new(&EXAMPLE_2, Feet::Fixed, &Loads::JointMoments(moments)).unwrap();
    let u = structure.inputs(1.0);
    let drift = |h: f64| {
        let energy = |state: &State| structure.model.energy(&state.q, &state.v, &u).total();
        let energies = record(&structure.model, h, 0.5, energy).unwrap();
        energies.iter().map(|e| (e - energies[0]).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (drift(1e-3), drift(5e-4));
    assert!((3.8..4.2).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
}
