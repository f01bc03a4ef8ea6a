//! Inverse and forward statics and stability of a spine of vertebrae, rest lengths of the prism mast, by their size.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use tg_fixtures::{Mast, MastScene, spine};
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

/// Rest lengths that hold the mast, every cable at 1 N or more.
fn inverse(c: &mut Criterion) {
    let mut group = c.benchmark_group("mast");
    group.sample_size(10).measurement_time(Duration::from_secs(1));
    // Dense work: cubic in the size.
    for stages in [2, 8, 32] {
        let Ok(mast) = Mast::build(&MastScene::balanced(stages)) else { continue };
        let model = mast.model;
        let (q, u) = (model.initial_coordinates(), model.inputs_at(0.0));
        let request = Request::new(Unknown::RestLength).tension_between(1.0, 200.0);
        group.bench_function(BenchmarkId::new("inverse", stages), |b| {
            b.iter(|| black_box(InverseStatics::new(&model, &q, &u).and_then(|s| s.solve(&request)).is_ok()));
        });
    }
    group.finish();
}

criterion_group!(benches, statics, inverse);
criterion_main!(benches);
