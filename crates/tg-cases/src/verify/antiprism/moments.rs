//! Example 2: moments about the universal joints of four struts with fixed feet.

use nalgebra::Vector3;
use tg_statics::{Configuration, Forward, ForwardOptions, Verdict, stability};

use super::{EXACT, MM, MODEL, apart, ends, table, twin};
use crate::antiprism::{Antiprism, EXAMPLE_2, Feet, Loads, MOMENTS};
use crate::error::CaseError;
use crate::row::Rows;

const LOAD_STEPS: u32 = 20;
const MOST_ITERATIONS: u32 = 200;
const TABLE_9: &str = "paper, Table 9";
const TABLE_10: &str = "paper, Table 10";

const EPSILON: [f64; 4] = [-0.46893071, 0.63110979, 0.81400353, -1.17162752];
const BETA: [f64; 4] = [-0.29156393, 0.15982977, 1.21364812, 0.59477392];
/// A_1 to A_4 \[mm\].
const TOPS: [[f64; 3]; 4] = [
    [12.507788, 43.285908, 85.440343],
    [15.915015, -16.999233, 79.708272],
    [52.436925, -25.417658, 24.003561],
    [56.032151, 35.063143, 32.191133],
];
/// The same in Table 10.
const PRINTED: [[f64; 3]; 4] = [
    [12.5079, 43.2859, 85.4404],
    [15.9151, -16.9992, 79.7083],
    [52.4370, -25.4176, 24.0035],
    [56.0322, 35.0631, 32.1911],
];

pub(super) fn loads() -> Loads {
    Loads::JointMoments(MOMENTS.to_vec())
}

/// Example 2 with its equilibrium under full load, by load steps from the unloaded state.
pub(super) fn loaded(loads: &Loads) -> Result<(Antiprism, Configuration), CaseError> {
    let structure = Antiprism::new(&EXAMPLE_2, Feet::Fixed, loads)?;
    let options = ForwardOptions { load_steps: LOAD_STEPS, relax: false, ..ForwardOptions::default() };
    let q = structure.model.initial_coordinates();
    let forward = Forward::new(&structure.model, options);
    let found = forward.solve_from(&q, &structure.inputs(0.0), &structure.inputs(1.0))?;
    Ok((structure, found.configuration))
}

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    let (structure, found) = loaded(&loads())?;
    let state = ends(&structure, &found.q);
    let angles: Vec<[f64; 2]> = (0..4).map(|j| structure.angles(j, &found.q)).collect();
    let (eps, beta) = (|| angles.iter().map(|x| x[0]), || angles.iter().map(|x| x[1]));
    table(rows, "example 2: ε", "rad", eps(), &EPSILON, (EXACT, 0.51e-8));
    table(rows, "example 2: β", "rad", beta(), &BETA, (EXACT, 0.51e-8));
    for (d, axis) in ["x", "y", "z"].into_iter().enumerate() {
        let tops = || state.iter().map(move |s| s[1][d]);
        let name = format!("example 2: A_{axis}");
        table(rows, &name, "mm", tops(), &TOPS.map(|top| top[d]), (EXACT, 0.51e-6));
        // The table has the printed, rounded R_B in it.
        table(rows, &name, "mm", tops(), &PRINTED.map(|top| top[d]), (TABLE_10, 1.2e-4));
    }
    // Four decimals; strut 1 is cut off after three, not rounded.
    let note = "(the paper cuts strut 1 off: -0.468, -0.291)";
    let (printed, half) = ([-0.4689, 0.6311, 0.8140, -1.1716], (TABLE_9, 0.5001e-4));
    table(rows, &format!("example 2: ε {note}"), "rad", eps(), &printed, half);
    let (printed, half) = ([-0.2916, 0.1598, 1.2136, 0.5948], (TABLE_9, 0.5001e-4));
    table(rows, &format!("example 2: β {note}"), "rad", beta(), &printed, half);

    let twin = twin(&structure, Feet::Fixed, &loads(), 1.0);
    let reference = twin.equilibrium(&twin.at(&state))?;
    let distance = apart(&state, &twin.ends(&reference));
    rows.below("example 2: largest distance of an end", "mm", distance, MODEL, 1e-8);
    let stability = stability(&structure.model, &found, 1)?;
    let unstable = usize::from(stability.verdict != Verdict::Stable);
    rows.exact("example 2: unstable", (unstable, 0), EXACT);
    let ours = (stability.counts.negative, stability.counts.zero);
    let theirs = twin.signs(&reference);
    rows.exact("example 2: negative eigenvalues", (ours.0, theirs.0), MODEL);
    rows.exact("example 2: zero eigenvalues", (ours.1, theirs.1), MODEL);
    let potential = structure.model.energy(&found.q, &vec![0.0; found.q.len()], &found.u).potential();
    // Bottom ties are idle here: both of their ends are fixed.
    let idle: f64 = structure.tensions(&found.q)[1].iter().map(|f| 0.5 * f * f / 500.0).sum();
    rows.near(
        "example 2: potential",
        "N mm",
        ((potential + idle) * MM, twin.potential(&reference)),
        MODEL,
        1e-9,
    );
    vectors(rows)
}

/// Moment vectors M_ε x + M_β y_C on struts without spin, y_C the joint's second axis, instead of moments that a universal
/// joint leads: another load, another equilibrium. The vectors follow ε from one solution to the next.
fn vectors(rows: &mut Rows) -> Result<(), CaseError> {
    let structure = Antiprism::new(&EXAMPLE_2, Feet::Fixed, &Loads::MomentVectors(vec![[0.0; 3]; 4]))?;
    let options = ForwardOptions { relax: false, ..ForwardOptions::default() };
    let forward = Forward::new(&structure.model, options);
    let (mut q, mut u) = (structure.model.initial_coordinates(), structure.inputs(1.0));
    let mut change = 0.0;
    for step in 1..=LOAD_STEPS {
        let factor = f64::from(step) / f64::from(LOAD_STEPS);
        for _ in 0..MOST_ITERATIONS {
            for (j, &load) in structure.loads.iter().enumerate() {
                let (sin, cos) = structure.angles(j, &q)[0].sin_cos();
                let [about_x, about_y] = MOMENTS[j].map(|m| m * factor);
                let vector = [about_x, about_y * cos, about_y * sin];
                u[structure.model.load_inputs(load)].copy_from_slice(&vector);
            }
            let next = forward.solve(&q, &u)?.configuration.q;
            change = q.iter().zip(&next).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            q = next;
            if change < 1e-13 {
                break;
            }
        }
    }
    rows.below("example 2 with moment vectors: change of the last iteration", "m", change, EXACT, 1e-12);
    let top: Vector3<f64> = structure.ends(0, &q)[1] * MM;
    for ((axis, value), exact) in ["x", "y", "z"].into_iter().zip(top.iter()).zip([5.2338, 46.7340, 80.7376])
    {
        let name = format!("example 2 with moment vectors: A_1{axis}");
        rows.near(name, "mm", (*value, exact), EXACT, 0.5001e-4);
    }
    Ok(())
}
