//! Redundant constraints: named, or dropped where they are implied in every configuration.

use crate::support::{Random, build, violation};
use tg_model::Joining::{Constrain, Share};
use tg_model::{BuildError, Mechanics, MemberId, Model, ModelBuilder, Projector, Redundancies, Signal};

fn redundant<const D: usize>(result: Result<Model<D>, BuildError>) -> (Vec<tg_model::Redundancy>, String) {
    let error = result.unwrap_err();
    let text = error.to_string();
    let BuildError::Redundant { list, tolerance } = error else { panic!("{text}") };
    assert!(tolerance > 1e-12 && list.iter().all(|r| r.sine <= tolerance));
    (list, text)
}

/// Two cranks of one length, a coupler, and a third crank parallel to them on the coupler's middle.
fn parallelogram(b: &mut ModelBuilder<2>, last: [f64; 2]) -> Result<Vec<MemberId>, BuildError> {
    let pegs = [b.anchor("A", [0.0, 0.0])?, b.anchor("B", [2.0, 0.0])?, b.anchor("C", last)?];
    let cranks = [
        b.bar("crank A", 1.0, [0.0, 0.0], [0.0, 1.0])?,
        b.bar("crank B", 1.0, [2.0, 0.0], [2.0, 1.0])?,
        b.bar("crank C", 1.0, last, [1.0, 1.0])?,
    ];
    let coupler = b.bar("coupler", 1.0, [0.0, 1.0], [2.0, 1.0])?;
    for ((peg, crank), name) in pegs.into_iter().zip(cranks).zip(["foot A", "foot B", "foot C"]) {
        b.joint(name, &[peg.into(), crank.node(0)], Share)?;
    }
    b.joint("left", &[cranks[0].node(1), coupler.node(0)], Share)?;
    b.joint("right", &[cranks[1].node(1), coupler.node(1)], Share)?;
    b.joint("middle", &[cranks[2].node(1), coupler.at([1.0, 1.0])], Constrain)?;
    Ok(cranks.into_iter().chain([coupler]).collect())
}

#[test]
fn a_third_parallel_bar_is_named() {
    let (list, text) = redundant(build::<2>(|b| parallelogram(b, [1.0, 0.0]).map(drop)));
    assert_eq!(list.len(), 1);
    let all: Vec<&str> = list[0].implied_by.iter().chain([&list[0].constraint]).map(String::as_str).collect();
    for name in ["crank A", "crank B", "crank C", "middle"] {
        assert!(all.iter().any(|words| words.contains(name)), "{name} in {all:?}");
    }
    assert!(text.starts_with("1 redundant constraint ") && text.contains(&list[0].constraint), "{text}");
    // Not parallel: regular and rigid.
    let braced = build::<2>(|b| parallelogram(b, [1.3, 0.0]).map(drop)).unwrap();
    assert_eq!(braced.report().degrees_of_freedom(), 0);
}

#[test]
fn a_dropped_parallel_bar_stays_satisfied_along_the_motion() {
    let mut members = Vec::new();
    let model = build::<2>(|b| {
        b.redundancies(Redundancies::Drop);
        members = parallelogram(b, [1.0, 0.0])?;
        Ok(())
    });
    let model = model.unwrap();
    assert_eq!(model.report().redundant.len(), 1);
    assert_eq!(model.report().degrees_of_freedom(), 1);
    let dropped = &model.report().redundant[0].constraint;
    assert!(model.report().to_string().contains(dropped.as_str()));
    assert!((0..model.sizes().constraints).all(|c| model.constraint_name(c) != *dropped));

    // Turn crank A by steps of 0.05 and let the projector find the rest.
    let mut projector = Projector::new(&model).unwrap();
    let mut q = model.initial_coordinates();
    let tip = model.form(members[0].node(1)).unwrap().terms()[0].0 * 2;
    for _ in 0..12 {
        let angle = q[tip].atan2(q[tip + 1]) + 0.05;
        (q[tip], q[tip + 1]) = (angle.sin(), angle.cos());
        projector.position(&mut q).unwrap();
        assert!(violation(&model, &q) < 1e-13);
        assert!(model.dropped_violation(&q) < 1e-12, "{}", model.dropped_violation(&q));
    }
    assert!(q[tip] > 0.2, "the linkage must have moved");
    for crank in &members[..3] {
        let nodes = model.member_nodes(*crank, &q);
        assert!(((nodes[1] - nodes[0]) - nalgebra::Vector2::new(q[tip], q[tip + 1])).norm() < 1e-11);
    }
}

#[test]
fn a_joint_given_twice_is_named_twice() {
    for dimension_three in [false, true] {
        let (list, text) =
            if dimension_three { redundant(build::<3>(twice)) } else { redundant(build::<2>(twice)) };
        assert_eq!(list.len(), if dimension_three { 3 } else { 2 });
        for r in &list {
            assert_eq!(r.implied_by.len(), 1);
            let pair = format!("{} {}", r.constraint, r.implied_by[0]);
            assert!(pair.contains("\"once\"") && pair.contains("\"again\""), "{pair}");
            assert_eq!(r.constraint[..1], r.implied_by[0][..1], "same component");
        }
        assert!(text.contains("once") && text.contains("again"));
    }
}

fn twice<const D: usize>(b: &mut ModelBuilder<D>) -> Result<(), BuildError> {
    let mut far = [0.0; D];
    far[0] = 1.0;
    let bars = [b.bar("one", 1.0, [0.0; D], far)?, b.bar("two", 1.0, far, [2.0; D])?];
    b.joint("once", &[bars[0].node(1), bars[1].node(0)], Constrain)?;
    b.joint("again", &[bars[0].node(1), bars[1].node(0)], Constrain)
}

/// A square grid of `k` by `k` cells with both diagonals in each: 4k² + 2k bars between (k + 1)² hinges.
fn lattice(b: &mut ModelBuilder<2>, k: usize) -> Result<(), BuildError> {
    let mut at = vec![Vec::new(); (k + 1) * (k + 1)];
    let mut add = |b: &mut ModelBuilder<2>, from: (usize, usize), to: (usize, usize)| {
        let x = |p: (usize, usize)| [p.0 as f64, p.1 as f64];
        let bar = b.bar(&format!("bar {from:?}-{to:?}"), 1.0, x(from), x(to))?;
        at[from.0 * (k + 1) + from.1].push(bar.node(0));
        at[to.0 * (k + 1) + to.1].push(bar.node(1));
        Ok::<(), BuildError>(())
    };
    for i in 0..=k {
        for j in 0..=k {
            if i < k {
                add(b, (i, j), (i + 1, j))?;
            }
            if j < k {
                add(b, (i, j), (i, j + 1))?;
            }
            if i < k && j < k {
                add(b, (i, j), (i + 1, j + 1))?;
                add(b, (i + 1, j), (i, j + 1))?;
            }
        }
    }
    for (n, places) in at.iter().enumerate() {
        b.joint(&format!("hinge {n}"), places, Share)?;
    }
    Ok(())
}

#[test]
fn a_lattice_has_as_many_redundant_bars_as_it_has_states_of_self_stress() {
    for k in [1, 2, 4] {
        let (list, text) = redundant(build::<2>(|b| lattice(b, k)));
        let (bars, hinges) = (4 * k * k + 2 * k, (k + 1) * (k + 1));
        assert_eq!(list.len(), bars - (2 * hinges - 3));
        assert!(list.iter().all(|r| r.constraint.contains("bar (") && !r.implied_by.is_empty()), "{text}");
        let model = build::<2>(|b| {
            b.redundancies(Redundancies::Drop);
            lattice(b, k)
        });
        let model = model.unwrap();
        assert_eq!(model.report().degrees_of_freedom(), 3);
        assert_eq!(model.report().redundant, list);
        // Anywhere in the plane, reached by the kept constraints alone.
        let mut q = model.initial_coordinates();
        let (s, c) = 0.7f64.sin_cos();
        let r = &mut Random::new(9);
        for x in q.chunks_exact_mut(2) {
            let moved = [c * x[0] - s * x[1] + 3.0, s * x[0] + c * x[1] - 1.0];
            (x[0], x[1]) = (moved[0] + 1e-3 * r.value(), moved[1] + 1e-3 * r.value());
        }
        assert!(model.dropped_violation(&q) > 1e-5);
        Projector::new(&model).unwrap().position(&mut q).unwrap();
        assert!(model.dropped_violation(&q) < 1e-12);
    }
}

/// Two bars of length one between anchors, their hinge `height` above the line.
fn toggle(b: &mut ModelBuilder<2>, height: f64) -> Result<MemberId, BuildError> {
    let x = (1.0 - height * height).sqrt();
    let pegs = [b.anchor("A", [-x, 0.0])?, b.anchor("B", [x, 0.0])?];
    let bars = [b.bar("left", 1.0, [-x, 0.0], [0.0, height])?, b.bar("right", 1.0, [x, 0.0], [0.0, height])?];
    for (k, name) in ["foot A", "foot B"].into_iter().enumerate() {
        b.joint(name, &[pegs[k].into(), bars[k].node(0)], Share)?;
    }
    b.joint("knee", &[bars[0].node(1), bars[1].node(1)], Share)?;
    Ok(bars[0])
}

#[test]
fn a_nearly_singular_pose_is_regular_a_singular_one_is_not() {
    for height in [0.5, 1e-3, 1e-6] {
        let model = build::<2>(|b| toggle(b, height).map(drop)).unwrap();
        assert_eq!(model.report().degrees_of_freedom(), 0, "height {height}");
    }
    let (list, _) = redundant(build::<2>(|b| toggle(b, 0.0).map(drop)));
    assert_eq!(list.len(), 1);
    assert!(list[0].constraint.contains("right") && list[0].implied_by[0].contains("left"));
}

#[test]
fn dropping_what_is_singular_only_there_shows_during_the_motion() {
    let mut left = None;
    let model = build::<2>(|b| {
        b.redundancies(Redundancies::Drop);
        left = Some(toggle(b, 0.0)?);
        Ok(())
    });
    let model = model.unwrap();
    assert_eq!(model.report().degrees_of_freedom(), 1);
    let mut q = model.initial_coordinates();
    assert!(model.dropped_violation(&q) < 1e-15);
    let tip = model.form(left.unwrap().node(1)).unwrap().terms()[0].0 * 2;
    (q[tip], q[tip + 1]) = (-0.5, 0.75f64.sqrt());
    let mut projector = Projector::new(&model).unwrap();
    projector.position(&mut q).unwrap();
    // Turned by 60° about A, the knee is √3 from B: |..|² - 1 = 2.
    assert!(model.dropped_violation(&q) > 0.5);
    q[tip] = f64::NAN;
    assert!(model.dropped_violation(&q).is_nan(), "not finite is not satisfied");
}

#[test]
fn dropping_does_not_hide_a_contradiction() {
    // One material point held by one support and moved by another: the same gradient, different rates.
    let contradiction = |offset: Signal, policy: Redundancies| {
        build::<2>(|b| {
            b.redundancies(policy);
            let bar = b.bar("bar", 1.0, [0.0, 0.0], [2.0, 0.0])?;
            b.support("held", bar.at([0.5, 0.0]), 1, 0.0)?;
            b.support("moved", bar.at([0.5, 0.0]), 1, offset)
        })
    };
    for policy in [Redundancies::Reject, Redundancies::Drop] {
        // The rates differ, however slow they are, or the places do.
        for offset in [Signal::sine(0.1, 1.0), Signal::sine(1e-4, 1e-4), Signal::Constant(0.1)] {
            let error = contradiction(offset, policy).unwrap_err().to_string();
            assert!(error.contains("held") && error.contains("moved"), "{error}");
        }
    }
    let agreeing = contradiction(0.0.into(), Redundancies::Drop).unwrap();
    assert_eq!(agreeing.report().redundant.len(), 1);
}

#[test]
fn a_constraint_that_nothing_free_can_change_is_named() {
    // The free component is at right angles to the bar: its gradient vanishes.
    let result = build::<2>(|b| {
        let bar = b.bar("strut", 1.0, [0.0, 0.0], [0.0, 1.0])?;
        b.fix("foot", bar.node(0))?;
        b.support("rail", bar.node(1), 1, 0.0)
    });
    let (list, text) = redundant(result);
    assert_eq!((list.len(), list[0].implied_by.len()), (1, 0));
    assert!(text.contains("rigidity u·u of \"strut\" is implied by the supports"), "{text}");
}

#[test]
fn a_support_between_held_points_must_agree_with_them() {
    // Both ends and the quarter point of a bar that is neither level nor upright, at heights 1, 3 and 1.5 m.
    let held = |offset: f64| {
        build::<2>(|b| {
            let bar = b.bar("bar", 1.0, [0.0, 1.0], [1.0, 3.0])?;
            b.support("low", bar.node(0), 1, 0.0)?;
            b.support("high", bar.node(1), 1, 0.0)?;
            b.support("between", bar.at([0.25, 1.5]), 1, offset)
        })
    };
    assert!(held(0.0).is_ok());
    let error = held(0.1).unwrap_err();
    assert!(
        matches!(&error, BuildError::UnsatisfiableConstraint { constraint, .. } if constraint.contains("between"))
    );
}

#[test]
fn the_worst_dropped_constraint_counts_per_size_wherever_it_stands() {
    const L: f64 = 10.0;
    // Two toggles that lie on lines: of each one rigidity is dropped.
    let mut knees = Vec::new();
    let model = build::<2>(|b| {
        b.redundancies(Redundancies::Drop);
        for (k, y) in [0.0, 5.0 * L].into_iter().enumerate() {
            let pegs = [b.anchor(&format!("A{k}"), [-L, y])?, b.anchor(&format!("B{k}"), [L, y])?];
            let left = b.bar(&format!("left {k}"), 1.0, [-L, y], [0.0, y])?;
            let right = b.bar(&format!("right {k}"), 1.0, [L, y], [0.0, y])?;
            b.joint(&format!("foot A{k}"), &[pegs[0].into(), left.node(0)], Share)?;
            b.joint(&format!("foot B{k}"), &[pegs[1].into(), right.node(0)], Share)?;
            b.joint(&format!("knee {k}"), &[left.node(1), right.node(1)], Share)?;
            knees.push((left, y));
        }
        Ok(())
    });
    let model = model.unwrap();
    assert_eq!(model.report().redundant.len(), 2);
    for (left, y) in knees {
        // Turned by 60° about A, the knee is √3 L from B: |..|² - L² = 2 L².
        let mut q = model.initial_coordinates();
        let tip = model.form(left.node(1)).unwrap().terms()[0].0 * 2;
        (q[tip], q[tip + 1]) = (-0.5 * L, y + 0.75f64.sqrt() * L);
        assert!((model.dropped_violation(&q) - 2.0).abs() < 1e-12, "{}", model.dropped_violation(&q));
        q[tip] = f64::NAN;
        assert!(model.dropped_violation(&q).is_nan());
    }
}

#[test]
fn supports_of_one_point_agree_or_differ_by_their_rates_and_places() {
    let twice = |first: Signal, second: Signal| {
        build::<2>(|b| {
            b.redundancies(Redundancies::Drop);
            let bar = b.bar("bar", 1.0, [0.0, 0.0], [2.0, 0.0])?;
            b.support("first", bar.at([0.5, 0.0]), 1, first)?;
            b.support("second", bar.at([0.5, 0.0]), 1, second)
        })
    };
    // Alike, however they move and wherever they are.
    for signal in [Signal::sine(0.1, 1.0), Signal::Constant(0.1), Signal::ramp(0.2, 0.5, 1.0)] {
        let model = twice(signal.clone(), signal).unwrap();
        assert_eq!(model.report().redundant.len(), 1);
    }
    // Rates of 0.1 and 0.2 differ by a third of both together.
    let sines = [Signal::sine(0.1, 1.0), Signal::sine(0.2, 1.0)];
    for [first, second] in [sines.clone(), [sines[1].clone(), sines[0].clone()]] {
        let Err(BuildError::ContradictoryConstraint { violation, .. }) = twice(first, second) else {
            panic!("a contradiction")
        };
        assert!((violation - 1.0 / 3.0).abs() < 1e-12, "{violation}");
    }
}
