//! Counts and names of built structures: examples 1 and 2, joints of many members, supports of every kind.

use crate::support::examples::{TowerChoice, pendulum, tower};
use crate::support::mixed::{Space, Spatial, member};
use crate::support::{Random, build, constraints, violation};
use approx::assert_relative_eq;
use nalgebra::Vector3;
use tg_coords::{CoordType, Member, Pose};
use tg_model::Joining::{Constrain, Share};
use tg_model::{BuildReport, CableLaw, Mechanics, Place, Signal};

const PLANAR: [CoordType; 3] = [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr];

/// (free, intrinsic, extrinsic, degrees of freedom)
fn counts(report: &BuildReport) -> (usize, usize, usize, usize) {
    (report.free, report.intrinsic, report.extrinsic, report.degrees_of_freedom())
}

#[test]
fn example_1_has_two_degrees_of_freedom_however_it_is_joined() {
    for kind in PLANAR {
        for (joinings, expected) in [
            ([Share, Share], (6, 4, 0, 2)),
            ([Share, Constrain], (8, 4, 2, 2)),
            ([Constrain, Share], (8, 4, 2, 2)),
            ([Constrain, Constrain], (10, 4, 4, 2)),
        ] {
            let model = pendulum(joinings, kind, 0.5).unwrap().model;
            assert_eq!(counts(model.report()), expected, "{kind} {joinings:?}");
            assert!(violation(&model, &model.initial_coordinates()) < 1e-15);
            assert_eq!(model.sizes().constraints, expected.1 + expected.2);
            assert_eq!(model.free().len(), expected.0);
            assert_eq!(model.report().coordinates, model.sizes().coordinates);
        }
    }
}

#[test]
fn example_2_has_five_degrees_of_freedom_however_it_is_joined() {
    let choice = TowerChoice::default();
    let model = tower(choice).unwrap();
    assert_eq!(counts(model.report()), (26, 13, 8, 5));
    assert_eq!((model.sizes().inputs, model.sizes().switches), (12, 0));
    assert_eq!(model.report().dropped_constraints, 0);
    assert!(model.report().idle_cables.is_empty() && model.report().redundant.is_empty());
    assert!(violation(&model, &model.initial_coordinates()) < 1e-14);

    let constrained = tower(TowerChoice { shared: Constrain, ..choice }).unwrap();
    assert_eq!(counts(constrained.report()), (34, 13, 16, 5));
    let points = [CoordType::Rrr; 3];
    let shared = tower(TowerChoice { constrained: Share, kinds: points, ..choice }).unwrap();
    assert_eq!(counts(shared.report()), (18, 13, 0, 5));
    for kind in PLANAR {
        // A corner that is no basic point cannot be shared; it is pinned as a material point.
        let joined = tower(TowerChoice { shared: Constrain, kinds: [kind; 3], ..choice }).unwrap();
        assert_eq!(counts(joined.report()), (34, 13, 16, 5), "{kind}");
    }
    let slack = tower(TowerChoice { slacking: true, damping: 0.1, shake: 0.01, ..choice }).unwrap();
    assert_eq!(counts(slack.report()), (26, 13, 8, 5));
    assert_eq!(slack.sizes().switches, 12);
    assert!(slack.features().damping && slack.features().moving_supports);
}

/// Bars from a common point outwards, joined there; the first end on an anchor if `anchored`.
fn star(joining: tg_model::Joining, members: usize, anchored: bool) -> BuildReport {
    let model = build::<3>(|b| {
        let mut places: Vec<Place<3>> = Vec::new();
        if anchored {
            places.push(b.anchor("hub", [0.0; 3])?.into());
        }
        for k in 0..members {
            let angle = 1.0 + k as f64;
            let bar = b.bar(&format!("bar {k}"), 1.0, [0.0; 3], [angle.cos(), angle.sin(), 0.2 * angle])?;
            places.push(bar.node(0));
        }
        b.joint("star", &places, joining)
    });
    model.unwrap().report().clone()
}

#[test]
fn joints_of_many_members() {
    for members in 3..6 {
        let dof = 3 + 2 * members;
        let shared = counts(&star(Share, members, false));
        assert_eq!(shared, (3 + 3 * members, members, 0, dof));
        let extrinsic = 3 * (members - 1);
        assert_eq!(counts(&star(Constrain, members, false)), (6 * members, members, extrinsic, dof));
        assert_eq!(counts(&star(Share, members, true)), (3 * members, members, 0, dof - 3));
        let pinned = counts(&star(Constrain, members, true));
        assert_eq!(pinned, (6 * members, members, 3 * members, dof - 3));
    }
}

#[test]
fn joints_by_sharing_chain_over_common_points() {
    let model = build::<2>(|b| {
        let bars: Vec<_> = (0..4)
            .map(|k| b.bar(&format!("bar {k}"), 1.0, [0.0, 0.0], [1.0, k as f64]))
            .collect::<Result<_, _>>()?;
        b.joint("a", &[bars[0].node(0), bars[1].node(0)], Share)?;
        b.joint("b", &[bars[2].node(0), bars[3].node(0)], Share)?;
        b.joint("c", &[bars[3].node(0), bars[1].node(0)], Share)
    });
    assert_eq!(counts(model.unwrap().report()), (10, 4, 0, 6));
}

#[test]
fn supports_hold_single_components_of_points_and_base_vectors() {
    let r = &mut Random::new(3);
    for kind in CoordType::ALL.into_iter().filter(|kind| kind.fits(3) && kind.span() == 3) {
        let body = member::<3>(kind, r);
        let pose = Spatial::pose([0.0; 3], r);
        let on_a_plane = build::<3>(|b| {
            let id = b.member("body", body.clone(), pose)?;
            b.support("floor", id.node(0), 2, 0.0)
        });
        assert_eq!(counts(on_a_plane.unwrap().report()), (11, 6, 0, 5), "{kind}");
        let pinned = build::<3>(|b| {
            let id = b.member("body", body.clone(), pose)?;
            b.fix("pin", id.node(0))
        });
        assert_eq!(counts(pinned.unwrap().report()), (9, 6, 0, 3), "{kind}");
    }
    // A horizontal base vector that stays horizontal: the rod translates only.
    let rod = Member::thin_rod(1.0, [0.0; 2].into(), [1.0, 0.0].into()).unwrap();
    let sliding = build::<2>(|b| {
        let id = b.member("rod", rod.with_type(CoordType::Ru).unwrap(), Pose::identity())?;
        b.support("level", id.node(1), 1, 0.0)
    });
    assert_eq!(counts(sliding.unwrap().report()), (3, 1, 0, 2));
}

#[test]
fn supports_at_material_points_are_constraints_to_hidden_anchors() {
    let at = [0.3, 0.1, -0.2];
    for (mass_centre, components, dof) in [(false, 1, 5), (false, 3, 3), (true, 1, 5), (true, 3, 3)] {
        let body = member::<3>(CoordType::Rrvw, &mut Random::new(8));
        let model = build::<3>(|b| {
            let id = b.member("body", body, Pose::translation([1.0, 2.0, 3.0].into()))?;
            let place = if mass_centre { id.mass_centre() } else { id.at(at) };
            (0..components).try_for_each(|axis| b.support(&format!("s{axis}"), place, axis, 0.0))
        });
        let model = model.unwrap();
        assert_eq!(counts(model.report()), (12, 6, components, dof));
        assert!(violation(&model, &model.initial_coordinates()) < 1e-15);
        assert_eq!(model.constraint_name(6), "support \"s0\"");
    }
}

#[test]
fn constraints_without_free_coordinates_are_dropped_and_counted() {
    let model = build::<2>(|b| {
        let pegs = [b.anchor("a", [0.0, 0.0])?, b.anchor("b", [0.0, 0.0])?];
        let held = b.bar("held", 1.0, [0.0, 0.0], [1.0, 0.0])?;
        let moved = b.bar("moved", 1.0, [5.0, 0.0], [5.0, 1.0])?;
        let swing = b.bar("swing", 1.0, [1.0, 0.0], [1.0, 1.0])?;
        b.joint("pegs", &[pegs[0].into(), pegs[1].into()], Constrain)?;
        b.fix("left", held.node(0))?;
        b.fix("right", held.node(1))?;
        b.shake("low", moved.node(0), Signal::sine(0.1, 1.0))?;
        b.shake("high", moved.node(1), Signal::sine(0.1, 1.0))?;
        b.joint("hinge", &[held.node(1), swing.node(0)], Share)
    });
    let model = model.unwrap();
    // Two components of the joint of anchors, the two held bars.
    assert_eq!(model.report().dropped_constraints, 4);
    assert_eq!(counts(model.report()), (2, 1, 0, 1));
    assert!(model.report().to_string().contains("4 constraints held by supports"));
}

#[test]
fn residuals_by_hand() {
    let (mut bar, mut mid) = (None, None);
    let model = build::<3>(|b| {
        let id = b.bar("bar", 1.0, [0.0; 3], [0.0, 0.0, 2.0])?;
        let ball = b.particle("ball", 1.0, [0.0, 0.0, 1.5])?;
        b.joint("bead", &[id.at([0.0, 0.0, 1.5]), ball.node(0)], Constrain)?;
        (bar, mid) = (Some(id), Some(ball));
        Ok(())
    });
    let model = model.unwrap();
    let mut q = model.initial_coordinates();
    let nodes = [bar.unwrap().node(0), bar.unwrap().node(1), mid.unwrap().node(0)];
    let values = [[1.0, 0.0, 0.0], [1.0, 3.0, 4.0], [0.5, -1.0, 2.0]];
    for (node, x) in nodes.into_iter().zip(values) {
        let k = model.form(node).unwrap().terms()[0].0 * 3;
        q[k..k + 3].copy_from_slice(&x);
    }
    let phi = constraints(&model, &q);
    // |(0, 3, 4)|² - 2², then ball - (quarter of the first end + three quarters of the second).
    let gap = Vector3::new(0.5, -1.0, 2.0) - Vector3::new(1.0, 2.25, 3.0);
    for (found, expected) in phi.iter().zip([21.0, gap.x, gap.y, gap.z]) {
        assert_relative_eq!(*found, expected, epsilon = 1e-14);
    }
    assert_eq!(model.constraint_scales(), [4.0, 2.0, 2.0, 2.0]);
}

#[test]
fn coordinates_constraints_and_cables_have_names() {
    let r = &mut Random::new(2);
    let body = member::<3>(CoordType::Rrvw, r);
    let (mut id, mut peg) = (None, None);
    let model = build::<3>(|b| {
        let part = b.member("hull", body, Pose::identity())?;
        let anchor = b.anchor("peg", [9.0, 0.0, 0.0])?;
        let bar = b.bar("mast", 1.0, [9.0, 0.0, 0.0], [9.0, 0.0, 1.0])?;
        b.joint("heel", &[anchor.into(), bar.node(0)], Constrain)?;
        b.cable("stay", part.node(1), anchor, CableLaw::slacking(1.0), 1.0)?;
        b.cable("sheet", part.mass_centre(), bar.node(1), CableLaw::linear(1.0), 1.0)?;
        b.load("wind", part.node(0), [1.0, 0.0, 0.0], 1.0)?;
        (id, peg) = (Some(part), Some(anchor));
        Ok(())
    });
    let model = model.unwrap();
    let coordinate = |place: Place<3>, d: usize| model.form(place).unwrap().terms()[0].0 * 3 + d;
    let id = id.unwrap();
    assert_eq!(model.coordinate_name(coordinate(id.node(1), 2)), "z component of basic point 1 of \"hull\"");
    assert_eq!(model.coordinate_name(coordinate(id.node(2), 0)), "x component of base vector 2 of \"hull\"");
    assert_eq!(model.coordinate_name(coordinate(peg.unwrap().into(), 1)), "y component of anchor \"peg\"");
    assert_eq!(model.cables_at(coordinate(peg.unwrap().into(), 1)), ["stay"]);
    assert_eq!(model.cables_at(coordinate(id.node(1), 0)), ["stay", "sheet"]);
    let names: Vec<String> = (0..model.sizes().constraints).map(|c| model.constraint_name(c)).collect();
    assert_eq!(names[0], "rigidity u·u of \"hull\"");
    assert_eq!(names[6], "rigidity u·u of \"mast\"");
    assert_eq!(names[8], "y component of joint \"heel\" at basic point 0 of \"mast\"");
    assert_eq!(names.len(), 10);
    let text = model.report().to_string();
    assert!(text.contains("7 intrinsic and 3 extrinsic") && text.contains("8 degrees of freedom"), "{text}");
}
