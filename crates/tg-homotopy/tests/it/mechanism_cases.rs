//! The planar compliant mechanism: all equilibria of its three cases, proved.

use std::time::Instant;

use crate::support::c;
use crate::support::mechanism::{Mechanism, Position, energy, lowest_curvature, turn};
use tg_homotopy::{
    CertificationReport, CertifyOptions, Complex64, GenericInstance, Grouping, ParameterSolver, PathOptions,
    Realness, SolveOptions, Start, certify, solve,
};

struct Case {
    proved: CertificationReport,
    positions: Vec<Position>,
    free: [f64; 2],
}

fn parameters(lengths: [bool; 2], free: [f64; 2]) -> Vec<Complex64> {
    (0..2).filter(|&s| lengths[s]).map(|s| c(free[s], 0.0)).collect()
}

fn proved(mechanism: &Mechanism, p: &[Complex64], points: &[Vec<Complex64>]) -> CertificationReport {
    let options = CertifyOptions { conjugation: Some(mechanism.conjugation.clone()), ..Default::default() };
    certify(&mechanism.system, p, points, &options).unwrap()
}

fn case(lengths: [bool; 2], free: [f64; 2], paths: usize) -> Case {
    let mechanism = Mechanism::new(lengths);
    let p = parameters(lengths, free);
    let start = Start::Grouped(mechanism.grouping.clone());
    let report = solve(&mechanism.system, &p, &SolveOptions { start, ..Default::default() }).unwrap();
    assert_eq!((report.paths.len(), report.failures().count(), report.singular().len()), (paths, 0, 0));
    assert_eq!(report.solutions().len() + report.at_infinity(), paths);
    let proved = proved(&mechanism, &p, &report.solutions());
    assert!(proved.rejections.is_empty() && proved.largest_radius() < 1e-10);
    assert_eq!(proved.with(Realness::Undecided), 0);
    let real = proved.certificates.iter().filter(|x| x.realness == Realness::Real);
    let positions = real.map(|x| mechanism.position(&x.solution)).collect();
    Case { proved, positions, free }
}

impl Case {
    /// The real solution at these angles, to `digits` degrees.
    fn at(&self, gamma: [f64; 2], digits: f64) -> Position {
        let near = |p: &&Position| (0..2).all(|j| turn(p.gamma[j], gamma[j]).abs() <= digits);
        let found: Vec<_> = self.positions.iter().filter(near).collect();
        assert_eq!(found.len(), 1, "{gamma:?} in {:?}", self.positions);
        *found[0]
    }

    /// Lowest eigenvalue of the Hessian at a position.
    fn curvature(&self, p: &Position) -> f64 {
        lowest_curvature(p.gamma, p.d.map(f64::signum), self.free)
    }

    /// Stable ones among those whose springs have positive length.
    fn stable(&self) -> Vec<Position> {
        let physical = self.positions.iter().filter(|p| p.d[0] > 0.0 && p.d[1] > 0.0);
        physical.filter(|p| self.curvature(p) > 0.0).copied().collect()
    }
}

#[test]
fn case_1_without_free_lengths() {
    let case = case([false, false], [0.0, 0.0], 6);
    assert_eq!((case.proved.count(), case.proved.real()), (6, 4));
    let stable = case.at([75.042_445_326_18, 289.011_978_563_78], 1e-10);
    assert!((energy(stable.d, case.free) - 46.345_143_042).abs() < 1e-8);
    case.at([275.799_953_392_88, 329.432_312_078_44], 1e-10);
    case.at([252.465_828_724_25, 123.204_770_288_38], 1e-10);
    case.at([92.913_202_93, 124.280_297_235], 1e-8);
    assert_eq!(case.stable().len(), 1);
    assert!(turn(case.stable()[0].gamma[0], stable.gamma[0]).abs() < 1e-9);
}

#[test]
fn case_2_with_one_free_length() {
    let case = case([true, false], [11.5, 0.0], 24);
    assert_eq!((case.proved.count(), case.proved.real()), (20, 10));
    assert_eq!(case.positions.iter().filter(|p| p.d[0] > 0.0).count(), 6);
    assert_eq!(case.stable().len(), 2);
    let bent = case.at([109.313_322_081_42, -113.241_117_475_52], 1e-10);
    assert!((bent.d[0] - 9.087_154_080_87).abs() < 1e-10 && case.curvature(&bent) > 0.0);
    let other = case.at([120.800_143_231_65, 41.307_604_228_04], 1e-10);
    assert!((other.d[0] - 11.498_821_045_97).abs() < 1e-10 && case.curvature(&other) > 0.0);
}

#[test]
fn case_3_with_two_free_lengths() {
    let clock = Instant::now();
    let case = case([true, true], [11.5, 11.5], 78);
    println!("case 3 from scratch with certificates: {:?}", clock.elapsed());
    assert_eq!((case.proved.count(), case.proved.real()), (62, 26));
    let signed =
        |a: f64, b: f64| case.positions.iter().filter(|p| p.d[0] * a > 0.0 && p.d[1] * b > 0.0).count();
    assert_eq!([signed(1.0, 1.0), signed(1.0, -1.0), signed(-1.0, 1.0), signed(-1.0, -1.0)], [15, 3, 4, 4]);
    let stable = case.stable();
    let unstressed = |p: &&Position| (p.d[0] - 11.5).abs() < 1e-12 && (p.d[1] - 11.5).abs() < 1e-12;
    assert_eq!((stable.len(), stable.iter().filter(unstressed).count()), (5, 4));
    let stressed = case.at([-98.545_742_214_43, 158.830_180_680_91], 1e-10);
    assert!((energy(stressed.d, case.free) - 0.360_363_9).abs() < 1e-7 && case.curvature(&stressed) > 0.0);
    let worst = case.proved.certificates.iter().map(|p| p.condition).fold(0.0, f64::max);
    println!("largest radius {:e}, largest condition {worst:e}", case.proved.largest_radius());
}

#[test]
fn every_seed_finds_all() {
    let mechanism = Mechanism::new([true, true]);
    let p = parameters([true, true], [11.5, 11.5]);
    for seed in 2..=8 {
        let start = Start::Grouped(mechanism.grouping.clone());
        let report =
            solve(&mechanism.system, &p, &SolveOptions { start, seed, ..Default::default() }).unwrap();
        let proved = proved(&mechanism, &p, &report.solutions());
        assert_eq!((proved.count(), proved.real(), report.failures().count()), (62, 26, 0), "seed {seed}");
        assert!(proved.rejections.is_empty());
    }
}

#[test]
fn the_best_grouping_needs_78_paths() {
    let mechanism = Mechanism::new([true, true]);
    let choices = vec![
        Grouping::single(6),
        Grouping::new(6, &[&[0, 1, 2, 3], &[4, 5]]).unwrap(),
        Grouping::new(6, &[&[0, 2], &[1, 3], &[4], &[5]]).unwrap(),
        mechanism.grouping.clone(),
    ];
    let counts: Vec<u64> = choices.iter().map(|g| g.bezout(&mechanism.system).unwrap()).collect();
    println!("paths: {counts:?}");
    assert_eq!(Grouping::best(&mechanism.system, &choices).unwrap(), (mechanism.grouping, 78));
}

#[test]
fn queries_from_a_generic_instance() {
    let mechanism = Mechanism::new([true, true]);
    let parameters = vec![c(9.1, 4.3), c(8.2, -3.7)];
    let start = Start::Grouped(mechanism.grouping.clone());
    let options = SolveOptions { start, ..Default::default() };
    let solutions = solve(&mechanism.system, &parameters, &options).unwrap().solutions();
    assert_eq!(solutions.len(), 62);
    let instance = GenericInstance { parameters, solutions };
    for grouping in [None, Some(mechanism.grouping.clone())] {
        let solver =
            ParameterSolver::new(&mechanism.system, instance.clone(), grouping, PathOptions::default())
                .unwrap();
        for (free, real) in [([11.5, 11.5], Some(26)), ([7.0, 9.0], None), ([3.0, 14.0], None)] {
            let p = vec![c(free[0], 0.0), c(free[1], 0.0)];
            let clock = Instant::now();
            let report = solver.query(&p).unwrap();
            let time = clock.elapsed();
            let proved = proved(&mechanism, &p, &report.solutions());
            println!("query {free:?}: {} of which {} real, {time:?}", proved.count(), proved.real());
            assert_eq!((proved.count(), report.failures().count()), (62, 0));
            assert!(real.is_none_or(|r| r == proved.real()));
        }
    }
}
