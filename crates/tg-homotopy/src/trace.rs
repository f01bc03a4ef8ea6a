//! The trace test: evidence that all solutions of a generic instance are known.
//!
//! Let the parameters move on a generic line, C = {(x, s): F(x; p + s q) = 0} the curve of all solutions, and cut C with
//! parallel hyperplanes a·x + b s + c = 0. The sum of the points of a *complete* section of C is affine-linear in c, that of
//! an incomplete one on an irreducible component is not (Sommese, Verschelde & Wampler, SIAM J. Numer. Anal. 40, 2002;
//! Leykin, Rodriguez & Sottile, Arnold Math. J. 4, 2018):
//!
//! ```text
//! Σ x(c + δ) - 2 Σ x(c) + Σ x(c - δ) = 0
//! ```
//!
//! The section is filled by monodromy from the known solutions, which are points of the hyperplane s = 0; then it is
//! moved back to s = 0, where it must yield the known solutions and no other. Both together prove, up to numerical error
//! and for generic lines and hyperplanes, that every component that holds a known solution is complete. Components that
//! hold none stay unseen: seed every one.

use num_complex::Complex64;

use crate::batch::{PathOptions, run};
use crate::error::HomotopyError;
use crate::grouping::Grouping;
use crate::homotopy::Homotopy;
use crate::monodromy::{MonodromyOptions, insert, monodromy};
use crate::parameter::GenericInstance;
use crate::polynomial::Polynomial;
use crate::random::Random;
use crate::scalar::Scalar;
use crate::system::{PolynomialSystem, SystemBuilder};

/// Curvature up to which a trace is linear: rounding leaves about 1e-14, a missing point seldom less than 1e-7.
const LINEAR: f64 = 1e-10;
/// Rounds of loops that fill a section, at most.
const ROUNDS: u64 = 12;
/// Loops in a row without a new point that end a round.
const FRUITLESS: usize = 2;

/// Outcome of [`trace_test`].
#[derive(Clone, Debug, PartialEq)]
pub struct TraceReport {
    /// Degree of the curve: points of the section.
    pub section: usize,
    /// ‖Σ x(c + δ) - 2 Σ x(c) + Σ x(c - δ)‖ relative to the sum of the moduli of all points.
    pub curvature: f64,
    /// Solutions at s = 0 that the instance does not hold.
    pub missing: Vec<Vec<Complex64>>,
    /// Solutions of the instance that the section did not reach.
    pub unreached: usize,
    /// Paths that did not arrive at one of the parallel sections.
    pub lost: usize,
}

impl TraceReport {
    /// Whether the trace is linear within `tolerance` and the section yields the instance.
    pub fn is_complete(&self, tolerance: f64) -> bool {
        self.curvature <= tolerance && self.missing.is_empty() && self.unreached == 0 && self.lost == 0
    }
}

/// F(x; p + s q) with the hyperplane a·x + b s + c; parameters p, q, (a, b), c. Loops move the line too: they exchange more
/// points than loops of the hyperplane alone.
fn sliced(system: &PolynomialSystem) -> Result<PolynomialSystem, HomotopyError> {
    let mut builder = SystemBuilder::new();
    let mut x: Vec<Polynomial> = system.unknown_names().iter().map(|n| builder.unknown(n.clone())).collect();
    x.push(builder.unknown("s"));
    let names = system.parameter_names();
    let p: Vec<Polynomial> = names.iter().map(|n| builder.parameter(n.clone())).collect();
    let q: Vec<Polynomial> = names.iter().map(|n| builder.parameter(format!("direction of {n}"))).collect();
    let line: Vec<Polynomial> = p.iter().zip(&q).map(|(p, q)| p + q * &x[system.unknowns()]).collect();
    for equation in system.polynomials() {
        builder.equation(equation.with_parameters(&line));
    }
    let normal: Vec<Polynomial> = (0..x.len()).map(|j| &builder.parameter(format!("a{j}")) * &x[j]).collect();
    let constant = builder.parameter("c");
    builder.equation(Polynomial::sum(normal) + constant);
    builder.build()
}

/// Tests whether `instance` holds all solutions of its components.
pub fn trace_test(
    system: &PolynomialSystem,
    instance: &GenericInstance,
    options: &MonodromyOptions,
) -> Result<TraceReport, HomotopyError> {
    instance.check(system)?;
    let n = system.unknowns();
    let mut random = Random::new(options.seed ^ 0x7261_6365);
    let direction: Vec<Complex64> =
        instance.parameters.iter().map(|p| random.normal() * p.norm().max(1e-3)).collect();
    let curve = sliced(system)?;
    // At s = 0 the hyperplane is (0, …, 0, 1 | 0).
    let line: Vec<Complex64> = instance.parameters.iter().chain(&direction).copied().collect();
    let mut vertical = vec![Complex64::zero(); n + 2];
    vertical[n] = Complex64::one();
    let vertical = [line.clone(), vertical].concat();
    let generic: Vec<Complex64> = line.into_iter().chain((0..n + 2).map(|_| random.unit())).collect();
    let lifted: Vec<Vec<Complex64>> =
        instance.solutions.iter().map(|x| x.iter().copied().chain([Complex64::zero()]).collect()).collect();
    let seeds = moved(&curve, &vertical, &generic, &lifted, &options.paths, None)?;
    let shift = random.unit() * 0.3;
    let mut section = seeds;
    let mut bend = Bend::default();
    // The trace says when to stop.
    for round in 0..ROUNDS {
        let options = MonodromyOptions {
            seed: options.seed.wrapping_add(round),
            fruitless_loops: FRUITLESS,
            target: None,
            ..options.clone()
        };
        section = monodromy(&curve, &generic, &section, &options)?.0.solutions;
        bend = Bend::of(&curve, &generic, shift, &section, &options.paths)?;
        if bend.curvature <= LINEAR {
            break;
        }
    }

    // Points of the section that belong to no solution at p go to infinity.
    let projective = Grouping::single(n + 1);
    let back = moved(&curve, &generic, &vertical, &section, &options.paths, Some(&projective))?;
    let mut known = instance.solutions.clone();
    let mut reached = vec![];
    let mut missing = vec![];
    for mut x in back {
        x.truncate(n);
        insert(&mut reached, x.clone());
        if insert(&mut known, x.clone()) {
            missing.push(x);
        }
    }
    let unreached = instance.solutions.len() - (reached.len() - missing.len()).min(instance.solutions.len());
    let Bend { curvature, lost } = bend;
    Ok(TraceReport { section: section.len(), curvature, missing, unreached, lost })
}

/// How far the trace is from linear.
#[derive(Default)]
struct Bend {
    curvature: f64,
    lost: usize,
}

impl Bend {
    /// Of a section, its hyperplane moved by `shift` to both sides.
    fn of(
        curve: &PolynomialSystem,
        hyperplane: &[Complex64],
        shift: Complex64,
        section: &[Vec<Complex64>],
        options: &PathOptions,
    ) -> Result<Self, HomotopyError> {
        let at = |factor: f64| {
            let mut parallel = hyperplane.to_vec();
            parallel[curve.parameters() - 1] += shift * factor;
            moved(curve, hyperplane, &parallel, section, options, None)
        };
        let (before, after) = (at(-1.0)?, at(1.0)?);
        let sum = |points: &[Vec<Complex64>], j: usize| points.iter().map(|x| x[j]).sum::<Complex64>();
        let (mut bend, mut scale): (f64, f64) = (0.0, f64::MIN_POSITIVE);
        for j in 0..curve.unknowns() {
            let second = sum(&before, j) + sum(&after, j) - sum(section, j) * 2.0;
            bend = bend.max(second.norm());
            scale = scale.max(section.iter().map(|x| x[j].norm()).sum());
        }
        Ok(Self { curvature: bend / scale, lost: 2 * section.len() - before.len() - after.len() })
    }
}

/// The points of the section `from`, moved to the section `to`; those that arrive.
fn moved(
    curve: &PolynomialSystem,
    from: &[Complex64],
    to: &[Complex64],
    points: &[Vec<Complex64>],
    options: &PathOptions,
    grouping: Option<&Grouping>,
) -> Result<Vec<Vec<Complex64>>, HomotopyError> {
    let homotopy = Homotopy::between(curve, from, to, grouping)?;
    let starts: Vec<Vec<Complex64>> = points.iter().map(|x| homotopy.lift(x)).collect();
    let results = run(&homotopy, curve, to, &starts, options);
    Ok(results.into_iter().filter(|r| r.is_success()).map(|r| r.solution).collect())
}
