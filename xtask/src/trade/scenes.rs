//! The scenes that are measured: those of `scenes/`, as a user runs them.

use tg_scene::{Built, RunSettings, SceneFile, Structure};
use tg_trade::{Reference, Subject, TrialError};

use crate::{TaskError, root};

/// A scene as it is run.
pub(super) struct Measured {
    /// Its file's name without ending.
    pub(super) name: &'static str,
    pub(super) built: Built,
    pub(super) settings: RunSettings,
    /// What errors are told by.
    pub(super) reference: Reference,
}

/// Times the budget of a run that the runs behind the reference may take.
const REFERENCE: f64 = 5.0;

/// Name and simulated time \[s\]. Times are shortened where errors grow so fast that late positions say nothing of the step
/// (the double pendulum is chaotic; so are the antiprism's struts under moments), and where a motion goes on as it began.
/// Without `tower_modal`, which stands still.
const SCENES: [(&str, f64); 9] = [
    ("double_pendulum", 3.0),
    ("tower", 1.0),
    ("deployable", 5.0),
    ("seismic", 2.0),
    ("prism_mast", 0.5),
    ("icosahedron", 1.0),
    ("antiprism_force", 2.0),
    ("antiprism_moments", 1.0),
    ("mechanism", 5.0),
];

/// The scenes whose name contains a word, with motions to compare with.
pub(super) fn scenes(part: Option<&str>, budget: f64) -> Result<Vec<Measured>, TaskError> {
    let wanted = SCENES.into_iter().filter(|(name, _)| part.is_none_or(|part| name.contains(part)));
    wanted
        .map(|(name, duration)| {
            let file = SceneFile::read(&root().join(format!("scenes/{name}.toml")))?;
            let settings = file.run(&[])?.ok_or("a scene without a run")?;
            let (built, settings) = (file.build(&[])?, RunSettings { duration, ..settings });
            eprintln!("{name}: reference");
            let reference = match &built {
                Built::Plane(structure) => reference(structure, duration, budget),
                Built::Space(structure) => reference(structure, duration, budget),
            }?;
            Ok(Measured { name, built, settings, reference })
        })
        .collect()
}

fn reference<const D: usize>(
    structure: &Structure<D>,
    end: f64,
    budget: f64,
) -> Result<Reference, TrialError> {
    Reference::new(&Subject::new(&structure.model, &structure.velocities, end), REFERENCE * budget)
}

/// Calls a function of a structure's `Subject<D>` for the dimension that a scene has.
macro_rules! with_subject {
    ($scene:expr, $subject:ident => $call:expr) => {
        match &$scene.built {
            tg_scene::Built::Plane(structure) => {
                let $subject =
                    tg_trade::Subject::new(&structure.model, &structure.velocities, $scene.settings.duration);
                $call
            }
            tg_scene::Built::Space(structure) => {
                let $subject =
                    tg_trade::Subject::new(&structure.model, &structure.velocities, $scene.settings.duration);
                $call
            }
        }
    };
}
pub(super) use with_subject;
