//! Moments: tangents against differences, power on rigid motions, potentials, couples of forces, inputs, refusals.

use nalgebra::{DMatrix, SMatrix, SVector, Vector3};
use tg_coords::{CoordType, Pose, Twist};
use tg_model::{
    At, BuildError, CableLaw, Load, LoadId, Mechanics, MemberId, Model, ModelBuilder, MomentAxes, Signal,
};

use crate::support::mixed::{Plane, Space, Spatial, member};
use crate::support::{Random, assert_close, derivative, force, select, stiffness};

const MOMENT: [f64; 3] = [0.7, -1.3, 2.1];

/// A member of the plane with a moment.
fn plane(kind: CoordType, r: &mut Random) -> (Model<2>, MemberId, LoadId) {
    let mut b = ModelBuilder::<2>::new();
    let id = b.member("member", member(kind, r), Plane::pose([0.3, -0.2], r)).unwrap();
    let load = b.moment("turn", id, MOMENT[2], Signal::ramp(0.0, 2.0, 2.0)).unwrap();
    (b.build().unwrap(), id, load)
}

/// Which load a member of space has.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Moment(MomentAxes),
    Joint,
}

fn space(kind: CoordType, load: Kind, r: &mut Random) -> (Model<3>, MemberId, LoadId) {
    let mut b = ModelBuilder::<3>::new();
    let id = b.member("member", member(kind, r), Spatial::pose([0.3, -0.2, 0.5], r)).unwrap();
    let load = match load {
        Kind::Moment(axes) => b.moment("turn", id, axes, MOMENT, Signal::ramp(0.0, 2.0, 2.0)),
        Kind::Joint => b.joint_moments("turn", id, [0.7, -1.3], Signal::ramp(0.0, 2.0, 2.0)),
    };
    (b.build().unwrap(), id, load.unwrap())
}

const BODIES: [CoordType; 4] = [CoordType::Ruvw, CoordType::Rrvw, CoordType::Rrrw, CoordType::Rrrr];
const BARS: [CoordType; 2] = [CoordType::Ru, CoordType::Rr];

/// Every load that a member of space may have.
fn spatial_loads() -> Vec<(CoordType, Kind)> {
    let bodies = BODIES
        .into_iter()
        .flat_map(|kind| [(kind, Kind::Moment(MomentAxes::Space)), (kind, Kind::Moment(MomentAxes::Body))]);
    let bars =
        BARS.into_iter().flat_map(|kind| [(kind, Kind::Moment(MomentAxes::Space)), (kind, Kind::Joint)]);
    bodies.chain(bars).collect()
}

const PLANAR: [CoordType; 5] = [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr, CoordType::Ru, CoordType::Rr];

/// The tangent, and with a potential its gradient, away from the constraints.
fn check_tangent<const D: usize>(model: &Model<D>, r: &mut Random, conservative: bool, what: &str) {
    let mut q = model.initial_coordinates();
    q.iter_mut().for_each(|q| *q += 0.1 * r.value());
    let (v, u) = (vec![0.0; q.len()], model.inputs_at(1.3));
    let at = |q| At { q, v: &v, u: &u, taut: None };
    let found = stiffness(model, At { q: &q, v: &v, u: &u, taut: None });
    let expected = -derivative(&q, 1e-3, |q| force(model, At { q, v: &v, u: &u, taut: None }));
    assert_close(&found, &expected, 1e-9, what);
    assert!(found.amax() > 0.1, "{what}: there is a tangent");
    let asymmetry = (&found - found.transpose()).amax();
    let f = force(model, at(&q));
    let gradient = derivative(&q, 1e-3, |q| vec![model.potential(q, &u)]);
    if conservative {
        assert!(asymmetry < 1e-12, "{what}: {asymmetry:e}");
        assert_close(&DMatrix::from_row_slice(1, f.len(), &f), &-gradient, 1e-9, what);
    } else {
        assert!(asymmetry > 0.1, "{what} has no potential");
        assert_eq!(gradient.amax(), 0.0, "{what} is left out of the energy");
        assert_eq!(model.potential(&q, &u), 0.0, "{what} is left out of the energy");
    }
    let largest = f.iter().fold(0.0_f64, |a, f| a.max(f.abs()));
    assert!((model.force_scale(at(&q)) - largest).abs() < 1e-13, "{what}: the only force there is");
}

#[test]
fn tangents_are_the_derivatives_of_the_forces() {
    let r = &mut Random::new(21);
    for kind in PLANAR {
        let (model, ..) = plane(kind, r);
        check_tangent(&model, r, true, &format!("plane {kind}"));
    }
    for (kind, load) in spatial_loads() {
        let (model, ..) = space(kind, load, r);
        check_tangent(&model, r, load == Kind::Joint, &format!("{kind} {load:?}"));
    }
}

/// Power on a rigid motion with this spin and a velocity of the frame's origin.
#[test]
fn tangents_reach_a_member_behind_others() {
    let mut r = Random::new(17);
    let mut b = ModelBuilder::<3>::new();
    for k in 0..3 {
        let x = f64::from(k);
        b.bar(&format!("bar {k}"), 1.0, [x, 0.0, 0.0], [x, 1.0, 0.0]).unwrap();
    }
    let pose = Spatial::pose([5.0, 0.0, 0.0], &mut r);
    let id = b.member("body", member(CoordType::Ruvw, &mut r), pose).unwrap();
    b.moment("turn", id, MomentAxes::Body, MOMENT, Signal::ramp(0.0, 2.0, 2.0)).unwrap();
    check_tangent(&b.build().unwrap(), &mut r, false, "the fourth member");
}

fn power<const D: usize>(model: &Model<D>, id: MemberId, u: &[f64], spin: SMatrix<f64, D, D>) -> f64 {
    let q = model.initial_coordinates();
    let rest = vec![0.0; q.len()];
    let f = force(model, At { q: &q, v: &rest, u, taut: None });
    let mut v = rest.clone();
    let velocity = SVector::from_fn(|i, _| 0.3 - i as f64);
    model.set_twist(id, &Twist { velocity, spin }, &q, &mut v).unwrap();
    f.iter().zip(&v).map(|(f, v)| f * v).sum()
}

#[test]
fn power_is_that_of_the_moment_on_every_rigid_motion() {
    let r = &mut Random::new(22);
    let rate = 0.8;
    for kind in PLANAR {
        let (model, id, load) = plane(kind, r);
        let u = model.inputs_at(1.0);
        let found = power(&model, id, &u, SMatrix::<f64, 2, 2>::new(0.0, -rate, rate, 0.0));
        assert!((found - u[model.load_inputs(load).start] * rate).abs() < 1e-13, "{kind}");
    }
    for (kind, load) in spatial_loads() {
        let (model, id, _) = space(kind, load, r);
        let (q, u) = (model.initial_coordinates(), model.inputs_at(1.0));
        for spin in [Vector3::new(0.4, 0.1, -0.7), Vector3::new(-1.0, 2.0, 0.3)] {
            let nodes = model.member_nodes(id, &q);
            let along = if kind == CoordType::Rr { nodes[1] - nodes[0] } else { nodes[1] }.normalize();
            let expected = match load {
                Kind::Moment(MomentAxes::Space) if kind.span() == 1 => {
                    // Without spin.
                    Vector3::from(MOMENT).dot(&(spin - along * along.dot(&spin)))
                }
                Kind::Moment(MomentAxes::Space) => Vector3::from(MOMENT).dot(&spin),
                Kind::Moment(MomentAxes::Body) => {
                    (model.pose(id, &q).unwrap().pose.rotation * Vector3::from(MOMENT)).dot(&spin)
                }
                Kind::Joint => {
                    // M_ε ε̇ + M_β β̇ from the velocity of the bar's direction.
                    let angles = |u: Vector3<f64>| [(-u.y).atan2(u.z), u.x.atan2(u.y.hypot(u.z))];
                    let h = 1e-6;
                    let rate = spin.cross(&along);
                    let (ahead, behind) = (angles(along + rate * h), angles(along - rate * h));
                    (0.7 * (ahead[0] - behind[0]) - 1.3 * (ahead[1] - behind[1])) / (2.0 * h)
                }
            };
            let tolerance = if load == Kind::Joint { 1e-8 } else { 1e-12 };
            let found = power(&model, id, &u, spin.cross_matrix());
            assert!((found - expected).abs() < tolerance, "{kind} {load:?}: {found} {expected}");
        }
    }
}

/// Two opposite forces do the work of their moment.
#[test]
fn couples_are_moments() {
    let r = &mut Random::new(23);
    for kind in BODIES {
        let (body, pose) = (member(kind, r), Spatial::pose([0.1, 0.2, 0.3], r));
        let points = [[0.5, -0.1, 0.2], [-0.3, 0.4, 0.1]];
        let pull = Vector3::new(1.0, 2.0, -0.5);
        let lever = pose.apply_point(&points[0].into()) - pose.apply_point(&points[1].into());
        let mut b = ModelBuilder::<3>::new();
        let id = b.member("body", body.clone(), pose).unwrap();
        b.load("up", id.at(points[0]), pull.into(), 1.0).unwrap();
        b.load("down", id.at(points[1]), (-pull).into(), 1.0).unwrap();
        let couple = b.build().unwrap();
        let mut b = ModelBuilder::<3>::new();
        let id = b.member("body", body, pose).unwrap();
        b.moment("turn", id, MomentAxes::Space, lever.cross(&pull).into(), 1.0).unwrap();
        let moment = b.build().unwrap();
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let spin = axis.cross_matrix();
            let ours = power(&moment, id, &moment.inputs_at(0.0), spin);
            let theirs = power(&couple, id, &couple.inputs_at(0.0), spin);
            assert!((ours - theirs).abs() < 1e-12, "{kind}");
        }
    }
}

/// In the plane the work of a constant moment is moment times angle, along any path shorter than half a turn.
#[test]
fn potential_counts_the_angle_from_the_pose_as_built() {
    let r = &mut Random::new(24);
    for kind in PLANAR {
        let (model, id, load) = plane(kind, r);
        let u = model.inputs_at(1.0);
        let m = u[model.load_inputs(load).start];
        let start = model.pose(id, &model.initial_coordinates()).unwrap().pose;
        for angle in [-3.0, -1.0, 0.0, 0.5, 2.9] {
            let turn = Pose::planar(0.7, 0.1, angle);
            let pose = Pose { position: turn.position, rotation: turn.rotation * start.rotation };
            let q: Vec<f64> =
                model.member(id).place(&pose).iter().flat_map(|node| node.iter().copied()).collect();
            let energy = model.energy(&q, &vec![0.0; q.len()], &u).load;
            assert!((energy + m * angle).abs() < 1e-12, "{kind}: {angle}");
        }
    }
}

#[test]
fn inputs_are_rest_lengths_and_then_the_loads_in_their_order() {
    let r = &mut Random::new(25);
    let mut b = ModelBuilder::<3>::new();
    let body = b.member("body", member(CoordType::Ruvw, r), Pose::identity()).unwrap();
    let bar = b.bar("bar", 1.0, [2.0, 0.0, 0.0], [2.0, 0.0, 1.0]).unwrap();
    b.cable("tie", body.mass_centre(), bar.node(1), CableLaw::linear(10.0), 0.4).unwrap();
    let force = b.load("force", bar.node(0), [1.0, 2.0, 3.0], 1.0).unwrap();
    let moment = b.moment("moment", body, MomentAxes::Body, MOMENT, Signal::ramp(0.0, 1.0, 1.0)).unwrap();
    let joint = b.joint_moments("joint", bar, [4.0, 5.0], 2.0).unwrap();
    let last = b.load("last", bar.node(1), [6.0, 7.0, 8.0], 1.0).unwrap();
    let model = b.build().unwrap();
    assert_eq!(model.sizes().inputs, 12);
    let ranges = [force, moment, joint, last].map(|load| model.load_inputs(load));
    assert_eq!(ranges, [1..4, 4..7, 7..9, 9..12]);
    assert_eq!(model.loads().collect::<Vec<_>>(), [force, moment, joint, last]);
    assert_eq!(model.load(joint), Load::JointMoments(bar));
    assert_eq!(model.load_name(moment), "moment");
    let half = MOMENT.map(|m| 0.5 * m);
    let expected = [&[0.4, 1.0, 2.0, 3.0], half.as_slice(), &[8.0, 10.0, 6.0, 7.0, 8.0]].concat();
    assert_eq!(model.inputs_at(0.5), expected);
    assert!(model.features().driven_inputs);
}

/// A scene pays only for its own moments: two nodes of a bar in space are four blocks of nine.
#[test]
fn the_pattern_grows_by_the_loaded_member_only() {
    let build = |with: bool| {
        let mut b = ModelBuilder::<3>::new();
        let anchor = b.anchor("foot", [0.0; 3]).unwrap();
        let bar = b.bar("bar", 1.0, [1.0, 0.0, 0.0], [1.0, 0.2, 1.0]).unwrap();
        let other = b.bar("other", 1.0, [2.0, 0.0, 0.0], [2.0, 0.2, 1.0]).unwrap();
        let tie = b.cable("tie", anchor, bar.node(1), CableLaw::linear(10.0), 0.4).unwrap();
        b.cable("far", anchor, other.node(1), CableLaw::slacking(10.0), 0.4).unwrap();
        if with {
            b.joint_moments("joint", bar, [4.0, 5.0], 1.0).unwrap();
        }
        (b.build().unwrap(), tie)
    };
    let ((without, _), (with, tie)) = (build(false), build(true));
    let (old, new) = (without.stiffness_pattern(), with.stiffness_pattern());
    assert_eq!(new.len(), old.len() + 4 * 9);
    assert_eq!(&new[..old.len()], old, "the cables' entries come first");
    // Another law moves the cables' entries; the moments' follow.
    let changed = with.with_law(tie, CableLaw::slacking(20.0)).unwrap();
    let (q, u) = (changed.initial_coordinates(), changed.inputs_at(0.0));
    let rest = vec![0.0; q.len()];
    let at = |q| At { q, v: &rest, u: &u, taut: None };
    let expected = -derivative(&q, 1e-3, |q| force(&changed, At { q, v: &rest, u: &u, taut: None }));
    let free = changed.free();
    let found = stiffness(&changed, at(&q));
    assert_close(&select(&found, free, free), &select(&expected, free, free), 1e-8, "with another law");
}

#[test]
fn meaningless_moments_are_refused() {
    let r = &mut Random::new(26);
    let mut b = ModelBuilder::<3>::new();
    let ball = b.particle("ball", 1.0, [0.0; 3]).unwrap();
    let bar = b.bar("bar", 1.0, [1.0, 0.0, 0.0], [1.0, 0.0, 1.0]).unwrap();
    let body = b.member("body", member(CoordType::Ruvw, r), Pose::identity()).unwrap();
    let message = |add: &dyn Fn(&mut ModelBuilder<3>) -> Result<LoadId, BuildError>| {
        let mut b = b.clone();
        add(&mut b).unwrap();
        b.build().unwrap_err().to_string()
    };
    let space = MomentAxes::Space;
    assert!(message(&|b| b.moment("m", ball, space, MOMENT, 1.0)).contains("put a force on it"));
    assert!(message(&|b| b.moment("m", ball, MomentAxes::Body, MOMENT, 1.0)).contains("put a force on it"));
    assert!(message(&|b| b.moment("m", bar, MomentAxes::Body, MOMENT, 1.0)).contains("axes of space"));
    assert!(message(&|b| b.joint_moments("m", body, [1.0, 2.0], 1.0)).contains("holds a bar"));
    assert!(message(&|b| b.joint_moments("m", ball, [1.0, 2.0], 1.0)).contains("holds a bar"));
    let mut other = ModelBuilder::<3>::new();
    other.particle("alone", 1.0, [0.0; 3]).unwrap();
    other.moment("m", body, space, MOMENT, 1.0).unwrap();
    assert!(matches!(other.build(), Err(BuildError::Dangling { .. })));
    assert!(b.moment("m", body, space, [f64::NAN, 0.0, 0.0], 1.0).is_err());
    b.moment("m", body, space, MOMENT, 1.0).unwrap();
    assert!(matches!(b.load("m", bar.node(0), MOMENT, 1.0), Err(BuildError::DuplicateName { .. })));
}

#[test]
fn a_moment_on_a_held_member_has_no_tangent() {
    let entries = |loaded: bool| {
        let mut b = ModelBuilder::<3>::new();
        b.bar("free", 1.0, [5.0, 0.0, 0.0], [5.0, 1.0, 0.0]).unwrap();
        let held = b.bar("held", 1.0, [0.0; 3], [0.0, 0.0, 1.0]).unwrap();
        b.fix("foot", held.node(0)).unwrap();
        b.fix("top", held.node(1)).unwrap();
        if loaded {
            b.moment("turn", held, MomentAxes::Space, MOMENT, 1.0).unwrap();
        }
        b.build().unwrap().stiffness_pattern().len()
    };
    assert_eq!(entries(true), entries(false));
}
