//! Filling a generic instance from a few seeds by loops of parameters.
//!
//! A loop p₀ → p₁ → p₂ → p₀ that encloses branch points permutes the solutions at p₀; the images of known solutions are
//! solutions, often new ones (Duff et al., *Solving polynomial systems via homotopy continuation and monodromy*, IMA J.
//! Numer. Anal. 39, 2019). Only solutions on the irreducible components of {(x, p): F = 0} that hold a seed are ever
//! reached: seed every component.

use num_complex::Complex64;

use crate::batch::{PathOptions, run};
use crate::error::{HomotopyError, check_finite, check_length};
use crate::homotopy::Homotopy;
use crate::lu::Lu;
use crate::parameter::GenericInstance;
use crate::random::Random;
use crate::scalar::{Scalar, norm};
use crate::system::PolynomialSystem;

/// Solutions closer than this (relative) are one. Loops end at generic parameters, where solutions lie far apart.
const SAME: f64 = 1e-8;
/// Largest relative Newton step of a seed.
const SEED_STEP: f64 = 1e-6;

/// Settings of [`monodromy`].
#[derive(Clone, Debug, PartialEq)]
pub struct MonodromyOptions {
    /// Decides the loops.
    pub seed: u64,
    /// Stop after so many loops in a row without a new solution. After one, half of ten searches were incomplete, after
    /// three none (docs/accuracy-and-speed.md, "Loops of monodromy").
    pub fruitless_loops: usize,
    /// Stop when so many solutions are known, if given.
    pub target: Option<usize>,
    /// Most loops: ten times what the searches of "Loops of monodromy" took.
    pub loops: usize,
    /// Size of the loops relative to the parameters (docs/accuracy-and-speed.md, "Loops of monodromy").
    pub radius: f64,
    /// How paths are followed.
    pub paths: PathOptions,
}

impl Default for MonodromyOptions {
    fn default() -> Self {
        Self {
            seed: 1,
            fruitless_loops: 10,
            target: None,
            loops: 200,
            radius: 1.0,
            paths: PathOptions::default(),
        }
    }
}

/// What filling cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MonodromyReport {
    /// Loops made.
    pub loops: usize,
    /// Loops in a row without a new solution at the end.
    pub fruitless: usize,
    /// Paths followed along loops.
    pub paths: usize,
    /// Paths that did not arrive.
    pub lost: usize,
}

/// One Newton step of F(·; p) at x: its relative length and the new point; none if singular.
fn newton_step(
    system: &PolynomialSystem,
    x: &[Complex64],
    parameters: &[Complex64],
) -> Option<(f64, Vec<Complex64>)> {
    let mut lu = Lu::new(system.unknowns());
    if !lu.factor(&system.jacobian(x, parameters)) {
        return None;
    }
    let mut delta = system.values(x, parameters);
    lu.solve(&mut delta);
    let next: Vec<Complex64> = x.iter().zip(&delta).map(|(x, d)| x - d).collect();
    Some((norm(&delta) / norm(&next).max(f64::MIN_POSITIVE), next))
}

/// Adds `x` unless it is known.
pub(crate) fn insert(known: &mut Vec<Vec<Complex64>>, x: Vec<Complex64>) -> bool {
    let scale = SAME * norm(&x);
    let same = |k: &Vec<Complex64>| k.iter().zip(&x).all(|(a, b)| (a - b).norm() <= scale);
    if known.iter().any(same) {
        return false;
    }
    known.push(x);
    true
}

/// Fills the solutions at `parameters` from `seeds`.
pub fn monodromy(
    system: &PolynomialSystem,
    parameters: &[Complex64],
    seeds: &[Vec<Complex64>],
    options: &MonodromyOptions,
) -> Result<(GenericInstance, MonodromyReport), HomotopyError> {
    check_length("parameters", system.parameters(), parameters.len())?;
    check_finite("parameter", parameters)?;
    let mut known: Vec<Vec<Complex64>> = vec![];
    let mut best = f64::INFINITY;
    for seed in seeds {
        check_length("seed", system.unknowns(), seed.len())?;
        check_finite("a coordinate of a seed", seed)?;
        if let Some((step, x)) = newton_step(system, seed, parameters) {
            best = best.min(step);
            if step <= SEED_STEP {
                insert(&mut known, x);
            }
        }
    }
    if known.is_empty() {
        return Err(HomotopyError::NoSeed { step: best });
    }
    let mut random = Random::new(options.seed);
    let mut report = MonodromyReport::default();
    let done = |known: &Vec<Vec<Complex64>>, report: &MonodromyReport| {
        options.target.is_some_and(|t| known.len() >= t)
            || report.fruitless >= options.fruitless_loops
            || report.loops >= options.loops
    };
    while !done(&known, &report) {
        let mut corner = || -> Vec<Complex64> {
            // Round zero, not round p: loops far from p would rarely enclose branch points.
            let spread = |p: &Complex64| options.radius * p.norm().max(1e-3);
            parameters.iter().map(|p| random.normal() * spread(p)).collect()
        };
        let (first, second) = (corner(), corner());
        let stations = [parameters, &first, &second, parameters];
        let mut points = known.clone();
        report.paths += points.len();
        let sent = points.len();
        for leg in stations.windows(2) {
            let homotopy = Homotopy::between(system, leg[0], leg[1], None)?;
            let results = run(&homotopy, system, leg[1], &points, &options.paths);
            points = results.into_iter().filter(|r| r.is_success()).map(|r| r.solution).collect();
        }
        report.lost += sent - points.len();
        let mut news = 0;
        for x in points {
            news += usize::from(insert(&mut known, x));
        }
        report.loops += 1;
        report.fruitless = if news == 0 { report.fruitless + 1 } else { 0 };
    }
    Ok((GenericInstance { parameters: parameters.to_vec(), solutions: known }, report))
}

/// A random pair (x, p) on F(x; p) = 0: minimum-norm Newton steps in both from a random start.
pub fn find_seed(
    system: &PolynomialSystem,
    seed: u64,
) -> Result<(Vec<Complex64>, Vec<Complex64>), HomotopyError> {
    let (n, k) = (system.unknowns(), system.parameters());
    let mut random = Random::new(seed);
    let mut best = f64::INFINITY;
    for _ in 0..20 {
        let mut x: Vec<Complex64> = (0..n).map(|_| random.normal()).collect();
        let mut p: Vec<Complex64> = (0..k).map(|_| random.normal()).collect();
        for _ in 0..50 {
            let Some(step) = minimum_norm_step(system, &mut x, &mut p) else { break };
            if !step.is_finite() {
                break;
            }
            best = best.min(step);
            if step <= 1e-12 {
                return Ok((x, p));
            }
        }
    }
    Err(HomotopyError::NoSeed { step: best })
}

/// (x, p) ← (x, p) - Aᴴ (A Aᴴ)⁻¹ F with A = [∂F/∂x, ∂F/∂p]; the relative length.
fn minimum_norm_step(system: &PolynomialSystem, x: &mut [Complex64], p: &mut [Complex64]) -> Option<f64> {
    let (n, k) = (x.len(), p.len());
    let by_x = system.jacobian(x, p);
    let by_p = system.parameter_jacobian(x, p);
    let entry = |i: usize, j: usize| if j < n { by_x[i * n + j] } else { by_p[(j - n) * n + i] };
    let mut normal = vec![Complex64::zero(); n * n];
    for i in 0..n {
        for l in 0..n {
            normal[i * n + l] = (0..n + k).map(|j| entry(i, j) * entry(l, j).conj()).sum();
        }
    }
    let mut lu = Lu::new(n);
    if !lu.factor(&normal) {
        return None;
    }
    let mut y = system.values(x, p);
    lu.solve(&mut y);
    let (mut length, mut size): (f64, f64) = (0.0, 0.0);
    for j in 0..n + k {
        let delta: Complex64 = (0..n).map(|i| entry(i, j).conj() * y[i]).sum();
        let z = if j < n { &mut x[j] } else { &mut p[j - n] };
        *z -= delta;
        (length, size) = (length.max(delta.norm()), size.max(z.norm()));
    }
    Some(length / size)
}
