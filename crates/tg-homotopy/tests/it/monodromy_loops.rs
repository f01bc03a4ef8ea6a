//! Filling instances by loops, and the trace test.

use crate::support::{c, mechanism::Mechanism, unknowns};
use tg_homotopy::{
    GenericInstance, HomotopyError, MonodromyOptions, PolynomialSystem, SolveOptions, Start, SystemBuilder,
    find_seed, monodromy, solve, trace_test,
};

/// Two general conics: every coefficient is a parameter, 4 solutions in one component.
fn conics() -> PolynomialSystem {
    let mut b = SystemBuilder::new();
    let x = unknowns(&mut b, 2);
    for k in 0..2 {
        let monomials = [x[0].pow(2), &x[0] * &x[1], x[1].pow(2), x[0].clone(), x[1].clone()];
        let mut conic = b.parameter(format!("c{k}"));
        for (m, monomial) in monomials.iter().enumerate() {
            conic = conic + b.parameter(format!("c{k}{m}")) * monomial;
        }
        b.equation(conic);
    }
    b.build().unwrap()
}

#[test]
fn two_conics_from_one_seed() {
    let system = conics();
    for seed in 1..=3 {
        let (x, p) = find_seed(&system, seed).unwrap();
        let options = MonodromyOptions { seed, ..Default::default() };
        let (instance, report) = monodromy(&system, &p, &[x], &options).unwrap();
        assert_eq!(instance.solutions.len(), 4);
        assert_eq!((report.fruitless, report.lost), (10, 0));
        let trace = trace_test(&system, &instance, &options).unwrap();
        assert!(trace.is_complete(1e-9), "{trace:?}");
    }
}

#[test]
fn the_trace_of_a_part_is_not_linear() {
    let system = conics();
    let (x, p) = find_seed(&system, 1).unwrap();
    let (full, _) = monodromy(&system, &p, &[x], &MonodromyOptions::default()).unwrap();
    let part = GenericInstance { parameters: p, solutions: full.solutions[..3].to_vec() };
    // Without loops the section stays as incomplete as the instance.
    let still = MonodromyOptions { loops: 0, ..Default::default() };
    let trace = trace_test(&system, &part, &still).unwrap();
    assert!(trace.curvature > 1e-4, "{trace:?}");
    // With loops the test finds what is missing.
    let trace = trace_test(&system, &part, &MonodromyOptions::default()).unwrap();
    assert!(trace.curvature < 1e-9 && trace.missing.len() == 1 && !trace.is_complete(1e-9));
}

#[test]
fn seeds_must_be_solutions() {
    let system = conics();
    let (mut x, p) = find_seed(&system, 1).unwrap();
    x[0] += c(0.1, 0.0);
    let error = monodromy(&system, &p, &[x], &MonodromyOptions::default()).unwrap_err();
    assert!(matches!(error, HomotopyError::NoSeed { .. }));
}

/// Case 3: 56 stressed and 6 stress-free solutions are two components; each seed fills its own.
#[test]
fn components_of_the_mechanism() {
    let mechanism = Mechanism::new([true, true]);
    let system = &mechanism.system;
    let p = vec![c(9.1, 4.3), c(8.2, -3.7)];
    let start = Start::Grouped(mechanism.grouping.clone());
    let all = solve(system, &p, &SolveOptions { start, ..Default::default() }).unwrap().solutions();
    let (free, stressed): (Vec<_>, Vec<_>) =
        all.into_iter().partition(|x| (x[4] * p[0] - 1.0).norm() < 1e-9 && (x[5] * p[1] - 1.0).norm() < 1e-9);
    assert_eq!((free.len(), stressed.len()), (6, 56));
    let options = MonodromyOptions::default();
    let count = |seeds: &[Vec<_>]| monodromy(system, &p, seeds, &options).unwrap().0;
    assert_eq!(count(&free[..1]).solutions.len(), 6);
    let instance = count(&[free[0].clone(), stressed[0].clone()]);
    assert_eq!(instance.solutions.len(), 62);
    let trace = trace_test(system, &instance, &options).unwrap();
    println!("case 3: section of {} points, curvature {:e}", trace.section, trace.curvature);
    assert!(trace.is_complete(1e-9), "{trace:?}");
}
