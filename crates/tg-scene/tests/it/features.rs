//! What the format can say, checked against closed forms and numerical integration. Child `shapes`: mass properties.

mod shapes;

use std::path::Path;

use tg_model::{At, CableId, CableLaw, Mechanics, MemberId, Model};
use tg_scene::{Built, Language, SceneFile, Structure};

fn file(text: &str, language: Language) -> SceneFile {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/data");
    SceneFile::parse(text, language, "scene", folder).unwrap_or_else(|error| panic!("{error}"))
}

fn plane(text: &str) -> Structure<2> {
    let Built::Plane(structure) =
        file(&format!("version = 1\ndimension = 2\n{text}"), Language::Toml).build(&[]).unwrap()
    else {
        panic!("a scene in space")
    };
    *structure
}

fn space(text: &str) -> Structure<3> {
    let built = file(&format!("version = 1\ndimension = 3\n{text}"), Language::Toml).build(&[]);
    let Built::Space(structure) = built.unwrap_or_else(|error| panic!("{error}")) else {
        panic!("a planar scene")
    };
    *structure
}

fn member<const D: usize>(model: &Model<D>, name: &str) -> MemberId {
    model.members().find(|&member| model.member_name(member) == name).unwrap_or_else(|| panic!("no {name}"))
}

fn cable<const D: usize>(model: &Model<D>, name: &str) -> CableId {
    model.cables().find(|&cable| model.cable_name(cable) == name).unwrap_or_else(|| panic!("no {name}"))
}

#[track_caller]
fn assert_close(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() <= tolerance), "{a:?} {b:?}");
}

/// Everything that a solver sees, at the configuration as built and another one.
#[track_caller]
fn assert_same<const D: usize>(a: &Model<D>, b: &Model<D>) {
    let q = a.initial_coordinates();
    assert_eq!(q, b.initial_coordinates());
    assert_eq!((a.free(), a.mass()), (b.free(), b.mass()));
    for t in [0.0, 0.3, 1.2] {
        let u = a.inputs_at(t);
        assert_eq!(u, b.inputs_at(t));
        let moved: Vec<f64> = q.iter().zip(0..).map(|(q, k)| q + 0.1 * f64::sin(f64::from(k) + t)).collect();
        let force = |model: &Model<D>| {
            let mut f = vec![0.0; q.len()];
            model.force(At { q: &moved, v: &q, u: &u, taut: None }, &mut f);
            f
        };
        assert_eq!(force(a), force(b));
        let constraints = |model: &Model<D>| {
            let mut phi = vec![0.0; model.sizes().constraints];
            model.constraints(&moved, &mut phi);
            phi
        };
        assert_eq!(constraints(a), constraints(b));
        assert!(constraints(a).iter().any(|phi| phi.abs() > 1e-3));
    }
}

#[test]
fn both_languages_say_the_same() {
    let (toml, json) = (include_str!("data/good.toml"), include_str!("data/good.json"));
    let build = |text, language| match file(text, language).build(&[]).unwrap() {
        Built::Plane(structure) => structure,
        Built::Space(_) => panic!("a scene in space"),
    };
    let (a, b) = (build(toml, Language::Toml), build(json, Language::Json));
    assert_same(&a.model, &b.model);
    assert_eq!((&a.groups, &a.pictures), (&b.groups, &b.pictures));
    assert_eq!(file(toml, Language::Toml).run(&[]).unwrap(), file(json, Language::Json).run(&[]).unwrap());
}

#[test]
fn aliases_say_the_same() {
    let plain = r#"
        gravity = [0, -1]
        anchors.a = [0, 0]
        bars.b = { ends = [[1, 0], [1, 2]], mass = 1 }
        joints.j = { places = ["b.to", "p"] }
        particles.p = { at = [1, 2], mass = 1 }
        cables.c = { ends = ["a", "b.to"], stiffness = 5, damping = 0.1, rest = 1, law = "linear" }
        cables.d = { ends = ["a", "b.from"], axial_stiffness = 5, tension = 2 }
        supports.s = { at = "b.from", axes = "y" }
        loads.l = { at = "b.to", force = [1, 0] }
        loads.m = { on = "b", moment = [1] }
    "#;
    let other = r#"
        gravity = [0, -1]
        anchors.a = [0, 0]
        rods.b = { between = [[1, 0], [1, 2]], mass = 1 }
        joints.j = { points = ["b.to", "p"] }
        particles.p = { position = [1, 2], mass = 1 }
        tendons.c = { nodes = ["a", "b.to"], k = 5, c = 0.1, free_length = 1, law = "two_way" }
        tendons.d = { between = ["a", "b.from"], EA = 5, pretension = 2 }
        supports.s = { place = "b.from", axes = "y" }
        loads.l = { place = "b.to", force = [1, 0] }
        loads.m = { member = "b", moment = [1] }
    "#;
    assert_same(&plane(plain).model, &plane(other).model);
}

#[test]
fn arrays_of_arrays_turn_and_shift() {
    let structure = space(
        r#"
        arrays.outer = { count = 3, index = "s", translate = [0, 0, 2], rotate = "90*deg", arrays.inner = { count = 2, translate = [0.5, 0, 0], particles."p {s} {i}" = { at = [1, "0.1 * i", "s"], mass = "1 + s + 10*i" } } }
        arrays.about = { count = 2, rotate = "PI", axis = [0, 2, 0], centre = [1, 0, 1], particles."q {i}" = { at = [0, 5, 0], mass = 1 } }
        "#,
    );
    let model = &structure.model;
    let q = model.initial_coordinates();
    for s in 0..3 {
        for i in 0..2 {
            let id = member(model, &format!("p {s} {i}"));
            let (s, i) = (f64::from(s), f64::from(i));
            let (x, y) = (1.0 + 0.5 * i, 0.1 * i);
            let (sin, cos) = (s * std::f64::consts::FRAC_PI_2).sin_cos();
            let expected = [x * cos - y * sin, x * sin + y * cos, s + 2.0 * s];
            assert_close(model.member_nodes(id, &q)[0].as_slice(), &expected, 1e-14);
            assert_eq!(model.member(id).mass_properties().mass(), 1.0 + s + 10.0 * i);
        }
    }
    // Half a turn about the vertical line... of y through (1, 0, 1): x → 2 - x, z → 2 - z.
    assert_close(model.member_nodes(member(model, "q 1"), &q)[0].as_slice(), &[2.0, 5.0, 2.0], 1e-14);
}

#[test]
fn rotations_agree() {
    let body = |rotation: &str| {
        let text = format!(
            "bodies.b = {{ position = [1, 2, 3], rotation = {rotation}, mass = 1, inertia = {{ principal = [1, 1, 1] }}, points = {{ p = [1, 0, 0], q = [0, 1, 0] }} }}
             run = {{ duration = 1, step = 0.1, points = [\"b.p\", \"b.q\"] }}"
        );
        let structure = space(&text);
        let q = structure.model.initial_coordinates();
        let points =
            structure.watched.iter().map(|(_, place)| structure.model.form(*place).unwrap().eval(&q));
        points.flat_map(|point| [point.x, point.y, point.z]).collect::<Vec<_>>()
    };
    // x → y, y → z: a third of a turn about (1, 1, 1), or a quarter about x, then one about z.
    let expected = [1.0, 3.0, 3.0, 1.0, 2.0, 4.0];
    for rotation in [
        r#"{ about = { axis = [2, 2, 2], angle = "120*deg" } }"#,
        "{ matrix = [[0, 0, 1], [1, 0, 0], [0, 1, 0]] }",
        "{ quaternion = [3, 3, 3, 3] }",
        r#"{ sequence = [{ about = { axis = [1, 0, 0], angle = "PI/2" } }, { about = { axis = [0, 0, 1], angle = "PI/2" } }] }"#,
    ] {
        assert_close(&body(rotation), &expected, 1e-14);
    }
}

/// Velocity of a point: that of the mass centre and ω × r, turned with the copy.
#[test]
fn velocities_at_the_start() {
    let structure = space(
        r#"arrays.a = { count = 2, rotate = "PI/2", bars."b {i}" = { ends = [[1, 0, 0], [3, 0, 0]], mass = 1, velocity = [0, 0, 5], spin = [0, 2, 0] } }
           bodies.c = { position = [0, 0, 9], mass = 1, centre = [0, 1, 0], inertia = { principal = [1, 1, 1] }, velocity = [1, 0, 0], spin = [0, 0, 3] }"#,
    );
    let (model, v) = (&structure.model, &structure.velocities);
    for name in ["b 0", "b 1"] {
        // ω × r = (0, 2, 0) × (±1, 0, 0) = (0, 0, ∓2); the copy turns about z.
        let [from, to] = [0, 1].map(|k| model.member_nodes(member(model, name), v)[k]);
        assert_close(from.as_slice(), &[0.0, 0.0, 7.0], 1e-14);
        assert_close(to.as_slice(), &[0.0, 0.0, 3.0], 1e-14);
    }
    // From the mass centre to the origin r = (0, -1, 0): ω × r = (3, 0, 0).
    assert_close(model.member_nodes(member(model, "c"), v)[0].as_slice(), &[4.0, 0.0, 0.0], 1e-14);
    let flat = plane("bars.b = { ends = [[0, 0], [0, 2]], mass = 1, velocity = [1, 0], spin = [3] }");
    let nodes = flat.model.member_nodes(member(&flat.model, "b"), &flat.velocities);
    assert_close(nodes[1].as_slice(), &[-2.0, 0.0], 1e-14);
}

#[test]
fn rest_lengths_follow_from_what_is_given() {
    let structure = plane(
        r#"
        anchors = { a = [0, 0], b = [3, 0] }
        particles.p = { at = [0, 4], mass = 1 }
        groups = { soft = { stiffness = 10, damping = 0.5, rest_ratio = 0.5, law = "linear" }, stiff = { axial_stiffness = 100 } }
        cables."of length" = { ends = ["b", "p"], stiffness = 7, rest = "1 + 2" }
        cables."of ratio" = { ends = ["b", "p"], group = "soft" }
        cables."of tension" = { ends = ["b", "p"], group = "soft", tension = 6 }
        cables."of density" = { ends = ["b", "p"], group = "soft", law = "slacking", force_density = 2 }
        cables."axial, length" = { ends = ["b", "p"], group = "stiff", rest = 4 }
        cables."axial, ratio" = { ends = ["b", "p"], group = "stiff", rest_ratio = 0.8 }
        cables."axial, tension" = { ends = ["b", "p"], group = "stiff", tension = 25 }
        cables."axial, density" = { ends = ["b", "p"], group = "stiff", force_density = 5, damping = 3 }
        cables."only a colour" = { ends = ["b", "p"], group = "stiff", stiffness = 8, rest = 5 }
        "#,
    );
    let model = &structure.model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let rest = vec![0.0; q.len()];
    // Length 5 in all; expected rest length, tension and stiffness.
    for (name, mu, tension, kappa) in [
        ("of length", 3.0, 14.0, 7.0),
        ("of ratio", 2.5, 25.0, 10.0),
        ("of tension", 4.4, 6.0, 10.0),
        ("of density", 4.0, 10.0, 10.0),
        ("axial, length", 4.0, 25.0, 25.0),
        ("axial, ratio", 4.0, 25.0, 25.0),
        ("axial, tension", 4.0, 25.0, 25.0),
        ("axial, density", 4.0, 25.0, 25.0),
        ("only a colour", 5.0, 0.0, 8.0),
    ] {
        let id = cable(model, name);
        let state = model.cable(id, &q, &rest, &u);
        let (CableLaw::Linear { stiffness, .. } | CableLaw::Slacking { stiffness, .. }) = model.cable_law(id)
        else {
            panic!("another law")
        };
        assert_close(&[state.rest, state.tension, *stiffness], &[mu, tension, kappa], 1e-12);
    }
    let law = |name: &str| format!("{:?}", model.cable_law(cable(model, name)));
    assert!(law("of ratio").starts_with("Linear") && law("of density").starts_with("Slacking"));
    assert!(law("of density").contains("η = 0.5") && law("axial, density").contains("η = 3"));
    assert_eq!(structure.groups[0], None);
    assert_eq!(structure.groups[1].as_deref(), Some("soft"));
}

#[test]
fn parameters_stand_in_any_order_and_can_be_set() {
    let text = "version = 1\ndimension = 2\nparameters = { a = \"b + 1\", b = \"c * 2\", c = 3 }\n";
    let file = file(text, Language::Toml);
    let value = |name: &str, set: &[(String, f64)]| {
        file.parameters(set).unwrap().into_iter().find(|(known, _)| known == name).unwrap().1
    };
    assert_eq!(value("a", &[]), 7.0);
    assert_eq!(value("a", &[("c".into(), 5.0)]), 11.0);
    assert_eq!(value("a", &[("b".into(), 0.5)]), 1.5);
}

#[test]
fn signals_have_the_values_written() {
    let structure = plane(
        r#"
        anchors = { a = [0, 0], b = [1, 0] }
        particles.p = { at = [0, 1], mass = 1 }
        signals.record = { file = { csv = "record.csv", column = "a", scale = 4 } }
        signals.wave = { sine = { amplitude = 2, frequency = 0.25, phase = "PI/2" } }
        signals.both = { sum = [{ signal = "record" }, { signal = "wave" }, 10] }
        groups.g = { stiffness = 1 }
        cables.record = { ends = ["a", "p"], group = "g", rest = { signal = "record" } }
        cables.both = { ends = ["b", "p"], group = "g", rest = { signal = "both" } }
        cables.ramp = { ends = ["b", "p"], group = "g", rest = { ramp = { from = 1, to = 3, start = 1, duration = 4 } } }
        cables.table = { ends = ["b", "p"], group = "g", rest = { table = { times = [0, 2], values = [1, 5] } } }
        "#,
    );
    let wave = |t: f64| 2.0 * (std::f64::consts::FRAC_PI_2 * (1.0 + t)).sin();
    for (t, record, ramp, table) in
        [(0.25, 2.0, 1.0, 1.5), (0.5, 4.0, 1.0, 2.0), (2.0, 0.0, 1.5, 5.0), (9.0, 0.0, 3.0, 5.0)]
    {
        assert_close(&structure.model.inputs_at(t), &[record, record + wave(t) + 10.0, ramp, table], 1e-14);
    }
}

#[test]
fn redundant_constraints_may_be_dropped() {
    let text = r#"
        redundancies = "drop"
        bars.b = { ends = [[0, 0], [2, 0]], mass = 1 }
        supports.foot = { at = "b.from" }
        supports.middle = { at = { on = "b", at = [0.5] }, axes = "x" }
    "#;
    let report = plane(text).model.report().clone();
    assert_eq!((report.degrees_of_freedom(), report.redundant.len()), (1, 1));
}
