//! All equilibria of a planar structure: solve, certify, judge.

use tg_homotopy::{
    CertifyOptions, Complex64, Conjugation, PathOptions, Realness, SolveOptions, SolveReport, Start, certify,
    solve,
};
use tg_model::{Mechanics, Model, Tensioned};
use tg_statics::{EquilibriumReport, Verdict, stability};

use crate::error::EquilibriaError;
use crate::report::{EquilibriaReport, RealEquilibrium};
use crate::stationarity::Stationarity;

/// Residual force above which a certified real solution is no equilibrium of the structure itself, per force that would
/// stretch the stiffest spring by its length: in stress-free equilibria there is no other force to hold it against.
const BALANCED: f64 = 1e-10;

/// Settings of the search.
#[derive(Clone, Debug)]
pub struct EquilibriaOptions {
    /// More paths than this are refused, with the number that would be needed.
    pub max_paths: u64,
    /// Decides all random numbers.
    pub seed: u64,
    /// How paths are followed.
    pub paths: PathOptions,
}

impl Default for EquilibriaOptions {
    fn default() -> Self {
        Self { max_paths: 20_000, seed: 1, paths: PathOptions::default() }
    }
}

/// All equilibria at inputs `u` (rest lengths, then loads) with every spring as a two-way one: complex solutions counted,
/// real ones certified and judged by energy.
///
/// # Errors
/// No polynomial form, equilibria that are not isolated, too many paths.
pub fn all_equilibria(
    model: &Model<2>,
    u: &[f64],
    options: &EquilibriaOptions,
) -> Result<EquilibriaReport, EquilibriaError> {
    let form = prepare(model, u)?;
    let parameters = parameters(&form, u);
    let solve_options = SolveOptions {
        start: Start::Best(form.groupings.clone()),
        seed: options.seed,
        max_paths: options.max_paths,
        paths: options.paths.clone(),
    };
    let solved = solve(&form.system, &parameters, &solve_options)?;
    judge(model, u, &form, &parameters, &solved)
}

pub(crate) fn prepare(model: &Model<2>, u: &[f64]) -> Result<Stationarity, EquilibriaError> {
    let expected = model.sizes().inputs;
    if u.len() != expected {
        return Err(EquilibriaError::Inputs { found: u.len(), expected });
    }
    Stationarity::new(model, u)
}

pub(crate) fn parameters(form: &Stationarity, u: &[f64]) -> Vec<Complex64> {
    form.springs.iter().map(|&cable| Complex64::new(u[cable], 0.0)).collect()
}

/// Certifies the finite solutions and looks at the real ones as equilibria of the structure.
pub(crate) fn judge(
    model: &Model<2>,
    u: &[f64],
    form: &Stationarity,
    parameters: &[Complex64],
    solved: &SolveReport,
) -> Result<EquilibriaReport, EquilibriaError> {
    let conjugation = Conjugation::exchanging(&form.system, &form.pairs, &[])?;
    let system = form.system.symmetrized(&conjugation)?;
    let options = CertifyOptions { conjugation: Some(conjugation), ..CertifyOptions::default() };
    let certified = certify(&system, parameters, &solved.solutions(), &options)?;
    let mut real = Vec::new();
    for certificate in certified.certificates.iter().filter(|c| c.realness == Realness::Real) {
        real.push(equilibrium(model, u, form, &certificate.solution, certificate.radius)?);
    }
    real.sort_by(|a, b| a.energy.total_cmp(&b.energy));
    Ok(EquilibriaReport {
        paths: solved.paths.len(),
        finite: solved.successes().count(),
        singular: solved.singular(),
        at_infinity: solved.at_infinity(),
        failed: solved.failures().count(),
        certified: certified.count(),
        undecided: certified.with(Realness::Undecided),
        rejected: certified.rejections.len(),
        largest_radius: certified.largest_radius(),
        equilibria: real,
    })
}

fn equilibrium(
    model: &Model<2>,
    u: &[f64],
    form: &Stationarity,
    solution: &[Complex64],
    radius: f64,
) -> Result<RealEquilibrium, EquilibriaError> {
    let q = form.form.coordinates(&solution[..form.coordinates]);
    let rest = vec![0.0; q.len()];
    let mut signs = vec![1.0; model.cable_count()];
    for (s, &cable) in form.springs.iter().enumerate() {
        signs[cable] = solution[form.coordinates + s].re.signum();
    }
    let report = EquilibriumReport::new(model, &q, u)?;
    let physical = signs.iter().all(|&sign| sign > 0.0);
    let slack = (0..model.cable_count()).any(|c| model.only_pulls(c) && report.cables[c].1.length < u[c]);
    let scale = (0..model.cable_count())
        .map(|c| model.linear_stiffness(c).unwrap_or(0.0) * report.cables[c].1.length)
        .fold(report.configuration.force_scale, f64::max);
    let residual = report.configuration.residual.iter().fold(0.0_f64, |a, r| a.max(r.abs()));
    let (negative, stable) = if physical && residual <= BALANCED * scale {
        let judged = stability(model, &report.configuration, 1)?;
        (Some(judged.counts.negative), judged.verdict == Verdict::Stable)
    } else {
        (None, false)
    };
    let lengths = signs.iter().zip(&report.cables).map(|(sign, (_, cable))| sign * cable.length).collect();
    let energy = model.energy(&q, &rest, u).potential();
    let taut = physical && !slack;
    Ok(RealEquilibrium {
        configuration: report.configuration,
        lengths,
        physical,
        taut,
        energy,
        negative,
        stable,
        radius,
    })
}
