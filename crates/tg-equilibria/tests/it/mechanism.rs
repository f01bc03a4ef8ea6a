//! The compliant mechanism of Rhodes, Tanouye and Vikas: a bar, a body, two springs.

use nalgebra::Vector2;
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_equilibria::{EquilibriaOptions, EquilibriaReport, Family, all_equilibria};
use tg_model::{CableLaw, Joining, Model, ModelBuilder};

/// Table 1 with free lengths L01 and L02.
fn mechanism(free: [f64; 2]) -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    let fixed = [[0.0, 0.0], [3.19, 0.0], [-2.55, 4.93]];
    let fixed: Vec<_> =
        fixed.iter().enumerate().map(|(k, &p)| b.anchor(&format!("{}", k + 1), p).unwrap()).collect();
    let bar = b.bar("bar 1-4", 1.0, [0.0, 0.0], [9.0, 0.0]).unwrap();
    let nodes = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Vector2::from);
    let mass = MassProperties::from_polar_moment(1.0, Vector2::zeros(), 1.0).unwrap();
    let body = Member::new(CoordType::Ruv, &nodes, mass).unwrap();
    let body = b.member("body", body, Pose::planar(9.0, 0.0, 0.0)).unwrap();
    b.joint("1", &[fixed[0].into(), bar.node(0)], Joining::Share).unwrap();
    b.joint("4", &[bar.node(1), body.node(0)], Joining::Share).unwrap();
    let law = || CableLaw::linear(2.81);
    b.cable("2-6", fixed[1], body.at([4.25, 0.0]), law(), free[0]).unwrap();
    b.cable("3-5", fixed[2], body.at([-0.3, -3.45]), law(), free[1]).unwrap();
    b.build().unwrap()
}

fn solve(free: [f64; 2]) -> EquilibriaReport {
    let model = mechanism(free);
    let start = std::time::Instant::now();
    let report = all_equilibria(&model, &model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap();
    println!(
        "{free:?}: paths {} finite {} singular {} infinity {} failed {} certified {} real {} physical {} stable {} index {} radius {:.1e} {:?}",
        report.paths,
        report.finite,
        report.singular.len(),
        report.at_infinity,
        report.failed,
        report.certified,
        report.equilibria.len(),
        report.physical().count(),
        report.stable().count(),
        report.index_sum(),
        report.largest_radius,
        start.elapsed()
    );
    report
}

#[test]
fn counts() {
    for (free, finite, real, physical, stable) in
        [([0.0, 0.0], 6, 4, 4, 1), ([11.5, 0.0], 20, 10, 6, 2), ([11.5, 11.5], 62, 26, 15, 5)]
    {
        let report = solve(free);
        assert_eq!(report.certified, finite);
        assert_eq!(report.equilibria.len(), real);
        assert_eq!(report.physical().count(), physical);
        assert_eq!(report.stable().count(), stable);
    }
}

#[test]
fn a_family_answers_like_a_search_from_scratch() {
    let model = mechanism([11.5, 11.5]);
    let start = std::time::Instant::now();
    let family = Family::new(&model, &model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap();
    println!("generic {} {:?}", family.generic_count(), start.elapsed());
    for free in [[11.5, 11.5], [8.0, 12.0], [5.0, 5.0]] {
        let start = std::time::Instant::now();
        let report = family.query(&free).unwrap();
        println!("{free:?} {} {} {:?}", report.certified, report.equilibria.len(), start.elapsed());
    }
}
