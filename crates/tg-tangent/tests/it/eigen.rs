//! Dense and sparse eigenpairs.

use tg_fixtures::spine;
use tg_model::Mechanics;
use tg_tangent::{Configuration, EigenOptions, Method, Metric, lowest};

#[test]
fn dense_and_sparse_agree() {
    let spine = spine(5, 8.0, 0.0).unwrap();
    let q = spine.model.initial_coordinates();
    let at = Configuration::at(&spine.model, &q, &spine.model.inputs_at(0.0)).unwrap();
    assert!(at.imbalance().0 < 1e-12, "{:?}", at.imbalance());
    for metric in [Metric::Mass, Metric::Coordinates] {
        let options = EigenOptions { method: Method::Dense, ..EigenOptions::new(10, metric) };
        let dense = lowest(&spine.model, &at, &options).unwrap();
        let sparse = lowest(&spine.model, &at, &EigenOptions { method: Method::Sparse, ..options }).unwrap();
        for (a, b) in dense.pairs.iter().zip(&sparse.pairs) {
            println!("{metric:?} {} {} {:.1e}", a.value, b.value, (a.value / b.value - 1.0).abs());
        }
        println!("{:?} {:?} {} {}", dense.counts, sparse.counts, dense.largest, sparse.largest);
        assert_eq!(dense.counts, sparse.counts);
    }
}

#[test]
fn a_thousand_bodies() {
    let spine = spine(1000, 8.0, 0.0).unwrap();
    let q = spine.model.initial_coordinates();
    let at = Configuration::at(&spine.model, &q, &spine.model.inputs_at(0.0)).unwrap();
    println!("{} {:?}", spine.model.free().len(), at.imbalance());
    let start = std::time::Instant::now();
    let sparse = lowest(&spine.model, &at, &EigenOptions::new(10, Metric::Mass)).unwrap();
    println!("{:?} {:?} {}", start.elapsed(), sparse.counts, sparse.largest);
    for p in &sparse.pairs {
        println!("{}", p.value);
    }
}
