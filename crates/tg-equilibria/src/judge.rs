//! Certifies complex solutions and looks at the real ones as equilibria of the structure.

use tg_homotopy::{CertifyOptions, Complex64, Realness, SolveReport, certify};
use tg_model::{Model, Tensioned};
use tg_statics::{EquilibriumReport, Verdict, stability};

use crate::error::EquilibriaError;
use crate::orbit::Orbits;
use crate::report::{EquilibriaReport, Origin, RealEquilibrium};
use crate::stationarity::Stationarity;

/// Residual force above which a certified real solution is no equilibrium of the structure itself, per force that would
/// stretch the stiffest spring by its length: in stress-free equilibria there is no other force to hold it against.
const BALANCED: f64 = 1e-10;

/// The report on one search.
pub(crate) fn judge<const D: usize>(
    model: &Model<D>,
    u: &[f64],
    form: &Stationarity<D>,
    parameters: &[Complex64],
    (origin, solved): (Origin, &SolveReport),
) -> Result<EquilibriaReport, EquilibriaError> {
    let quaternions: Vec<[usize; 4]> = form.unknowns.quaternions.values().copied().collect();
    let orbits = Orbits::new(solved.solutions(), &quaternions);
    let options = CertifyOptions { conjugation: Some(form.conjugation.clone()), ..CertifyOptions::default() };
    let certified = certify(&form.symmetric, parameters, &orbits.representatives, &options)?;
    let mut real = Vec::new();
    for certificate in certified.certificates.iter().filter(|c| c.realness == Realness::Real) {
        real.push(equilibrium(model, u, form, &certificate.solution, certificate.radius)?);
    }
    real.sort_by(|a, b| a.energy.total_cmp(&b.energy));
    Ok(EquilibriaReport {
        origin,
        paths: solved.paths.len(),
        finite: orbits.representatives.len(),
        singular: solved.singular(),
        at_infinity: solved.at_infinity(),
        failed: solved.failures().count() + orbits.incomplete,
        retracked: solved.paths.iter().filter(|path| path.retracked > 0).count(),
        certified: certified.count(),
        undecided: certified.with(Realness::Undecided),
        rejected: certified.rejections.len(),
        largest_radius: certified.largest_radius(),
        equilibria: real,
        euler_characteristic: form.euler_characteristic(),
    })
}

fn equilibrium<const D: usize>(
    model: &Model<D>,
    u: &[f64],
    form: &Stationarity<D>,
    solution: &[Complex64],
    radius: f64,
) -> Result<RealEquilibrium, EquilibriaError> {
    let y = form.unknowns.y.len();
    let q = form.unknowns.coordinates(&solution[..y]);
    let mut signs = vec![1.0; model.cable_count()];
    for (s, &cable) in form.springs().iter().enumerate() {
        signs[cable] = solution[y + s].re.signum();
    }
    let report = EquilibriumReport::new(model, &q, u)?;
    let lengths: Vec<f64> = report.cables.iter().map(|(_, cable)| cable.length).collect();
    let physical = signs.iter().all(|&sign| sign > 0.0);
    let slack = (0..lengths.len()).any(|c| model.only_pulls(c) && lengths[c] < u[c]);
    let scale = (0..lengths.len())
        .map(|c| model.linear_stiffness(c).unwrap_or(0.0) * lengths[c])
        .fold(report.configuration.force_scale, f64::max);
    let residual = report.configuration.residual.iter().fold(0.0_f64, |a, r| a.max(r.abs()));
    let (negative, stable) = if physical && residual <= BALANCED * scale {
        let judged = stability(model, &report.configuration, 1)?;
        (Some(judged.counts.negative), judged.verdict == Verdict::Stable)
    } else {
        (None, false)
    };
    let energy = model.energy(&q, &vec![0.0; q.len()], u).potential();
    Ok(RealEquilibrium {
        configuration: report.configuration,
        lengths: signs.iter().zip(&lengths).map(|(sign, length)| sign * length).collect(),
        physical,
        taut: physical && !slack,
        energy,
        negative,
        stable,
        radius,
    })
}
