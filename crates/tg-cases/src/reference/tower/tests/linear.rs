//! One pose at a time: figure, forces, inertia, and the small oscillations about the upright tower.

use super::*;
use std::array::from_fn;

/// Upright, the points are those of Fig. 10 and the auxiliary cables measure 0.1 √5.
#[test]
fn upright_tower_is_the_papers_figure() {
    let tower = Tower::paper(Setup::Un);
    let start = tower.start();
    #[rustfmt::skip]
    let table = [
        [0.0, 0.0], [0.1, 0.0], [-0.1, 0.0], [0.2, 0.0], [0.0, 0.1], [0.1, 0.1], [0.05, 0.15],
        [0.0, 0.2], [0.1, 0.2], [0.05, 0.25], [0.0, 0.3], [0.1, 0.3], [0.05, 0.35],
    ];
    for (p, q) in tower.points(0.0, &start).iter().zip(table) {
        assert!((p[0] - q[0]).abs() < 1e-16 && (p[1] - q[1]).abs() < 1e-16, "{p:?} {q:?}");
    }
    let thirds = [[0.0, 0.05], [0.1, 0.05], [0.05, 0.35 / 3.0], [0.05, 0.2], [0.05, 0.65 / 3.0], [0.05, 0.3]];
    for (p, q) in tower.mass_centres(0.0, &start).iter().zip(thirds.iter().chain(&[[0.05, 0.95 / 3.0]])) {
        assert!((p[0] - q[0]).abs() < 1e-16 && (p[1] - q[1]).abs() < 1e-15, "{p:?} {q:?}");
    }
    let (l, mu) = (tower.cable_lengths(0.0, &start), tower.rest_lengths());
    let (aux, diagonal, half) = (0.05_f64.sqrt(), 0.02_f64.sqrt(), 0.005_f64.sqrt());
    let lengths = [aux, aux, diagonal, diagonal, 0.1, 0.1, half, half, 0.1, 0.1, half, half];
    for j in 0..CABLES {
        assert!((l[j] - lengths[j]).abs() < 1e-16);
        assert!((mu[j] / lengths[j] - if j < 2 { 0.998 } else { 0.95 }).abs() < 1e-15);
    }
}

fn weightless(alpha: f64, beta: f64) -> Tower {
    Tower { gravity: 0.0, alpha, beta, ..still(Setup::Un) }
}

#[test]
fn small_oscillations_have_the_reference_frequencies() {
    // Framework reference values, 50 to 70 digit modal model [Hz].
    let table = [
        (
            0.9,
            0.9,
            [1.7371005292722144, 2.754061681064904, 5.80177267111918, 17.948435227452013, 25.68777545837293],
        ),
        (
            0.845,
            0.845,
            [0.233763396396822, 1.90940107519818, 5.08454569414947, 18.4582800282254, 26.5332160021312],
        ),
        (
            0.999,
            0.999,
            [1.96813607357342, 3.62010447823185, 7.17483969292167, 16.9792377463325, 24.1478066757069],
        ),
        (
            0.95,
            0.998,
            [
                1.9166284729168914,
                3.5319012971847257,
                7.0356651700849255,
                17.339243507704843,
                24.159552874987597,
            ],
        ),
    ];
    for (alpha, beta, expected) in table {
        let tower = weightless(alpha, beta);
        let k = tower.stiffness();
        assert!((k - k.transpose()).norm() < 1e-11 * k.norm());
        let start = TowerState::default();
        let at_rest =
            Mechanics::new(&tower).force(0.0, &start, &Rotations::new(&start.theta), &[true; CABLES]);
        assert!(at_rest.iter().all(|q| q.abs() < 1e-14), "not an equilibrium");
        let squares = tower.modes().unwrap().map(|mode| mode.omega_squared);
        for (square, f) in squares.iter().zip(expected) {
            // Differences leave an absolute error in the squares; near loss of stability the lowest one is small.
            let found = square / std::f64::consts::TAU.powi(2);
            assert!((found - f * f).abs() < 1e-11 * (1.0 + f * f), "{alpha} {f} {}", found.sqrt());
        }
    }
}

#[test]
fn stability_is_lost_at_the_critical_ratio() {
    let det = |ratio: f64| weightless(ratio, ratio).stiffness().determinant();
    let (mut lo, mut hi) = (0.84, 0.85);
    assert!(det(lo) < 0.0 && det(hi) > 0.0);
    for _ in 0..40 {
        let mid = 0.5 * (lo + hi);
        if det(mid) < 0.0 { lo = mid } else { hi = mid }
    }
    // Framework reference value, and the cubic that it solves.
    assert!((hi - 0.844559346936171).abs() < 1e-12, "{hi}");
    let x = 1.0 - hi;
    assert!((293.0 * x.powi(3) - 180.0 * x * x - 37.0 * x + 9.0).abs() < 1e-10);
}

/// M is the Hessian of the kinetic energy, and the velocity terms are Christoffel's symbols of M:
/// Q(ω) - Q(0) = -Σ_bc (∂M_ab/∂θ_c - ½ ∂M_bc/∂θ_a) ω_b ω_c.
#[test]
fn inertia_obeys_lagranges_equations() {
    let tower = still(Setup::Un);
    let mechanics = Mechanics::new(&tower);
    let s = some_state();
    let rest = TowerState { omega: [0.0; ANGLES], ..s };
    let r = Rotations::new(&s.theta);
    let m = mechanics.mass_matrix(&r);
    let kinetic: f64 = (0..25).map(|i| 0.5 * m[i / 5][i % 5] * s.omega[i / 5] * s.omega[i % 5]).sum();
    assert!((tower.energy(0.0, &s) - tower.energy(0.0, &rest) - kinetic).abs() < 1e-15);

    let d = 1e-4;
    let slope: [_; ANGLES] = from_fn(|c| {
        let at = |d: f64| {
            let mut theta = s.theta;
            theta[c] += d;
            Square::from(mechanics.mass_matrix(&Rotations::new(&theta))).transpose()
        };
        (at(d) - at(-d)) / (2.0 * d)
    });
    let pulls = [true; CABLES];
    let (q, q0) = (mechanics.force(0.0, &s, &r, &pulls), mechanics.force(0.0, &rest, &r, &pulls));
    for a in 0..ANGLES {
        let mut christoffel = 0.0;
        for b in 0..ANGLES {
            for c in 0..ANGLES {
                christoffel += (slope[c][(a, b)] - 0.5 * slope[a][(b, c)]) * s.omega[b] * s.omega[c];
            }
        }
        assert!((q[a] - q0[a] + christoffel).abs() < 1e-10, "{a} {} {christoffel}", q[a] - q0[a]);
    }
}

#[test]
fn forces_at_rest_are_the_slope_of_the_energy() {
    let s = TowerState { omega: [0.0; ANGLES], ..some_state() };
    for setup in [Setup::Un, Setup::Us] {
        let tower = still(setup);
        let mechanics = Mechanics::new(&tower);
        let pulls = tower.slack(0.0, &s).map(|slack| !slack || !tower.slacking);
        assert_eq!(pulls.contains(&false), tower.slacking);
        let q = mechanics.force(0.0, &s, &Rotations::new(&s.theta), &pulls);
        for a in 0..ANGLES {
            let at = |d: f64| {
                let mut moved = s;
                moved.theta[a] += d;
                tower.energy(0.0, &moved)
            };
            let d = 1e-4;
            let slope = (8.0 * (at(d) - at(-d)) - (at(2.0 * d) - at(-2.0 * d))) / (12.0 * d);
            assert!((q[a] + slope).abs() < 1e-10, "{setup:?} {a} {} {slope}", q[a]);
        }
    }
}
