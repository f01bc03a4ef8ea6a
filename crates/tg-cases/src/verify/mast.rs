//! The prism mast that other tools were measured on: its model against plain sums over its bars and cables, its motion
//! against converged positions, its modes against those of another model and solver.
//!
//! The symplectic scheme is symmetric: its error has even powers of h only, and each halving of the step removes one more
//! (Romberg).

use rayon::prelude::*;
use tg_fixtures::{Mast, MastScene, mast};
use tg_modal::{ModeOptions, modes};
use tg_model::{At, Mechanics, Model};
use tg_statics::{Forward, ForwardOptions};
use tg_tangent::Configuration;

use crate::error::CaseError;
use crate::published::{self, CONVERGED};
use crate::row::{Row, Rows};
use crate::simulate::{distance, order, run};

/// Name of the case.
pub const NAME: &str = "mast";
const GEOMETRY: &str = "geometry of the mast";
const SUMS: &str = "sums over bars and cables";
const SCIPY: &str = "scipy: saddle-point matrix, Lanczos";
const THEORY: &str = "theory, second order";

/// How a size is run.
struct Runs {
    stages: usize,
    /// Last of the known times to run to \[s\].
    end: f64,
    /// The largest step \[s\]; each further one is half of it.
    step: f64,
    count: i32,
    /// Largest error at the smallest step, and after extrapolation \[m\].
    errors: [f64; 2],
}

/// Larger masts take larger steps, and the largest ends earlier: all sizes together take seconds.
const RUNS: [Runs; 3] = [
    Runs { stages: 2, end: 2.0, step: 2e-3, count: 3, errors: [1e-5, 1e-8] },
    Runs { stages: 8, end: 2.0, step: 2e-3, count: 2, errors: [5e-5, 1e-5] },
    Runs { stages: 32, end: 1.0, step: 2e-3, count: 2, errors: [5e-5, 1e-5] },
];

/// All rows.
///
/// # Errors
/// A model cannot be built or a run fails.
pub fn rows() -> Result<Vec<Row>, CaseError> {
    let mut rows = Rows::new(NAME);
    for stages in published::Mast::STAGES {
        counts(&mut rows, stages)?;
        model(&mut rows, stages)?;
    }
    let paths: Vec<Vec<Path>> = RUNS.par_iter().map(Runs::paths).collect::<Result<_, _>>()?;
    for (runs, paths) in RUNS.iter().zip(&paths) {
        runs.rows(&mut rows, paths);
    }
    for (&stages, known) in &published::mast().omega_squared {
        modal(&mut rows, stages, known)?;
    }
    Ok(rows.finish())
}

/// Ten lowest modes about the loaded equilibrium.
fn modal(rows: &mut Rows, stages: usize, known: &[f64]) -> Result<(), CaseError> {
    let model = mast(stages)?.model;
    let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
    let at = Forward::new(&model, ForwardOptions::default()).solve(&q, &u)?.configuration;
    let found = modes(&model, &at, &ModeOptions::new(known.len()))?;
    let pairs = found.list.iter().zip(known);
    let apart = pairs.map(|(ours, known)| (ours.omega_squared / known - 1.0).abs());
    // `f64::max` would drop NaN.
    let largest = apart.fold(0.0, |largest, apart| if apart <= largest { largest } else { apart });
    let name = |what: &str| format!("N = {stages}: {what}");
    rows.exact(name("lowest modes"), (found.list.len(), known.len()), SCIPY);
    rows.below(name("largest difference of an ω², relative"), "1", largest, SCIPY, 1e-9);
    Ok(())
}

fn counts(rows: &mut Rows, stages: usize) -> Result<(), CaseError> {
    let mast = mast(stages)?;
    let report = mast.model.report();
    let name = |what: &str| format!("N = {stages}: {what}");
    rows.exact(name("free coordinates"), (report.free, 9 * stages), GEOMETRY);
    rows.exact(name("constraints"), (report.intrinsic + report.extrinsic, 3 * stages), GEOMETRY);
    rows.exact(name("degrees of freedom"), (report.degrees_of_freedom(), 6 * stages), GEOMETRY);
    rows.exact(name("cables"), (mast.model.cables().len(), 12 * stages), GEOMETRY);
    Ok(())
}

/// Mass, force and balance of the model.
fn model(rows: &mut Rows, stages: usize) -> Result<(), CaseError> {
    let scene = MastScene::new(stages);
    let mast = Mast::build(&scene)?;
    let name = |what: &str| format!("N = {stages}: {what}");
    let along_x = mast.model.mass().iter().filter(|e| e.row % 3 == 0 && e.col % 3 == 0);
    let mass = 3.0 * stages as f64 * MastScene::BAR_MASS;
    rows.near(name("mass"), "kg", (along_x.map(|e| e.value).sum(), mass), SUMS, 1e-12);
    rows.below(name("largest difference of a force"), "N", force_difference(&scene, &mast)?, SUMS, 1e-11);
    let balanced = Mast::build(&MastScene::balanced(stages))?.model;
    let at = Configuration::at(&balanced, &balanced.initial_coordinates(), &balanced.inputs_at(0.0))?;
    let source = "the design geometry is an equilibrium";
    rows.below(name("imbalance with guys undisturbed"), "1", at.imbalance().0, source, 1e-12);
    Ok(())
}

/// Largest difference between the model's forces on the free nodes and a sum over bars and cables, in a bent and moving
/// configuration \[N\].
fn force_difference(scene: &MastScene, mast: &Mast) -> Result<f64, CaseError> {
    let model: &Model<3> = &mast.model;
    let (mut q, mut v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
    for (k, &i) in model.free().iter().enumerate() {
        q[i] += 2e-3 * (1.0 + k as f64).sin();
        v[i] = 0.1 * (2.0 + k as f64).cos();
    }
    let mut force = vec![0.0; q.len()];
    model.force(At { q: &q, v: &v, u: &u, taut: None }, &mut force);
    let forms = mast.nodes.iter().map(|&node| model.form(node)).collect::<Result<Vec<_>, _>>()?;
    let free = 3..3 + forms.len();
    let mut at = scene.nodes.clone();
    let mut speed = vec![[0.0; 3]; at.len()];
    for (node, form) in free.clone().zip(&forms) {
        (at[node], speed[node]) = (form.eval(&q).into(), form.eval(&v).into());
    }
    let sum = sum_of_forces(scene, &at, &speed);
    let ours: Vec<[f64; 3]> = forms.iter().map(|form| form.eval(&force).into()).collect();
    Ok(distance(&ours, &sum[free]))
}

/// Weights and damped cables, node by node.
fn sum_of_forces(scene: &MastScene, at: &[[f64; 3]], speed: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let mut sum = vec![[0.0; 3]; at.len()];
    for &node in scene.bars.iter().flatten() {
        sum[node][2] -= MastScene::BAR_MASS * MastScene::GRAVITY / 2.0;
    }
    for cable in &scene.cables {
        let [a, b] = cable.nodes;
        let apart: [f64; 3] = std::array::from_fn(|d| at[b][d] - at[a][d]);
        let length = apart.iter().map(|x| x * x).sum::<f64>().sqrt();
        let rate = (0..3).map(|d| apart[d] * (speed[b][d] - speed[a][d])).sum::<f64>() / length;
        let tension = cable.stiffness * (length - cable.rest_length) + cable.damping * rate;
        for d in 0..3 {
            let pull = tension * apart[d] / length;
            sum[a][d] += pull;
            sum[b][d] -= pull;
        }
    }
    sum
}

/// Positions of all free nodes, at the times at which they are known one after the other.
type Path = Vec<Vec<[f64; 3]>>;

impl Runs {
    /// With each step.
    fn paths(&self) -> Result<Vec<Path>, CaseError> {
        let mast = mast(self.stages)?;
        let forms = mast.nodes.iter().map(|&node| mast.model.form(node)).collect::<Result<Vec<_>, _>>()?;
        let times = self.times();
        let with = |halving: i32| {
            let h = self.step * 0.5_f64.powi(halving);
            let strides: Vec<usize> = times.iter().map(|t| (t / h).round() as usize).collect();
            let (mut path, mut step) = (Path::new(), 0);
            run(&mast.model, h, self.end, |state| {
                if strides.contains(&step) {
                    path.push(forms.iter().map(|form| form.eval(&state.q).into()).collect());
                }
                step += 1;
            })?;
            Ok(path)
        };
        (0..self.count).map(with).collect()
    }

    /// The known times that the runs come to.
    fn times(&self) -> Vec<f64> {
        published::mast().t.iter().copied().filter(|&t| t <= self.end).collect()
    }

    /// Extrapolated positions, error and order.
    fn rows(&self, rows: &mut Rows, paths: &[Path]) {
        let times = self.times();
        let exact: Path = published::mast()
            .positions(self.stages)
            .unwrap_or_default()
            .iter()
            .take(times.len())
            .map(|nodes| nodes.iter().skip(3).copied().collect())
            .collect();
        let name = |what: String| format!("N = {}: {what}", self.stages);
        let h = self.step * 0.5_f64.powi(self.count - 1);
        let largest = |path: &Path| worst(path, &exact).into_iter().fold(0.0, f64::max);
        let errors: Vec<f64> = paths.iter().map(largest).collect();
        let finest = errors.last().copied().unwrap_or(f64::NAN);
        rows.below(name(format!("largest error, h = {h:e}")), "m", finest, CONVERGED, self.errors[0]);
        rows.near(name("order of convergence".into()), "1", (order(&errors), 2.0), THEORY, 0.1);
        for (t, left) in times.iter().zip(worst(&extrapolated(paths), &exact)) {
            let quantity = name(format!("t = {t} s: largest error, extrapolated"));
            rows.below(quantity, "m", left, CONVERGED, self.errors[1]);
        }
    }
}

/// Largest distance at each time; NaN where a path ends early.
fn worst(path: &Path, exact: &Path) -> Vec<f64> {
    let at = |k: usize| path.get(k).map_or(f64::NAN, |nodes| distance(nodes, &exact[k]));
    (0..exact.len()).map(at).collect()
}

/// The path that paths with halved steps lead to.
fn extrapolated(paths: &[Path]) -> Path {
    let mut row = paths.to_vec();
    let mut factor = 4.0;
    while row.len() > 1 {
        row = row.windows(2).map(|pair| without(factor, &pair[0], &pair[1])).collect();
        factor *= 4.0;
    }
    row.pop().unwrap_or_default()
}

/// The path without the error that is `factor` times smaller in `fine` than in `coarse`.
fn without(factor: f64, coarse: &Path, fine: &Path) -> Path {
    let value = |c: f64, f: f64| f + (f - c) / (factor - 1.0);
    let point = |(c, f): (&[f64; 3], &[f64; 3])| std::array::from_fn(|d| value(c[d], f[d]));
    let nodes = |(c, f): (&Vec<[f64; 3]>, &Vec<[f64; 3]>)| c.iter().zip(f).map(point).collect();
    coarse.iter().zip(fine).map(nodes).collect()
}
