//! The planar compliant mechanism with two free lengths: all solutions from scratch, and one parameter query.
#![allow(missing_docs)]

#[path = "../tests/it/support/mod.rs"]
// The tests use the rest of it.
#[allow(dead_code, clippy::unwrap_used, clippy::expect_used)]
mod support;

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use support::c;
use support::mechanism::Mechanism;
use tg_homotopy::{GenericInstance, ParameterSolver, PathOptions, SolveOptions, Start, solve};

// The inputs are constants that the tests check.
#[allow(clippy::unwrap_used)]
fn mechanism(criterion: &mut Criterion) {
    let mechanism = Mechanism::new([true, true]);
    let system = &mechanism.system;
    let target = [c(11.5, 0.0), c(11.5, 0.0)];
    let start = Start::Grouped(mechanism.grouping.clone());
    let options = SolveOptions { start, ..Default::default() };
    criterion.bench_function("case 3 from scratch", |bencher| {
        bencher.iter(|| solve(system, black_box(&target), &options).unwrap().paths.len());
    });
    let parameters = vec![c(9.1, 4.3), c(8.2, -3.7)];
    let solutions = solve(system, &parameters, &options).unwrap().solutions();
    let instance = GenericInstance { parameters, solutions };
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    for (name, grouping) in [("affine", None), ("multiprojective", Some(mechanism.grouping.clone()))] {
        let solver =
            ParameterSolver::new(system, instance.clone(), grouping, PathOptions::default()).unwrap();
        criterion.bench_function(&format!("query on one core, {name}"), |bencher| {
            bencher.iter(|| one.install(|| solver.query(black_box(&target)).unwrap().paths.len()));
        });
    }
}

criterion_group!(benches, mechanism);
criterion_main!(benches);
