//! Questions to a model: forms, poses, twists, energies, names.

use crate::support::examples::{TRIANGLE_MASS, TRIANGLE_POLAR, pendulum, triangle};
use crate::support::mixed::{Mixed, Plane, Space, Spatial, local_point, member, mixed, rigid_motion};
use crate::support::{Random, mass};
use approx::assert_relative_eq;
use nalgebra::{SMatrix, SVector, Vector2, Vector3};
use tg_coords::{CoordType, Twist};
use tg_model::Joining::{Constrain, Share};
use tg_model::{CableLaw, Mechanics, ModelBuilder, PlaceError, Signal};

#[test]
fn poses_and_forms_of_every_type() {
    fn check<S: Space<D>, const D: usize>() {
        let r = &mut Random::new(41);
        let mut b = ModelBuilder::<D>::new();
        let mut parts = Vec::new();
        for &kind in S::TYPES {
            let (body, pose) = (member::<D>(kind, r), S::pose(r.array(3.0), r));
            parts.push((b.member(kind.name(), body.clone(), pose).unwrap(), body, pose));
        }
        let model = b.build().unwrap();
        let q = model.initial_coordinates();
        for (id, body, pose) in &parts {
            assert_eq!(model.member_name(*id), body.coord_type().name());
            assert_eq!(model.member_nodes(*id, &q).len(), body.coord_type().nodes());
            for _ in 0..5 {
                let local = local_point(body, r);
                let found = model.form(id.at(local.into())).unwrap().eval(&q);
                assert_relative_eq!(found, pose.apply_point(&local), epsilon = 1e-13);
                let fit = model.pose(*id, &q).unwrap();
                assert!(fit.misfit < 1e-14);
                assert_relative_eq!(fit.pose.apply_point(&local), pose.apply_point(&local), epsilon = 1e-13);
            }
            let centre = body.mass_properties().centre();
            let found = model.form(id.mass_centre()).unwrap().eval(&q);
            assert_relative_eq!(found, pose.apply_point(&centre), epsilon = 1e-13);
            if body.coord_type().span() == D {
                let fit = model.pose(*id, &q).unwrap().pose;
                assert_relative_eq!(fit.rotation, pose.rotation, epsilon = 1e-13);
                assert_relative_eq!(fit.position, pose.position, epsilon = 1e-13);
            }
        }
    }
    check::<Plane, 2>();
    check::<Spatial, 3>();
}

#[test]
fn places_that_are_not_of_the_model() {
    let built = pendulum([Share, Share], CoordType::Ruv, 0.5).unwrap();
    let mut other = ModelBuilder::<2>::new();
    let foreign = [0, 1, 2].map(|k| other.bar(&format!("{k}"), 1.0, [0.0; 2], [1.0, 0.0]).unwrap())[2];
    let pegs = [0, 1].map(|k| other.anchor(&format!("{k}"), [0.0; 2]).unwrap());
    for place in [foreign.node(0), foreign.at([0.0, 0.0]), foreign.mass_centre()] {
        assert!(matches!(built.model.form(place), Err(PlaceError::NoSuchMember(2))));
    }
    assert!(matches!(built.model.form(pegs[1]), Err(PlaceError::NoSuchAnchor(1))));
    assert!(built.model.form(pegs[0]).is_ok());
    let error = built.model.form(built.bar.node(2)).unwrap_err();
    assert!(matches!(error, PlaceError::NoSuchNode { node: 2, nodes: 2, .. }));
    assert!(error.to_string().contains("\"bar\" has no node 2"), "{error}");
    for local in [[0.05, 0.05], [f64::NAN, 0.0]] {
        let error = built.model.form(built.bar.at(local)).unwrap_err();
        assert!(matches!(error, PlaceError::NotOfMember { .. }) && error.to_string().contains("\"bar\""));
    }
}

#[test]
fn twists_make_the_round_trip() {
    let r = &mut Random::new(43);
    for kind in CoordType::ALL.into_iter().filter(|kind| kind.fits(3)) {
        let mut b = ModelBuilder::<3>::new();
        let id = b.member("body", member::<3>(kind, r), Spatial::pose(r.array(1.0), r)).unwrap();
        b.particle("bystander", 1.0, [9.0; 3]).unwrap();
        let model = b.build().unwrap();
        let q = model.initial_coordinates();
        let mut v = vec![5.0; q.len()];
        let twist = Twist::spatial(Vector3::from(r.array(1.0)), Vector3::from(r.array(2.0)));
        model.set_twist(id, &twist, &q, &mut v).unwrap();
        assert_eq!(v[v.len() - 3..], [5.0; 3], "other members stay");
        // Against the motion of the placed body over a short time.
        let h = 1e-6;
        let nodes = model.member_nodes(id, &q);
        let origin = model.pose(id, &q).unwrap().pose.position;
        for (a, rate) in model.member_nodes(id, &v).into_iter().enumerate() {
            let arm = if kind.is_point(a) { nodes[a] - origin } else { nodes[a] };
            let omega = twist.angular_velocity();
            let turned = arm + omega.cross(&arm) * h;
            let moved = if kind.is_point(a) { turned + twist.velocity * h } else { turned };
            assert_relative_eq!(rate, (moved - arm) / h, epsilon = 1e-8);
        }
        let found = model.twist(id, &q, &v).unwrap();
        if kind.span() == 3 {
            assert_relative_eq!(found.velocity, twist.velocity, epsilon = 1e-12);
            assert_relative_eq!(found.spin, twist.spin, epsilon = 1e-12);
        } else if kind.span() == 1 {
            // The spin of a bar about its axis is not in its coordinates.
            let axis = if kind == CoordType::Rr { nodes[1] - nodes[0] } else { nodes[1] }.normalize();
            let omega = twist.angular_velocity();
            let across = omega - axis * axis.dot(&omega);
            assert_relative_eq!(found.angular_velocity(), across, epsilon = 1e-12);
        }
    }
}

#[test]
fn a_bar_has_a_pose() {
    let built = pendulum([Share, Constrain], CoordType::Rrr, 0.5).unwrap();
    let mut q = built.model.initial_coordinates();
    // The bar straight down: its local direction (1, -1) turned by -45°.
    let tip = built.model.form(built.bar.node(1)).unwrap().terms()[0].0 * 2;
    (q[tip], q[tip + 1]) = (0.0, -0.05 * 2f64.sqrt());
    let pose = built.model.pose(built.bar, &q).unwrap().pose;
    assert_relative_eq!(pose.angle(), -45f64.to_radians(), epsilon = 1e-14);
    assert_relative_eq!(pose.position, Vector2::zeros(), epsilon = 1e-15);
    (q[tip], q[tip + 1]) = (0.0, 0.0);
    assert!(built.model.pose(built.bar, &q).is_err(), "a collapsed bar has no direction");
}

/// ½ m v² + ½ ω·I ω of every member of a structure that moves as one rigid body.
#[test]
fn kinetic_energy_of_a_rigid_motion() {
    fn check<S: Space<D>, const D: usize>(
        rotational: impl Fn(&SMatrix<f64, D, D>, &SMatrix<f64, D, D>) -> f64,
    ) {
        for seed in 0..5 {
            let mixed: Mixed<D> = mixed::<S, D>(seed, false);
            let q = mixed.model.initial_coordinates();
            let r = &mut Random::new(seed);
            let t = SVector::<f64, D>::from(r.array(2.0));
            let half = SMatrix::<f64, D, D>::from_fn(|_, _| r.value());
            let spin = half - half.transpose();
            let v = rigid_motion(&mixed, &q, t, spin);
            let mut expected = 0.0;
            for (id, body) in &mixed.members {
                let (pose, mass) = (mixed.model.pose(*id, &q).unwrap().pose, body.mass_properties());
                let centre = pose.apply_point(&mass.centre());
                let j = pose.rotation * mass.second_moment() * pose.rotation.transpose();
                expected += 0.5 * mass.mass() * (t + spin * centre).norm_squared() + rotational(&j, &spin);
            }
            let found = mixed.model.energy(&q, &v, &mixed.model.inputs_at(0.0)).kinetic;
            assert_relative_eq!(found, expected, max_relative = 1e-12);
            let velocity = nalgebra::DVector::from_vec(v.clone());
            let dense = 0.5 * (velocity.transpose() * mass(&mixed.model) * &velocity)[0];
            assert_relative_eq!(found, dense, max_relative = 1e-12);
        }
    }
    check::<Plane, 2>(|j, spin| 0.5 * (j[(0, 0)] + j[(1, 1)]) * spin[(1, 0)].powi(2));
    check::<Spatial, 3>(|j, spin| {
        let omega = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        0.5 * (j.trace() * omega.norm_squared() - omega.dot(&(j * omega)))
    });
}

#[test]
fn the_split_of_a_planar_second_moment_does_not_matter() {
    let r = &mut Random::new(47);
    for kind in [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr] {
        let (twist, pose) = (Twist::planar(Vector2::from(r.array(1.0)), 3.0), Plane::pose(r.array(1.0), r));
        let energies = [0.0, 0.25, 0.5, 1.0].map(|split| {
            let mut b = ModelBuilder::<2>::new();
            let id = b.member("triangle", triangle(kind, split), pose).unwrap();
            let model = b.build().unwrap();
            let q = model.initial_coordinates();
            let mut v = vec![0.0; q.len()];
            model.set_twist(id, &twist, &q, &mut v).unwrap();
            model.energy(&q, &v, &[]).kinetic
        });
        let centre = pose.apply_vector(&Vector2::new(0.05, 0.05 / 3.0));
        let rate = twist.velocity + twist.spin * centre;
        let expected = 0.5 * TRIANGLE_MASS * rate.norm_squared() + 0.5 * TRIANGLE_POLAR * 9.0;
        for energy in energies {
            assert_relative_eq!(energy, expected, max_relative = 1e-12);
        }
    }
}

#[test]
fn energies_by_hand() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let peg = b.anchor("peg", [0.0, 0.0]).unwrap();
    let bar = b.bar("bar", 3.0, [1.0, 2.0], [3.0, 2.0]).unwrap();
    let tie = b.cable("tie", peg, bar.at([2.0, 2.0]), CableLaw::slacking(10.0), 2.0).unwrap();
    let push = b.load("push", bar.node(1), [4.0, -1.0], Signal::ramp(1.0, 3.0, 2.0)).unwrap();
    let model = b.build().unwrap();
    let (q, u) = (model.initial_coordinates(), model.inputs_at(1.0));
    let mut v = vec![0.0; q.len()];
    let state = model.cable(tie, &q, &v, &u);
    assert_relative_eq!(state.length, 8f64.sqrt(), max_relative = 1e-15);
    model.set_twist(bar, &Twist::planar(Vector2::new(1.0, 0.0), 2.0), &q, &mut v).unwrap();
    let energy = model.energy(&q, &v, &u);
    // The frame of a bar made between points of space is that of space: v_centre = (1, 0) + 2 (-2, 2).
    let kinetic = 0.5 * 3.0 * (9.0 + 16.0) + 0.5 * (3.0 * 4.0 / 12.0) * 4.0;
    assert_relative_eq!(energy.kinetic, kinetic, max_relative = 1e-14);
    assert_relative_eq!(energy.gravity, 3.0 * 9.81 * 2.0, max_relative = 1e-14);
    assert_relative_eq!(energy.elastic, 5.0 * (8f64.sqrt() - 2.0).powi(2), max_relative = 1e-14);
    assert_relative_eq!(energy.load, -2.0 * (4.0 * 3.0 - 2.0), max_relative = 1e-14);
    assert_relative_eq!(model.potential(&q, &u), energy.potential());
    assert_relative_eq!(energy.total(), kinetic + energy.potential());
    assert_relative_eq!(model.cable(tie, &q, &v, &u).rate, (-3.0 + 4.0) / 2f64.sqrt(), max_relative = 1e-13);
    assert_eq!((model.cable_name(tie), model.load_name(push)), ("tie", "push"));
    assert_relative_eq!(model.cable_form(tie).eval(&q), Vector2::new(2.0, 2.0), epsilon = 1e-15);
}

/// E0 of example 1 as the paper's figures have it: framework reference values, minimal-coordinate model.
#[test]
fn example_1_has_its_published_energy() {
    for kind in [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr] {
        let model = pendulum([Constrain, Share], kind, 0.3).unwrap().model;
        let (q, v) = (model.initial_coordinates(), model.velocities_at_rest());
        assert_relative_eq!(model.energy(&q, &v, &[]).total(), -0.0481814203268595, max_relative = 1e-14);
    }
}
