//! A sweep of L01 with L02 = 0 against the extended system of the two-angle model, solved in tg-cases.

use tg_equilibria::{Curve, EquilibriaOptions, Family};

use crate::support::mechanism;

/// L01 of the folds with d1 > 0 \[m\].
const FOLDS: [f64; 2] = [10.974371963459, 12.332081653844];

#[test]
fn folds_and_curves() {
    let model = mechanism([11.5, 0.0]);
    let family = Family::new(&model, &[11.5, 0.0], &EquilibriaOptions::default()).unwrap();
    let values: Vec<f64> = (1..=200).map(|k| 0.1 * f64::from(k)).collect();
    let sweep = family.sweep(&[11.5, 0.0], 0, &values).unwrap();
    // Three curves through, and three that a fold begins or ends: the stable one of them between both folds.
    let ends = |c: &Curve| [values[c.points[0].sample], values[c.points[c.points.len() - 1].sample]];
    let mut curves: Vec<_> =
        sweep.curves.iter().map(|c| (ends(c).map(|x| (10.0 * x).round()), c.negative)).collect();
    curves.sort_by(|a, b| a.partial_cmp(b).unwrap());
    let expected = [
        ([1.0, 123.0], 1),
        ([1.0, 200.0], 0),
        ([1.0, 200.0], 1),
        ([1.0, 200.0], 2),
        ([110.0, 123.0], 0),
        ([110.0, 200.0], 1),
    ];
    assert_eq!(curves, expected);
    assert!(sweep.curves.iter().all(|c| c.stable == (c.negative == 0)));
    let found: Vec<f64> = sweep.folds.iter().map(|fold| fold.value).collect();
    assert_eq!(found.len(), FOLDS.len());
    assert!(found.iter().zip(FOLDS).all(|(a, b)| (a - b).abs() < 1e-10), "{found:?}");
    for (value, report) in &sweep.samples {
        assert!(report.accounts_for_all(), "{value}: {report}");
        let on_curves =
            sweep.curves.iter().flat_map(|c| &c.points).filter(|p| values[p.sample] == *value).count();
        assert_eq!(on_curves, report.physical().count(), "{value}");
    }
}

/// With two free lengths there are folds close together, pitchforks where stress-free states appear in pairs, and cones
/// where spring 2 has no length.
#[test]
fn folds_pitchforks_and_cones() {
    let model = mechanism([11.5, 11.5]);
    let family = Family::new(&model, &[11.5, 11.5], &EquilibriaOptions::default()).unwrap();
    let values: Vec<f64> = (1..=80).map(|k| 0.25 * f64::from(k)).collect();
    let sweep = family.sweep(&[11.5, 11.5], 0, &values).unwrap();
    let count = |value: f64| family.query(&[value, 11.5]).unwrap().physical().count();
    assert!(sweep.folds.len() >= 5, "{:?}", sweep.folds);
    for fold in &sweep.folds {
        let [before, after] = [-1e-7, 1e-7].map(|by| count(fold.value + by));
        assert_eq!(before.abs_diff(after), 2, "{}", fold.value);
    }
    // Stress-free states begin and end where both free lengths just reach: in pairs, with a saddle between them.
    assert!(sweep.branch_points.len() >= 4, "{:?}", sweep.branch_points);
    for point in &sweep.branch_points {
        let [before, after] = [-1e-4, 1e-4].map(|by| count(point.value + by));
        assert!(before.abs_diff(after) % 2 == 0 && before != after, "{}: {before} {after}", point.value);
    }
    for end in &sweep.loose_ends {
        assert!(sweep.at(*end).lengths[1] < 0.1, "{:?}", sweep.at(*end).lengths);
    }
}
