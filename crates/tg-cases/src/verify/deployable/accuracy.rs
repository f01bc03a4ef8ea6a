//! Runs at the paper's step, its half and its quarter, against a path that is known at a few times.
//!
//! The scheme is symmetric, so its error has even powers of h only, e = c_2 h² + c_4 h⁴ + …, and three runs give the path
//! without the first two terms (Romberg):
//! ```text
//! r_1 = (4 q_{h/2} - q_h) / 3,   r_2 = (4 q_{h/4} - q_{h/2}) / 3,   q = (16 r_2 - r_1) / 15
//! ```

use rayon::prelude::*;

use super::top_path;
use crate::deployable::Choices;
use crate::error::CaseError;
use crate::published::{EXACT, SCHEME, Top};
use crate::row::Rows;
use crate::simulate::{STEP, distance, order};

/// x and z of the mass centre of tetrahedron 10, the point that is compared, \[m\] at successive times.
type Path = Vec<[f64; 2]>;

/// Adds the error at the paper's step beside the published one, the order of convergence, and what is left after
/// extrapolation.
pub(super) fn rows(rows: &mut Rows, name: &str, choices: &Choices, known: &Top) -> Result<(), CaseError> {
    let exact: Path = known.x.iter().zip(&known.z).map(|(&x, &z)| [x, z]).collect();
    let steps = [STEP, STEP / 2.0, STEP / 4.0];
    let paths = steps.par_iter().map(|&h| sample(choices, h, known)).collect::<Result<Vec<Path>, _>>()?;
    let errors: Vec<f64> = paths.iter().map(|path| distance(path, &exact)).collect();
    let label = format!("{name}: largest error, h = 1e-3");
    match known.error {
        // Known to two digits, as the largest at times that are not known.
        Some(published) => rows.near(label, "m", (errors[0], published), SCHEME, 0.1 * published),
        None => rows.below(label, "m", errors[0], EXACT, 3e-5),
    }
    rows.near(
        format!("{name}: order of convergence"),
        "1",
        (order(&errors), 2.0),
        "theory, second order",
        0.01,
    );
    let halves = [extrapolated(4.0, &paths[0], &paths[1]), extrapolated(4.0, &paths[1], &paths[2])];
    let left = distance(&extrapolated(16.0, &halves[0], &halves[1]), &exact);
    // The sixth power of h is left.
    rows.below(format!("{name}: largest error, extrapolated"), "m", left, EXACT, 1e-10);
    Ok(())
}

/// The path at the times at which it is known.
fn sample(choices: &Choices, h: f64, known: &Top) -> Result<Path, CaseError> {
    let path = top_path(choices, h, known.t.last().copied().unwrap_or(0.0))?;
    Ok(known.t.iter().map(|t| path[(t / h).round() as usize]).map(|[x, _, z]| [x, z]).collect())
}

/// The path without the error term that is `factor` times smaller in `fine` than in `coarse`.
fn extrapolated(factor: f64, coarse: &Path, fine: &Path) -> Path {
    let value = |coarse: f64, fine: f64| (factor * fine - coarse) / (factor - 1.0);
    coarse.iter().zip(fine).map(|(c, f)| [value(c[0], f[0]), value(c[1], f[1])]).collect()
}
