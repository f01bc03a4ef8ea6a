//! Ten lowest modes of a spine of vertebrae and of the balanced prism mast, by size and method.

use std::hint::black_box;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup as Group, BenchmarkId, Criterion, criterion_group, criterion_main};
use tg_fixtures::{Mast, MastScene, spine};
use tg_model::Model;
use tg_tangent::{Configuration, EigenOptions, Method, Metric, lowest};

fn eigen(c: &mut Criterion) {
    let mut group = c.benchmark_group("ten lowest modes");
    group.sample_size(10);
    for (method, sizes) in [(Method::Dense, &[5, 20][..]), (Method::Sparse, &[5, 20, 100, 1000])] {
        for &vertebrae in sizes {
            let Ok(spine) = spine(vertebrae, 8.0, 0.0) else { continue };
            ten(&mut group, &format!("{method:?}"), vertebrae, method, &spine.model);
        }
    }
    for stages in [2, 8, 32, 128, 512] {
        let Ok(mast) = Mast::build(&MastScene::balanced(stages)) else { continue };
        ten(&mut group, "mast", stages, EigenOptions::new(10, Metric::Mass).method, &mast.model);
    }
    group.finish();
}

/// Ten modes about the initial configuration.
fn ten(group: &mut Group<'_, WallTime>, name: &str, size: usize, method: Method, model: &Model<3>) {
    let Ok(at) = Configuration::at(model, &model.initial_coordinates(), &model.inputs_at(0.0)) else {
        return;
    };
    let options = EigenOptions { method, ..EigenOptions::new(10, Metric::Mass) };
    group.bench_function(BenchmarkId::new(name, size), |b| {
        b.iter(|| black_box(lowest(model, &at, &options).map(|found| found.pairs.len())));
    });
}

criterion_group!(benches, eigen);
criterion_main!(benches);
