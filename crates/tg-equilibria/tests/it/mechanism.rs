//! The planar compliant mechanism: counts known from homotopy in two public packages and from exact degrees.

use tg_equilibria::{EquilibriaOptions, EquilibriaReport, Family, all_equilibria};

use crate::support::{assert_complete, mechanism};

fn solve(free: [f64; 2]) -> EquilibriaReport {
    let model = mechanism(free);
    all_equilibria(&model, &model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap()
}

/// Two reports on the same structure hold the same solutions.
#[track_caller]
fn assert_same(a: &EquilibriaReport, b: &EquilibriaReport) {
    assert_eq!(a.certified, b.certified);
    assert_eq!(a.equilibria.len(), b.equilibria.len());
    for x in &a.equilibria {
        let apart = |y: &tg_equilibria::RealEquilibrium| {
            let pairs =
                x.configuration.q.iter().zip(&y.configuration.q).chain(x.lengths.iter().zip(&y.lengths));
            pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        };
        let nearest = b.equilibria.iter().map(apart).fold(f64::INFINITY, f64::min);
        assert!(nearest < 1e-10, "{nearest}");
    }
}

#[test]
fn counts() {
    for (free, paths, finite, real, physical, stable) in
        [([0.0, 0.0], 12, 6, 4, 4, 1), ([11.5, 0.0], 28, 20, 10, 6, 2), ([11.5, 11.5], 78, 62, 26, 15, 5)]
    {
        let report = solve(free);
        assert_complete(&report);
        assert!(report.paths <= paths, "{}", report.paths);
        assert_eq!((report.certified, report.equilibria.len()), (finite, real));
        assert_eq!((report.physical().count(), report.stable().count()), (physical, stable));
    }
    assert_eq!(solve([0.0, 0.0]).euler_characteristic, Some(0));
}

#[test]
fn a_family_answers_like_a_search_from_scratch() {
    let model = mechanism([11.5, 11.5]);
    let options = EquilibriaOptions::default();
    let family = Family::new(&model, &[11.5, 11.5], &options).unwrap();
    assert_eq!(family.generic_count(), 62);
    let stored = Family::with_instance(&model, &[11.5, 11.5], family.instance().clone(), &options).unwrap();
    for free in [[11.5, 11.5], [11.5, 11.5], [11.5, 11.5], [8.0, 12.0], [5.0, 5.0]] {
        let report = stored.query(&free).unwrap();
        assert_complete(&report);
        assert_same(&report, &solve(free));
    }
}

/// Springs at their free lengths and stressed ones are two components: 56 and 6.
#[test]
fn monodromy_and_traces_find_nothing_more() {
    for (free, orbits) in [([11.5, 0.0], vec![20]), ([11.5, 11.5], vec![56, 6])] {
        let model = mechanism(free);
        let family = Family::new(&model, &free, &EquilibriaOptions::default()).unwrap();
        let evidence = family.evidence().unwrap().unwrap();
        assert!(evidence.supports_completeness(), "{evidence:?}");
        assert_eq!(evidence.orbits, orbits);
    }
    let model = mechanism([0.0, 0.0]);
    assert!(
        Family::new(&model, &[0.0, 0.0], &EquilibriaOptions::default())
            .unwrap()
            .evidence()
            .unwrap()
            .is_none()
    );
}
