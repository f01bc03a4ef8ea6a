//! Pseudo-arclength continuation (Keller): equilibria as one parameter changes, around folds.
//!
//! ```text
//! F(q, p) + A(q)ᵀλ = 0,   Φ(q) = 0,   t_q·(q - q₀)/L² + t_p (p - p₀)/P² = ds
//! ```
//! t is the unit tangent of the branch in the metric of the third equation; L is the structure's size, P the range of the
//! parameter. At every point three things are looked at: the sign of t_p, the number of negative eigenvalues of the reduced
//! Hessian, which cables are taut. Where one changes, bisection in the arclength finds the place.

use crate::branch::{Branch, BranchEnd};
use crate::continuation_error::ContinuationError;
use crate::continuation_options::ContinuationOptions;
use crate::family::Family;
use crate::path::Path;

/// Corrections up to which the next step is longer.
const QUICK: u32 = 4;
const GROWTH: f64 = 1.5;

/// Follows the branch through an equilibrium at full coordinates `q` and parameter `range.0` towards `range.1`.
///
/// # Errors
/// There is no equilibrium at the start, or a tangent cannot be had. A branch that is lost later is no error.
pub fn continuation(
    family: &dyn Family,
    q: &[f64],
    range: (f64, f64),
    options: &ContinuationOptions,
) -> Result<Branch, ContinuationError> {
    let mut path = Path::new(family, q, range, options)?;
    let mut here = path.start(q)?;
    let mut branch = Branch { points: vec![here.point.clone()], events: Vec::new(), end: BranchEnd::Steps };
    let mut step = options.step;
    for _ in 0..options.steps {
        let Some(next) = path.step(&here, step)? else {
            step *= 0.5;
            if step < options.shortest {
                branch.end = BranchEnd::Lost;
                break;
            }
            continue;
        };
        let passed = path.passed(next.point.parameter);
        let next = match passed {
            None => next,
            Some((bound, _)) => path.at_bound(&here, step, bound)?,
        };
        branch.events.extend(path.events(&here, &next)?);
        branch.points.push(next.point.clone());
        if let Some((_, end)) = passed {
            branch.end = end;
            break;
        }
        if next.corrections <= QUICK {
            step = (step * GROWTH).min(options.longest);
        }
        here = next;
    }
    Ok(branch)
}
