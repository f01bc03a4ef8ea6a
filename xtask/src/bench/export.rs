//! The mast as a file that the floor program and the peers' scripts read, so that all run the same numbers.

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};
use tg_fixtures::MastScene;

use super::converged::converged;
use super::scene::MastRun;
use crate::TaskError;

/// Writes `mast-N.json`; its path.
pub(crate) fn scene(scene: &MastScene, folder: &Path) -> Result<PathBuf, TaskError> {
    fs::create_dir_all(folder)?;
    let path = folder.join(format!("mast-{}.json", scene.stages));
    fs::write(&path, serde_json::to_vec(&document(scene))?)?;
    Ok(path)
}

/// Writes scene and converged trajectory (samples, free nodes, coordinates) of the mast.
pub(crate) fn export(stages: usize, folder: &Path) -> Result<bool, TaskError> {
    let run = MastRun::new(stages)?;
    println!("{}", scene(&run.numbers(), folder)?.display());
    converged(&run, folder)?;
    Ok(true)
}

fn document(scene: &MastScene) -> Value {
    let (length, mass) = (MastScene::BAR_LENGTH, MastScene::BAR_MASS);
    let bars = scene.bars.iter().map(|nodes| json!({ "nodes": nodes, "length": length, "mass": mass }));
    let cables = scene.cables.iter().map(|cable| {
        json!({
            "nodes": cable.nodes, "k": cable.stiffness, "c": cable.damping, "rest_length": cable.rest_length,
        })
    });
    // The feet, then the anchors behind the last level.
    let fixed: Vec<usize> = (0..3).chain(3 * (scene.stages + 1)..scene.nodes.len()).collect();
    json!({
        "name": format!("prism mast, {} stages", scene.stages),
        "units": "SI",
        "stages": scene.stages,
        "gravity": [0.0, 0.0, -MastScene::GRAVITY],
        "nodes": scene.nodes,
        "fixed_nodes": fixed,
        "bars": bars.collect::<Vec<_>>(),
        "cables": cables.collect::<Vec<_>>(),
    })
}
