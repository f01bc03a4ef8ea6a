//! Modal analysis of example 2 (Sec. 6.2.1, Figs. 11 to 14): frequencies, mode shapes, and the loss of stability.

use tg_modal::{Mode, ModeOptions, SweepOptions, member_twists, modes, sweep};
use tg_model::CableLaw;
use tg_statics::{ContinuationOptions, EventKind, InputFamily, continuation, critical_parameter};
use tg_tangent::Configuration;

use super::{EXACT, MODEL};
use crate::error::CaseError;
use crate::published::framework;
use crate::reference::tower as angles;
use crate::row::Rows;
use crate::tower::{Choices, Tower, initial_lengths};

const SECTION: &str = "paper, Sec. 6.2.1";
const POLYNOMIAL: &str = "1 - α: root of 293x³ - 180x² - 37x + 9";

pub(super) fn rows(rows: &mut Rows) -> Result<(), CaseError> {
    for (name, alpha, beta) in [
        ("alpha=beta=0.9", 0.9, 0.9),
        ("alpha=beta=0.845", 0.845, 0.845),
        ("alpha=beta=0.999", 0.999, 0.999),
        ("alpha=0.95,beta=0.998", 0.95, 0.998),
    ] {
        frequencies(rows, name, &Choices { alpha, beta, ..Choices::modal(alpha) })?;
    }
    curves(rows)?;
    critical_ratio(rows)
}

/// The five modes of the upright tower.
fn five_modes(tower: &Tower) -> Result<(Configuration, Vec<Mode>), CaseError> {
    let at =
        Configuration::at(&tower.model, &tower.model.initial_coordinates(), &tower.model.inputs_at(0.0))?;
    let found = modes(&tower.model, &at, &ModeOptions::all())?;
    Ok((at, found.list))
}

fn hertz(omega_squared: f64) -> f64 {
    omega_squared.sqrt() / std::f64::consts::TAU
}

fn frequencies(rows: &mut Rows, name: &str, choices: &Choices) -> Result<(), CaseError> {
    let tower = Tower::new(choices)?;
    let (at, list) = five_modes(&tower)?;
    rows.below(format!("{name}: residual force per largest force"), "1", at.imbalance().0, SECTION, 1e-12);
    rows.exact(format!("{name}: modes"), (list.len(), 5), SECTION);
    let known = &framework().example2.frequencies[name];
    for (k, (mode, known)) in list.iter().zip(known).enumerate() {
        let found = hertz(mode.omega_squared);
        rows.near(format!("{name}: frequency {}", k + 1), "Hz", (found, *known), EXACT, 1e-9 * known);
    }
    let reference = angles::Tower {
        gravity: 0.0,
        ground_amplitude: 0.0,
        alpha: choices.alpha,
        beta: choices.beta,
        ..angles::Tower::paper(angles::Setup::Un)
    };
    let mut worst = 0.0_f64;
    for (mode, theirs) in list.iter().zip(&reference.modes()?) {
        worst = worst.max(shape_difference(&tower, &at, mode, theirs)?);
    }
    // The reference's stiffness comes from differences.
    rows.below(format!("{name}: mode shapes, largest difference of a rotation"), "1", worst, MODEL, 1e-8);
    Ok(())
}

/// Largest difference of the rotations of bars 1, 4, triangle 5, bar 6 and triangle 7 in two mass-normalised shapes, per
/// the largest rotation; the sign is free.
fn shape_difference(
    tower: &Tower,
    at: &Configuration,
    mode: &Mode,
    theirs: &angles::Mode,
) -> Result<f64, CaseError> {
    let twists = member_twists(&tower.model, &at.q, &mode.shape)?;
    let members: Vec<_> = tower.model.members().collect();
    let turning = [tower.bars[0], tower.bars[2], tower.triangles[1], tower.bars[3], tower.triangles[2]];
    let ours = turning.map(|member| {
        members.iter().position(|&m| m == member).map_or(f64::NAN, |k| twists[k].angular_velocity())
    });
    let largest = theirs.shape.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    let apart = |sign: f64| {
        let pairs = ours.iter().zip(&theirs.shape);
        pairs.map(|(a, b)| (a - sign * b).abs()).fold(0.0, f64::max) / largest
    };
    Ok(if ours.iter().any(|x| x.is_nan()) { f64::NAN } else { apart(1.0).min(apart(-1.0)) })
}

/// Frequencies followed from α = β = 0.845 to 0.999 (Fig. 14): the lowest three rise, the highest two fall.
fn curves(rows: &mut Rows) -> Result<(), CaseError> {
    let (parameters, curves) = frequency_curves()?;
    let rising = curves.iter().filter(|curve| curve.windows(2).all(|w| w[1] > w[0])).count();
    let falling = curves.iter().filter(|curve| curve.windows(2).all(|w| w[1] < w[0])).count();
    rows.exact("α = β from 0.845 to 0.999: frequencies that rise", (rising, 3), SECTION);
    rows.exact("α = β from 0.845 to 0.999: frequencies that fall", (falling, 2), SECTION);
    let ends = [("alpha=beta=0.845", 0), ("alpha=beta=0.999", parameters.len() - 1)];
    for (name, k) in ends {
        let known = &framework().example2.frequencies[name];
        let worst = curves.iter().zip(known).map(|(curve, f)| (curve[k] / f - 1.0).abs()).fold(0.0, f64::max);
        rows.below(format!("curves at {name}: largest relative difference"), "1", worst, EXACT, 1e-9);
    }
    Ok(())
}

/// Ratios α = β and, for each mode, its frequency there \[Hz\].
///
/// # Errors
/// A mode is lost on the way.
pub fn frequency_curves() -> Result<(Vec<f64>, Vec<Vec<f64>>), CaseError> {
    let ratios: Vec<f64> = (0..=22).map(|k| 0.845 + 0.007 * f64::from(k)).collect();
    let found = sweep(&ratios, &SweepOptions::new(5), |ratio| -> Result<_, CaseError> {
        let tower = Tower::new(&Choices::modal(ratio))?;
        let at =
            Configuration::at(&tower.model, &tower.model.initial_coordinates(), &tower.model.inputs_at(0.0))?;
        Ok((Box::new(tower.model), at))
    })?;
    let curve = |track: &tg_modal::Track| track.omega_squared.iter().map(|&w| hertz(w)).collect();
    Ok((found.parameters.clone(), found.tracks.iter().map(curve).collect()))
}

/// Stability is lost where the lowest eigenvalue of the reduced Hessian passes through zero, whatever κ is.
fn critical_ratio(rows: &mut Rows) -> Result<(), CaseError> {
    let x = root_of_the_cubic();
    let mut directions = Vec::new();
    for stiffness in [100.0, 7.3] {
        let tower = Tower::new(&Choices { law: CableLaw::linear(stiffness), ..Choices::modal(0.9) })?;
        let family = InputFamily::new(&tower.model, &[0.0; 12], &initial_lengths());
        let q = tower.model.initial_coordinates();
        let critical = critical_parameter(&family, &q, (0.8, 0.95))?;
        rows.near(
            format!("κ = {stiffness}: critical ratio by root finding"),
            "1",
            (critical.parameter, 1.0 - x),
            POLYNOMIAL,
            1e-10,
        );
        directions.push(critical.pair.value / stiffness);
        let branch = continuation(&family, &q, (0.95, 0.8), &ContinuationOptions::default())?;
        let lost: Vec<_> = branch.events.iter().filter(|event| event.loses_stability()).collect();
        rows.exact(
            format!("κ = {stiffness}: losses of stability from 0.95 to 0.8"),
            (lost.len(), 1),
            SECTION,
        );
        for event in lost {
            let bifurcates = usize::from(event.kind == EventKind::Bifurcation);
            rows.exact(format!("κ = {stiffness}: it is a bifurcation"), (bifurcates, 1), "symmetry");
            rows.near(
                format!("κ = {stiffness}: critical ratio by continuation"),
                "1",
                (event.parameter, 1.0 - x),
                POLYNOMIAL,
                1e-9,
            );
        }
    }
    let known = framework().example2.critical_ratio;
    rows.near("critical ratio of the cubic", "1", (1.0 - x, known), EXACT, 1e-14);
    let left = directions.iter().fold(0.0_f64, |a, v| a.max(v.abs()));
    rows.below("lowest eigenvalue there, per κ", "1", left, "definition", 1e-11);
    Ok(())
}

/// The smallest positive root of 293x³ - 180x² - 37x + 9, by Newton's method.
fn root_of_the_cubic() -> f64 {
    let mut x = 0.15;
    for _ in 0..20 {
        let value = ((293.0 * x - 180.0) * x - 37.0) * x + 9.0;
        x -= value / ((879.0 * x - 360.0) * x - 37.0);
    }
    x
}
