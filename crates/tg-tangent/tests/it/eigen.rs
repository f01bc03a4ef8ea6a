//! Dense and sparse eigenpairs against each other and against a beam.

use approx::assert_relative_eq;
use tg_fixtures::{mast, prism, spine};
use tg_model::{CableLaw, Mechanics, Model, ModelBuilder};
use tg_tangent::{Configuration, Counts, EigenOptions, Method, Metric, Sign, Spectrum, Tangent, lowest};

fn at(model: &Model<3>) -> Configuration {
    Configuration::at(model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap()
}

fn spectrum(model: &Model<3>, metric: Metric, method: Method) -> Spectrum {
    lowest(model, &at(model), &EigenOptions { method, ..EigenOptions::new(12, metric) }).unwrap()
}

#[test]
fn dense_and_sparse_agree() {
    let models = [
        spine(5, 8.0, 0.0).unwrap().model,
        prism(6, 10.0, 0.0, CableLaw::slacking).unwrap().model,
        prism(6, -10.0, 0.0, CableLaw::linear).unwrap().model,
    ];
    for model in models {
        for metric in [Metric::Mass, Metric::Coordinates] {
            let (dense, sparse) =
                (spectrum(&model, metric, Method::Dense), spectrum(&model, metric, Method::Sparse));
            assert_eq!(dense.counts, sparse.counts);
            assert_eq!((dense.pairs.len(), sparse.pairs.len()), (12, 12));
            for (a, b) in dense.pairs.iter().zip(&sparse.pairs) {
                assert_eq!(a.sign, b.sign);
                assert!((a.value - b.value).abs() <= a.accuracy + b.accuracy, "{} {}", a.value, b.value);
            }
        }
    }
}

/// K x - ν M x is a constraint force, A x = 0, xᵀ M x = 1.
#[test]
fn pairs_satisfy_their_equations() {
    let model = spine(8, 8.0, 0.0).unwrap().model;
    let tangent_at = at(&model);
    let tangent = Tangent::new(&model, &tangent_at);
    for method in [Method::Dense, Method::Sparse] {
        let found = spectrum(&model, Metric::Mass, method);
        for pair in &found.pairs {
            let x: Vec<f64> = model.free().iter().map(|&i| pair.shape[i]).collect();
            let (mut r, mut mx) = (vec![0.0; x.len()], vec![0.0; x.len()]);
            tangent.stiffness.add_product(1.0, &x, &mut r);
            tangent.mass.add_product(1.0, &x, &mut mx);
            assert_relative_eq!(
                x.iter().zip(&mx).map(|(a, b)| a * b).sum::<f64>(),
                1.0,
                max_relative = 1e-11
            );
            r.iter_mut().zip(&mx).for_each(|(r, m)| *r -= pair.value * m);
            let (_, residual) = tg_tangent::balance(&model, &tangent_at.q, &r).unwrap();
            let size = r.iter().fold(0.0_f64, |a, r| a.max(r.abs()));
            assert!(residual.iter().all(|r| r.abs() < 1e-7 * size.max(1e-3)), "{method:?} {}", pair.value);
            let mut rate = vec![0.0; model.sizes().constraints];
            tangent.jacobian.add_product(1.0, &x, &mut rate);
            assert!(rate.iter().all(|rate| rate.abs() < 1e-10), "{method:?}");
        }
    }
}

/// Six zeros, and pairs of equal eigenvalues by the symmetry of sixty bars.
#[test]
fn dense_and_sparse_agree_on_a_large_free_body() {
    for law in [CableLaw::slacking, CableLaw::linear] {
        let model = prism(60, 10.0, 0.0, law).unwrap().model;
        let (dense, sparse) =
            (spectrum(&model, Metric::Mass, Method::Dense), spectrum(&model, Metric::Mass, Method::Sparse));
        assert_eq!(sparse.method, Method::Sparse);
        assert_eq!(dense.counts, sparse.counts);
        for (a, b) in dense.pairs.iter().zip(&sparse.pairs) {
            assert!((a.value - b.value).abs() <= 1e-9 * b.value.abs() + a.accuracy + b.accuracy);
        }
    }
}

#[test]
fn dense_and_sparse_agree_on_a_mast() {
    for stages in [8, 32] {
        let model = mast(stages).unwrap().model;
        let (dense, sparse) =
            (spectrum(&model, Metric::Mass, Method::Dense), spectrum(&model, Metric::Mass, Method::Sparse));
        assert_eq!(dense.counts, sparse.counts);
        for (a, b) in dense.pairs.iter().zip(&sparse.pairs) {
            assert_relative_eq!(a.value, b.value, max_relative = 1e-11);
        }
    }
}

/// Behind the eighth mode dozens lie within 1e-3 of each other; the tenth and the eleventh differ by 5e-6.
#[test]
fn a_cluster_far_from_zero_is_resolved() {
    let model = mast(128).unwrap().model;
    let tangent_at = at(&model);
    let tangent = Tangent::new(&model, &tangent_at);
    let found = lowest(&model, &tangent_at, &EigenOptions::new(10, Metric::Mass)).unwrap();
    assert_eq!(found.counts, Counts { negative: 0, zero: 0, positive: 768 });
    let free = |x: &[f64]| model.free().iter().map(|&i| x[i]).collect::<Vec<_>>();
    let shapes: Vec<_> = found.pairs.iter().map(|pair| free(&pair.shape)).collect();
    for (pair, x) in found.pairs.iter().zip(&shapes) {
        let (mut r, mut mx) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        tangent.stiffness.add_product(1.0, x, &mut r);
        tangent.mass.add_product(1.0, x, &mut mx);
        let products = shapes.iter().map(|y| y.iter().zip(&mx).map(|(a, b)| a * b).sum::<f64>());
        let off = products.zip(&shapes).filter(|(_, y)| *y != x).fold(0.0_f64, |a, (p, _)| a.max(p.abs()));
        assert!(off < 1e-7, "{off:e}");
        let size = pair.value * mx.iter().fold(0.0_f64, |a, m| a.max(m.abs()));
        r.iter_mut().zip(&mx).for_each(|(r, m)| *r -= pair.value * m);
        let (_, residual) = tg_tangent::balance(&model, &tangent_at.q, &r).unwrap();
        let worst = residual.iter().fold(0.0_f64, |a, r| a.max(r.abs())) / size;
        assert!(worst < 1e-7, "{worst:e}");
    }
}

#[test]
fn a_free_body_of_cables_has_six_zeros() {
    let model = prism(4, 10.0, 0.0, CableLaw::slacking).unwrap().model;
    for method in [Method::Dense, Method::Sparse] {
        let found = spectrum(&model, Metric::Mass, method);
        assert_eq!(found.counts, Counts { negative: 0, zero: 6, positive: 14 });
        assert!(found.pairs[..6].iter().all(|pair| pair.sign == Sign::Zero));
        let zeros = found.pairs[..6].iter().map(|pair| pair.value.abs() / found.largest);
        assert!(zeros.fold(0.0, f64::max) < 1e-14);
    }
}

/// A spine of a thousand vertebrae bends like a slender cantilever: pairs of equal frequencies, and
/// ω_n²/ω_1² = (β_n/β_1)⁴ with the roots of cos β cosh β = -1.
#[test]
fn a_thousand_bodies_bend_like_a_beam() {
    let model = spine(1000, 8.0, 0.0).unwrap().model;
    assert_eq!(model.free().len(), 12_000);
    let found = lowest(&model, &at(&model), &EigenOptions::new(10, Metric::Mass)).unwrap();
    assert_eq!(found.method, Method::Sparse);
    assert_eq!(found.counts, Counts { negative: 0, zero: 0, positive: 6000 });
    let roots: [f64; 3] = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613];
    for (pair, root) in found.pairs.chunks_exact(2).zip(roots) {
        assert!((pair[0].value - pair[1].value).abs() < pair[0].accuracy);
        let ratio = pair[0].value / found.pairs[0].value;
        assert_relative_eq!(ratio, (root / roots[0]).powi(4), max_relative = 3e-3);
    }
}

#[test]
fn nothing_asked_is_counted_all_the_same() {
    let model = spine(3, 8.0, 0.0).unwrap().model;
    for method in [Method::Dense, Method::Sparse] {
        let options = EigenOptions { method, ..EigenOptions::new(0, Metric::Mass) };
        let found = lowest(&model, &at(&model), &options).unwrap();
        assert!(found.pairs.is_empty());
        assert_eq!(found.counts, Counts { negative: 0, zero: 0, positive: 18 });
        let all = EigenOptions { method, ..EigenOptions::new(100, Metric::Mass) };
        assert_eq!(lowest(&model, &at(&model), &all).unwrap().pairs.len(), 18);
    }
}

/// Two masses on a line with stiffnesses 1 and `ratio`: ω² are the roots of x² - (1 + 2 ratio) x + ratio.
#[test]
fn stiff_motions_beside_soft_ones() {
    for ratio in [1e-12, 1e-6, 1.0, 1e6, 1e12] {
        let mut b = ModelBuilder::<2>::new();
        let wall = b.anchor("wall", [0.0, 0.0]).unwrap();
        let near = b.particle("near", 1.0, [1.0, 0.0]).unwrap();
        let far = b.particle("far", 1.0, [2.0, 0.0]).unwrap();
        for (name, mass) in [("near", near), ("far", far)] {
            b.support(name, mass.node(0), 1, 0.0).unwrap();
        }
        b.cable("first", wall, near.node(0), CableLaw::linear(1.0), 1.0).unwrap();
        b.cable("second", near.node(0), far.node(0), CableLaw::linear(ratio), 1.0).unwrap();
        let model = b.build().unwrap();
        let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap();
        let larger = 0.5 + ratio + 0.5_f64.hypot(ratio);
        for method in [Method::Dense, Method::Sparse] {
            let options = EigenOptions { method, ..EigenOptions::new(2, Metric::Mass) };
            let found = lowest(&model, &at, &options).unwrap();
            for (pair, exact) in found.pairs.iter().zip([ratio / larger, larger]) {
                let off = (pair.value - exact).abs();
                assert!(off <= pair.accuracy, "{method:?}, {ratio:.0e}: {off:.1e} of {exact:.1e}");
            }
            assert_eq!(found.pairs.len(), 2);
        }
    }
}

/// One pair of six zeros: a shift just behind it lies among the others, where no factorisation tells the inertia.
#[test]
fn fewer_pairs_than_zeros() {
    for bars in [3, 6, 9, 12] {
        let model = prism(bars, 10.0, 0.0, CableLaw::slacking).unwrap().model;
        for metric in [Metric::Mass, Metric::Coordinates] {
            for count in [1, 4, 6, 7] {
                let options = EigenOptions { method: Method::Sparse, ..EigenOptions::new(count, metric) };
                let found = lowest(&model, &at(&model), &options).unwrap();
                assert_eq!((found.pairs.len(), found.counts.zero, found.counts.negative), (count, 6, 0));
                let zeros = found.pairs.iter().filter(|pair| pair.sign == Sign::Zero).count();
                assert_eq!(zeros, count.min(6), "{bars} bars, {metric:?}, {count}");
            }
        }
    }
}
