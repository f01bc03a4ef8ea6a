//! The driver: its end, its observers, its stops.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::support::{alpha, example1, pendulum, start, symplectic};
use tg_integrate::{Ended, Recorder, Run, State, StepReport, Stepper, Summary};
use tg_model::ModelBuilder;

#[test]
fn end_time_is_hit_with_a_shorter_last_step() {
    let model = example1().model;
    for (h, end, steps) in
        [(1e-3, 0.5, 500), (1e-3, 0.0505, 51), (0.003, 0.01, 4), (0.02, 0.005, 1), (7e-4, 0.7, 1000)]
    {
        let mut stepper = symplectic(&model);
        let mut state = start(&model, &mut stepper);
        let mut times = Vec::new();
        let mut watch = |state: &State, _: &StepReport| times.push(state.t);
        let summary = Run::new(h, end).observe(&mut watch).go(&mut stepper, &mut state).unwrap();
        assert_eq!(summary.ended, Ended::AtEnd);
        assert_eq!(summary.steps, steps, "h = {h}, end = {end}");
        assert!((state.t - end).abs() <= f64::EPSILON * end, "h = {h}: {} is not {end}", state.t);
        assert_eq!(times.len() as u64, steps + 1, "the start and every step are observed");
        assert_eq!(times[0], 0.0);
        for (k, t) in times[..times.len() - 1].iter().enumerate() {
            assert!((t - k as f64 * h).abs() <= f64::EPSILON * end, "time {k} is {t}");
        }
        // Nothing is left to do.
        let again = Run::new(h, end).go(&mut stepper, &mut state).unwrap();
        assert_eq!((again.steps, again.ended), (0, Ended::AtEnd));
    }
}

/// Half a million steps of 1e-3 s: a time that is summed up plainly is off by 5e-6 of a step.
#[test]
fn rounding_of_the_time_makes_no_extra_step() {
    let mut b = ModelBuilder::<2>::new();
    b.particle("stone", 1.0, [0.0, 0.0]).unwrap();
    let model = b.build().unwrap();
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let summary = Run::new(1e-3, 500.0).go(&mut stepper, &mut state).unwrap();
    assert_eq!(summary.steps, 500_000);
    assert!((state.t - 500.0).abs() <= 500.0 * f64::EPSILON, "{}", state.t);
}

#[test]
fn start_is_shown_with_an_empty_report_and_steps_with_theirs() {
    let model = example1().model;
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let mut reports = Vec::new();
    let mut watch = |_: &State, report: &StepReport| reports.push(*report);
    let summary = Run::new(1e-3, 0.1).observe(&mut watch).go(&mut stepper, &mut state).unwrap();
    assert_eq!(reports[0], StepReport::default());
    let mut sum = Summary::default();
    reports[1..].iter().for_each(|&report| sum += report);
    assert_eq!(sum, summary);
    assert!(summary.iterations >= 100 && summary.residual > 0.0 && summary.residual < 1e-9, "{summary:?}");
}

#[test]
fn stop_condition_ends_after_the_step_that_satisfies_it() {
    let (model, rod) = pendulum(0.4, 1.0);
    let tip = model.form(rod.node(1)).unwrap();
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let mut before = f64::NAN;
    let mut last = 1.0;
    let mut watch = |state: &State, _: &StepReport| {
        before = last;
        last = tip.eval(&state.q)[0];
    };
    let run =
        Run::new(1e-3, f64::INFINITY).observe(&mut watch).stop_when(|state| tip.eval(&state.q)[0] < 0.0);
    let summary = run.go(&mut stepper, &mut state).unwrap();
    assert_eq!(summary.ended, Ended::Stopped);
    assert!(last < 0.0 && before >= 0.0, "{before} {last}");
    assert_eq!(state.t, summary.steps as f64 * 1e-3);
}

#[test]
fn cancellation_from_an_observer_ends_between_steps() {
    let model = example1().model;
    let mut stepper = alpha(&model, 0.7);
    let mut state = start(&model, &mut stepper);
    let flag = AtomicBool::new(false);
    let mut seen = 0;
    let mut watch = |state: &State, _: &StepReport| {
        seen += 1;
        if state.t > 0.0095 {
            flag.store(true, Ordering::Relaxed);
        }
    };
    let summary =
        Run::new(1e-3, 1.0).observe(&mut watch).cancel_on(&flag).go(&mut stepper, &mut state).unwrap();
    assert_eq!((summary.ended, summary.steps, seen), (Ended::Cancelled, 10, 11));
    // Set before the start: no step at all. Cleared: it goes on.
    let cancelled = Run::new(1e-3, 1.0).cancel_on(&flag).go(&mut stepper, &mut state).unwrap();
    assert_eq!((cancelled.ended, cancelled.steps), (Ended::Cancelled, 0));
    flag.store(false, Ordering::Relaxed);
    let rest = Run::new(1e-3, 1.0).cancel_on(&flag).go(&mut stepper, &mut state).unwrap();
    assert_eq!((rest.ended, rest.steps), (Ended::AtEnd, 990));
}

#[test]
fn recorder_keeps_channels_with_its_stride() {
    let p = example1();
    let mut stepper = symplectic(&p.model);
    let mut state = start(&p.model, &mut stepper);
    let tip = p.model.form(p.triangle.at([0.1, 0.0])).unwrap();
    let mut calls = 0;
    let mut every = Recorder::every(1).channel("x", |state| tip.eval(&state.q)[0]);
    let mut third = Recorder::every(3).channel("x", |state| tip.eval(&state.q)[0]).channel("calls", |_| {
        calls += 1;
        f64::from(calls)
    });
    Run::new(1e-3, 0.02).observe(&mut every).observe(&mut third).go(&mut stepper, &mut state).unwrap();
    assert_eq!(third.names().collect::<Vec<_>>(), ["x", "calls"]);
    assert_eq!((every.times().len(), third.times().len()), (21, 7));
    for (k, (&t, &x)) in third.times().iter().zip(third.values("x").unwrap()).enumerate() {
        assert_eq!((t, x), (every.times()[3 * k], every.values("x").unwrap()[3 * k]));
    }
    assert_eq!(third.values("calls").unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
    assert!(third.values("y").is_none());
    assert_eq!(every.values("x").unwrap()[20], tip.eval(&state.q)[0]);
}

/// A step that the driver makes is the step that the stepper makes.
#[test]
fn driver_adds_nothing_to_the_steps() {
    let model = example1().model;
    let mut stepper = symplectic(&model);
    let (mut a, mut b) = (start(&model, &mut stepper), start(&model, &mut stepper));
    Run::new(1e-3, 0.2).go(&mut stepper, &mut a).unwrap();
    (0..200).for_each(|_| assert!(stepper.step(&mut b, 1e-3).is_ok()));
    assert_eq!(a, b);
}
