//! The forces of a shape: tensions, axial forces, reactions, and what does not balance.

use serde_json::{Value, json};
use tg_scene::Structure;
use tg_statics::{Configuration, EquilibriumReport};

use crate::answer::Failure;

/// Adds the forces at full coordinates `q` and inputs `u` to an answer.
pub(super) fn equilibrium<const D: usize>(
    structure: &Structure<D>,
    q: &[f64],
    u: &[f64],
    document: &mut Value,
    text: &mut String,
) -> Result<Configuration, Failure> {
    let report = EquilibriumReport::new(&structure.model, q, u).map_err(Failure::analysis)?;
    *text += &format!("residual force {:.3e} of the largest force\n", report.imbalance);
    let width = report.cables.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0).max(5);
    *text +=
        &format!("  {:width$}  {:>14}  {:>14}  {:>14}\n", "cable", "length [m]", "rest [m]", "tension [N]");
    for (name, cable) in &report.cables {
        let slack = if cable.slack { "  slack" } else { "" };
        *text += &format!(
            "  {name:width$}  {:14.9}  {:14.9}  {:14.6}{slack}\n",
            cable.length, cable.rest, cable.tension
        );
    }
    let axial: Vec<(&str, f64)> =
        report.members.iter().filter_map(|member| Some((member.name.as_str(), member.axial?))).collect();
    if !axial.is_empty() {
        let width = axial.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0).max(3);
        *text += &format!("  {:width$}  {:>14}\n", "bar", "axial [N]");
        for (name, force) in &axial {
            *text += &format!("  {name:width$}  {force:14.6}\n");
        }
    }
    if !report.supports.is_empty() {
        let width =
            report.supports.iter().map(|support| support.name.chars().count()).max().unwrap_or(0).max(7);
        *text += &format!("  {:width$}  reaction [N]\n", "support");
        for support in &report.supports {
            let force: Vec<String> = support.force.iter().map(|f| format!("{f:12.6}")).collect();
            *text += &format!("  {:width$}  {}\n", support.name, force.join("  "));
        }
    }
    document["imbalance"] = json!(report.imbalance);
    document["constraint_violation"] = json!(report.constraint_violation);
    document["potential_energy"] = json!(structure.model.mechanics().potential(q, u));
    document["cables"] = report
        .cables
        .iter()
        .map(|(name, cable)| {
            json!({
                "cable": name,
                "length": cable.length,
                "rest_length": cable.rest,
                "tension": cable.tension,
                "slack": cable.slack,
            })
        })
        .collect();
    document["bars"] =
        axial.iter().map(|(name, force)| json!({ "bar": name, "axial_force": force })).collect();
    document["reactions"] = report
        .supports
        .iter()
        .map(|support| json!({ "at": support.name, "force": support.force.as_slice() }))
        .collect();
    document["coordinates"] = json!(q);
    Ok(report.configuration)
}
