//! Example 1: 10 N down on each of three tops, the feet sliding on the plane.

use nalgebra::Vector3;
use tg_statics::{Equilibrium, EquilibriumReport, Forward, ForwardOptions, Verdict, stability};

use super::{EXACT, MM, MODEL, apart, ends, table, turn, turned, twin};
use crate::antiprism::{Antiprism, EXAMPLE_1, FORCE, Feet, Loads, angles};
use crate::error::CaseError;
use crate::row::Rows;

const TABLE_4: &str = "paper, Table 4";
const TABLE_5: &str = "paper, Table 5";

/// Feet of Table 4 \[mm\].
const A: [f64; 3] = [40.8573, -20.4241, -20.4332];
const B: [f64; 3] = [-0.0053, 35.3861, -35.3808];
const EPSILON: [f64; 3] = [-0.0269, 0.6808, -0.6643];
const BETA: [f64; 3] = [-0.7434, 0.3271, 0.3635];
/// Tops of Table 5 \[mm\]; A_1x is -26.8241, printed as -26.8244.
const TOPS: [[f64; 3]; 3] =
    [[-26.8241, 11.7016, 15.1224], [1.9750, -24.2177, 22.2429], [73.5888, 73.5888, 73.5888]];
/// Half a unit of a fourth decimal, with room for the rounding of the comparison.
const FOURTH: f64 = 0.5001e-4;

pub(super) fn loads() -> Loads {
    Loads::Force(FORCE, 1.0)
}

/// The equilibrium under full load, in so many steps from the unloaded state.
pub(super) fn loaded(structure: &Antiprism, load_steps: u32) -> Result<Equilibrium, CaseError> {
    let options = ForwardOptions { load_steps, relax: false, ..ForwardOptions::default() };
    let q = structure.model.initial_coordinates();
    Ok(Forward::new(&structure.model, options).solve_from(
        &q,
        &structure.inputs(0.0),
        &structure.inputs(1.0),
    )?)
}

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    let structure = Antiprism::new(&EXAMPLE_1, Feet::Sliding, &loads())?;
    let found = loaded(&structure, 20)?.configuration;
    let state = ends(&structure, &found.q);
    let centre = state.iter().map(|s| s[0]).sum::<Vector3<f64>>() / 3.0;
    let centred: Vec<_> = state.iter().map(|s| s.map(|p| p - centre)).collect();
    scalars(rows, &structure, &found, &centred)?;
    printed(rows, &centred);

    let twin = twin(&structure, Feet::Sliding, &loads(), 1.0);
    let reference = twin.equilibrium(&twin.at(&centred))?;
    let feet: Vec<_> = twin.ends(&reference).iter().map(|s| s[0]).collect();
    let ours = turned(&centred, turn(&centred, &feet));
    rows.below(
        "example 1: largest distance of an end",
        "mm",
        apart(&ours, &twin.ends(&reference)),
        MODEL,
        1e-8,
    );
    let (negative, zero) = twin.signs(&reference);
    let stability = stability(&structure.model, &found, 2)?;
    let unstable = usize::from(stability.verdict == Verdict::Unstable);
    rows.exact("example 1: Table 4's state is unstable", (unstable, 1), EXACT);
    rows.exact("example 1: negative eigenvalues", (stability.counts.negative, 2), EXACT);
    rows.exact("example 1: negative eigenvalues of the twin", (stability.counts.negative, negative), MODEL);
    rows.exact("example 1: zero eigenvalues", (stability.counts.zero, 3), EXACT);
    rows.exact("example 1: zero eigenvalues of the twin", (stability.counts.zero, zero), MODEL);
    rows.exact("example 1: rigid motions of the plane", (stability.rigid_motions, 3), EXACT);
    for (k, pair) in stability.lowest.iter().enumerate() {
        let name = format!("example 1: eigenvalue {}", k + 1);
        rows.near(name, "N/mm", (pair.value / MM, -0.00657), EXACT, 0.5e-5);
    }
    one_step(rows, &structure)
}

/// Radii, twist, forces and energy of the symmetric state.
fn scalars(
    rows: &mut Rows,
    structure: &Antiprism,
    found: &tg_statics::Configuration,
    state: &[[Vector3<f64>; 2]],
) -> Result<(), CaseError> {
    let [foot, top] = state[0];
    let angle = |p: &Vector3<f64>| p.y.atan2(p.x);
    let twist = (angle(&top) - angle(&foot)).to_degrees().rem_euclid(360.0);
    let mut exact = |what: &str, unit, value: f64, exact: f64, half: f64| {
        rows.near(format!("example 1: {what}"), unit, (value, exact), EXACT, half);
    };
    exact("R_B", "mm", foot.xy().norm(), 40.8572997806, 0.51e-10);
    exact("R_T", "mm", top.xy().norm(), 26.8967114872, 0.51e-10);
    exact("twist", "°", twist, 175.7964072454, 0.51e-10);
    exact("A_z", "mm", top.z, 73.5887657317, 0.51e-10);
    let [t, b, l] = structure.tensions(&found.q);
    for j in 0..3 {
        let k = j + 1;
        exact(&format!("tension of top tie {k}"), "N", t[j], 5.79323543, 0.51e-8);
        exact(&format!("tension of bottom tie {k}"), "N", b[j], 5.63007572, 0.51e-8);
        exact(&format!("tension of lateral tie {k}"), "N", l[j], 1.07137156, 0.51e-8);
    }
    let report = EquilibriumReport::new(&structure.model, &found.q, &found.u)?;
    for (j, member) in report.members.iter().enumerate() {
        let axial = member.axial.unwrap_or(f64::NAN);
        exact(&format!("axial force of strut {}", j + 1), "N", axial, -14.91054726, 0.51e-8);
    }
    let potential = structure.model.energy(&found.q, &vec![0.0; found.q.len()], &found.u).potential();
    exact("potential", "N mm", potential * MM, 2468.5582208952, 0.51e-10);
    rows.below("example 1: residual force per largest", "1", report.imbalance, "equilibrium", 1e-12);
    Ok(())
}

/// Tables 4 and 5. The paper's state stands a little turned on its plane, as far as its feet say.
fn printed(rows: &mut Rows, state: &[[Vector3<f64>; 2]]) {
    let feet: Vec<_> = (0..3).map(|j| Vector3::new(A[j], B[j], 0.0)).collect();
    let state = turned(state, turn(state, &feet));
    let angles: Vec<[f64; 2]> = state.iter().map(|[foot, top]| angles(&(top - foot))).collect();
    let source = (TABLE_4, FOURTH);
    table(rows, "example 1: a", "mm", state.iter().map(|s| s[0].x), &A, source);
    table(rows, "example 1: b", "mm", state.iter().map(|s| s[0].y), &B, source);
    table(rows, "example 1: ε", "rad", angles.iter().map(|x| x[0]), &EPSILON, source);
    table(rows, "example 1: β", "rad", angles.iter().map(|x| x[1]), &BETA, source);
    for (d, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let note = if d == 0 { " (the paper prints -26.8244 for strut 1: not its own Table 4)" } else { "" };
        // Tops were computed from the rounded angles of Table 4: 100 mm times half of 1e-4.
        let source = (TABLE_5, 5e-3);
        table(
            rows,
            &format!("example 1: A_{axis}{note}"),
            "mm",
            state.iter().map(|s| s[1][d]),
            &TOPS[d],
            source,
        );
    }
}

/// Without load steps, Newton's method ends at another equilibrium.
fn one_step(rows: &mut Rows, structure: &Antiprism) -> Result<(), CaseError> {
    let found = loaded(structure, 1)?.configuration;
    let mut tops: Vec<f64> = (0..3).map(|j| structure.ends(j, &found.q)[1].z * MM).collect();
    // Rounding says at which strut the symmetry breaks; the highest comes first here.
    let highest = (0..3).max_by(|&a, &b| tops[a].total_cmp(&tops[b])).unwrap_or(0);
    tops.rotate_left(highest);
    let name = "example 1 in one step: A_z, from the highest";
    table(rows, name, "mm", tops, &[74.007, 73.075, 73.659], (EXACT, 0.5001e-3));
    let stability = stability(&structure.model, &found, 1)?;
    rows.exact("example 1 in one step: negative eigenvalues", (stability.counts.negative, 1), EXACT);
    Ok(())
}
