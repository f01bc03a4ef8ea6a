//! All paths of one homotopy, in parallel, with the path-crossing check.
//!
//! A regular solution is the end of exactly one path, and the paths that end at a singular one with winding number c come
//! in cycles of c (Sommese & Wampler 2005, ch. 10). Paths that contradict this, or failed, are tracked again with tighter
//! settings. Results do not depend on the number of threads.

use num_complex::Complex64;
use rayon::prelude::*;

use crate::complex_dd::ComplexDd;
use crate::endgame::follow;
use crate::homotopy::Homotopy;
use crate::options::{EndgameOptions, TrackerOptions};
use crate::path::{FailureReason, PathResult, ReturnCode};
use crate::scalar::Field;
use crate::system::PolynomialSystem;
use crate::tracker::{Tracker, distance};

/// Singular ends closer than this (relative) are one: the endgame gives some nine digits.
const SAME_SINGULAR: f64 = 1e-6;

/// How paths are followed.
#[derive(Clone, Debug, PartialEq)]
pub struct PathOptions {
    /// Predictor and corrector.
    pub tracker: TrackerOptions,
    /// Ends.
    pub endgame: EndgameOptions,
    /// How often suspicious paths are tracked again, each time with tighter settings; none of a mechanism's had to be
    /// (docs/accuracy-and-speed.md, "Paths followed again").
    pub retracks: u32,
}

impl Default for PathOptions {
    fn default() -> Self {
        Self { tracker: TrackerOptions::default(), endgame: EndgameOptions::default(), retracks: 3 }
    }
}

/// Follows all paths.
pub(crate) fn run(
    homotopy: &Homotopy,
    system: &PolynomialSystem,
    parameters: &[Complex64],
    starts: &[Vec<Complex64>],
    options: &PathOptions,
) -> Vec<PathResult> {
    let parameters: Vec<ComplexDd> = parameters.iter().map(|&p| p.into()).collect();
    let track = |indices: &[usize], settings: &TrackerOptions| -> Vec<PathResult> {
        let one = |tracker: &mut Tracker<'_>, &i: &usize| {
            let target = (system, parameters.as_slice());
            follow(tracker, target, &options.endgame, settings.first_step, i, &starts[i])
        };
        indices.par_iter().map_init(|| Tracker::new(homotopy, settings), one).collect()
    };
    let all: Vec<usize> = (0..starts.len()).collect();
    let mut results = track(&all, &options.tracker);
    let mut suspects = suspicious(&mut results);
    for level in 1..=options.retracks {
        if suspects.is_empty() {
            break;
        }
        for mut result in track(&suspects, &options.tracker.tightened(level)) {
            result.retracked = level;
            let i = result.index;
            results[i] = result;
        }
        suspects = suspicious(&mut results);
    }
    mark_crossings(&mut results);
    results
}

/// Whether two regular ends are the same to the accuracy that double-double and their condition allow.
fn same_regular(a: &PathResult, b: &PathResult) -> bool {
    let accuracy = (1e-26 + 1e-29 * a.condition.max(b.condition)).min(1e-12);
    (a.extended[0] - b.extended[0]).size()
        <= accuracy * a.extended.iter().map(|z| z.size()).fold(0.0, f64::max)
        && distance(&a.extended, &b.extended) <= accuracy
}

fn same_singular(a: &PathResult, b: &PathResult) -> bool {
    let size = |x: &[Complex64]| x.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let difference = a.solution.iter().zip(&b.solution).map(|(x, y)| (x - y).norm()).fold(0.0, f64::max);
    difference <= SAME_SINGULAR * size(&a.solution).max(1.0)
}

/// Groups of paths with the same end, as lists of indices; single ones included.
fn clusters(
    results: &[PathResult],
    code: ReturnCode,
    same: fn(&PathResult, &PathResult) -> bool,
) -> Vec<Vec<usize>> {
    let mut clusters: Vec<Vec<usize>> = vec![];
    for (i, result) in results.iter().enumerate().filter(|(_, r)| r.code == code) {
        match clusters.iter_mut().find(|c| same(&results[c[0]], result)) {
            Some(cluster) => cluster.push(i),
            None => clusters.push(vec![i]),
        }
    }
    clusters
}

/// Sets multiplicities; the paths whose ends contradict each other or failed.
fn suspicious(results: &mut [PathResult]) -> Vec<usize> {
    let mut suspects: Vec<usize> = vec![];
    for (i, result) in results.iter().enumerate() {
        if matches!(result.code, ReturnCode::Failed(_)) {
            suspects.push(i);
        }
    }
    for cluster in clusters(results, ReturnCode::Success, same_regular) {
        if cluster.len() > 1 {
            suspects.extend(cluster);
        }
    }
    for cluster in clusters(results, ReturnCode::Singular, same_singular) {
        for &i in &cluster {
            results[i].multiplicity = cluster.len();
            let winding = results[i].winding;
            let cycle = cluster.iter().filter(|&&j| results[j].winding == winding).count();
            if cycle % winding.max(1) != 0 {
                suspects.push(i);
            }
        }
    }
    suspects.sort_unstable();
    suspects
}

/// What retracking did not resolve is a failure of all but the first path.
fn mark_crossings(results: &mut [PathResult]) {
    for cluster in clusters(results, ReturnCode::Success, same_regular) {
        for &i in &cluster[1..] {
            results[i].code = ReturnCode::Failed(FailureReason::Crossing);
        }
    }
}

/// Singular ends, grouped.
pub(crate) fn singular_clusters(results: &[PathResult]) -> Vec<Vec<usize>> {
    clusters(results, ReturnCode::Singular, same_singular)
}
