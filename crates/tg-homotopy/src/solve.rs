//! All isolated solutions from scratch: choose a start system, follow every path.

use num_complex::Complex64;

use crate::batch::{PathOptions, run};
use crate::error::{HomotopyError, check_finite, check_length};
use crate::grouping::Grouping;
use crate::homotopy::Homotopy;
use crate::path::{PathResult, ReturnCode};
use crate::random::Random;
use crate::system::PolynomialSystem;

/// How to start.
#[derive(Clone, Debug, PartialEq)]
pub enum Start {
    /// One group: roots of unity, Π d_i paths.
    TotalDegree,
    /// Linear products for this partition.
    Grouped(Grouping),
    /// The partition with the fewest paths among these.
    Best(Vec<Grouping>),
}

/// Settings of [`solve`].
#[derive(Clone, Debug, PartialEq)]
pub struct SolveOptions {
    /// Start system.
    pub start: Start,
    /// Decides all random numbers.
    pub seed: u64,
    /// More paths than this are an error before anything is tracked. A mechanism's path takes a millisecond
    /// (docs/accuracy-and-speed.md, "Predictor of paths"), so that the default is a minute or two.
    pub max_paths: u64,
    /// How paths are followed.
    pub paths: PathOptions,
}

impl Default for SolveOptions {
    fn default() -> Self {
        Self { start: Start::TotalDegree, seed: 1, max_paths: 100_000, paths: PathOptions::default() }
    }
}

/// A singular finite solution.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularSolution {
    /// The point, to some nine digits.
    pub point: Vec<Complex64>,
    /// Paths that end there: the multiplicity, if the point is isolated.
    pub multiplicity: usize,
    /// Winding numbers of the cycles of paths that end there, increasing.
    pub windings: Vec<usize>,
}

/// All paths of one homotopy.
#[derive(Clone, Debug)]
pub struct SolveReport {
    /// Every path, by its start solution.
    pub paths: Vec<PathResult>,
    /// The partition whose projective spaces were used; none in affine unknowns.
    pub grouping: Option<Grouping>,
}

impl SolveReport {
    /// Regular finite solutions.
    pub fn solutions(&self) -> Vec<Vec<Complex64>> {
        self.successes().map(|p| p.solution.clone()).collect()
    }

    /// The paths that ended at regular finite solutions.
    pub fn successes(&self) -> impl Iterator<Item = &PathResult> {
        self.paths.iter().filter(|p| p.is_success())
    }

    /// Singular finite solutions.
    pub fn singular(&self) -> Vec<SingularSolution> {
        crate::batch::singular_clusters(&self.paths)
            .into_iter()
            .map(|cluster| {
                let mut seen: Vec<usize> = cluster.iter().map(|&i| self.paths[i].winding).collect();
                seen.sort_unstable();
                // c paths of winding number c are one cycle.
                let mut windings = vec![];
                let mut rest = seen.as_slice();
                while let Some(&c) = rest.first() {
                    windings.push(c);
                    let run = rest.iter().take(c.max(1)).take_while(|&&w| w == c).count();
                    rest = &rest[run..];
                }
                let point = self.paths[cluster[0]].solution.clone();
                SingularSolution { point, multiplicity: cluster.len(), windings }
            })
            .collect()
    }

    /// Number of paths that ended at infinity.
    pub fn at_infinity(&self) -> usize {
        self.paths.iter().filter(|p| p.code == ReturnCode::AtInfinity).count()
    }

    /// The paths that failed: while there is one, a solution may be missing.
    pub fn failures(&self) -> impl Iterator<Item = &PathResult> {
        self.paths.iter().filter(|p| matches!(p.code, ReturnCode::Failed(_)))
    }
}

impl Start {
    /// The partition and the number of paths, before anything is tracked.
    pub fn estimate(&self, system: &PolynomialSystem) -> Result<(Grouping, u64), HomotopyError> {
        let single = |g: Grouping| g.bezout(system).map(|count| (g, count));
        match self {
            Self::TotalDegree => single(Grouping::single(system.unknowns())),
            Self::Grouped(grouping) => single(grouping.clone()),
            Self::Best(choices) => Grouping::best(system, choices),
        }
    }
}

/// All isolated solutions of F(x; `parameters`) = 0.
pub fn solve(
    system: &PolynomialSystem,
    parameters: &[Complex64],
    options: &SolveOptions,
) -> Result<SolveReport, HomotopyError> {
    check_length("parameters", system.parameters(), parameters.len())?;
    check_finite("parameter", parameters)?;
    let (grouping, paths) = options.start.estimate(system)?;
    if paths == 0 {
        return Err(HomotopyError::NoPaths);
    }
    if paths > options.max_paths {
        return Err(HomotopyError::TooManyPaths { paths, limit: options.max_paths });
    }
    let mut random = Random::new(options.seed);
    let (homotopy, starts) = Homotopy::from_start(system, parameters, &grouping, &mut random)?;
    let paths = run(&homotopy, system, parameters, &starts, &options.paths);
    Ok(SolveReport { paths, grouping: Some(grouping) })
}
