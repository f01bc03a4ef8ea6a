//! Every way in which a builder refuses a part or a structure, with the name of the culprit.

use crate::support::build;
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::Joining::{Constrain, Share};
use tg_model::{BuildError, CableLaw, Model, ModelBuilder, Signal};

/// Asserts the variant and that the message holds all the words.
macro_rules! refused {
    ($result:expr, $variant:pat, $($word:expr),+) => {{
        let error = $result.map(drop).unwrap_err();
        let text = error.to_string();
        assert!(matches!(error, $variant), "{text}");
        $(assert!(text.contains($word), "{:?} is not in: {text}", $word);)+
    }};
}

fn law() -> CableLaw {
    CableLaw::slacking(1.0)
}

fn triangle() -> Member<2> {
    let mass = MassProperties::from_polar_moment(1.0, [0.3, 0.3].into(), 0.1).unwrap();
    Member::new(CoordType::Rrv, &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Into::into), mass).unwrap()
}

/// A bar from the origin to (1, 0), what `parts` adds, built.
fn with_bar(
    parts: impl FnOnce(&mut ModelBuilder<2>, tg_model::MemberId) -> Result<(), BuildError>,
) -> Result<Model<2>, BuildError> {
    build(|b| {
        let bar = b.bar("boom", 1.0, [0.0, 0.0], [1.0, 0.0])?;
        parts(b, bar)
    })
}

#[test]
fn names_are_unique_within_their_kind() {
    type Add = fn(&mut ModelBuilder<2>, tg_model::MemberId, tg_model::MemberId) -> Result<(), BuildError>;
    let kinds: [(&str, Add); 7] = [
        ("member", |b, _, _| b.bar("twin", 1.0, [0.0, 0.0], [5.0, 0.0]).map(drop)),
        ("member", |b, _, _| b.particle("twin", 1.0, [0.0, 0.0]).map(drop)),
        ("anchor", |b, _, _| b.anchor("twin", [1.0, 2.0]).map(drop)),
        ("joint", |b, x, y| b.joint("twin", &[x.node(1), y.node(0)], Constrain)),
        ("support", |b, x, _| b.support("twin", x.node(0), 0, 0.0)),
        ("cable", |b, x, y| b.cable("twin", x.node(0), y.node(1), law(), 1.0).map(drop)),
        ("load", |b, x, _| b.load("twin", x.node(0), [1.0, 0.0], 1.0).map(drop)),
    ];
    for (kind, add) in kinds {
        let mut b = ModelBuilder::<2>::new();
        let x = b.bar("x", 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
        let y = b.bar("y", 1.0, [1.0, 0.0], [1.0, 1.0]).unwrap();
        add(&mut b, x, y).unwrap();
        let words = format!("two {kind}s are named \"twin\"");
        refused!(add(&mut b, x, y), BuildError::DuplicateName { .. }, &words);
    }
    // Different kinds may use one name.
    let mut b = ModelBuilder::<2>::new();
    let x = b.bar("x", 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
    b.anchor("x", [0.0, 0.0]).unwrap();
    b.load("x", x.node(0), [0.0, 0.0], 1.0).unwrap();
    b.build().unwrap();
}

#[test]
fn numbers_that_are_not_finite() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused!(build::<2>(|b| b.gravity([0.0, bad])), BuildError::NotFinite { .. }, "gravity");
        refused!(build::<2>(|b| b.anchor("peg", [bad, 0.0]).map(drop)), BuildError::NotFinite { .. }, "peg");
        refused!(
            with_bar(|b, bar| b.load("push", bar.node(0), [0.0, bad], 1.0).map(drop)),
            BuildError::NotFinite { .. },
            "push",
            "force"
        );
        refused!(
            with_bar(|b, bar| b.cable("tie", bar.node(0), bar.node(1), CableLaw::linear(bad), 1.0).map(drop)),
            BuildError::NotFinite { .. },
            "tie",
            "stiffness"
        );
        refused!(
            with_bar(|b, bar| b
                .cable("tie", bar.node(0), bar.node(1), law().with_damping(bad), 1.0)
                .map(drop)),
            BuildError::NotFinite { .. },
            "tie",
            "damping"
        );
        let signals = [Signal::Constant(bad), Signal::user(move |_| (bad, 0.0)), Signal::sine(bad, 1.0)];
        for signal in signals {
            refused!(
                with_bar(|b, bar| b.cable("tie", bar.node(0), bar.node(1), law(), signal.clone()).map(drop)),
                BuildError::Signal { .. },
                "cable \"tie\""
            );
            refused!(
                with_bar(|b, bar| b.support("rail", bar.node(0), 0, signal.clone())),
                BuildError::Signal { .. },
                "support \"rail\""
            );
            refused!(
                with_bar(|b, bar| b.load("push", bar.node(0), [1.0, 0.0], signal.clone()).map(drop)),
                BuildError::Signal { .. },
                "load \"push\""
            );
        }
        refused!(
            build::<2>(|b| b.bar("rod", 1.0, [0.0, 0.0], [1.0, bad]).map(drop)),
            BuildError::Coordinates { .. },
            "rod"
        );
        refused!(
            build::<2>(|b| b.bar("rod", bad, [0.0, 0.0], [1.0, 0.0]).map(drop)),
            BuildError::Coordinates { .. },
            "rod"
        );
        refused!(
            build::<2>(|b| b.particle("ball", 1.0, [bad, 0.0]).map(drop)),
            BuildError::Coordinates { .. },
            "ball"
        );
        refused!(
            build::<2>(|b| b.member("plate", triangle(), Pose::planar(bad, 0.0, 0.0)).map(drop)),
            BuildError::Coordinates { .. },
            "plate"
        );
        refused!(
            with_bar(|b, bar| b.cable("tie", bar.node(0), bar.at([bad, 0.0]), law(), 1.0).map(drop)),
            BuildError::Coordinates { .. },
            "tie"
        );
    }
}

#[test]
fn numbers_out_of_range() {
    let tie = |law: CableLaw, rest: f64| {
        with_bar(move |b, bar| b.cable("tie", bar.node(0), bar.node(1), law, rest).map(drop))
    };
    refused!(tie(CableLaw::linear(-1.0), 1.0), BuildError::OutOfRange { .. }, "tie", "stiffness is -1");
    refused!(tie(law().with_damping(-0.5), 1.0), BuildError::OutOfRange { .. }, "tie", "damping is -0.5");
    refused!(tie(law(), -0.1), BuildError::OutOfRange { .. }, "tie", "rest length is -0.1");
    tie(law(), 0.0).unwrap();
    refused!(
        build::<2>(|b| b.bar("rod", 0.0, [0.0, 0.0], [1.0, 0.0]).map(drop)),
        BuildError::Coordinates { .. },
        "rod",
        "mass"
    );
    refused!(
        build::<2>(|b| b.bar("rod", 1.0, [1.0, 1.0], [1.0, 1.0]).map(drop)),
        BuildError::Coordinates { .. },
        "rod"
    );
    refused!(
        with_bar(|b, bar| b.support("rail", bar.node(0), 0, Signal::ramp(0.0, 1.0, 0.0))),
        BuildError::Signal { .. },
        "rail",
        "duration"
    );
    refused!(
        with_bar(|b, bar| b.support("rail", bar.node(0), 2, 0.0)),
        BuildError::NoSuchAxis { axis: 2, dimension: 2, .. },
        "rail",
        "component 2"
    );
}

#[test]
fn attachments_to_nowhere() {
    let mut other = ModelBuilder::<2>::new();
    for k in 0..3 {
        other.bar(&format!("{k}"), 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
    }
    let foreign = other.bar("foreign", 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap();
    let peg = other.anchor("peg", [0.0, 0.0]).unwrap();
    for place in [foreign.node(0), foreign.at([0.5, 0.0]), foreign.mass_centre(), peg.into()] {
        refused!(
            with_bar(|b, bar| b.cable("tie", bar.node(0), place, law(), 1.0).map(drop)),
            BuildError::Dangling { .. },
            "cable \"tie\"",
            "does not exist"
        );
        refused!(
            with_bar(|b, _| b.load("push", place, [1.0, 0.0], 1.0).map(drop)),
            BuildError::Dangling { .. },
            "load \"push\""
        );
        refused!(
            with_bar(|b, _| b.support("rail", place, 0, 0.0)),
            BuildError::Dangling { .. },
            "support \"rail\""
        );
        for joining in [Share, Constrain] {
            refused!(
                with_bar(|b, bar| b.joint("pin", &[bar.node(0), place], joining)),
                BuildError::Dangling { .. } | BuildError::CannotShare { .. },
                "joint \"pin\""
            );
        }
    }
    refused!(
        with_bar(|b, bar| b.cable("tie", bar.node(0), bar.node(2), law(), 1.0).map(drop)),
        BuildError::Dangling { .. },
        "tie",
        "2 of \"boom\"",
        "count from 0"
    );
    refused!(
        with_bar(|b, bar| b.cable("tie", bar.node(0), bar.at([0.5, 0.1]), law(), 1.0).map(drop)),
        BuildError::Coordinates { .. },
        "cable \"tie\"",
        "off the axis"
    );
    let on_vector = |add: &dyn Fn(&mut ModelBuilder<2>, tg_model::Place<2>) -> Result<(), BuildError>| {
        with_bar(|b, _| {
            let plate = b.member("plate", triangle(), Pose::planar(5.0, 5.0, 0.0))?;
            add(b, plate.node(2))
        })
    };
    let peg = |b: &mut ModelBuilder<2>| b.anchor("peg", [9.0, 9.0]);
    refused!(
        on_vector(&|b, end| {
            let peg = peg(b)?;
            b.cable("tie", peg, end, law(), 1.0).map(drop)
        }),
        BuildError::NotAPoint { .. },
        "cable \"tie\"",
        "base vector 2 of \"plate\""
    );
    refused!(
        on_vector(&|b, end| b.load("push", end, [1.0, 0.0], 1.0).map(drop)),
        BuildError::NotAPoint { .. },
        "load \"push\""
    );
    refused!(
        on_vector(&|b, end| {
            let peg = peg(b)?;
            b.joint("pin", &[peg.into(), end], Constrain)
        }),
        BuildError::NotAPoint { .. },
        "joint \"pin\""
    );
}

#[test]
fn a_structure_far_from_the_origin() {
    let at = |x: f64| {
        let mut b = ModelBuilder::<2>::new();
        b.bar("bar", 1.0, [x, 0.0], [x + 1.0, 0.0])?;
        b.build()
    };
    // A bar of 1 m keeps six digits up to 1e-6/ε m.
    assert!(at(4e9).is_ok());
    refused!(at(5e9), BuildError::FarFromOrigin { .. }, "5.0e9 m from the origin", "place the origin nearer");
}
