//! Ten lowest modes of a spine of vertebrae, by size and method.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use tg_fixtures::spine;
use tg_tangent::{Configuration, EigenOptions, Method, Metric, lowest};

fn eigen(c: &mut Criterion) {
    let mut group = c.benchmark_group("ten lowest modes");
    group.sample_size(10);
    for (method, sizes) in [(Method::Dense, &[5, 20][..]), (Method::Sparse, &[5, 20, 100, 1000])] {
        for &vertebrae in sizes {
            let Ok(spine) = spine(vertebrae, 8.0, 0.0) else { continue };
            let model = spine.model;
            let Ok(at) = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))
            else {
                continue;
            };
            let options = EigenOptions { method, ..EigenOptions::new(10, Metric::Mass) };
            group.bench_function(BenchmarkId::new(format!("{method:?}"), vertebrae), |b| {
                b.iter(|| black_box(lowest(&model, &at, &options).map(|found| found.pairs.len())));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, eigen);
criterion_main!(benches);
