//! One step of each scheme: example 1, example 2, and chains of prisms in space.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use support::tower::{self, tower};
use support::{alpha, composition, example1, fixed, prism, start, symplectic};
use tg_integrate::{CompositionScheme, EmbeddedPair, Stepper};
use tg_model::Model;

#[path = "../tests/it/support/mod.rs"]
// The tests use the rest of it.
#[allow(dead_code, clippy::unwrap_used, clippy::expect_used)]
mod support;

const STEP: f64 = 1e-3;

/// Steps onward from the start: the iterations are those of a moving structure.
fn stepping<const D: usize>(c: &mut Criterion, name: &str, size: &str, model: &Model<D>) {
    let mut group = c.benchmark_group(name);
    let mut steppers: [(&str, Box<dyn Stepper + '_>); 6] = [
        ("symplectic", Box::new(symplectic(model))),
        ("generalised-alpha", Box::new(alpha(model, 0.7))),
        ("Dormand-Prince 5", Box::new(fixed(model, EmbeddedPair::DormandPrince5))),
        ("Dormand-Prince 8", Box::new(fixed(model, EmbeddedPair::DormandPrince8))),
        ("composition 4", Box::new(composition(model, CompositionScheme::Suzuki4))),
        ("composition 6", Box::new(composition(model, CompositionScheme::KahanLi6))),
    ];
    for (scheme, stepper) in &mut steppers {
        let mut state = start(model, stepper.as_mut());
        group.bench_function(BenchmarkId::new(*scheme, size), |b| {
            b.iter(|| stepper.step(black_box(&mut state), STEP));
        });
    }
    group.finish();
}

fn all(c: &mut Criterion) {
    stepping(c, "double pendulum", "example 1", &example1().model);
    stepping(c, "tower", "UN", &tower(tower::UN).model);
    for count in [2, 8, 32] {
        let setup = prism::Setup { count, damping: 1.0, ..prism::STANDING };
        stepping(c, "chain of prisms", &count.to_string(), &prism::prisms(setup).model);
    }
}

criterion_group!(benches, all);
criterion_main!(benches);
