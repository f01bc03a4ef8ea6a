//! Inverse and forward statics and stability of a spine of vertebrae, by its size.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use tg_fixtures::spine;
use tg_model::Mechanics;
use tg_statics::{
    Configuration, Forward, ForwardOptions, InverseStatics, Request, SelfStress, Unknown, stability,
};

fn statics(c: &mut Criterion) {
    let mut group = c.benchmark_group("spine");
    group.sample_size(10);
    for vertebrae in [3, 10, 30, 300] {
        let Ok(spine) = spine(vertebrae, 8.0, 0.0) else { continue };
        let model = spine.model;
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
        let mut near = q.clone();
        let free = model.free();
        free.iter().enumerate().for_each(|(k, &i)| near[i] += 1e-3 * (1.0 + k as f64).sin());
        group.bench_function(BenchmarkId::new("forward", vertebrae), |b| {
            let forward = Forward::new(&model, ForwardOptions::default());
            b.iter(|| black_box(forward.solve(&near, &u).map(|found| found.report.iterations)));
        });
        let Ok(at) = Configuration::at(&model, &q, &u) else { continue };
        group.bench_function(BenchmarkId::new("stability", vertebrae), |b| {
            b.iter(|| black_box(stability(&model, &at, 1).map(|found| found.verdict)));
        });
        // Dense work: cubic in the size.
        if vertebrae > 30 {
            continue;
        }
        group.bench_function(BenchmarkId::new("inverse", vertebrae), |b| {
            let request = Request::new(Unknown::RestLength).tension_between(1.0, 40.0);
            b.iter(|| black_box(InverseStatics::new(&model, &q, &u).and_then(|s| s.solve(&request)).is_ok()));
        });
        group.bench_function(BenchmarkId::new("self-stress", vertebrae), |b| {
            b.iter(|| black_box(SelfStress::new(&model, &at).map(|found| found.states.len())));
        });
    }
    group.finish();
}

criterion_group!(benches, statics);
criterion_main!(benches);
