//! Joints, supports and structures that a builder refuses.

use crate::support::{Random, build};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::Joining::{Constrain, Share};
use tg_model::{BuildError, CableLaw, ModelBuilder, Signal};

macro_rules! refused {
    ($result:expr, $variant:pat, $($word:expr),+) => {{
        let error = $result.map(drop).unwrap_err();
        let text = error.to_string();
        assert!(matches!(error, $variant), "{text}");
        $(assert!(text.contains($word), "{:?} is not in: {text}", $word);)+
    }};
}

fn plate() -> Member<2> {
    let mass = MassProperties::from_polar_moment(1.0, [0.3, 0.3].into(), 0.1).unwrap();
    Member::new(CoordType::Rrv, &[[0.1, 0.2], [1.1, 0.3], [0.1, 1.0]].map(Into::into), mass).unwrap()
}

#[test]
fn cables_of_zero_length() {
    refused!(
        build::<2>(|b| {
            let peg = b.anchor("peg", [1.0, 0.0])?;
            let bar = b.bar("boom", 1.0, [0.0, 0.0], [1.0, 0.0])?;
            b.cable("stub", bar.node(1), peg, CableLaw::slacking(1.0), 0.1).map(drop)
        }),
        BuildError::ZeroLengthCable { .. },
        "stub",
        "basic point 1 of \"boom\"",
        "anchor \"peg\""
    );
    // The same, where the ends meet to rounding only, also far from the origin.
    let r = &mut Random::new(6);
    for distance in [0.0, 0.0, 0.0, 1e3, 1e3, 1e3] {
        refused!(
            build::<2>(|b| {
                let pose = Pose::planar(distance + r.value(), distance + r.value(), 3.0 * r.value());
                let at = pose.apply_point(&[0.6, 0.7].into());
                let body = b.member("plate", plate(), pose)?;
                let peg = b.anchor("peg", at.into())?;
                b.cable("stub", body.at([0.6, 0.7]), peg, CableLaw::slacking(1.0), 0.1).map(drop)
            }),
            BuildError::ZeroLengthCable { .. },
            "stub"
        );
    }
}

#[test]
fn joints_whose_points_are_apart() {
    for joining in [Share, Constrain] {
        let apart = |gap: f64| {
            build::<2>(|b| {
                let bars = [
                    b.bar("one", 1.0, [0.0, 0.0], [1.0, 0.0])?,
                    b.bar("two", 1.0, [1.0, 0.0], [2.0, 0.0])?,
                    b.bar("three", 1.0, [1.0, gap], [1.0, 1.0])?,
                ];
                b.joint("knot", &[bars[0].node(1), bars[1].node(0), bars[2].node(0)], joining)
            })
        };
        refused!(
            apart(0.01),
            BuildError::InconsistentJoint { .. },
            "joint \"knot\"",
            "basic point 1 of \"one\"",
            "basic point 0 of \"three\"",
            "1.000e-2 m"
        );
        refused!(apart(1e-7), BuildError::InconsistentJoint { .. }, "knot");
        apart(1e-12).unwrap();
    }
}

#[test]
fn joints_without_meaning() {
    let joint = |places: &dyn Fn(tg_model::MemberId) -> Vec<tg_model::Place<2>>, joining| {
        build::<2>(|b| {
            let body = b.member("plate", plate(), Pose::planar(0.3, 0.4, 0.5))?;
            b.joint("knot", &places(body), joining)
        })
    };
    for joining in [Share, Constrain] {
        refused!(joint(&|_| vec![], joining), BuildError::MeaninglessJoint { .. }, "knot", "fewer than two");
        refused!(
            joint(&|m| vec![m.node(0)], joining),
            BuildError::MeaninglessJoint { .. },
            "knot",
            "fewer than two"
        );
        refused!(
            joint(&|m| vec![m.node(0), m.node(0)], joining),
            BuildError::MeaninglessJoint { .. },
            "knot",
            "with itself"
        );
    }
    // The same point under another name; its weights differ by rounding.
    refused!(
        joint(&|m| vec![m.node(1), m.at([1.1, 0.3])], Constrain),
        BuildError::MeaninglessJoint { .. },
        "knot",
        "with itself"
    );
    refused!(
        build::<2>(|b| {
            let bodies =
                [b.member("one", plate(), Pose::identity())?, b.member("two", plate(), Pose::identity())?];
            b.joint("first", &[bodies[0].node(1), bodies[1].node(1)], Share)?;
            b.joint("second", &[bodies[0].node(1), bodies[1].at([1.1, 0.3])], Constrain)
        }),
        BuildError::MeaninglessJoint { .. },
        "second",
        "with itself"
    );
}

#[test]
fn members_that_would_meet_themselves() {
    // A bar shorter than the distance at which points count as one, in a structure a thousand million times larger.
    refused!(
        build::<2>(|b| {
            let peg = b.anchor("peg", [0.0, 0.0])?;
            b.anchor("far", [1e3, 0.0])?;
            let bar = b.bar("speck", 1.0, [0.0, 0.0], [1e-7, 0.0])?;
            b.joint("head", &[peg.into(), bar.node(0)], Share)?;
            b.joint("tail", &[peg.into(), bar.node(1)], Share)
        }),
        BuildError::SelfJoined { .. },
        "\"speck\""
    );
}

#[test]
fn places_that_cannot_be_shared() {
    let share = |place: &dyn Fn(tg_model::MemberId) -> tg_model::Place<2>| {
        build::<2>(|b| {
            let body = b.member("plate", plate(), Pose::identity())?;
            let peg = b.anchor("peg", [0.6, 0.7])?;
            b.joint("knot", &[peg.into(), place(body)], Share)
        })
    };
    refused!(
        share(&|m| m.at([0.6, 0.7])),
        BuildError::CannotShare { .. },
        "joint \"knot\"",
        "[0.6, 0.7]",
        "\"plate\""
    );
    refused!(share(&|m| m.mass_centre()), BuildError::CannotShare { .. }, "knot", "mass centre of \"plate\"");
    refused!(share(&|m| m.node(2)), BuildError::CannotShare { .. }, "knot", "base vector 2 of \"plate\"");
}

#[test]
fn supports_that_contradict_each_other() {
    let two = |first: Signal, second: Signal| {
        build::<2>(|b| {
            let peg = b.anchor("peg", [0.0, 0.0])?;
            let bar = b.bar("boom", 1.0, [0.0, 0.0], [1.0, 0.0])?;
            b.joint("foot", &[peg.into(), bar.node(0)], Share)?;
            b.support("one", peg, 1, first)?;
            b.support("two", bar.node(0), 1, second)
        })
    };
    refused!(
        two(Signal::sine(0.1, 1.0), 0.0.into()),
        BuildError::ContradictorySupports { axis: 'y', .. },
        "\"one\"",
        "\"two\"",
        "y component"
    );
    refused!(two(0.1.into(), 0.2.into()), BuildError::ContradictorySupports { .. }, "\"one\"", "\"two\"");
    two(Signal::sine(0.1, 1.0), Signal::sine(0.1, 1.0)).unwrap();
}

#[test]
fn held_constraints_that_the_supports_violate() {
    let bar = |offset: Signal| {
        build::<2>(|b| {
            b.particle("ball", 1.0, [9.0, 9.0])?;
            let bar = b.bar("boom", 1.0, [0.0, 0.0], [1.0, 0.0])?;
            b.fix("left", bar.node(0))?;
            b.shake("right", bar.node(1), offset)
        })
    };
    refused!(
        bar(Signal::sine(0.1, 1.0)),
        BuildError::UnsatisfiableConstraint { .. },
        "rigidity u·u of \"boom\""
    );
    refused!(bar(0.1.into()), BuildError::UnsatisfiableConstraint { .. }, "rigidity u·u of \"boom\"");
    bar(0.0.into()).unwrap();
    refused!(
        build::<2>(|b| {
            b.particle("ball", 1.0, [9.0, 9.0])?;
            let pegs = [b.anchor("still", [0.0, 0.0])?, b.anchor("moving", [0.0, 0.0])?];
            b.shake("quake", pegs[1], Signal::sine(0.1, 1.0))?;
            b.joint("knot", &[pegs[0].into(), pegs[1].into()], Constrain)
        }),
        BuildError::UnsatisfiableConstraint { .. },
        "x component of joint \"knot\""
    );
}

#[test]
fn structures_with_nothing_to_solve() {
    refused!(build::<3>(|_| Ok(())), BuildError::NothingFree, "no free coordinate");
    refused!(build::<3>(|b| b.anchor("peg", [0.0; 3]).map(drop)), BuildError::NothingFree, "free");
    let held = |b: &mut ModelBuilder<3>| {
        let ball = b.particle("ball", 1.0, [0.0; 3])?;
        b.fix("grip", ball.node(0))
    };
    refused!(build(held), BuildError::NothingFree, "free");
}

#[test]
fn numbers_that_overflow_in_the_constraints() {
    refused!(
        build::<2>(|b| {
            b.bar("sound", 1.0, [0.0, 0.0], [0.0, 1.0])?;
            let bar = b.bar("torn", 1.0, [0.0, 0.0], [1.0, 0.0])?;
            b.support("pull", bar.node(1), 0, 1.5e308)
        }),
        BuildError::Sparse { .. },
        "rigidity u·u of \"torn\"",
        "not finite"
    );
}
