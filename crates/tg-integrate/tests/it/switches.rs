//! Slacking cables under explicit schemes: switches are located, so that the error follows the tolerance.

use crate::slacking::thrown_into_a_damper;
use crate::support::friction::Friction;
use crate::support::tower::{self, Tower, tower};
use crate::support::{at_end, corners, distance, explicit, fixed, run, start};
use tg_integrate::{EmbeddedPair, Run, State, StepReport, Stepper, Summary};

const PAIRS: [EmbeddedPair; 2] = [EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8];

/// Positions of the triangles at 0.8 s, and the totals.
fn end(t: &Tower, pair: EmbeddedPair, tolerance: f64) -> (Vec<f64>, Summary) {
    let mut stepper = explicit(&t.model, pair, tolerance);
    let mut state = start(&t.model, &mut stepper);
    let summary = run(&mut stepper, &mut state, 0.4, 0.8);
    (corners(&t.model, &t.triangles, &state.q), summary)
}

/// Law (30) bends (undamped) or jumps (damped) at the switches of a dozen cables.
#[test]
fn error_follows_the_tolerance_through_switches() {
    for (name, setup) in [("US", tower::US), ("damped", tower::DAMPED_SLACKING)] {
        let t = tower(setup);
        let (exact, _) = end(&t, PAIRS[1], 1e-10);
        for (pair, tolerances) in PAIRS.into_iter().zip([[1e-4, 1e-6], [1e-6, 1e-8]]) {
            for tolerance in tolerances {
                let (found, summary) = end(&t, pair, tolerance);
                let error = distance(&found, &exact);
                println!("{name}, {pair:?} at {tolerance:e}: {error:.1e}, {summary:?}");
                assert!(error < 0.1 * tolerance, "{name}, {pair:?} at {tolerance:e}: {error:e}");
                assert!(summary.frozen > 5 && summary.forced == 0, "{summary:?}");
            }
        }
    }
}

/// US: mass centre of triangle 3 at 0.8 s (framework reference values, minimal-coordinate, high-precision model).
#[test]
fn slacking_tower_is_that_of_the_minimal_coordinate_model() {
    let t = tower(tower::US);
    let centre = t.model.form(t.triangles[0].mass_centre()).unwrap();
    let state = at_end(&t.model, &mut explicit(&t.model, PAIRS[1], 1e-11), 0.4, 0.8);
    let centre = centre.eval(&state.q);
    let error = distance(&[centre[0], centre[1]], &[0.0337022140612, 0.1141768766901]);
    println!("{error:e}");
    assert!(error < 1e-12, "{error:e}");
}

/// Cables are slack at the same times whatever the pair and the tolerance.
#[test]
fn slack_intervals_hold() {
    let t = tower(tower::US);
    let slack = |pair, tolerance| {
        let mut times = Vec::new();
        let mut watch = |state: &State, _: &StepReport| {
            let u = t.model.inputs_at(state.t);
            let slack = |cable| t.model.cable(cable, &state.q, &state.v, &u).slack;
            times.push(t.model.cables().map(slack).collect::<Vec<_>>());
        };
        let mut stepper = explicit(&t.model, pair, tolerance);
        let mut state = start(&t.model, &mut stepper);
        Run::new(5e-3, 0.8).observe(&mut watch).go(&mut stepper, &mut state).unwrap();
        times
    };
    let fine = slack(PAIRS[1], 1e-9);
    let changes = fine.windows(2).filter(|pair| pair[0] != pair[1]).count();
    assert!(changes > 5, "{changes}");
    assert_eq!(slack(PAIRS[0], 1e-5), fine);
}

/// A stone that meets a damper of 2048 N s/m in the middle of a step stops `m v/η` behind, but for the cable's spring.
#[test]
fn jump_of_the_force_is_found_where_it_is() {
    let gap = 0.0123;
    let (model, stone, thrown) = thrown_into_a_damper(gap);
    let place = model.form(stone.node(0)).unwrap();
    for pair in PAIRS {
        let mut stepper = explicit(&model, pair, 1e-9);
        let mut state = stepper.start(0.0, &thrown.q, &thrown.v).unwrap();
        // Until the damper has stopped it: e^{-2048 t}.
        let report = stepper.step(&mut state, gap + 0.02).unwrap();
        let ahead = place.eval(&state.q)[0] - 1.0;
        println!("{ahead:e} {report:?}");
        // The spring of 1 N/m moves the end by v t/η-terms of 1e-8.
        assert!((ahead - gap - 1.0 / 2048.0).abs() < 1e-7, "{ahead:e}");
        assert!(report.frozen == 1 && report.forced == 0, "{report:?}");
    }
}

/// Without error control each stage lets the laws decide: no order to speak of, but no failure.
#[test]
fn fixed_steps_pass_over_switches() {
    let t = tower(tower::US);
    let (exact, _) = end(&t, PAIRS[1], 1e-10);
    let mut stepper = fixed(&t.model, PAIRS[0]);
    let state = at_end(&t.model, &mut stepper, 4e-3, 0.8);
    let error = distance(&corners(&t.model, &t.triangles, &state.q), &exact);
    println!("{error:e}");
    assert!(error > 1e-9 && error < 1e-4, "{error:e}");
}

/// Dry friction brings a mass from 1 m/s to rest after 0.5 m; the direction of the force then changes without end. The step
/// ends all the same, stays near the rest, and says what it passed over.
#[test]
fn chattering_ends_and_is_counted() {
    for pair in PAIRS {
        let mut stepper = explicit(&Friction, pair, 1e-6);
        let mut state = stepper.start(0.0, &[0.0], &[1.0]).unwrap();
        let report = stepper.step(&mut state, 3.0).unwrap();
        println!("{state:?} {report:?}");
        assert!(report.forced > 0 && report.substeps < 5000, "{report:?}");
        assert!((state.q[0] - 0.5).abs() < 0.05 && state.v[0].abs() < 0.1, "{state:?}");
    }
}
