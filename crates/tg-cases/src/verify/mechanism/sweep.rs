//! Sweep of L01 with L02 = 0 (Fig. 4): the number of equilibria changes only at folds.

use tg_statics::{Configuration, stability};

use super::{SEARCH, expected, twin};
use crate::error::CaseError;
use crate::mechanism::{Case, Mechanism, Parameters};
use crate::reference::mechanism::Sweep;
use crate::row::Rows;

/// Largest L01 \[m\]: beyond it no fold is found up to 30 m.
pub(super) const MOST: f64 = 20.0;
const SAMPLES: usize = 200;

/// Folds for |L01| ≤ 20 m with L02 = 0, Table 1 otherwise; negative L01 are the branch d1 < 0.
///
/// # Errors
/// As [`crate::reference::mechanism::Model::sweep`].
pub fn paper() -> Result<Sweep, CaseError> {
    Ok(twin(&Parameters::paper(Case::Two)).sweep((-MOST, MOST), SAMPLES)?)
}

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    let sweep = paper()?;
    rows.exact("sweep: boxes that the searches leave undecided", (sweep.undecided, 0), SEARCH);
    let changes = sweep.counts.windows(2).filter(|pair| pair[0].abs_diff(pair[1]) == 2).count();
    rows.exact("sweep: folds at which the count changes by two", (changes, sweep.folds.len()), SEARCH);
    let residual = sweep.folds.iter().map(|fold| fold.residual).fold(0.0, f64::max);
    rows.below("sweep: largest residual of a fold", "J/rad", residual, "∂V = 0, ∂²V v = 0", 1e-12);
    let at = |rest: f64| sweep.counts[sweep.folds.iter().filter(|fold| fold.rest < rest).count()];
    let most = (0..2000).map(|k| MOST * (f64::from(k) + 0.5) / 2000.0).map(|rest| at(rest) + at(-rest)).max();
    let what = "sweep: most real solutions at one L01, d1 of either sign";
    rows.exact(what, (most.unwrap_or(0), 10), "paper, Sec. 4 and Fig. 4");
    for (k, fold) in sweep.folds.iter().enumerate() {
        let name = format!("sweep: fold {}", k + 1);
        let model = twin(&Parameters::paper(Case::Two));
        for by in [-1e-9, 1e-9] {
            let found = model.with_rest(fold.rest + by).search()?.equilibria.len();
            let side = if by < 0.0 { "before" } else { "after" };
            rows.exact(format!("{name}: equilibria 1 nm {side}"), (found, at(fold.rest + by)), SEARCH);
        }
        let parameters = Parameters { rest: [fold.rest, 0.0], ..Parameters::paper(Case::Two) };
        let mechanism = Mechanism::new(&parameters)?;
        let (q, u) = (mechanism.coordinates(fold.angles), mechanism.model.inputs_at(0.0));
        let lowest = stability(&mechanism.model, &Configuration::at(&mechanism.model, &q, &u)?, 2)?.lowest;
        let least = lowest.iter().map(|pair| pair.value.abs()).fold(f64::INFINITY, f64::min);
        let what = format!("{name}: eigenvalue nearest zero, natural coordinates");
        rows.below(what, "N/m", least, "singular at a fold", 1e-12);
    }
    // The paper: stable solutions appear from 0.4 m on. Its own Table 2 flags one at 0.
    let short = twin(&Parameters { rest: [0.2, 0.0], ..Parameters::paper(Case::Two) });
    let stable = short.search()?.equilibria.iter().filter(|e| e.stable()).count();
    let what = "sweep: stable at L01 = 0.2 m (the paper's Fig. 4 marks none below 0.4)";
    rows.exact(what, (stable, expected(Case::One)?.stable()), SEARCH);
    Ok(())
}
