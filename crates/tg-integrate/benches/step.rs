//! One step of each scheme: example 1, example 2, chains of prisms and the prism mast in space. Iterations are printed.

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use support::tower::{self, tower};
use support::{alpha, composition, example1, fixed, prism, start, symplectic};
use tg_fixtures::mast;
use tg_integrate::{CompositionScheme, EmbeddedPair, StepError, Stepper};
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
        let (mut steps, mut iterations) = (0_u64, 0);
        group.bench_function(BenchmarkId::new(*scheme, size), |b| {
            b.iter(|| {
                let report = stepper.step(black_box(&mut state), STEP)?;
                steps += 1;
                iterations += u64::from(report.iterations);
                Ok::<_, StepError>(report)
            });
        });
        println!("{name}, {scheme}, {size}: {:.2} iterations a step", iterations as f64 / steps as f64);
    }
    group.finish();
}

fn all(c: &mut Criterion) {
    stepping(c, "double pendulum", "example 1", &example1().model);
    for (size, setup) in [("UN", tower::UN), ("DN", tower::DN), ("US", tower::US)] {
        stepping(c, "tower", size, &tower(setup).model);
    }
    for count in [2, 8, 32] {
        let setup = prism::Setup { count, damping: 1.0, ..prism::STANDING };
        stepping(c, "chain of prisms", &count.to_string(), &prism::prisms(setup).model);
    }
    for stages in [2, 8, 32, 128, 512] {
        let Ok(mast) = mast(stages) else { continue };
        stepping(c, "mast", &stages.to_string(), &mast.model);
    }
}

/// Long enough to compare with; the large masts decide how long it takes.
fn short() -> Criterion {
    let (warm_up, measurement) = (Duration::from_millis(300), Duration::from_secs(1));
    Criterion::default().sample_size(20).warm_up_time(warm_up).measurement_time(measurement)
}

criterion_group! {
    name = benches;
    config = short();
    targets = all
}
criterion_main!(benches);
