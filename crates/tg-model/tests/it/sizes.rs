//! What counts as rounding is a matter of ratios: structures of any size are accepted and refused alike.

use crate::support::mixed::Cubic;
use crate::support::{build, violation};
use std::sync::Arc;
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::Joining::{Constrain, Share};
use tg_model::{At, BuildError, CableLaw, Mechanics, ModelBuilder, Redundancies, Signal};

const SIZES: [f64; 3] = [1e-6, 1.0, 1e6];
/// Points that are apart by this part of the structure's diagonal still meet.
const MEETING: f64 = 1e-9;

/// Two bars of a structure that is 5 m by 12 m times `size`, their ends apart by `part` of what is allowed.
fn nearly_joined(size: f64, part: f64, joining: tg_model::Joining) -> Result<(), BuildError> {
    let gap = part * MEETING * 13.0 * size;
    build::<2>(|b| {
        let one = b.bar("one", 1.0, [0.0, 0.0], [5.0 * size, 0.0])?;
        let two = b.bar("two", 1.0, [5.0 * size, gap], [5.0 * size, 12.0 * size])?;
        b.joint("knee", &[one.node(1), two.node(0)], joining)
    })
    .map(drop)
}

#[test]
fn points_meet_in_proportion_to_the_structure() {
    for size in SIZES {
        for joining in [Share, Constrain] {
            nearly_joined(size, 0.9, joining).unwrap();
            let Err(BuildError::InconsistentJoint { distance, allowed, .. }) =
                nearly_joined(size, 1.1, joining)
            else {
                panic!("{size:e} {joining:?}")
            };
            assert!((allowed / (MEETING * 13.0 * size) - 1.0).abs() < 1e-12);
            assert!((distance / allowed - 1.1).abs() < 1e-6);
        }
    }
}

/// A base vector counts from its body's first point, not from the origin: a body far away is no larger.
#[test]
fn the_size_of_a_structure_is_that_of_its_points() {
    for kind in [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr] {
        let mass = MassProperties::from_polar_moment(1.0, [0.3, 0.3].into(), 0.1).unwrap();
        let corners = [[0.0, 0.0], [3.0, 0.0], [0.0, 4.0]].map(Into::into);
        let plate = Member::new(CoordType::Rrr, &corners, mass).unwrap().with_type(kind).unwrap();
        let allowed = |apart: f64| {
            let error = build::<2>(|b| {
                let plate = b.member("plate", plate, Pose::planar(100.0, 200.0, 0.0))?;
                let ball = b.particle("ball", 1.0, [100.0 + apart, 200.0])?;
                b.joint("gap", &[plate.node(0), ball.node(0)], Constrain)
            });
            let Err(BuildError::InconsistentJoint { allowed, .. }) = error else { panic!("{kind}") };
            allowed
        };
        assert!((allowed(1.0) / (5.0 * MEETING) - 1.0).abs() < 1e-12, "{kind}");
    }
    // Points that all are one have no size, nor has one that is not a number; then it is a metre.
    let error = build::<2>(|b| {
        let balls = [b.particle("a", 1.0, [7.0, 7.0])?, b.particle("b", 1.0, [7.0, 7.0])?];
        b.cable("tie", balls[0].node(0), balls[1].node(0), CableLaw::linear(1.0), 0.0)?;
        b.joint("joint", &[balls[0].node(0), balls[1].node(0)], Constrain)
    });
    assert!(matches!(error, Err(BuildError::ZeroLengthCable { .. })));
    let model = build::<2>(|b| {
        let balls = [b.particle("a", 1.0, [7.0, 7.0])?, b.particle("b", 1.0, [7.0, 7.0])?];
        b.joint("joint", &[balls[0].node(0), balls[1].node(0)], Constrain)
    });
    assert_eq!(model.unwrap().constraint_scales(), [1.0, 1.0]);
    let error = build::<2>(|b| {
        let balls = [b.particle("a", 1.0, [0.0, 0.0])?, b.particle("b", 1.0, [1e-3, 0.0])?];
        b.anchor("far", [1e200, 0.0])?;
        b.joint("joint", &[balls[0].node(0), balls[1].node(0)], Constrain)
    });
    // A size whose square overflows is none; the place is refused.
    assert!(matches!(error, Err(BuildError::FarFromOrigin { distance: 1e200, .. })), "{error:?}");
}

/// A joint of points alone is scaled by the structure.
#[test]
fn joints_of_particles_are_scaled_by_the_structure() {
    for size in SIZES {
        let model = build::<2>(|b| {
            let peg = b.anchor("peg", [3.0 * size, 0.0])?;
            let balls = [b.particle("a", 1.0, [0.0, 4.0 * size])?, b.particle("b", 1.0, [3.0 * size, 0.0])?];
            b.joint("joint", &[peg.into(), balls[1].node(0)], Constrain)?;
            b.cable("tie", peg, balls[0].node(0), CableLaw::linear(1.0), 0.0).map(drop)
        });
        let model = model.unwrap();
        for scale in model.constraint_scales() {
            assert!((scale / (5.0 * size) - 1.0).abs() < 1e-15);
        }
    }
}

#[test]
fn a_cable_has_a_length_in_proportion_to_the_structure() {
    for size in SIZES {
        let cable = |part: f64| {
            build::<2>(|b| {
                let pegs = [b.anchor("a", [0.0, 0.0])?, b.anchor("b", [5.0 * size, 12.0 * size])?];
                let ball = b.particle("ball", 1.0, [part * MEETING * 13.0 * size, 0.0])?;
                b.cable("long", pegs[1], ball.node(0), CableLaw::linear(1.0), 0.0)?;
                b.cable("short", pegs[0], ball.node(0), CableLaw::linear(1.0), 0.0).map(drop)
            })
        };
        assert!(cable(1.1).is_ok(), "{size:e}");
        assert!(matches!(cable(0.9), Err(BuildError::ZeroLengthCable { .. })), "{size:e}");
    }
}

/// Lengths of bars whose ends were rounded differ; that is no contradiction.
#[test]
fn a_redundant_bar_with_rounded_ends_is_dropped() {
    for size in SIZES {
        let square = |gap: f64| {
            build::<2>(|b| {
                b.redundancies(Redundancies::Drop);
                let corners = [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]];
                let mut places = [const { Vec::new() }; 4];
                for (i, j) in [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3)] {
                    let mut from = corners[i];
                    if (i, j) == (1, 3) {
                        from[0] += gap;
                    }
                    let bar = b.bar(&format!("{i}{j}"), 1.0, from, corners[j])?;
                    places[i].push(bar.node(0));
                    places[j].push(bar.node(1));
                }
                (0..4).try_for_each(|k| b.joint(&format!("hinge {k}"), &places[k], Share))
            })
        };
        // The diagonal of the whole is √2 times the side.
        let model = square(1.3 * MEETING * size).unwrap();
        assert_eq!((model.report().redundant.len(), model.report().degrees_of_freedom()), (1, 3));
        // |d|² of the diagonal is off by 2 gap · size, of 2 size².
        let q = model.initial_coordinates();
        let off = model.dropped_violation(&q).max(violation(&model, &q));
        assert!((off / (1.3 * MEETING) - 1.0).abs() < 1e-6, "{size:e}: {off:e}");
    }
}

/// A support along a bar on its other support: the bar's rigidity implies it, in metres or in kilometres.
#[test]
fn what_implies_a_constraint_is_named_at_every_size() {
    for size in SIZES {
        let error = build::<2>(|b| {
            let bars = [
                b.bar("boom", 1.0, [0.0, 0.0], [size, 0.0])?,
                b.bar("bystander", 1.0, [0.0, 0.0], [0.0, size])?,
            ];
            b.fix("foot", bars[0].node(0))?;
            b.support("rail", bars[0].mass_centre(), 0, 0.0)
        });
        let Err(BuildError::Redundant { list, .. }) = error else { panic!("{size:e}") };
        assert_eq!((list.len(), list[0].implied_by.len()), (1, 1), "{size:e}: {list:?}");
        let mut names = [list[0].constraint.as_str(), list[0].implied_by[0].as_str()];
        names.sort_unstable();
        assert_eq!(names, ["rigidity u·u of \"boom\"", "support \"rail\""]);
    }
}

/// Supports that hold a whole bar: its length to MEETING, their rates relative to how fast they are.
#[test]
fn held_constraints_are_judged_in_proportion() {
    let held = |length: f64, offset: Signal| {
        build::<2>(|b| {
            b.particle("ball", 1.0, [9.0, 9.0])?;
            let bar = b.bar("boom", 1.0, [0.0, 0.0], [length, 0.0])?;
            b.fix("left", bar.node(0))?;
            b.shake("right", bar.node(1), offset)
        })
    };
    for length in [1e-3, 1.0, 1e3] {
        // ||l + d|² - l²| / l² = 2 d/l.
        assert!(held(length, (0.4 * MEETING * length).into()).is_ok(), "{length:e}");
        let refused = held(length, (0.6 * MEETING * length).into());
        let Err(BuildError::UnsatisfiableConstraint { violation, .. }) = refused else {
            panic!("{length:e}")
        };
        assert!((violation / (1.2 * MEETING) - 1.0).abs() < 1e-5, "{violation:e}");
        for amplitude in [1e-12, 1.0] {
            let moving = held(length, Signal::sine(amplitude, 1.0));
            assert!(matches!(moving, Err(BuildError::UnsatisfiableConstraint { .. })), "{length:e}");
        }
    }
}

/// The largest of tensions, weights and loads; a taut cable counts with what its length resolves, 1e-4 κ l.
#[test]
fn the_force_scale_by_hand() {
    let user = |c: f64| CableLaw::User(Arc::new(Cubic { a: 100.0, b: 0.0, c }));
    let scale = |law: CableLaw, rest: f64, extra: &dyn Fn(&mut ModelBuilder<2>, tg_model::MemberId)| {
        let mut b = ModelBuilder::<2>::new();
        let peg = b.anchor("peg", [0.0, 0.0]).unwrap();
        let ball = b.particle("ball", 2.0, [3.0, 4.0]).unwrap();
        b.cable("tie", peg, ball.node(0), law, rest).unwrap();
        extra(&mut b, ball);
        let model = b.build().unwrap();
        let (q, v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
        model.force_scale(At { q: &q, v: &v, u: &u, taut: None })
    };
    let none: &dyn Fn(&mut ModelBuilder<2>, tg_model::MemberId) = &|_, _| {};
    let close = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    close(scale(CableLaw::linear(100.0), 4.0, none), 100.0);
    close(scale(CableLaw::linear(100.0), 7.0, none), 200.0);
    close(scale(CableLaw::linear(100.0), 5.0 - 1e-9, none), 1e-4 * 100.0 * 5.0);
    close(scale(CableLaw::slacking(100.0), 5.0 - 1e-9, none), 1e-4 * 100.0 * 5.0);
    close(scale(CableLaw::slacking(100.0), 7.0, none), 0.0);
    close(scale(user(0.0), 4.5, none), 50.0);
    assert!((scale(user(1.0), 5.0 - 1e-6, none) - 1e-4).abs() < 1e-12, "a user's law resolves as it says");
    let push = |b: &mut ModelBuilder<2>, ball: tg_model::MemberId| {
        b.load("push", ball.node(0), [30.0, -300.0], 1.0).unwrap();
    };
    close(scale(CableLaw::linear(100.0), 4.0, &push), 300.0);
    close(scale(CableLaw::linear(100.0), 1.0, &push), 400.0);
    let gravity = |b: &mut ModelBuilder<2>, _: tg_model::MemberId| b.gravity([0.0, -80.0]).unwrap();
    close(scale(CableLaw::linear(100.0), 4.0, &gravity), 160.0);
}

#[test]
fn the_size_of_a_structure_is_its_diagonal_and_the_unit_a_power_of_1024_near_it() {
    let of = |s: f64| build::<2>(|b| b.bar("bar", 1.0, [s, s], [4.0 * s, 5.0 * s]).map(drop)).unwrap();
    for (s, unit) in
        [(1.0, 1.0), (0.01, 1.0), (2.0, 1.0), (1e5, 1024.0 * 1024.0), (1e-6, 1.0 / 1024.0 / 1024.0)]
    {
        let model = of(s);
        assert!((model.size() / (5.0 * s) - 1.0).abs() < 1e-15);
        assert_eq!(model.unit(), unit, "{s:e}");
    }
}
