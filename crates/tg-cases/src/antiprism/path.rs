//! What happens to an antiprism as its load grows from zero: a branch of equilibria with its events.
//!
//! Limit points and losses of stability come from the continuation. Two events more are located on the branch: a tie whose
//! tension becomes negative, which a cable would not follow, and two struts that meet, which no strut does:
//! ```text
//! f_j = k (w_j - w_j0) = 0;       (E_k - E_j)·(u_j × u_k) = 0 with the nearest points inside both struts
//! ```

use std::fmt;

use tg_statics::{
    Branch, BranchEnd, ContinuationOptions, EventKind, Forward, ForwardOptions, InputFamily, continuation,
};

use super::nearest::{Nearest, clearance};
use super::{Antiprism, EXAMPLE_1, EXAMPLE_2, FORCE, Feet, Loads, MOMENTS};
use crate::error::CaseError;

/// Bisections between two points of the branch: to rounding of the load factor.
const BISECTIONS: u32 = 44;

/// What happens on a load path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PathEventKind {
    /// The load factor turns back: no equilibrium nearby beyond it.
    LimitPoint,
    /// The number of negative Hessian eigenvalues changes while the factor goes on.
    Stability,
    /// A tie's tension falls below zero: from here on the two-way spring pushes.
    Pushes {
        /// Name of the tie.
        tie: String,
    },
    /// A pushing tie pulls again.
    Pulls {
        /// Name of the tie.
        tie: String,
    },
    /// Two struts go through each other.
    StrutsMeet {
        /// The struts, from 0.
        struts: (usize, usize),
    },
}

/// An event on a load path.
#[derive(Clone, Debug)]
pub struct PathEvent {
    /// What happens.
    pub kind: PathEventKind,
    /// Load factor.
    pub factor: f64,
    /// Full coordinates there.
    pub q: Vec<f64>,
    /// The point of the path before it.
    pub after: usize,
    /// Negative Hessian eigenvalues before and behind.
    pub negative: (usize, usize),
}

/// An equilibrium on a load path.
#[derive(Clone, Debug)]
pub struct PathPoint {
    /// Load factor.
    pub factor: f64,
    /// Full coordinates.
    pub q: Vec<f64>,
    /// Negative Hessian eigenvalues: zero where stable.
    pub negative: usize,
    /// Tensions of top, bottom and lateral ties \[N\].
    pub tensions: [Vec<f64>; 3],
    /// Least distance between two struts \[m\].
    pub clearance: f64,
}

/// A load path.
#[derive(Clone, Debug)]
pub struct LoadPath {
    /// Equilibria from the unloaded state on.
    pub points: Vec<PathPoint>,
    /// Events in the order of the branch.
    pub events: Vec<PathEvent>,
    /// Why the branch ended.
    pub end: BranchEnd,
}

impl fmt::Display for PathEventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LimitPoint => write!(f, "limit point"),
            Self::Stability => write!(f, "stability changes"),
            Self::Pushes { tie } => write!(f, "\"{tie}\" pushes: a cable would be slack"),
            Self::Pulls { tie } => write!(f, "\"{tie}\" pulls again"),
            Self::StrutsMeet { struts: (j, k) } => write!(f, "struts {} and {} meet", j + 1, k + 1),
        }
    }
}

impl LoadPath {
    /// First event of a kind.
    pub fn first(&self, wanted: impl Fn(&PathEventKind) -> bool) -> Option<&PathEvent> {
        self.events.iter().find(|event| wanted(&event.kind))
    }
}

/// Steps of continuation that lead past the fold of either example.
const STEPS: u32 = 28;

/// The loaded examples of the paper, with their names.
///
/// # Errors
/// No structure has these parameters; both do.
pub fn examples() -> Result<[(&'static str, Antiprism); 2], CaseError> {
    let forces = Loads::Force(FORCE, 1.0);
    let moments = Loads::JointMoments(MOMENTS.to_vec());
    Ok([
        ("example 1", Antiprism::new(&EXAMPLE_1, Feet::Sliding, &forces)?),
        ("example 2", Antiprism::new(&EXAMPLE_2, Feet::Fixed, &moments)?),
    ])
}

/// The load path of an example, past the fold that ends it.
///
/// # Errors
/// As [`load_path`].
pub fn past_fold(example: &Antiprism) -> Result<LoadPath, CaseError> {
    load_path(example, 2.0, &ContinuationOptions { steps: STEPS, ..ContinuationOptions::default() })
}

/// Follows the equilibria of an antiprism from no load to `to` times its load.
///
/// # Errors
/// The branch has no start, or an event cannot be located.
pub fn load_path(
    antiprism: &Antiprism,
    to: f64,
    options: &ContinuationOptions,
) -> Result<LoadPath, CaseError> {
    let model = &antiprism.model;
    let family = InputFamily::load_factor(model, &model.inputs_at(0.0));
    let branch = continuation(&family, &model.initial_coordinates(), (0.0, to), options)?;
    let points: Vec<PathPoint> = branch
        .points
        .iter()
        .map(|point| {
            let q = point.configuration.q.clone();
            PathPoint {
                factor: point.parameter,
                negative: point.negative,
                tensions: antiprism.tensions(&q),
                clearance: clearance(antiprism, &q),
                q,
            }
        })
        .collect();
    let mut events: Vec<(f64, PathEvent)> = of_branch(&branch);
    for (k, pair) in points.windows(2).enumerate() {
        for (s, event) in between(antiprism, k, [&pair[0], &pair[1]])? {
            events.push((k as f64 + s, event));
        }
    }
    events.sort_by(|a, b| a.0.total_cmp(&b.0));
    let events = events.into_iter().map(|(_, event)| event).collect();
    Ok(LoadPath { points, events, end: branch.end })
}

/// Events of the continuation with their place among the points.
fn of_branch(branch: &Branch) -> Vec<(f64, PathEvent)> {
    let mut placed = Vec::new();
    let mut from = 0;
    for event in &branch.events {
        let kind = match event.kind {
            EventKind::LimitPoint => PathEventKind::LimitPoint,
            EventKind::Bifurcation => PathEventKind::Stability,
            EventKind::Slack { .. } | EventKind::Taut { .. } => continue,
        };
        // The first change of the counts behind the last event is this one.
        let changes = |k: &usize| {
            let (a, b) = (&branch.points[*k], &branch.points[k + 1]);
            a.negative != b.negative || a.direction.signum() != b.direction.signum()
        };
        from = (from..branch.points.len().saturating_sub(1)).find(changes).unwrap_or(from);
        let (factor, q) = (event.parameter, event.configuration.q.clone());
        placed
            .push((from as f64 + 0.5, PathEvent { kind, factor, q, after: from, negative: event.negative }));
        // Several events may lie between two points; the last of them leads to the next one's count.
        if branch.points[from + 1].negative == event.negative.1 {
            from += 1;
        }
    }
    placed
}

/// Ties that change sign and struts that meet between two points, each with its place between them.
fn between(
    antiprism: &Antiprism,
    after: usize,
    [a, b]: [&PathPoint; 2],
) -> Result<Vec<(f64, PathEvent)>, CaseError> {
    let mut events = Vec::new();
    let ties = [&antiprism.top, &antiprism.bottom, &antiprism.lateral];
    for (kind, ties) in ties.iter().enumerate() {
        for (j, &tie) in ties.iter().enumerate() {
            let (first, last) = (a.tensions[kind][j], b.tensions[kind][j]);
            if first.signum() == last.signum() {
                continue;
            }
            let tension = |q: &[f64]| antiprism.tensions(q)[kind][j];
            let (s, factor, q) = locate(antiprism, a, b, tension)?;
            let tie = antiprism.model.cable_name(tie).to_owned();
            let kind = if last < 0.0 { PathEventKind::Pushes { tie } } else { PathEventKind::Pulls { tie } };
            events.push((s, PathEvent { kind, factor, q, after, negative: (a.negative, b.negative) }));
        }
    }
    let n = antiprism.struts.len();
    for j in 0..n {
        for k in j + 1..n {
            let side = |q: &[f64]| Nearest::of(antiprism, j, k, q).side;
            if side(&a.q).signum() == side(&b.q).signum() {
                continue;
            }
            let (s, factor, q) = locate(antiprism, a, b, side)?;
            let nearest = Nearest::of(antiprism, j, k, &q);
            if nearest.inside {
                let kind = PathEventKind::StrutsMeet { struts: (j, k) };
                events.push((s, PathEvent { kind, factor, q, after, negative: (a.negative, b.negative) }));
            }
        }
    }
    Ok(events)
}

/// The equilibrium between two points of the branch where a function of the coordinates vanishes.
fn locate(
    antiprism: &Antiprism,
    a: &PathPoint,
    b: &PathPoint,
    f: impl Fn(&[f64]) -> f64,
) -> Result<(f64, f64, Vec<f64>), CaseError> {
    let options = ForwardOptions { relax: false, ..ForwardOptions::default() };
    let forward = Forward::new(&antiprism.model, options);
    let at = |s: f64| -> Result<(f64, Vec<f64>), CaseError> {
        let factor = a.factor + s * (b.factor - a.factor);
        let guess: Vec<f64> = a.q.iter().zip(&b.q).map(|(a, b)| a + s * (b - a)).collect();
        Ok((factor, forward.solve(&guess, &antiprism.inputs(factor))?.configuration.q))
    };
    let (mut low, mut high) = (0.0, 1.0);
    let before = f(&a.q).signum();
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if f(&at(middle)?.1).signum() == before { low = middle } else { high = middle }
    }
    let (factor, q) = at(high)?;
    Ok((high, factor, q))
}
