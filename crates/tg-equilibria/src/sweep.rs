//! A sweep of one input: all equilibria at each value, the curves that they lie on, and the folds where curves end.
//!
//! From one sample to the next an equilibrium goes on as the nearest one with as many negative eigenvalues. Those that find
//! no successor have met another one at a fold, where continuation from them turns back.

use tg_statics::{Configuration, ContinuationOptions, EventKind, InputFamily, continuation};

use crate::error::EquilibriaError;
use crate::family::Family;
use crate::report::{EquilibriaReport, RealEquilibrium};

/// Folds closer than this part of the swept range, and of the structure, are one.
const SAME: f64 = 1e-6;
/// How far behind a sample a branch is followed before it is given up, in steps of the sweep.
const BEHIND: f64 = 0.5;

/// All equilibria along a sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Values of the input and what was found there.
    pub samples: Vec<(f64, EquilibriaReport)>,
    /// Curves of physical equilibria, by their first sample.
    pub curves: Vec<Curve>,
    /// Folds between samples, ascending: two equilibria meet and vanish.
    pub folds: Vec<Critical>,
    /// Where curves cross between samples and exchange negative eigenvalues, ascending.
    pub branch_points: Vec<Critical>,
    /// First or last points of curves with neither up to the next sample: a cone of the potential, where a spring loses
    /// its length, or a fold too sharp to follow.
    pub loose_ends: Vec<CurvePoint>,
}

/// Physical equilibria that follow each other from sample to sample without a fold: all have as many negative eigenvalues.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Negative eigenvalues of the reduced Hessian.
    pub negative: usize,
    /// Every equilibrium on it is stable.
    pub stable: bool,
    /// The equilibria.
    pub points: Vec<CurvePoint>,
}

/// A place in a sweep: `samples[sample].1.equilibria[equilibrium]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurvePoint {
    /// Number of the sample.
    pub sample: usize,
    /// Number of the equilibrium in it.
    pub equilibrium: usize,
}

/// An equilibrium with a singular Hessian.
#[derive(Clone, Debug)]
pub struct Critical {
    /// The input's value \[m or N\].
    pub value: f64,
    /// The equilibrium there.
    pub configuration: Configuration,
}

impl Sweep {
    /// The equilibrium at a point of a curve.
    pub fn at(&self, point: CurvePoint) -> &RealEquilibrium {
        &self.samples[point.sample].1.equilibria[point.equilibrium]
    }
}

impl<const D: usize> Family<'_, D> {
    /// All equilibria at each of the ascending `values` of an input, the others being those of `u`. Two folds within one
    /// step of the sweep that undo each other stay unseen.
    ///
    /// # Errors
    /// As [`Family::query`].
    pub fn sweep(&self, u: &[f64], input: usize, values: &[f64]) -> Result<Sweep, EquilibriaError> {
        let mut inputs = u.to_vec();
        let mut samples = Vec::new();
        for &value in values {
            *inputs
                .get_mut(input)
                .ok_or(EquilibriaError::Inputs { found: input + 1, expected: u.len() })? = value;
            samples.push((value, self.query(&inputs)?));
        }
        let mut sweep = Sweep {
            samples,
            curves: Vec::new(),
            folds: Vec::new(),
            branch_points: Vec::new(),
            loose_ends: Vec::new(),
        };
        let range = values.last().copied().unwrap_or(0.0) - values.first().copied().unwrap_or(0.0);
        for sample in 0..values.len() {
            let (ended, begun) = sweep.extend_curves(sample);
            // At the first sample curves begin without a fold.
            let Some(before) = sample.checked_sub(1) else { continue };
            for point in ended.iter().chain(&begun) {
                let other = if point.sample == before { sample } else { before };
                let Some((turns, critical)) =
                    self.critical(&sweep, u, input, (*point, values[point.sample], values[other]))
                else {
                    sweep.loose_ends.push(*point);
                    continue;
                };
                let list = if turns { &mut sweep.folds } else { &mut sweep.branch_points };
                if !list.iter().any(|known| known.is(&critical, range)) {
                    list.push(critical);
                }
            }
        }
        // Curves that end at a pitchfork turn back there, or go on as the one that passes through.
        let Sweep { folds, branch_points, loose_ends, .. } = &mut sweep;
        folds.retain(|fold| !branch_points.iter().any(|known| known.is(fold, range)));
        let passes = |point: &CurvePoint, critical: &Critical| {
            let [before, after] = [point.sample.saturating_sub(1), (point.sample + 1).min(values.len() - 1)];
            (values[before]..=values[after]).contains(&critical.value)
        };
        loose_ends.retain(|point| !branch_points.iter().any(|critical| passes(point, critical)));
        for list in [folds, branch_points] {
            list.sort_by(|a, b| a.value.total_cmp(&b.value));
        }
        Ok(sweep)
    }

    /// Follows an equilibrium without successor to a singular one; whether it is a fold.
    fn critical(
        &self,
        sweep: &Sweep,
        u: &[f64],
        input: usize,
        (point, from, to): (CurvePoint, f64, f64),
    ) -> Option<(bool, Critical)> {
        let (mut origin, mut direction) = (u.to_vec(), vec![0.0; u.len()]);
        (origin[input], direction[input]) = (0.0, 1.0);
        let family = InputFamily::new(self.model(), &origin, &direction);
        let options = ContinuationOptions { behind: BEHIND, ..ContinuationOptions::default() };
        let branch = continuation(&family, &sweep.at(point).configuration.q, (from, to), &options).ok()?;
        let event = branch.events.into_iter().find(|e| {
            let between = e.parameter >= from.min(to) && e.parameter <= from.max(to);
            between && matches!(e.kind, EventKind::LimitPoint | EventKind::Bifurcation)
        })?;
        let critical = Critical { value: event.parameter, configuration: event.configuration };
        Some((event.kind == EventKind::LimitPoint, critical))
    }
}

impl Critical {
    fn is(&self, other: &Self, range: f64) -> bool {
        let size = self.configuration.q.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let apart = distance(&self.configuration, &other.configuration);
        (self.value - other.value).abs() <= SAME * range && apart <= SAME.sqrt() * size
    }
}

/// Largest difference of a coordinate.
fn distance(a: &Configuration, b: &Configuration) -> f64 {
    a.q.iter().zip(&b.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

impl Sweep {
    /// Carries curves on to a sample: the points that find no successor there, and those without predecessor.
    fn extend_curves(&mut self, sample: usize) -> (Vec<CurvePoint>, Vec<CurvePoint>) {
        let equilibria = &self.samples[sample].1.equilibria;
        let mut news: Vec<usize> =
            (0..equilibria.len()).filter(|&e| equilibria[e].negative.is_some()).collect();
        let is_open = |curve: &Curve| curve.points.last().is_some_and(|last| last.sample + 1 == sample);
        let mut open: Vec<usize> = (0..self.curves.len()).filter(|&c| is_open(&self.curves[c])).collect();
        let mut pairs = Vec::new();
        for &curve in &open {
            let last = self.curves[curve].points[self.curves[curve].points.len() - 1];
            for &e in news.iter().filter(|&&e| equilibria[e].negative == Some(self.curves[curve].negative)) {
                let apart = distance(&self.at(last).configuration, &equilibria[e].configuration);
                pairs.push((apart, curve, e));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (_, curve, equilibrium) in pairs {
            if open.contains(&curve) && news.contains(&equilibrium) {
                open.retain(|&c| c != curve);
                news.retain(|&e| e != equilibrium);
                let stable = self.samples[sample].1.equilibria[equilibrium].stable;
                self.curves[curve].stable &= stable;
                self.curves[curve].points.push(CurvePoint { sample, equilibrium });
            }
        }
        let ended = open.iter().filter_map(|&c| self.curves[c].points.last().copied()).collect();
        let mut begun = Vec::new();
        for equilibrium in news {
            let point = CurvePoint { sample, equilibrium };
            let RealEquilibrium { negative, stable, .. } = *self.at(point);
            self.curves.push(Curve { negative: negative.unwrap_or(0), stable, points: vec![point] });
            begun.push(point);
        }
        (ended, begun)
    }
}
