//! Benchmark systems with known numbers of solutions.

use crate::support::{cyclic, katsura, noon};
use tg_homotopy::{
    CertificationReport, CertifyOptions, Conjugation, PolynomialSystem, SolveOptions, SolveReport, certify,
    solve,
};

fn solved(system: &PolynomialSystem, seed: u64) -> (SolveReport, CertificationReport) {
    let report = solve(system, &[], &SolveOptions { seed, ..Default::default() }).unwrap();
    assert_eq!(report.failures().count(), 0);
    let options = CertifyOptions { conjugation: Some(Conjugation::plain(system)), ..Default::default() };
    let proved = certify(system, &[], &report.solutions(), &options).unwrap();
    assert!(proved.rejections.is_empty() && proved.largest_radius() < 1e-10, "{:?}", proved.rejections);
    (report, proved)
}

#[test]
fn katsura_has_two_to_the_n() {
    for n in 4..=6 {
        for seed in 1..=3 {
            assert_eq!(solved(&katsura(n), seed).1.count(), 1 << n, "katsura-{n}, seed {seed}");
        }
    }
}

#[test]
fn cyclic_five_has_seventy() {
    for seed in 1..=3 {
        let (report, proved) = solved(&cyclic(5), seed);
        assert_eq!((report.paths.len(), proved.count(), proved.real()), (120, 70, 10));
        assert_eq!(report.at_infinity(), 50);
    }
}

#[test]
fn noon_three_has_twenty_one() {
    for seed in 1..=3 {
        assert_eq!(solved(&noon(3), seed).1.count(), 21);
    }
}

#[test]
fn results_depend_on_the_seed_only() {
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| solve(&katsura(5), &[], &SolveOptions::default()).unwrap().solutions())
    };
    assert_eq!(run(1), run(2));
}
