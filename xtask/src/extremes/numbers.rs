//! Numbers that are none: NaN and infinity from signals, laws, starts and settings.

use std::sync::Arc;

use tg_integrate::{
    EmbeddedPair, GeneralizedAlpha, Leapfrog, NewtonOptions, Run, RungeKutta, Symplectic, Tolerances,
};
use tg_model::{CableLaw, Joining, Model, ModelBuilder, Signal, Tension, TensionLaw};

use super::axis::{Axis, Probe};
use super::scheme::Scheme;
use super::verdict::Verdict;
use crate::TaskError;

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let from_signals = [0.0, 0.05].into_iter().flat_map(|since| {
        [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().flat_map(move |bad| {
            SOURCES.into_iter().map(move |source| {
                let at = format!("{bad} as {} from t = {since} s", source.words());
                Probe::new(at, move |_| by_every_scheme(source, bad, since))
            })
        })
    });
    vec![
        Axis {
            title: "Signals and laws that are NaN or infinite",
            setup: "A bar on a hinge whose support moves, a particle at its tip on a cable to it and on one to the ground, and a \
                    load, stepped by all nine schemes for 0.1 s in steps of 1 ms; a number becomes bad. Every scheme \
                    must refuse; the words are those of the first.",
            probes: from_signals.collect(),
            cause: "",
        },
        Axis {
            title: "Starts and settings that are NaN, infinite or out of range",
            setup: "The same structure with a bad number in the start, in a setting or in a part; all must be refused.",
            probes: settings(),
            cause: "",
        },
    ]
}

/// Where the bad number comes from.
#[derive(Clone, Copy, Debug)]
enum Source {
    SupportValue,
    SupportRate,
    RestLength,
    Load,
    Law,
}

const SOURCES: [Source; 5] =
    [Source::SupportValue, Source::SupportRate, Source::RestLength, Source::Load, Source::Law];

impl Source {
    fn words(self) -> &'static str {
        match self {
            Self::SupportValue => "position of a support",
            Self::SupportRate => "velocity of a support",
            Self::RestLength => "rest length",
            Self::Load => "factor of a load",
            Self::Law => "tension of a user's law",
        }
    }
}

/// A law of 100 N/m whose tension is bad beyond a length.
struct BreaksAt(f64, f64);

impl TensionLaw for BreaksAt {
    fn tension(&self, length: f64, _: f64, rest: f64) -> Tension {
        let force = if length < self.0 { 100.0 * (length - rest) } else { self.1 };
        Tension { force, by_length: 100.0, by_rate: 0.0 }
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        50.0 * (length - rest).powi(2)
    }

    fn damped(&self) -> bool {
        false
    }
}

/// The structure; the signal of `source` is bad from `since` on.
fn structure(source: Option<(Source, f64, f64)>) -> Result<Model<2>, TaskError> {
    let signal = move |mine: fn(Source) -> bool, good: f64| match source {
        Some((source, bad, since)) if mine(source) => Signal::user(move |t| {
            let bad = if t >= since { bad } else { good };
            if matches!(source, Source::SupportRate) {
                (good, if t >= since { bad } else { 0.0 })
            } else {
                (bad, 0.0)
            }
        }),
        _ => Signal::Constant(good),
    };
    let law = match source {
        Some((Source::Law, bad, since)) => {
            CableLaw::User(Arc::new(BreaksAt(if since > 0.0 { 1.001 } else { 0.0 }, bad)))
        }
        _ => CableLaw::slacking(100.0),
    };
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81])?;
    let pivot = b.anchor("pivot", [0.0, 0.0])?;
    let peg = b.anchor("peg", [1.0, 2.0])?;
    let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0])?;
    let stone = b.particle("stone", 1.0, [1.0, -1.0])?;
    b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share)?;
    b.shake("ground", pivot, signal(|s| matches!(s, Source::SupportValue | Source::SupportRate), 0.0))?;
    b.cable(
        "guy",
        peg,
        bar.node(1),
        CableLaw::slacking(100.0),
        signal(|s| matches!(s, Source::RestLength), 1.9),
    )?;
    b.cable("thread", bar.node(1), stone.node(0), law, 1.0)?;
    b.load("wind", stone.node(0), [1.0, 0.0], signal(|s| matches!(s, Source::Load), 1.0))?;
    Ok(b.build()?)
}

/// Refused by every scheme, in the words of the first; an answer of any is wrong.
fn by_every_scheme(source: Source, bad: f64, since: f64) -> Verdict {
    let mut verdicts = Scheme::ALL.into_iter().map(|scheme| {
        refused(structure(Some((source, bad, since))).and_then(|model| {
            scheme.follow(&model, &model.velocities_at_rest(), (1e-3, 0.1), |_| 0.0).map(drop)
        }))
    });
    let first = verdicts.next().unwrap_or(Verdict::Endless);
    verdicts.find(|verdict| !verdict.holds()).unwrap_or(first)
}

/// Only an error is right.
fn refused<E: std::fmt::Display>(answer: Result<(), E>) -> Verdict {
    Verdict::of(answer.map(|()| f64::NAN), 0.0)
}

type Question = fn(f64) -> Result<(), TaskError>;

/// Bad settings and parts, each with the numbers that are bad for it.
fn settings() -> Vec<Probe> {
    const NOT_FINITE: &[f64] = &[f64::NAN, f64::INFINITY];
    let questions: [(&str, &[f64], Question); 14] = [
        ("coordinate of the start", NOT_FINITE, |bad| {
            every_start(|q, _| q.iter_mut().for_each(|q| *q *= bad), 0.0)
        }),
        ("velocity of the start", NOT_FINITE, |bad| {
            every_start(|_, v| v.iter_mut().for_each(|v| *v = bad), 0.0)
        }),
        ("time of the start", NOT_FINITE, |bad| every_start(|_, _| {}, bad)),
        ("step", &[f64::NAN, f64::INFINITY, 0.0, -1e-3], |bad| every_step((bad, 1.0))),
        ("end", &[f64::NAN], |bad| every_step((1e-3, bad))),
        ("spectral radius", &[f64::NAN, f64::INFINITY, -0.1, 1.0], |bad| {
            GeneralizedAlpha::new(&structure(None)?, bad, NewtonOptions::default())?;
            Ok(())
        }),
        ("tolerance of Newton's iteration", &[f64::NAN, f64::INFINITY, -1e-12], |bad| {
            let (model, options) =
                (structure(None)?, NewtonOptions { tolerance: bad, ..NewtonOptions::default() });
            Leapfrog::new(&model, options)?;
            Symplectic::new(&model, options)?;
            Ok(())
        }),
        ("relative tolerance", &[f64::NAN, f64::INFINITY, -1e-6], |bad| {
            let tolerances = Tolerances { relative: bad, ..Tolerances::default() };
            RungeKutta::new(&structure(None)?, EmbeddedPair::default(), tolerances)?;
            Ok(())
        }),
        ("absolute tolerance", &[f64::NAN, f64::INFINITY, 0.0, -1e-6], |bad| {
            let tolerances = Tolerances { absolute: bad, ..Tolerances::default() };
            RungeKutta::new(&structure(None)?, EmbeddedPair::default(), tolerances)?;
            Ok(())
        }),
        ("mass", &[f64::NAN, f64::INFINITY, 0.0, -1.0], |bad| {
            ModelBuilder::<2>::new().bar("bar", bad, [0.0, 0.0], [1.0, 0.0])?;
            Ok(())
        }),
        ("position", NOT_FINITE, |bad| {
            ModelBuilder::<2>::new().bar("bar", 1.0, [0.0, 0.0], [bad, 0.0])?;
            Ok(())
        }),
        ("stiffness, damping or rest length", &[f64::NAN, f64::INFINITY, -1.0], |bad| {
            let laws =
                [CableLaw::linear(bad), CableLaw::slacking(1.0).with_damping(bad), CableLaw::linear(1.0)];
            for (law, rest) in laws.into_iter().zip([1.0, 1.0, bad]) {
                let mut b = ModelBuilder::<2>::new();
                let (from, to) = (b.anchor("a", [0.0, 0.0])?, b.anchor("b", [1.0, 0.0])?);
                if b.cable("cable", from, to, law, rest).is_ok() {
                    return Ok(());
                }
            }
            Err("all three are refused as the cable's".into())
        }),
        ("value of a table", NOT_FINITE, |bad| {
            Signal::table(vec![0.0, 1.0], vec![0.0, bad])?;
            Ok(())
        }),
        ("time of a table", &[f64::NAN, f64::INFINITY, 0.0, -1.0], |bad| {
            Signal::table(vec![0.0, bad], vec![0.0, 1.0])?;
            Ok(())
        }),
    ];
    let probes = questions.into_iter().flat_map(|(what, bad, ask)| {
        bad.iter().map(move |&bad| Probe::new(format!("{what} {bad}"), move |_| refused(ask(bad))))
    });
    probes.collect()
}

/// A start of every scheme that `spoil` spoils; an error if all refuse.
fn every_start(spoil: impl Fn(&mut [f64], &mut [f64]), t: f64) -> Result<(), TaskError> {
    let model = structure(None)?;
    let (mut q, mut v) = (model.initial_coordinates(), model.velocities_at_rest());
    spoil(&mut q, &mut v);
    all_refuse(|scheme| Ok(scheme.stepper(&model)?.start(t, &q, &v).map(drop)?))
}

/// A run of every scheme with this step and end.
fn every_step((step, end): (f64, f64)) -> Result<(), TaskError> {
    let model = structure(None)?;
    all_refuse(|scheme| {
        let mut stepper = scheme.stepper(&model)?;
        let mut state = stepper.start(0.0, &model.initial_coordinates(), &model.velocities_at_rest())?;
        Ok(Run::new(step, end).go(stepper.as_mut(), &mut state).map(drop)?)
    })
}

/// The refusal of the last scheme if all refuse.
fn all_refuse(ask: impl Fn(Scheme) -> Result<(), TaskError>) -> Result<(), TaskError> {
    let mut last = Ok(());
    for scheme in Scheme::ALL {
        last = ask(scheme);
        if last.is_ok() {
            break;
        }
    }
    last
}
