//! Mass matrix and Jacobian as operators, and the numbering of unknowns, against dense algebra.

use crate::support::mixed::{Plane, Spatial, mixed};
use crate::support::{Random, all, assert_close, jacobian, scatter, seeds};
use nalgebra::{DMatrix, DVector};
use tg_model::{Entry, Inertia, Jacobian, Layout, Mechanics};

fn each(check: impl Fn(&dyn Mechanics, &mut Random)) {
    for seed in 0..seeds(4) {
        check(mixed::<Plane, 2>(seed, true).model.mechanics(), &mut Random::new(seed + 60));
        check(mixed::<Spatial, 3>(seed, true).model.mechanics(), &mut Random::new(seed + 70));
    }
}

fn column(x: Vec<f64>) -> DMatrix<f64> {
    DMatrix::from_vec(x.len(), 1, x)
}

/// Product, rows and energy of the operator on `n` coordinates are those of the entries.
fn check_inertia(n: usize, entries: &[Entry], r: &mut Random, what: &str) {
    let (pattern, values): (Vec<_>, Vec<_>) = entries.iter().map(|e| ((e.row, e.col), e.value)).unzip();
    let inertia = Inertia::new(n, entries);
    let x = r.vector(n, 1.0);
    let expected = scatter(n, n, &pattern, &values) * column(x.clone());
    let mut product = vec![f64::NAN; n];
    inertia.product(&x, &mut product);
    assert_close(&column(product), &expected, 1e-14, what);
    let rows = all(n).into_iter().map(|i| inertia.row(i, &x)).collect();
    assert_close(&column(rows), &expected, 1e-14, what);
    let energy = 0.5 * DVector::from_vec(x.clone()).dot(&expected.column(0));
    assert!((inertia.kinetic_energy(&x) - energy).abs() < 1e-13, "{what}");
}

#[test]
fn the_mass_matrix_as_an_operator_is_the_dense_one() {
    each(|m, r| check_inertia(m.sizes().coordinates, m.mass(), r, "M"));
}

/// What is nearly a scalar pattern ⊗ I_d must not be taken for one.
#[test]
fn a_matrix_that_is_no_product_with_the_identity_is_taken_as_it_is() {
    let r = &mut Random::new(5);
    for d in [2, 3] {
        let n = 3 * d;
        let scalar = [(0, 0, 2.0), (0, 1, 0.5), (1, 0, 0.5), (1, 1, 3.0), (2, 2, 1.0)];
        let product: Vec<Entry> = scalar
            .into_iter()
            .flat_map(|(a, b, value)| (0..d).map(move |k| Entry { row: a * d + k, col: b * d + k, value }))
            .collect();
        check_inertia(n, &product, r, "a product");
        check_inertia(n + 1, &product, r, "with a coordinate without mass");
        check_inertia(n, &product.iter().rev().copied().collect::<Vec<_>>(), r, "in another order");
        let without = |gone: &dyn Fn(&Entry) -> bool| -> Vec<Entry> {
            product.iter().copied().filter(|e| !gone(e)).collect()
        };
        check_inertia(n, &without(&|e| e.row / d == 1), r, "with an empty row");
        check_inertia(n, &without(&|e| e.row == 1), r, "with an empty row of one component");
        check_inertia(n, &without(&|e| e.row == n - 1), r, "with an empty last row");
        check_inertia(n, &without(&|e| e.row == 1 && e.col == d + 1), r, "with an entry less");
        for row in [0, 1, d] {
            let more = Entry { row, col: n - 1, value: 0.7 };
            check_inertia(n, &[product.as_slice(), &[more]].concat(), r, "with an entry more");
        }
        for k in 0..product.len() {
            let mut other = product.clone();
            other[k].value += 1.0;
            check_inertia(n, &other, r, "with another value");
            other = product.clone();
            other[k].col = if other[k].col == n - 1 { 0 } else { n - 1 };
            check_inertia(n, &other, r, "with another column");
        }
        let moved = |by: usize| -> Vec<Entry> {
            product.iter().map(|e| Entry { row: e.row + by, col: e.col + by, ..*e }).collect()
        };
        check_inertia(n + d, &moved(1), r, "off by a component");
        check_inertia(n + d, &moved(d), r, "off by a node");
        // Blocks whose columns, or whose rows, begin between nodes.
        let between = |row: usize, col: usize| -> Vec<Entry> {
            (0..d).map(|k| Entry { row: row + k, col: col + k, value: 5.0 }).collect()
        };
        check_inertia(2 * d, &between(0, 1), r, "columns between nodes");
        check_inertia(2 * d, &between(1, d), r, "rows between nodes");
        let different: Vec<Entry> = (0..n).map(|i| Entry { row: i, col: i, value: 1.0 + i as f64 }).collect();
        check_inertia(n, &different, r, "a diagonal of different values");
    }
    check_inertia(4, &[], r, "no mass");
}

#[test]
fn the_jacobian_as_an_operator_is_the_dense_one() {
    each(|m, r| {
        let n = m.sizes().coordinates;
        let (q, x, y) = (r.vector(n, 1.0), r.vector(n, 1.0), r.vector(m.sizes().constraints, 1.0));
        let mut values = vec![0.0; m.jacobian_pattern().len()];
        m.jacobian(&q, &mut values);
        let (operator, dense) = (Jacobian::new(m), jacobian(m, &q));
        let (mut product, mut transposed) = (vec![f64::NAN; y.len()], vec![f64::NAN; n]);
        let largest = operator.product(&values, &x, &mut product);
        operator.transposed(&values, &y, &mut transposed);
        assert_close(&column(product), &(&dense * column(x.clone())), 1e-13, "A x");
        assert_close(&column(transposed), &(dense.transpose() * column(y)), 1e-13, "Aᵀ y");
        // The rows of these structures each are one run of entries.
        let mut sizes = vec![0.0; m.sizes().constraints];
        for (&(row, i), a) in m.jacobian_pattern().iter().zip(&values) {
            sizes[row] += (a * x[i]).abs();
        }
        let expected = sizes.into_iter().fold(0.0, f64::max);
        assert!((largest / expected - 1.0).abs() < 1e-14, "{largest} {expected}");
    });
}

#[test]
fn unknowns_number_the_free_coordinates_in_runs() {
    each(|m, _| {
        let layout = Layout::new(m);
        assert_eq!(layout.unknowns(), m.free().len());
        for i in 0..m.sizes().coordinates {
            assert_eq!(layout.unknown(i), m.free().iter().position(|&free| free == i));
        }
        let runs = layout.runs();
        let numbered =
            runs.iter().flat_map(|run| (0..run.len).map(|k| (run.unknown + k, run.coordinate + k)));
        assert!(numbered.eq(m.free().iter().copied().enumerate()));
        // As long as can be: a prescribed coordinate between each two.
        assert!(runs.windows(2).all(|pair| pair[0].coordinate + pair[0].len < pair[1].coordinate));
        assert!(runs.len() > 1);
    });
}
