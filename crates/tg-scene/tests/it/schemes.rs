//! Schemes by name, in scenes and elsewhere.

use tg_scene::{Language, RunSettings, SceneFile, Scheme, schema};

/// The run of a scene whose run section is this.
fn settings(run: &str) -> RunSettings {
    let text = format!("version = 1\ndimension = 2\nrun = {{ duration = 1, {run} }}\n");
    let file = SceneFile::parse(&text, Language::Toml, "scene", ".".into()).unwrap();
    file.run(&[]).unwrap().unwrap()
}

#[test]
fn every_scheme_has_a_name_that_scenes_know() {
    for scheme in Scheme::ALL {
        let name = scheme.to_string();
        assert_eq!(name.parse::<Scheme>().unwrap(), scheme);
        assert_eq!(settings(&format!("step = 0.1, scheme = \"{name}\"")).scheme, scheme);
    }
    let names = schema().as_value()["$defs"]["Scheme"]["oneOf"].as_array().map(Vec::len);
    assert_eq!(names, Some(Scheme::ALL.len()));
    let error = "leap-frog".parse::<Scheme>().unwrap_err().to_string();
    assert_eq!(error, "`leap-frog` is not known here; did you mean `leapfrog`?");
}

#[test]
fn error_control_needs_no_step() {
    let with = |more: &str| settings(&format!("scheme = \"runge-kutta-5\", tolerance = \"1e-6\"{more}"));
    assert_eq!((with("").tolerance, with("").step), (Some(1e-6), None));
    assert_eq!(with("").longest_step(), 0.02);
    assert_eq!(with(", every = 0.1").longest_step(), 0.1);
    assert_eq!(with(", every = 0.1, step = 0.05").longest_step(), 0.05);
}
