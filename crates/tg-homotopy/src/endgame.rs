//! The end of a path: an ordinary step to t = 0 where the end is regular, otherwise the Cauchy endgame.
//!
//! Near t = 0 a path is a power series in t^(1/c), c the winding number. Going round t = 0 on a circle of radius r, the
//! path is back after c turns, and by Cauchy's integral formula its end is the mean over them:
//!
//! ```text
//! X(0) = 1/(c K) Σ_{j<cK} X(r e^(2πij/K)) + O((r/R)^K)       Morgan, Sommese & Wampler (Numer. Math. 58, 1991)
//! ```
//!
//! with R the distance of the next branch point. Means at two radii must agree. Regular ends with branch points within r look
//! like one singular end; Newton's method tells: from their mean it leaps, at most singular ends it stays. After a leap the
//! path is followed to smaller radii.

use num_complex::Complex64;

use crate::complex_dd::ComplexDd;
use crate::dd::Dd;
use crate::lu;
use crate::options::EndgameOptions;
use crate::path::{FailureReason, PathResult, ReturnCode};
use crate::scalar::{Field, Scalar};
use crate::system::PolynomialSystem;
use crate::tracker::{Arrival, Tracker, distance, largest};

/// Shrinking of the radius from one estimate to the next.
const SHRINK: f64 = 0.1;
/// Newton steps that refine an end.
const REFINEMENTS: usize = 12;
/// Newton steps longer than this from a mean are leaps: means of singular ends are known better.
const LEAP: f64 = 1e-10;
/// Radius at which even a leap is believed to leave a singular end: clusters of regular ends that close to each other
/// cannot be told from it in double-double.
const ISOLATING: f64 = 1e-22;
/// Radius from which the distance of sheets, r^(1/c), asks for double-double.
const EXTENDED_RADIUS: f64 = 1e-10;
/// Affine paths beyond this norm are taken to diverge.
const DIVERGED: f64 = 1e10;

/// Where a path ended, in unknowns of a path.
struct End {
    point: Vec<ComplexDd>,
    winding: usize,
    regular: bool,
    radius: f64,
}

/// One path from its start point to its end.
pub(crate) fn follow(
    tracker: &mut Tracker<'_>,
    target: (&PolynomialSystem, &[ComplexDd]),
    endgame: &EndgameOptions,
    first_step: f64,
    index: usize,
    start: &[Complex64],
) -> PathResult {
    tracker.start(start);
    let end = tracker
        .track(Complex64::new(endgame.start, 0.0), first_step, None)
        .and_then(|_| approach(tracker, endgame));
    let mut result = PathResult {
        index,
        code: ReturnCode::AtInfinity,
        solution: vec![],
        extended: vec![],
        winding: 0,
        multiplicity: 0,
        condition: f64::NAN,
        radius: tracker.t().norm(),
        retracked: 0,
        counts: tracker.counts,
    };
    match end {
        Err(reason) => {
            // Without patches a diverging path ends as a failed one.
            let diverged = tracker.homotopy.groups() == 0 && largest(&tracker.extended_point()) > DIVERGED;
            result.code = if diverged { ReturnCode::AtInfinity } else { ReturnCode::Failed(reason) };
        }
        Ok(end) => {
            (result.winding, result.radius) = (end.winding, end.radius);
            if let Some(solution) = dehomogenize(tracker, &end, endgame) {
                classify(&mut result, target, solution, end.regular);
            }
        }
    }
    result
}

/// Fills in a finite end.
fn classify(
    result: &mut PathResult,
    (system, parameters): (&PolynomialSystem, &[ComplexDd]),
    solution: Vec<ComplexDd>,
    regular: bool,
) {
    result.solution = solution.iter().map(|z| z.to_c64()).collect();
    result.multiplicity = 1;
    if regular {
        result.condition = lu::condition(&system.jacobian(&solution, parameters), &solution);
        result.extended = solution;
        result.code = ReturnCode::Success;
    } else {
        result.condition = f64::INFINITY;
        result.code = ReturnCode::Singular;
    }
}

/// X_j/X_0g, or nothing if a group is at infinity.
fn dehomogenize(tracker: &Tracker<'_>, end: &End, endgame: &EndgameOptions) -> Option<Vec<ComplexDd>> {
    let (n, group_of) = (tracker.homotopy.affine_unknowns(), tracker.homotopy.group_of());
    let groups = tracker.homotopy.groups();
    if groups == 0 {
        return (largest(&end.point) <= DIVERGED).then(|| end.point.clone());
    }
    let limit = if end.regular { endgame.infinity } else { endgame.singular_infinity };
    if nearness(tracker, &end.point) <= limit {
        return None;
    }
    let inverses: Vec<ComplexDd> = (0..groups).map(|g| end.point[n + g].recip()).collect();
    Some((0..n).map(|v| end.point[v] * inverses[group_of[v]]).collect())
}

/// min_g |X_0g|/‖X_g‖: zero at infinity.
fn nearness(tracker: &Tracker<'_>, point: &[ComplexDd]) -> f64 {
    let (n, group_of) = (tracker.homotopy.affine_unknowns(), tracker.homotopy.group_of());
    let ratio = |g: usize| {
        let members = (0..group_of.len()).filter(|&v| group_of[v] == g);
        point[n + g].size() / members.map(|v| point[v].size()).fold(0.0, f64::max)
    };
    (0..tracker.homotopy.groups()).map(ratio).fold(f64::INFINITY, f64::min)
}

fn at_infinity(tracker: &Tracker<'_>, point: &[ComplexDd], endgame: &EndgameOptions) -> bool {
    nearness(tracker, point) <= endgame.singular_infinity
}

/// From `endgame.start` to the end.
fn approach(tracker: &mut Tracker<'_>, endgame: &EndgameOptions) -> Result<End, FailureReason> {
    tracker.freeze_patch();
    let zero = Complex64::new(0.0, 0.0);
    let mut stall = endgame.first_radius;
    let mut before: Option<(usize, Vec<ComplexDd>)> = None;
    let mut direct = true;
    loop {
        let radius = tracker.t().norm();
        if direct && tracker.track(zero, radius, Some(stall))? == Arrival::Reached {
            let (previous, previous_t) = tracker.previous();
            let point = tracker.extended_point();
            if let Some((refined, polish)) = tracker.polish(&point, zero, REFINEMENTS)
                && polish.quadratic
                && polish.first <= 1e-6
            {
                return Ok(End { point: refined, winding: 1, regular: true, radius: 0.0 });
            }
            // A step to a singular end can look short enough; go round it instead.
            tracker.restore(&previous, previous_t);
            direct = false;
        }
        let radius = tracker.t().norm();
        if radius < EXTENDED_RADIUS {
            tracker.stay_extended();
        }
        if radius < endgame.smallest_radius {
            return Err(FailureReason::EndgameUnsettled);
        }
        if let Some((winding, mean)) = turn(tracker, endgame)? {
            if let Some((last_winding, last)) = &before
                && *last_winding == winding
                && difference(&mean, last) <= endgame.tolerance
                && let Some(end) = settle(tracker, endgame, winding, &mean, radius)
            {
                return Ok(end);
            }
            before = Some((winding, mean));
        } else {
            before = None;
        }
        stall = radius * SHRINK;
        if !direct {
            tracker.track(Complex64::new(stall, 0.0), radius, None)?;
        }
    }
}

/// ‖a - b‖ relative to ‖b‖, but absolute for small b: patches have norm about 1.
fn difference(a: &[ComplexDd], b: &[ComplexDd]) -> f64 {
    distance(a, b) * largest(b).min(1.0)
}

/// Turns round t = 0 until the path closes: the winding number and the mean.
fn turn(
    tracker: &mut Tracker<'_>,
    endgame: &EndgameOptions,
) -> Result<Option<(usize, Vec<ComplexDd>)>, FailureReason> {
    let (start, t) = (tracker.extended_point(), tracker.t());
    let mut sum = vec![ComplexDd::zero(); start.len()];
    let mut excursion: f64 = 0.0;
    for winding in 1..=endgame.largest_winding {
        tracker.counts.turns += 1;
        for k in 1..=endgame.samples {
            let point = tracker.extended_point();
            excursion = excursion.max(difference(&point, &start));
            for (s, x) in sum.iter_mut().zip(point) {
                *s = *s + x;
            }
            let angle = std::f64::consts::TAU * k as f64 / endgame.samples as f64;
            let next = if k == endgame.samples { t } else { t * Complex64::from_polar(1.0, angle) };
            tracker.track(next, t.norm(), None)?;
        }
        let back = difference(&tracker.extended_point(), &start);
        if back <= tracker.accuracy() || back <= endgame.closure * excursion {
            let inverse = Dd::ONE / Dd::from((winding * endgame.samples) as f64);
            let inverse = ComplexDd::new(inverse, Dd::ZERO);
            let mean = sum.into_iter().map(|s| s * inverse).collect();
            tracker.restore(&start, t);
            return Ok(Some((winding, mean)));
        }
    }
    tracker.restore(&start, t);
    Ok(None)
}

/// Whether the mean is an end. Regular: Newton's method converges quadratically from it. Singular: it stays near. A leap
/// means that the circle holds the branch points of several regular ends, or a multiple end that Newton's method leaves.
fn settle(
    tracker: &mut Tracker<'_>,
    endgame: &EndgameOptions,
    winding: usize,
    mean: &[ComplexDd],
    radius: f64,
) -> Option<End> {
    let singular = End { point: mean.to_vec(), winding, regular: false, radius };
    match tracker.polish(mean, Complex64::new(0.0, 0.0), REFINEMENTS) {
        Some((point, polish)) if polish.quadratic => {
            let same = winding == 1 && polish.first <= endgame.tolerance;
            same.then_some(End { point, winding, regular: true, radius: 0.0 })
        }
        // Ends at infinity need not be told apart, and often lie on components of positive dimension.
        _ if at_infinity(tracker, mean, endgame) => Some(singular),
        Some((_, polish)) if !(polish.longest <= LEAP) && radius > ISOLATING => None,
        _ => Some(singular),
    }
}
