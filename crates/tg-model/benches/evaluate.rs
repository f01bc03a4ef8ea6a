//! Evaluation of a structure: force, tangents, constraints and Jacobian of a chain of bars in space, by its length.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use tg_model::{At, BuildError, CableLaw, Mechanics, Model, ModelBuilder};

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
            let (q, v, u) = (model.initial_coordinates(), model.velocities_at_rest(), model.inputs_at(0.0));
            let at = At { q: &q, v: &v, u: &u, taut: None };
            let mut group = c.benchmark_group(name);
            let mut f = vec![0.0; q.len()];
            group.bench_function(BenchmarkId::new("force", bars), |b| {
                b.iter(|| model.force(black_box(at), &mut f));
            });
            let mut k = vec![0.0; model.stiffness_pattern().len()];
            group.bench_function(BenchmarkId::new("stiffness", bars), |b| {
                b.iter(|| model.stiffness(black_box(at), &mut k));
            });
            let mut phi = vec![0.0; model.sizes().constraints];
            let mut a = vec![0.0; model.jacobian_pattern().len()];
            group.bench_function(BenchmarkId::new("constraints and Jacobian", bars), |b| {
                b.iter(|| {
                    model.constraints(black_box(&q), &mut phi);
                    model.jacobian(black_box(&q), &mut a);
                });
            });
            group.finish();
        }
    }
}

criterion_group!(benches, evaluate);
criterion_main!(benches);
