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
        assert!(report.is_complete(), "{value}: {report}");
        let on_curves =
            sweep.curves.iter().flat_map(|c| &c.points).filter(|p| values[p.sample] == *value).count();
        assert_eq!(on_curves, report.physical().count(), "{value}");
    }
}
