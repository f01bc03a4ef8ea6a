//! Every file in `scenes/` is a scene.

use std::path::{Path, PathBuf};

use tg_scene::{Built, ChannelName, SceneFile};

fn scenes() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let paths = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut scenes: Vec<_> =
        paths.filter(|p| p.extension().is_some_and(|e| e == "toml" || e == "json")).collect();
    scenes.sort();
    scenes
}

#[test]
fn all_scenes_build() {
    let scenes = scenes();
    assert!(scenes.len() >= 11, "{scenes:?}");
    for path in scenes {
        let file = SceneFile::read(&path).unwrap_or_else(|error| panic!("{error}"));
        let built = file.build(&[]).unwrap_or_else(|error| panic!("{error}"));
        let (freedom, watched, pictures, members) = match &built {
            Built::Plane(s) => (
                s.model.report().degrees_of_freedom(),
                s.watched.len(),
                s.pictures.len(),
                s.model.members().len(),
            ),
            Built::Space(s) => (
                s.model.report().degrees_of_freedom(),
                s.watched.len(),
                s.pictures.len(),
                s.model.members().len(),
            ),
        };
        let name = path.display();
        assert!(freedom > 0, "{name} cannot move");
        assert_eq!(pictures, members, "{name}");
        assert!(
            file.scene.title.is_some() && file.scene.description.is_some(),
            "{name} says nothing of itself"
        );
        let run = file.run(&[]).unwrap_or_else(|error| panic!("{error}")).expect("a scene here has a run");
        assert!(run.step.or(run.accuracy).unwrap() < run.duration, "{name}");
        assert_eq!(run.channels.contains(&ChannelName::Points), watched > 0, "{name}");
    }
}
