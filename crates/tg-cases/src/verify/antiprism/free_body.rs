//! Newton's laws for the struts of example 2 (Fig. 10): all forces as lines in the frame C of the universal joint.

use nalgebra::{Matrix3, Vector3};
use tg_statics::{Action, FreeBody, FreeBodyReport, Source, Wrench};

use super::moments::{loaded, loads};
use super::{EXACT, MM};
use crate::antiprism::MOMENTS;
use crate::error::CaseError;
use crate::row::Rows;

const FIGURE: &str = "paper, (51) for strut 4";

/// Ties of strut 4 with their forces \[N\] and unit lines in C (directions, moments \[mm\]) as printed.
// Four decimals of whatever they are.
#[allow(clippy::approx_constant)]
const LINES: [(&str, f64, [f64; 6]); 6] = [
    ("top tie 4", 14.6319, [-0.6284, -0.6622, 0.4082, 54.8493, -74.9186, -37.1052]),
    ("top tie 3", 10.5691, [-0.0588, -0.2611, -0.9635, 21.6248, 49.1177, -14.6290]),
    ("lateral tie 4", 4.9205, [-0.2965, 0.3217, -0.8992, -26.6442, 25.8241, 18.0246]),
    ("bottom tie 4", 9.1701, [0.7071, 0.2748, 0.6515, 0.0, 0.0, 0.0]),
    ("bottom tie 3", 9.1701, [-0.7071, 0.2748, 0.6515, 0.0, 0.0, 0.0]),
    ("lateral tie 3", 9.9022, [0.8768, -0.2669, 0.4, 0.0, 0.0, 0.0]),
];
const REACTION: [f64; 3] = [2.592749, 8.468629, -7.273677];
const REACTION_MOMENT: f64 = 608.842765;

/// The wrench of some actions about the foot, in C.
fn sum(
    actions: &[Action<3>],
    wanted: impl Fn(&Source<3>) -> bool,
    foot: &Vector3<f64>,
    axes: &Matrix3<f64>,
) -> Wrench<3> {
    let wanted = actions.iter().filter(|action| wanted(&action.source));
    wanted.map(|action| action.about(foot)).sum::<Wrench<3>>().in_axes(axes)
}

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    let (structure, found) = loaded(&loads())?;
    let report = FreeBodyReport::new(&structure.model, &found.q, &found.u)?;
    rows.below(
        "free bodies: largest unbalance per largest force",
        "1",
        report.unbalance,
        "Newton's laws",
        1e-12,
    );
    rows.exact("free bodies: reactions that balance themselves", (report.indeterminate, 0), "Newton's laws");
    for (j, body) in report.bodies.iter().enumerate() {
        let [foot, _] = structure.ends(j, &found.q);
        let [eps, beta] = structure.angles(j, &found.q);
        let (s, c) = eps.sin_cos();
        // (50)
        let axes = Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c);
        let moment =
            sum(&body.reactions, |s| matches!(s, Source::UniversalJoint { .. }), &foot, &axes).moment;
        let expected = -MOMENTS[j][0] * beta.tan() * MM;
        let name = format!("free bodies: RM_z of strut {} is -M_ε tan β", j + 1);
        rows.near(name, "N mm", (moment.z * MM, expected), "balance about the strut", 1e-8);
        for (axis, value) in [("x", moment.x), ("y", moment.y)] {
            let name = format!("free bodies: RM_{axis} of strut {}", j + 1);
            rows.below(name, "N mm", value * MM, "paper, rows four and five of (51)", 1e-8);
        }
        if j == 3 {
            strut_4(rows, body, &foot, &axes);
        }
    }
    let mut off = found.q.clone();
    // The top of strut 1, 0.01 mm aside.
    off[3] += 1e-5;
    let unbalance = FreeBodyReport::new(&structure.model, &off, &found.u)?.unbalance;
    let seen = usize::from(unbalance > 1e-6);
    rows.exact("free bodies: an unbalance 0.01 mm aside is seen", (seen, 1), "Newton's laws");
    Ok(())
}

/// Every number of the paper's worked example.
fn strut_4(rows: &mut Rows, body: &FreeBody<3>, foot: &Vector3<f64>, axes: &Matrix3<f64>) {
    for (name, force, line) in LINES {
        for action in &body.given {
            let Source::Cable { name: cable, tension, line: ours } = &action.source else { continue };
            if cable != name {
                continue;
            }
            // 9.17016 N is printed as 9.1701: cut off.
            rows.near(format!("strut 4: force of {name}"), "N", (*tension, force), FIGURE, 1e-4);
            let ours = ours.times(1.0).moved(&Vector3::zeros(), foot).in_axes(axes);
            let ours = ours.force.iter().copied().chain(ours.moment.iter().map(|m| m * MM));
            let names = ["L", "M", "N", "P", "Q", "R"];
            for ((component, value), printed) in names.into_iter().zip(ours).zip(line) {
                // Directions, then moments of some 50 mm from ends rounded to 1e-4 mm.
                let (unit, tolerance) = if "LMN".contains(component) { ("1", 0.6e-4) } else { ("mm", 2e-4) };
                let name = format!("strut 4: {component} of the line of {name}");
                rows.near(name, unit, (value, printed), FIGURE, tolerance);
            }
        }
    }
    let reaction = sum(&body.reactions, |s| matches!(s, Source::Support { .. }), foot, axes);
    for ((axis, value), exact) in ["x", "y", "z"].into_iter().zip(reaction.force.iter()).zip(REACTION) {
        rows.near(format!("strut 4: R_{axis}"), "N", (*value, exact), EXACT, 0.51e-6);
    }
    let joint = sum(&body.reactions, |s| matches!(s, Source::UniversalJoint { .. }), foot, axes);
    rows.near("strut 4: RM_z", "N mm", (joint.moment.z * MM, REACTION_MOMENT), EXACT, 0.51e-6);
    let moments = sum(&body.given, |s| matches!(s, Source::Load { .. }), foot, axes).moment * MM;
    for ((axis, value), applied) in ["x", "y", "z"].into_iter().zip(moments.iter()).zip([-900.0, 450.0, 0.0])
    {
        rows.near(format!("strut 4: applied moment about {axis}"), "N mm", (*value, applied), FIGURE, 1e-9);
    }
}
