//! The planar compliant mechanism from model to judged equilibria: from scratch, one query, and a sweep.
#![allow(missing_docs)]

#[path = "../tests/it/support.rs"]
// The tests use the rest of it.
#[allow(dead_code, clippy::unwrap_used)]
mod support;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use support::mechanism;
use tg_equilibria::{EquilibriaOptions, Family, all_equilibria};

// The inputs are constants that the tests check.
#[allow(clippy::unwrap_used)]
fn equilibria(criterion: &mut Criterion) {
    let options = EquilibriaOptions::default();
    let (model, u) = (mechanism([11.5, 11.5]), [11.5, 11.5]);
    criterion.bench_function("case 3 from scratch", |bencher| {
        bencher.iter(|| all_equilibria(&model, black_box(&u), &options).unwrap().certified);
    });
    let family = Family::new(&model, &u, &options).unwrap();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    criterion.bench_function("case 3, query on one core", |bencher| {
        bencher.iter(|| one.install(|| family.query(black_box(&u)).unwrap().certified));
    });
    let values: Vec<f64> = (1..=200).map(|k| 0.1 * f64::from(k)).collect();
    let mut group = criterion.benchmark_group("200 values of L01");
    group.sample_size(10);
    for free in [[11.5, 0.0], [11.5, 11.5]] {
        let model = mechanism(free);
        let family = Family::new(&model, &free, &options).unwrap();
        group.bench_function(format!("L02 = {}", free[1]), |bencher| {
            bencher.iter(|| family.sweep(black_box(&free), 0, &values).unwrap().folds.len());
        });
    }
    group.finish();
}

criterion_group!(benches, equilibria);
criterion_main!(benches);
