//! The mast by its size: steps, their parts, analyses, memory.

use super::floor::{Floor, VARIANTS};
use super::page::{digits, table};
use super::scene::{MastRun, Scene};
use super::scheme::{Counts, Dial, SCHEMES};
use super::stepping::{Cost, cost};
use super::{Options, growth, memory, parts};
use crate::TaskError;

/// Largest mast that the floor program is run on.
const FLOOR: usize = 128;
/// Size whose peak memory is measured.
const LARGE: usize = 4096;
/// Seconds that an analysis may take; larger masts are left out.
const PATIENCE: f64 = 10.0;

/// Stages that are measured.
fn stages(options: &Options) -> &'static [usize] {
    if options.quick { &[2, 8, 32] } else { &[2, 8, 32, 128, 512, 2048] }
}

pub(super) fn section(options: &Options, floor: Option<&Floor>) -> Result<String, TaskError> {
    let stages = stages(options);
    let steps = steps(options, stages, floor)?;
    let parts = analyses(options, stages)?;
    Ok(format!("{steps}\n{parts}\n{}\n", peak(options)?))
}

/// Cost of all schemes and of the floor on one mast.
struct Measured {
    degrees_of_freedom: usize,
    costs: Vec<Cost>,
    /// µs per step of each variant of the floor program, where it was run.
    floor: Vec<f64>,
}

impl Measured {
    fn new(options: &Options, stages: usize, floor: Option<&Floor>) -> Result<Self, TaskError> {
        let scene = Scene::mast(stages)?;
        let floor = floor.filter(|_| stages <= FLOOR);
        let nothing = Cost { micros: f64::INFINITY, iterations: 0.0, allocations: 0 };
        let mut costs = vec![nothing; SCHEMES.len()];
        let mut of_floor = vec![f64::INFINITY; if floor.is_some() { VARIANTS.len() } else { 0 }];
        let run = MastRun::new(stages)?;
        for _ in 0..options.passes() {
            for (best, scheme) in costs.iter_mut().zip(&SCHEMES) {
                let now = cost(&scene, scheme, options.budget())?;
                if now.micros < best.micros {
                    *best = now;
                }
            }
            for (best, variant) in of_floor.iter_mut().zip(&VARIANTS) {
                if let (Some(floor), Dial::Steps(steps)) = (floor, Dial::PAPER) {
                    *best = best.min(floor.micros(&run, variant, steps)?);
                }
            }
        }
        Ok(Self { degrees_of_freedom: scene.degrees_of_freedom, costs, floor: of_floor })
    }

    /// How many times as long as the floor's a step of scheme k takes, or an evaluation in it.
    fn times_floor(&self, k: usize) -> f64 {
        let variant = VARIANTS.iter().position(|variant| Some(variant.name) == SCHEMES[k].floor);
        let Some((at, &floor)) = variant.and_then(|at| Some((at, self.floor.get(at)?))) else {
            return f64::NAN;
        };
        match SCHEMES[k].counts {
            Counts::Iterations => self.costs[k].micros / floor,
            Counts::Evaluations => self.per_evaluation(k) / (floor / VARIANTS[at].evaluations),
        }
    }

    fn per_evaluation(&self, k: usize) -> f64 {
        self.costs[k].micros / self.costs[k].iterations
    }
}

fn steps(options: &Options, stages: &[usize], floor: Option<&Floor>) -> Result<String, TaskError> {
    let measured: Vec<Measured> =
        stages.iter().map(|&n| Measured::new(options, n, floor)).collect::<Result<_, _>>()?;
    let mut header: Vec<String> = vec!["µs per step of 1 ms".into()];
    header.extend(stages.iter().map(|n| format!("N = {n}")));
    header.push("growth".into());
    let growth = growth::exponents(options, stages.iter().copied().max().unwrap_or(0))?;
    let mut rows = Vec::new();
    for (k, scheme) in SCHEMES.iter().enumerate() {
        let micros: Vec<f64> = measured.iter().map(|m| m.costs[k].micros).collect();
        let exponent = growth.as_ref().map(|exponents| format!("N^{:.2}", exponents[k]));
        rows.push(row(scheme.name, &micros, &exponent.unwrap_or_default()));
        let per_freedom: Vec<f64> = micros
            .iter()
            .zip(&measured)
            .map(|(micros, m)| 1e3 * micros / m.degrees_of_freedom as f64)
            .collect();
        rows.push(row("· ns per degree of freedom", &per_freedom, ""));
        match scheme.counts {
            Counts::Iterations => {
                let iterations: Vec<f64> = measured.iter().map(|m| m.costs[k].iterations).collect();
                rows.push(row(scheme.counts.label(), &iterations, ""));
            }
            Counts::Evaluations => {
                let micros: Vec<f64> = measured.iter().map(|m| m.per_evaluation(k)).collect();
                rows.push(row("· µs per evaluation", &micros, ""));
            }
        }
        let allocations: Vec<f64> = measured.iter().map(|m| m.costs[k].allocations as f64).collect();
        rows.push(row("· allocations, all steps", &allocations, ""));
        let ratios: Vec<f64> = measured.iter().map(|m| m.times_floor(k)).collect();
        if ratios.iter().any(|ratio| ratio.is_finite()) {
            rows.push(row(&format!("· times the floor, {}", scheme.floor.unwrap_or("")), &ratios, ""));
        }
    }
    if floor.is_some() {
        for (k, variant) in VARIANTS.iter().enumerate() {
            let micros: Vec<f64> =
                measured.iter().map(|m| m.floor.get(k).copied().unwrap_or(f64::NAN)).collect();
            rows.push(row(&format!("floor: {}", variant.name), &micros, ""));
        }
    }
    Ok(format!("### Steps of the mast\n\n{}", table(&header, &rows)))
}

fn row(name: &str, values: &[f64], last: &str) -> Vec<String> {
    let mut row = vec![name.to_string()];
    row.extend(values.iter().map(|&x| digits(x)));
    row.push(last.into());
    row
}

/// Parts of a Newton iteration, inverse statics, search for equilibrium, modes.
fn analyses(options: &Options, stages: &[usize]) -> Result<String, TaskError> {
    let mut header: Vec<String> = vec!["ms".into()];
    header.extend(stages.iter().map(|n| format!("N = {n}")));
    let names = [
        "assembly of the matrix (55)",
        "factorisation",
        "solve",
        "inverse statics",
        "loaded equilibrium",
        "ten lowest modes",
    ];
    let mut rows: Vec<Vec<String>> = names.iter().map(|name| vec![(*name).into()]).collect();
    let budget = options.budget() / 2.0;
    let (mut inverse, mut modal) = (Vec::new(), Vec::new());
    for &n in stages {
        let newton = parts::newton(&Scene::mast(n)?, budget)?;
        inverse.push(if next(&inverse) < PATIENCE {
            parts::inverse_statics(n, budget)?
        } else {
            f64::INFINITY
        });
        let (modes, search) = if next(&modal) < PATIENCE {
            let modal = parts::modal(n, budget)?;
            (modal.modes, modal.search)
        } else {
            (f64::INFINITY, f64::INFINITY)
        };
        modal.push(modes + search);
        let seconds =
            [newton.assembly, newton.factorisation, newton.solve, inverse[inverse.len() - 1], search, modes];
        for (row, seconds) in rows.iter_mut().zip(seconds) {
            row.push(digits(1e3 * seconds));
        }
    }
    Ok(format!("### Parts and analyses of the mast\n\n{}", table(&header, &rows)))
}

/// What the next size will take, if time grows as it did.
fn next(seconds: &[f64]) -> f64 {
    match seconds {
        [.., before, last] => last * last / before,
        _ => 0.0,
    }
}

fn peak(options: &Options) -> Result<String, TaskError> {
    let stages = if options.quick { 128 } else { LARGE };
    let header = [format!("peak memory, N = {stages}"), "MB".into()];
    let mut rows = Vec::new();
    for (k, scheme) in SCHEMES.iter().enumerate() {
        rows.push(vec![scheme.name.to_string(), digits(memory::peak(stages, k)?)]);
    }
    Ok(format!("### Memory\n\n{}", table(&header, &rows)))
}
