//! `tg check`: what a scene holds.

use serde_json::json;
use tg_scene::Structure;

use super::with_structure;
use crate::answer::{Answer, Failure};
use crate::args::Check;
use crate::loading::{Loaded, remarks};

pub(crate) fn check(arguments: &Check) -> Result<Answer, Failure> {
    let loaded = Loaded::new(&arguments.scene)?;
    // A run section that cannot be read is a mistake of the scene as well.
    loaded.file.run(&loaded.set)?;
    with_structure!(&loaded.built, structure => count(&loaded, structure))
}

fn count<const D: usize>(loaded: &Loaded, structure: &Structure<D>) -> Result<Answer, Failure> {
    let (model, parameters) = (&structure.model, loaded.file.parameters(&loaded.set)?);
    let report = model.report();
    let mass: f64 = model.members().map(|member| model.member(member).mass_properties().mass()).sum();
    let (members, cables, joints) = (model.members().len(), model.cables().len(), model.joints().len());
    let (supports, loads) = (model.supports().len(), model.loads().len());
    let document = json!({
        "title": loaded.title(),
        "dimension": D,
        "parameters": parameters.iter().cloned().collect::<std::collections::BTreeMap<_, _>>(),
        "members": members,
        "cables": cables,
        "joints": joints,
        "supports": supports,
        "loads": loads,
        "mass": mass,
        "coordinates": report.coordinates,
        "free_coordinates": report.free,
        "intrinsic_constraints": report.intrinsic,
        "extrinsic_constraints": report.extrinsic,
        "degrees_of_freedom": report.degrees_of_freedom(),
    });
    let mut text = format!(
        "{}\n{members} members ({mass} kg), {cables} cables, {joints} joints, {supports} held components, {loads} loads in \
         {D} dimensions\n{report}\n",
        loaded.title()
    );
    for (name, value) in parameters {
        text += &format!("  {name} = {value}\n");
    }
    Ok(Answer::new(document, text).warn(remarks(structure)))
}
