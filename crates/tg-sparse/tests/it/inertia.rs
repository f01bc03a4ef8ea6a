//! Inertia of the reduced block against systems whose signs are known by construction.

use crate::support::Random;
use tg_sparse::{Inertia, SaddlePattern, SaddleSystem};

/// x ← (I - 2 v vᵀ / vᵀv) x.
fn reflect(v: &[f64], x: &mut [f64]) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let share = 2.0 * dot(v, x) / dot(v, v);
    x.iter_mut().zip(v).for_each(|(x, v)| *x -= share * v);
}

/// A dense system of n unknowns and m constraints: A = [R 0] Q with R triangular, and the block of H on the null space of
/// A congruent to diag(signs). Q is a product of reflections.
fn system(n: usize, m: usize, signs: &[f64], r: &mut Random) -> SaddleSystem {
    let free = n - m;
    let lower: Vec<Vec<f64>> = (0..free)
        .map(|i| {
            (0..free)
                .map(|j| {
                    if i == j {
                        1.0
                    } else if j < i {
                        r.value()
                    } else {
                        0.0
                    }
                })
                .collect()
        })
        .collect();
    let mut h = vec![vec![0.0; n]; n];
    for i in 0..n {
        for j in 0..=i {
            h[i][j] = r.value();
            h[j][i] = h[i][j];
        }
    }
    for i in 0..free {
        for j in 0..free {
            h[m + i][m + j] = (0..free).map(|k| lower[i][k] * signs[k] * lower[j][k]).sum();
        }
    }
    let mut a = vec![vec![0.0; n]; m];
    for (i, row) in a.iter_mut().enumerate() {
        row[..i].iter_mut().for_each(|x| *x = r.value());
        row[i] = 1.0 + r.value().abs();
    }
    for _ in 0..3 {
        let v = r.vector(n);
        a.iter_mut().for_each(|row| reflect(&v, row));
        h.iter_mut().for_each(|row| reflect(&v, row));
        for column in 0..n {
            let mut x: Vec<f64> = h.iter().map(|row| row[column]).collect();
            reflect(&v, &mut x);
            h.iter_mut().zip(x).for_each(|(row, x)| row[column] = x);
        }
    }
    let leading: Vec<_> = (0..n).flat_map(|i| (0..n).map(move |j| Some((i, j)))).collect();
    let jacobian: Vec<_> = (0..m).flat_map(|i| (0..n).map(move |j| Some((i, j)))).collect();
    let mut system = SaddleSystem::new(SaddlePattern::new(n, m, &[&leading], &jacobian).unwrap());
    system.add_leading(0, 1.0, &h.concat());
    let a = a.concat();
    system.set_jacobian(&a, &a);
    system
}

#[test]
fn signs_of_the_reduced_block_are_counted() {
    let r = &mut Random::new(5);
    for (n, m) in [(4, 0), (6, 2), (12, 5), (20, 19)] {
        for negative in 0..=n - m {
            let signs: Vec<f64> =
                (0..n - m).map(|k| if k < negative { -1.0 } else { 1.0 } * (0.5 + r.value().abs())).collect();
            let mut system = system(n, m, &signs, r);
            assert_eq!(system.inertia(), None, "not factored yet");
            system.factor().unwrap();
            let expected = Inertia { negative, positive: n - m - negative };
            assert_eq!(system.inertia(), Some(expected), "n = {n}, m = {m}");
        }
    }
}

#[test]
fn values_that_changed_have_no_inertia() {
    let mut system = system(6, 2, &[1.0, -1.0, 2.0, 3.0], &mut Random::new(9));
    system.factor().unwrap();
    assert_eq!(system.inertia(), Some(Inertia { negative: 1, positive: 3 }));
    system.clear_leading();
    assert_eq!(system.inertia(), None);
}
