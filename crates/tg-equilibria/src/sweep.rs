//! A sweep of one rest length: all equilibria at each value, folds between them.
//!
//! Counts change only at folds, where continuation from an equilibrium of the richer side turns back.

use tg_model::Tensioned;
use tg_statics::{Configuration, ContinuationOptions, EventKind, InputFamily, continuation};

use crate::error::EquilibriaError;
use crate::family::Family;
use crate::report::EquilibriaReport;

/// Folds closer than this part of the swept range and of the structure are one.
const SAME: f64 = 1e-6;
/// How far behind a sample a branch is followed before it is given up, in steps of the sweep.
const BEHIND: f64 = 0.5;

/// All equilibria along a sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// Rest lengths \[m\] and what was found there.
    pub samples: Vec<(f64, EquilibriaReport)>,
    /// Folds between samples, ascending.
    pub folds: Vec<Fold>,
}

/// Where two equilibria meet and vanish.
#[derive(Clone, Debug)]
pub struct Fold {
    /// The rest length \[m\].
    pub rest: f64,
    /// The equilibrium there.
    pub configuration: Configuration,
}

impl Family<'_> {
    /// All equilibria at each of the ascending rest lengths `values` of a cable, the other inputs being those of `u`, and
    /// the folds between them.
    ///
    /// # Errors
    /// As [`Family::query`]; an equilibrium that continuation cannot start from.
    pub fn sweep(&self, u: &[f64], cable: usize, values: &[f64]) -> Result<Sweep, EquilibriaError> {
        let mut samples: Vec<(f64, EquilibriaReport)> = Vec::new();
        for &value in values {
            let mut inputs = u.to_vec();
            inputs[cable] = value;
            samples.push((value, self.query(&inputs)?));
        }
        let mut folds: Vec<Fold> = Vec::new();
        for pair in samples.windows(2) {
            let counts = [pair[0].1.physical().count(), pair[1].1.physical().count()];
            if counts[0] == counts[1] {
                continue;
            }
            // Those that vanish do so on the way from the side that has more.
            let (from, to) = if counts[0] > counts[1] { (&pair[0], &pair[1]) } else { (&pair[1], &pair[0]) };
            for equilibrium in from.1.physical() {
                let family = InputFamily::rest_length(self.model(), u, cable);
                let options = ContinuationOptions { behind: BEHIND, ..ContinuationOptions::default() };
                let branch = continuation(&family, &equilibrium.configuration.q, (from.0, to.0), &options)?;
                let turns = branch.events.into_iter().filter(|event| event.kind == EventKind::LimitPoint);
                let found =
                    turns.map(|event| Fold { rest: event.parameter, configuration: event.configuration });
                folds.extend(found.take(1));
            }
        }
        folds.sort_by(|a, b| a.rest.total_cmp(&b.rest));
        let range = values.last().copied().unwrap_or(0.0) - values.first().copied().unwrap_or(0.0);
        folds.dedup_by(|a, b| self.same(a, b, range));
        Ok(Sweep { samples, folds })
    }

    fn same(&self, a: &Fold, b: &Fold, range: f64) -> bool {
        let pairs = a.configuration.q.iter().zip(&b.configuration.q);
        let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let mut lengths = vec![0.0; self.model().cable_count()];
        let mut gradients = vec![0.0; self.model().length_pattern().len()];
        self.model().lengths(&a.configuration.q, &mut lengths, &mut gradients);
        let size = lengths.iter().fold(0.0_f64, |m, l| m.max(*l));
        (a.rest - b.rest).abs() <= SAME * range && apart <= SAME * size.max(f64::MIN_POSITIVE) * 1e3
    }
}
