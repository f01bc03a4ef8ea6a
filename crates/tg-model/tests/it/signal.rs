//! Signals: values, rates, holds, kinks and what is refused.

use std::f64::consts::{FRAC_PI_2, TAU};

use crate::support::Random;
use approx::assert_relative_eq;
use tg_model::{Signal, SignalError};

fn table() -> Signal {
    Signal::table(vec![-1.0, 0.0, 0.5, 2.0], vec![3.0, 1.0, 4.0, -2.0]).expect("a table in order")
}

fn user() -> Signal {
    Signal::user(|t| (t.exp(), t.exp()))
}

#[test]
fn rates_and_accelerations_are_the_derivatives_away_from_kinks() {
    let ramp = Signal::Ramp { from: 2.0, to: -1.0, start: 0.25, duration: 1.5 };
    let sine = Signal::Sine { amplitude: 0.3, frequency: 1.7, phase: 0.4 };
    let sum = Signal::Sum(vec![ramp.clone(), sine.clone(), user(), Signal::Sum(vec![table()])]);
    let kinks = [-1.0, 0.0, 0.25, 0.5, 1.75, 2.0];
    let r = &mut Random::new(1);
    for signal in [Signal::Constant(3.0), ramp, sine, table(), user(), sum] {
        for _ in 0..200 {
            let (t, h) = (r.within(-2.0, 3.0), 1e-3);
            if kinks.iter().any(|k: &f64| (k - t).abs() < 3.0 * h) {
                continue;
            }
            let s = |steps: f64| signal.at(t + steps * h).0;
            let slope = (8.0 * (s(1.0) - s(-1.0)) - (s(2.0) - s(-2.0))) / (12.0 * h);
            assert_relative_eq!(signal.at(t).1, slope, epsilon = 1e-8, max_relative = 1e-8);
            let rate = |steps: f64| signal.at(t + steps * h).1;
            let slope = (8.0 * (rate(1.0) - rate(-1.0)) - (rate(2.0) - rate(-2.0))) / (12.0 * h);
            assert_relative_eq!(signal.acceleration(t), slope, epsilon = 1e-7, max_relative = 1e-7);
        }
    }
}

#[test]
fn ramp_holds_before_and_after() {
    let ramp = Signal::Ramp { from: 2.0, to: 5.0, start: 1.0, duration: 2.0 };
    for (t, value, rate) in [
        (-9.0, 2.0, 0.0),
        (0.999, 2.0, 0.0),
        (1.0, 2.0, 1.5),
        (2.0, 3.5, 1.5),
        (3.0, 5.0, 0.0),
        (99.0, 5.0, 0.0),
    ] {
        assert_eq!(ramp.at(t), (value, rate), "t = {t}");
    }
    assert_eq!(Signal::ramp(2.0, 5.0, 2.0).at(0.5), (2.75, 1.5));
    assert_eq!(Signal::ramp(2.0, 5.0, 2.0).at(-0.5), (2.0, 0.0));
}

#[test]
fn sine_starts_at_its_phase() {
    let cosine = Signal::Sine { amplitude: 2.0, frequency: 0.5, phase: FRAC_PI_2 };
    let (value, rate) = cosine.at(0.0);
    assert_relative_eq!(value, 2.0);
    assert_relative_eq!(rate, 0.0, epsilon = 1e-14);
    let (value, rate) = Signal::sine(0.01, 3.0).at(0.0);
    assert_eq!(value, 0.0);
    assert_relative_eq!(rate, 0.01 * 3.0 * TAU);
    assert_relative_eq!(Signal::sine(0.01, 3.0).at(1.0 / 12.0).0, 0.01);
}

#[test]
fn table_is_linear_between_samples_and_held_outside() {
    for (t, value, rate) in [
        (-5.0, 3.0, 0.0),
        (-1.0, 3.0, -2.0),
        (-0.5, 2.0, -2.0),
        (0.0, 1.0, 6.0),
        (0.25, 2.5, 6.0),
        (0.5, 4.0, -4.0),
        (1.0, 2.0, -4.0),
        (2.0, -2.0, 0.0),
        (7.0, -2.0, 0.0),
    ] {
        assert_eq!(table().at(t), (value, rate), "t = {t}");
    }
    let single = Signal::table(vec![1.0], vec![4.0]).expect("one sample");
    for t in [0.0, 1.0, 2.0] {
        assert_eq!(single.at(t), (4.0, 0.0));
    }
}

#[test]
fn sums_add_values_and_rates() {
    let sum = Signal::Sum(vec![Signal::Constant(1.0), Signal::ramp(0.0, 1.0, 2.0), user()]);
    let (value, rate) = sum.at(0.5);
    assert_relative_eq!(value, 1.25 + 0.5f64.exp());
    assert_relative_eq!(rate, 0.5 + 0.5f64.exp());
    assert_eq!(Signal::Sum(vec![]).at(3.0), (0.0, 0.0));
}

#[test]
fn constants_are_known_as_such() {
    assert_eq!(Signal::from(2.5).constant(), Some(2.5));
    assert_eq!(Signal::Sum(vec![1.0.into(), 2.0.into()]).constant(), Some(3.0));
    assert_eq!(Signal::Sum(vec![1.0.into(), Signal::sine(1.0, 1.0)]).constant(), None);
    for signal in [Signal::sine(1.0, 1.0), Signal::ramp(0.0, 1.0, 1.0), table(), user()] {
        assert_eq!(signal.constant(), None);
    }
}

#[test]
fn equality_compares_parameters() {
    assert_eq!(Signal::sine(1.0, 2.0), Signal::Sine { amplitude: 1.0, frequency: 2.0, phase: 0.0 });
    assert_ne!(Signal::sine(1.0, 2.0), Signal::sine(1.0, 2.5));
    assert_ne!(Signal::ramp(0.0, 1.0, 2.0), Signal::ramp(0.0, 1.0, 3.0));
    assert_eq!(table(), table());
    let function = user();
    assert_eq!(function, function.clone());
    assert_ne!(function, user(), "two closures cannot be compared");
}

#[test]
fn bad_parameters_are_refused() {
    let not_finite = |signal: Signal| matches!(signal.check(), Err(SignalError::NotFinite(..)));
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    assert!(not_finite(Signal::Constant(nan)));
    for [from, to, start, duration] in
        [[nan, 1.0, 0.0, 1.0], [0.0, inf, 0.0, 1.0], [0.0, 1.0, nan, 1.0], [0.0, 1.0, 0.0, nan]]
    {
        assert!(not_finite(Signal::Ramp { from, to, start, duration }));
    }
    for [amplitude, frequency, phase] in [[nan, 1.0, 0.0], [1.0, inf, 0.0], [1.0, 1.0, nan]] {
        assert!(not_finite(Signal::Sine { amplitude, frequency, phase }));
    }
    assert!(not_finite(Signal::Sum(vec![1.0.into(), Signal::Constant(inf)])));
    assert!(not_finite(Signal::user(|_| (f64::NAN, 0.0))));
    assert!(not_finite(Signal::user(|_| (0.0, f64::INFINITY))));
    assert_eq!(Signal::user(|t| (t, 1.0)).check(), Ok(()));
    for duration in [0.0, -1.0] {
        let error = Signal::ramp(0.0, 1.0, duration).check();
        assert_eq!(error, Err(SignalError::RampDuration(duration)));
    }
    let table = |t: &[f64], x: &[f64]| Signal::table(t.to_vec(), x.to_vec()).map(drop);
    assert_eq!(table(&[0.0, 1.0], &[0.0]), Err(SignalError::TableLength { times: 2, values: 1 }));
    assert_eq!(table(&[], &[]), Err(SignalError::TableLength { times: 0, values: 0 }));
    assert_eq!(table(&[0.0, 2.0, 1.0], &[0.0; 3]), Err(SignalError::TableOrder { index: 2, time: 1.0 }));
    assert_eq!(table(&[0.0, 0.0], &[0.0; 2]), Err(SignalError::TableOrder { index: 1, time: 0.0 }));
    assert!(matches!(table(&[0.0, nan], &[0.0; 2]), Err(SignalError::NotFinite("times", _))));
    assert!(matches!(table(&[0.0, 1.0], &[0.0, nan]), Err(SignalError::NotFinite("values", _))));
}
