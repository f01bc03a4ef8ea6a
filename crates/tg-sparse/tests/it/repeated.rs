//! Repeated use: no allocation, the same bits, large systems.

use crate::support::lattice::{Bars, lattice};
use crate::support::{Problem, Random, chain, largest};

#[test]
fn no_allocation_after_creation() {
    let mut doubtful = chain(6, 3, true, 3);
    // Two constraints of the first body at a small angle: the probe and the refinement run as well.
    for at in 0..doubtful.jacobian.len() {
        if let Some((0, i)) = doubtful.jacobian[at] {
            doubtful.jacobian.push(Some((doubtful.m, i)));
            doubtful.upper.push(doubtful.upper[at] + 3e-5 * (at as f64 + 1.0).cos());
            doubtful.lower.push(doubtful.lower[at] + 3e-5 * (at as f64 + 1.0).cos());
        }
    }
    doubtful.m += 1;
    for problem in [chain(6, 3, true, 3), lattice(&[5, 4, 3], Bars::Axes, 1), doubtful] {
        let mut system = problem.system();
        let rhs = Random::new(1).vector(problem.n + problem.m);
        let mut x = rhs.clone();
        let mut product = rhs.clone();
        let counted = allocation_counter::measure(|| {
            for _ in 0..3 {
                problem.fill(&mut system);
                system.factor().unwrap();
                x.copy_from_slice(&rhs);
                system.solve(&mut x).unwrap();
                system.multiply(&x, &mut product);
            }
        });
        assert_eq!(counted.count_total, 0);
        assert!(largest(product.iter().zip(&rhs).map(|(a, b)| a - b)) < 1e-9 * largest(x.iter().copied()));
    }
}

fn solve(problem: &Problem) -> Vec<f64> {
    let mut system = problem.system();
    let mut x = Random::new(1).vector(problem.n + problem.m);
    system.factor().unwrap();
    system.solve(&mut x).unwrap();
    x
}

#[test]
fn same_bits_every_time() {
    for problem in [chain(9, 3, true, 3), lattice(&[4, 4, 3], Bars::Axes, 2)] {
        let first = solve(&problem);
        assert_eq!(first, solve(&problem));
        // A system that solved something else before gives the same.
        let mut used = problem.system();
        used.add_leading(0, 3.0, &problem.leading[0].2);
        used.factor().unwrap();
        used.solve(&mut vec![1.0; first.len()]).unwrap();
        problem.fill(&mut used);
        used.factor().unwrap();
        let mut x = Random::new(1).vector(problem.n + problem.m);
        used.solve(&mut x).unwrap();
        assert_eq!(first, x);
    }
}

#[test]
fn a_chain_of_ten_thousand() {
    for closed in [false, true] {
        let problem = chain(556, 3, closed, 7);
        assert_eq!(problem.n + problem.m, 10_008);
        let mut system = problem.system();
        system.factor().unwrap();
        let rhs = Random::new(3).vector(10_008);
        let mut x = rhs.clone();
        let report = system.solve(&mut x).unwrap();
        assert!(report.residual < 1e-13 && !report.fell_back);
        let mut product = vec![0.0; x.len()];
        system.multiply(&x, &mut product);
        let residual = largest(product.iter().zip(&rhs).map(|(a, b)| a - b)) / largest(x);
        assert!(residual < 1e-13, "{residual:e}");
        // Fill stays proportional to the chain's length.
        assert!(system.pattern().factor_entries() < 120 * 10_008);
    }
}

#[test]
fn a_large_lattice() {
    let problem = lattice(&[9, 9, 9], Bars::Axes, 1);
    let mut system = problem.system();
    system.factor().unwrap();
    let mut x = Random::new(3).vector(problem.n + problem.m);
    let report = system.solve(&mut x).unwrap();
    assert!(report.residual < 1e-12 && !report.fell_back, "{report:?}");
}

#[test]
fn threads_share_patterns_and_own_systems() {
    fn shared<T: Send + Sync>() {}
    fn owned<T: Send>() {}
    shared::<tg_sparse::SaddlePattern>();
    owned::<tg_sparse::SaddleSystem>();
}
