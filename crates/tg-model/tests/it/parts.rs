//! Questions about single parts: what was built is told again, by handle and by name.

use crate::support::mixed::{Cubic, Spatial, mixed};
use nalgebra::Vector2;
use std::sync::Arc;
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::Joining::{Constrain, Share};
use tg_model::{
    CableLaw, ConstraintSource, InertialSystem, Joint, Load, Mechanics, ModelBuilder, MomentAxes, Place,
    Projector, Reactions, Redundancies, Signal, Support, Tensioned,
};

#[test]
fn a_model_tells_its_parts() {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.5, -9.81]).unwrap();
    let peg = b.anchor("peg", [0.0, 0.0]).unwrap();
    let hook = b.anchor("hook", [3.0, 1.0]).unwrap();
    let boom = b.bar("boom", 2.0, [0.0, 0.0], [2.0, 0.0]).unwrap();
    let ball = b.particle("ball", 3.0, [1.0, 0.0]).unwrap();
    let (foot, bead) = ([peg.into(), boom.node(0)], [boom.at([1.0, 0.0]), ball.node(0)]);
    b.joint("foot", &foot, Share).unwrap();
    b.joint("bead", &bead, Constrain).unwrap();
    b.support("lift", hook, 1, Signal::sine(0.1, 1.0)).unwrap();
    b.support("rail", boom.mass_centre(), 1, 0.0).unwrap();
    let (tip, middle): (Place<2>, Place<2>) = (boom.node(1), boom.mass_centre());
    let tie = b.cable("tie", hook, tip, CableLaw::slacking(10.0).with_damping(2.0), 1.0).unwrap();
    let strut = b.cable("strut", hook, middle, CableLaw::linear(20.0), 1.0).unwrap();
    let law = CableLaw::User(Arc::new(Cubic { a: 3.0, b: 2.0, c: 0.0 }));
    let own = b.cable("own", hook, ball.node(0), law, 1.0).unwrap();
    let push = b.load("push", tip, [4.0, 5.0], 1.0).unwrap();
    let turn = b.moment("turn", boom, 6.0, 1.0).unwrap();
    let model = b.build().unwrap();

    assert_eq!(model.gravity(), [0.5, -9.81]);
    let joints: Vec<_> = model.joints().collect();
    assert_eq!(joints[0], Joint { name: "foot", places: &foot, joining: Share });
    assert_eq!(joints[1], Joint { name: "bead", places: &bead, joining: Constrain });
    let supports: Vec<_> = model.supports().collect();
    assert_eq!(supports[0], Support { name: "lift", place: hook.into(), axis: 1 });
    assert_eq!(supports[1], Support { name: "rail", place: middle, axis: 1 });
    assert_eq!((joints.len(), supports.len()), (2, 2));
    assert_eq!(model.members().collect::<Vec<_>>(), [boom, ball]);
    assert_eq!((model.member_name(ball), model.member(ball).mass_properties().mass()), ("ball", 3.0));

    assert_eq!(model.cables().collect::<Vec<_>>(), [tie, strut, own]);
    assert_eq!(model.cable_places(tie), [hook.into(), tip]);
    assert_eq!(model.cable_places(strut), [hook.into(), middle]);
    let tensioned: &dyn Tensioned = &model;
    assert_eq!(tensioned.cable_count(), 3);
    assert_eq!(Tensioned::cable_name(&model, 1), "strut");
    assert_eq!([0, 1, 2].map(|k| tensioned.linear_stiffness(k)), [Some(10.0), Some(20.0), None]);
    assert_eq!([0, 1, 2].map(|k| tensioned.only_pulls(k)), [true, false, false]);
    assert_eq!([0, 1].map(|k| tensioned.static_tension(k, 0.5, 1.0)), [0.0, -10.0]);
    assert_eq!(tensioned.static_tension(2, 2.0, 1.0), 5.0);
    assert_eq!(tensioned.mechanics().sizes(), model.mechanics().sizes());

    assert_eq!(model.loads().collect::<Vec<_>>(), [push, turn]);
    assert_eq!(
        (model.load(push), model.load(turn)),
        (Load::Force(tip), Load::Moment(boom, MomentAxes::Space))
    );
    let names: Vec<String> = (0..7).map(|input| model.input_name(input)).collect();
    let expected = [
        "rest length of \"tie\"",
        "rest length of \"strut\"",
        "rest length of \"own\"",
        "component 1 of load \"push\"",
        "component 2 of load \"push\"",
        "component 1 of load \"turn\"",
        "input 6",
    ];
    assert_eq!(names, expected);

    // The foot's node comes first, being the boom's; anchors follow, the rail's base is the last.
    let nodes: Vec<&str> = (0..model.sizes().coordinates / 2).map(|node| model.node_name(node)).collect();
    let expected = [
        "basic point 0 of \"boom\"",
        "basic point 1 of \"boom\"",
        "basic point 0 of \"ball\"",
        "anchor \"hook\"",
        "base of support \"rail\"",
    ];
    assert_eq!(nodes, expected);
    assert_eq!((model.member_node_ids(boom), model.member_node_ids(ball)), (&[0, 1][..], &[2][..]));
    assert_eq!(model.coordinate_name(9), "y component of base of support \"rail\"");
    let bead =
        |axis| ConstraintSource::Joint { name: "bead".into(), at: "basic point 0 of \"ball\"".into(), axis };
    // Joints count by their members' length, not by the structure's; √10 m from the peg to the hook.
    assert_eq!(model.constraint_scales(), [4.0, 2.0, 2.0, 2.0]);
    let rail = ConstraintSource::Support { name: "rail".into(), axis: 1 };
    assert_eq!(model.constraint_sources(), [ConstraintSource::Rigidity(boom), bead(0), bead(1), rail]);
}

/// Every place has words, which errors use.
#[test]
fn places_are_described() {
    let mass = MassProperties::from_polar_moment(1.0, Vector2::zeros(), 0.1).unwrap();
    let nodes = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vector2::from);
    let plate = Member::new(CoordType::Ruv, &nodes, mass).unwrap();
    let words = |place: &dyn Fn(&mut ModelBuilder<2>, tg_model::MemberId) -> Place<2>| {
        let mut b = ModelBuilder::<2>::new();
        let plate = b.member("plate", plate.clone(), Pose::identity()).unwrap();
        let ball = b.particle("ball", 1.0, [5.0, 0.0]).unwrap();
        let place = place(&mut b, plate);
        b.joint("gap", &[ball.node(0), place], Constrain).unwrap();
        b.build().unwrap_err().to_string()
    };
    let at = |text: String, what: &str| assert!(text.contains(what), "{text}");
    at(words(&|_, plate| plate.node(0)), "basic point 0 of \"plate\"");
    at(words(&|_, plate| plate.node(1)), "base vector 1 of \"plate\"");
    at(words(&|_, plate| plate.at([0.25, 0.5])), "point [0.25, 0.5] of \"plate\"");
    at(words(&|_, plate| plate.mass_centre()), "mass centre of \"plate\"");
    at(words(&|b, _| b.anchor("peg", [0.0, 0.0]).unwrap().into()), "anchor \"peg\"");
}

/// A projector and its like say what they work on.
#[test]
fn workspaces_tell_their_system() {
    let mixed = mixed::<Spatial, 3>(2, true);
    let m = mixed.model.mechanics();
    let (unknowns, size) = (m.free().len(), m.free().len() + m.sizes().constraints);
    let mut projector = Projector::new(m).unwrap();
    assert_eq!(projector.mechanics().free(), m.free());
    assert_eq!(projector.system().size(), size);
    assert_eq!(projector.multipliers().len(), size - unknowns);
    let mut system = InertialSystem::new(m).unwrap();
    assert_eq!((system.layout().unknowns(), system.size(), system.fallbacks()), (unknowns, size, 0));
    assert_eq!(system.mechanics().free(), m.free());
    let q = mixed.model.initial_coordinates();
    system.factor(&q).unwrap();
    let mut values = vec![f64::NAN; m.jacobian_pattern().len()];
    m.jacobian(&q, &mut values);
    assert_eq!(system.jacobian(), values);
    let prescribed: Vec<usize> = (0..q.len()).filter(|i| !m.free().contains(i)).collect();
    assert_eq!(Reactions::new(m).unwrap().coordinates(), prescribed);
}

/// A bar twice between the same points, with what the report says of it.
#[test]
fn a_report_in_words() {
    let mut b = ModelBuilder::<2>::new();
    b.redundancies(Redundancies::Drop);
    let peg = b.anchor("peg", [0.0, 0.0]).unwrap();
    let bars = ["one", "two"].map(|name| b.bar(name, 1.0, [0.0, 0.0], [1.0, 0.0]).unwrap());
    b.joint("foot", &[peg.into(), bars[0].node(0), bars[1].node(0)], Share).unwrap();
    b.joint("head", &[bars[0].node(1), bars[1].node(1)], Share).unwrap();
    let model = b.build().unwrap();
    let counts = "4 coordinates (2 free), 1 intrinsic and 0 extrinsic constraints, 1 degrees of freedom";
    let dropped = "dropped rigidity u·u of \"two\" is implied by rigidity u·u of \"one\"";
    assert_eq!(model.report().to_string(), format!("{counts}; {dropped}"));
    assert_eq!((model.report().dropped_constraints, model.report().redundant.len()), (0, 1));
}
