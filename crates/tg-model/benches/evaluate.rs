//! Evaluation of a structure: force, tangents, constraints and Jacobian of a chain of bars and of the prism mast, by their
//! length; of the mast also the matrix of a Newton step (55): assembled, factored, solved.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use tg_fixtures::mast;
use tg_model::{At, BuildError, CableLaw, Layout, Mechanics, Model, ModelBuilder};
use tg_sparse::SaddleSystem;

/// Stages of the masts.
const STAGES: [usize; 5] = [2, 8, 32, 128, 512];

/// Bars side by side, 0.1 m apart, each end tied to the same and to the opposite end of the next.
fn fence(bars: usize, law: &CableLaw) -> Result<Model<3>, BuildError> {
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -9.81])?;
    let mut before = None;
    for k in 0..bars {
        let x = 0.1 * k as f64;
        let bar = b.bar(&format!("bar {k}"), 0.1, [x, 0.0, 0.0], [x, 0.0, 0.2])?;
        if let Some(before) = before.replace(bar) {
            for (from, to, rest) in [(0, 0, 0.09), (1, 1, 0.09), (0, 1, 0.2), (1, 0, 0.2)] {
                b.cable(
                    &format!("cable {k}.{from}{to}"),
                    before.node(from),
                    bar.node(to),
                    law.clone(),
                    rest,
                )?;
            }
        }
    }
    b.build()
}

fn evaluate(c: &mut Criterion) {
    let damped = CableLaw::slacking(1000.0).with_damping(2.0);
    for (name, law) in [("undamped", CableLaw::slacking(1000.0)), ("damped", damped)] {
        for bars in [8, 64, 512] {
            let Ok(model) = fence(bars, &law) else { continue };
            evaluation(c, name, bars, &model);
        }
    }
    for stages in STAGES {
        let Ok(mast) = mast(stages) else { continue };
        evaluation(c, "mast", stages, &mast.model);
        newton(c, stages, &mast.model);
    }
}

/// Functions of the state one by one.
fn evaluation(c: &mut Criterion, name: &str, size: usize, model: &Model<3>) {
    let (q, v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
    let at = At { q: &q, v: &v, u: &u, taut: None };
    let mut group = c.benchmark_group(name);
    let mut f = vec![0.0; q.len()];
    group.bench_function(BenchmarkId::new("force", size), |b| {
        b.iter(|| model.force(black_box(at), &mut f));
    });
    let mut k = vec![0.0; model.stiffness_pattern().len()];
    group.bench_function(BenchmarkId::new("stiffness", size), |b| {
        b.iter(|| model.stiffness(black_box(at), &mut k));
    });
    let mut phi = vec![0.0; model.sizes().constraints];
    let mut a = vec![0.0; model.jacobian_pattern().len()];
    group.bench_function(BenchmarkId::new("constraints and Jacobian", size), |b| {
        b.iter(|| {
            model.constraints(black_box(&q), &mut phi);
            model.jacobian(black_box(&q), &mut a);
        });
    });
    group.finish();
}

/// The matrix (55) of a step of 1 ms.
fn newton(c: &mut Criterion, size: usize, model: &Model<3>) {
    let (q, v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
    let at = At { q: &q, v: &v, u: &u, taut: None };
    let mass: Vec<_> = model.mass().iter().map(|e| (e.row, e.col)).collect();
    let values: Vec<f64> = model.mass().iter().map(|e| e.value).collect();
    let groups = [&mass, model.stiffness_pattern(), model.damping_pattern()];
    let Ok(pattern) = Layout::new(model).saddle(model, &groups) else { return };
    let mut system = SaddleSystem::new(pattern);
    let (mut stiffness, mut damping) = (vec![0.0; groups[1].len()], vec![0.0; groups[2].len()]);
    let mut jacobian = vec![0.0; model.jacobian_pattern().len()];
    let h = 1e-3;
    let mut group = c.benchmark_group("mast, matrix (55)");
    group.bench_function(BenchmarkId::new("assembly", size), |b| {
        b.iter(|| {
            model.stiffness(black_box(at), &mut stiffness);
            model.damping(at, &mut damping);
            model.jacobian(at.q, &mut jacobian);
            system.clear_leading();
            system.add_leading(0, 1.0, &values);
            system.add_leading(1, h * h / 4.0, &stiffness);
            system.add_leading(2, h / 2.0, &damping);
            system.set_jacobian(&jacobian, &jacobian);
        });
    });
    group.bench_function(BenchmarkId::new("factorisation", size), |b| b.iter(|| system.factor()));
    let rhs = vec![1e-3; model.free().len() + model.sizes().constraints];
    let mut x = rhs.clone();
    group.bench_function(BenchmarkId::new("solve", size), |b| {
        b.iter(|| {
            x.copy_from_slice(black_box(&rhs));
            system.solve(&mut x)
        });
    });
    group.finish();
}

/// Long enough to compare with: there are many groups.
fn short() -> Criterion {
    let (warm_up, measurement) = (Duration::from_millis(300), Duration::from_secs(1));
    Criterion::default().sample_size(20).warm_up_time(warm_up).measurement_time(measurement)
}

criterion_group! {
    name = benches;
    config = short();
    targets = evaluate
}
criterion_main!(benches);
