//! After a warm-up a step allocates nothing, nor does the driver with an observer that does nothing.

use crate::support::prism::{self, prisms};
use crate::support::tower::{self, tower};
use crate::support::{alpha, composition, example1, explicit, fixed, start, symplectic};
use allocation_counter::measure;
use tg_integrate::{
    CompositionScheme, EmbeddedPair, Leapfrog, NewtonOptions, Run, State, StepReport, Stepper, Summary,
};
use tg_model::Model;

/// Allocations of `steps` steps after the first, with the totals of the reports.
fn allocations(stepper: &mut dyn Stepper, state: &mut State, h: f64, steps: usize) -> (u64, Summary) {
    let mut total = Summary::default();
    stepper.step(state, h).unwrap();
    let info = measure(|| {
        for _ in 0..steps {
            total += stepper.step(state, h).unwrap();
        }
    });
    (info.count_total, total)
}

fn none<const D: usize>(name: &str, model: &Model<D>) {
    let mut steppers: [Box<dyn Stepper + '_>; 3] = [
        Box::new(symplectic(model)),
        Box::new(symplectic(model).carrying_momentum()),
        Box::new(alpha(model, 0.7)),
    ];
    for (k, stepper) in steppers.iter_mut().enumerate() {
        let mut state = start(model, stepper.as_mut());
        let (count, total) = allocations(stepper.as_mut(), &mut state, 1e-3, 500);
        assert!(total.iterations >= 500, "{name}: {total:?}");
        assert_eq!(total.fallbacks, 0, "{name}: the fallback may allocate");
        assert_eq!(count, 0, "{name}, stepper {k}");
    }
}

#[test]
fn steps_allocate_nothing() {
    none("example 1", &example1().model);
    none("tower, moving supports", &tower(tower::UN).model);
    none("tower, damped", &tower(tower::DN).model);
    none("tower, slacking", &tower(tower::US).model);
    none("prisms", &prisms(prism::Setup { count: 3, damping: 1.0, ..prism::STANDING }).model);
}

/// Frozen and divided steps neither.
#[test]
fn steps_that_need_the_remedy_allocate_nothing() {
    let model = tower(tower::DAMPED_SLACKING).model;
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let (count, total) = allocations(&mut stepper, &mut state, 2e-3, 900);
    assert!(total.divided > 0, "{total:?}");
    assert_eq!(count, 0);
}

/// Explicit steps under error control with switches to locate, fixed ones, and compositions.
#[test]
fn explicit_and_composed_steps_allocate_nothing() {
    let model = tower(tower::US).model;
    let pairs = [EmbeddedPair::DormandPrince5, EmbeddedPair::DormandPrince8];
    let mut steppers: Vec<Box<dyn Stepper + '_>> = Vec::new();
    for pair in pairs {
        steppers.push(Box::new(explicit(&model, pair, 1e-5)));
        steppers.push(Box::new(fixed(&model, pair)));
    }
    steppers.push(Box::new(composition(&model, CompositionScheme::Suzuki4)));
    steppers.push(Box::new(Leapfrog::new(&model, NewtonOptions::default()).unwrap()));
    let mut located = 0;
    for (k, stepper) in steppers.iter_mut().enumerate() {
        let mut state = start(&model, stepper.as_mut());
        let (count, total) = allocations(stepper.as_mut(), &mut state, 4e-3, 150);
        located += total.frozen;
        assert_eq!((count, total.fallbacks), (0, 0), "stepper {k}: {total:?}");
    }
    assert!(located > 0);
}

#[test]
fn driver_allocates_nothing_per_step() {
    let model = tower(tower::UN).model;
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let mut count_of = |steps: u32, state: &mut State| {
        let end = state.t + f64::from(steps) * 1e-3;
        let mut nothing = |_: &State, _: &StepReport| ();
        let info = measure(|| {
            let summary = Run::new(1e-3, end).observe(&mut nothing).go(&mut stepper, state).unwrap();
            assert_eq!(summary.steps, u64::from(steps));
        });
        info.count_total
    };
    count_of(10, &mut state);
    let (short, long) = (count_of(10, &mut state), count_of(500, &mut state));
    println!("{short} {long}");
    assert_eq!(short, long, "allocations depend on the number of steps");
}

/// The counter counts: the test above can fail.
#[test]
fn counter_sees_an_allocation() {
    assert_eq!(measure(|| drop(std::hint::black_box(vec![0.0; 3]))).count_total, 1);
}
