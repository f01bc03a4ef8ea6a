//! Where the static elimination order fails, the pivoting factorisation solves the step, and the report counts it.

use std::sync::Arc;

use crate::support::{alpha, run, start, symplectic};
use tg_integrate::Stepper;
use tg_model::{CableLaw, Joining, Model, ModelBuilder, Tension, TensionLaw};

/// A spring of negative stiffness: f = -k (l - μ).
struct Negative(f64);

impl TensionLaw for Negative {
    fn tension(&self, length: f64, _: f64, rest: f64) -> Tension {
        Tension { force: -self.0 * (length - rest), by_length: -self.0, by_rate: 0.0 }
    }

    fn energy(&self, length: f64, rest: f64) -> f64 {
        -0.5 * self.0 * (length - rest).powi(2)
    }

    fn damped(&self) -> bool {
        false
    }
}

const H: f64 = 1.0 / 32.0;
/// m + h²/4 (-k) = 0 for a mass of 1 kg.
const CRITICAL: f64 = 4.0 / (H * H);

/// Two particles of 1 kg on a rail, joined by constraints and tied to a wall by springs of -k and +c: together one mass
/// of 2 kg on a spring c - k.
fn pair(k: f64, c: f64) -> (Model<2>, usize) {
    let mut b = ModelBuilder::<2>::new();
    let wall = b.anchor("wall", [0.0, 0.0]).unwrap();
    let first = b.particle("first", 1.0, [1.0, 0.0]).unwrap();
    let second = b.particle("second", 1.0, [1.0, 0.0]).unwrap();
    b.support("rail", first.node(0), 1, 0.0).unwrap();
    b.joint("glue", &[first.node(0), second.node(0)], Joining::Constrain).unwrap();
    b.cable("pushing", wall, first.node(0), CableLaw::User(Arc::new(Negative(k))), 0.75).unwrap();
    b.cable("pulling", wall, second.node(0), CableLaw::linear(c), 0.75).unwrap();
    let model = b.build().unwrap();
    let x = 2 * model.form(first.node(0)).unwrap().terms()[0].0;
    (model, x)
}

/// At the critical k the first particle's pivot is zero, though the pair is as sound as any: midpoint rule with
/// tan(φ/2) = ω h/2, ω² = (c - k)/2.
#[test]
fn vanishing_pivot_is_solved_by_the_fallback_and_counted() {
    let c = CRITICAL + 200.0;
    let (model, x) = pair(CRITICAL, c);
    let mut stepper = symplectic(&model);
    let mut state = start(&model, &mut stepper);
    let summary = run(&mut stepper, &mut state, H, 1.0);
    println!("{summary:?}");
    assert_eq!((summary.steps, summary.divided), (32, 0));
    // Its factors serve many steps.
    assert!(summary.fallbacks >= 1, "{summary:?}");
    let phase = 32.0 * 2.0 * (0.5 * H * 100.0_f64.sqrt()).atan();
    assert!((state.q[x] - 0.75 - 0.25 * phase.cos()).abs() < 1e-11, "{}", state.q[x]);
}

/// Away from it the static order serves, also with an indefinite leading block.
#[test]
fn indefinite_block_needs_no_fallback() {
    for k in [0.5 * CRITICAL, 1.5 * CRITICAL] {
        let (model, x) = pair(k, k + 200.0);
        let mut stepper = symplectic(&model);
        let mut state = start(&model, &mut stepper);
        let summary = run(&mut stepper, &mut state, H, 1.0);
        assert_eq!((summary.steps, summary.fallbacks), (32, 0), "{summary:?}");
        let phase = 32.0 * 2.0 * (0.5 * H * 100.0_f64.sqrt()).atan();
        assert!((state.q[x] - 0.75 - 0.25 * phase.cos()).abs() < 1e-11, "{}", state.q[x]);
    }
}

/// Generalised-α has its own critical stiffness, m β'.
#[test]
fn generalised_alpha_counts_its_fallbacks() {
    // ρ∞ = 0: α_m = -1, α_f = 0, γ = 3/2, β = 1, so β' = 2/h².
    let k = 2.0 / (H * H);
    let (model, x) = pair(k, k + 200.0);
    let mut stepper = alpha(&model, 0.0);
    let mut state = start(&model, &mut stepper);
    let mut fallbacks = 0;
    for _ in 0..32 {
        fallbacks += stepper.step(&mut state, H).unwrap().fallbacks;
    }
    assert!(fallbacks >= 16, "{fallbacks}");
    assert!((state.q[x] - 0.75).abs() < 0.25, "damped");
}
