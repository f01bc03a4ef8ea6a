//! Refactorisation and solve of chains of RUVW bodies: 18 equations a body, neighbours coupled by three cables.
#![allow(missing_docs)]

#[path = "../tests/it/support/mod.rs"]
// The tests use the rest of it.
#[allow(dead_code, clippy::unwrap_used, clippy::expect_used)]
mod support;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use support::{Random, chain};
use tg_sparse::{SaddlePattern, SaddleSystem};

fn saddle(criterion: &mut Criterion) {
    for bodies in [1, 3, 6, 56, 556] {
        let problem = chain(bodies, 3, false, 7);
        let mut system = SaddleSystem::new(problem.pattern());
        let size = problem.n + problem.m;
        let rhs = Random::new(3).vector(size);
        let mut x = rhs.clone();
        problem.fill(&mut system);
        let mut group = criterion.benchmark_group("chain");
        group.bench_with_input(BenchmarkId::new("fill", size), &problem, |bencher, problem| {
            bencher.iter(|| problem.fill(&mut system));
        });
        group.bench_function(BenchmarkId::new("factor", size), |bencher| bencher.iter(|| system.factor()));
        group.bench_function(BenchmarkId::new("solve", size), |bencher| {
            bencher.iter(|| {
                x.copy_from_slice(black_box(&rhs));
                system.solve(&mut x)
            });
        });
        group.bench_function(BenchmarkId::new("factor and solve", size), |bencher| {
            bencher.iter(|| {
                x.copy_from_slice(black_box(&rhs));
                system.factor()?;
                system.solve(&mut x)
            });
        });
        group.finish();
    }
    let problem = chain(556, 3, false, 7);
    criterion.bench_function("pattern of 10008", |bencher| {
        let leading: Vec<_> = problem.leading.iter().map(|(_, entries, _)| entries.as_slice()).collect();
        bencher.iter(|| SaddlePattern::new(problem.n, problem.m, &leading, &problem.jacobian));
    });
}

criterion_group!(benches, saddle);
criterion_main!(benches);
