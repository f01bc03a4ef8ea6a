//! Projections of positions and velocities: nearest in the mass metric, idempotent, named where they fail.

use crate::support::mixed::{Plane, Space, Spatial, mixed};
use crate::support::{Random, all, build, jacobian, mass, pick, seeds, select, violation};
use approx::assert_relative_eq;
use nalgebra::{DMatrix, DVector};
use tg_model::Joining::{Constrain, Share};
use tg_model::{Mechanics, Projector, Signal};

/// A state of a random structure that satisfies the constraints, supports at a time.
fn consistent<S: Space<D>, const D: usize>(seed: u64, check: impl Fn(&dyn Mechanics, Vec<f64>, &mut Random)) {
    let mixed = mixed::<S, D>(seed, true);
    let m = mixed.model.mechanics();
    let mut q = mixed.model.initial_coordinates();
    let mut v = vec![0.0; q.len()];
    m.prescribe(0.1, &mut q, &mut v);
    let moved = Projector::new(m).unwrap().position(&mut q).unwrap();
    assert!(moved.residual < 1e-13 && violation(m, &q) < 1e-13);
    check(m, q, &mut Random::new(seed + 500));
}

fn each(check: impl Fn(&dyn Mechanics, Vec<f64>, &mut Random)) {
    for seed in 0..seeds(5) {
        consistent::<Plane, 2>(seed, &check);
        consistent::<Spatial, 3>(seed, &check);
    }
}

/// `[M -Aᵀ; A 0]⁻¹ [f; g]` on the free coordinates, dense.
fn dense_solve(
    m: &dyn Mechanics,
    q: &[f64],
    f: &DVector<f64>,
    g: &DVector<f64>,
) -> (DVector<f64>, DVector<f64>) {
    let free = m.free();
    let (n, c) = (free.len(), m.sizes().constraints);
    let (mass, a) = (select(&mass(m), free, free), select(&jacobian(m, q), &all(c), free));
    let mut k = DMatrix::zeros(n + c, n + c);
    k.view_mut((0, 0), (n, n)).copy_from(&mass);
    k.view_mut((0, n), (n, c)).copy_from(&-a.transpose());
    k.view_mut((n, 0), (c, n)).copy_from(&a);
    let mut rhs = DVector::zeros(n + c);
    rhs.rows_mut(0, n).copy_from(f);
    rhs.rows_mut(n, c).copy_from(g);
    let x = k.full_piv_lu().solve(&rhs).unwrap();
    (x.rows(0, n).into_owned(), x.rows(n, c).into_owned())
}

fn product(matrix: &DMatrix<f64>, x: &[f64]) -> DVector<f64> {
    matrix * DVector::from_column_slice(x)
}

/// Part of `x` outside the range of Aᵀ (free columns).
fn outside_range(m: &dyn Mechanics, q: &[f64], x: &DVector<f64>) -> f64 {
    let a = select(&jacobian(m, q), &all(m.sizes().constraints), m.free());
    let nu = (&a * a.transpose()).full_piv_lu().solve(&(&a * x)).unwrap();
    (x - a.transpose() * nu).amax()
}

#[test]
fn velocities_satisfy_the_rate_of_the_constraints_and_move_least() {
    each(|m, q, r| {
        let mut projector = Projector::new(m).unwrap();
        let (mut prescribed, mut v) = (q.clone(), r.vector(q.len(), 1.0));
        m.prescribe(0.1, &mut prescribed, &mut v);
        let start = v.clone();
        let moved = projector.velocity(&q, &mut v).unwrap();
        assert!(product(&jacobian(m, &q), &v).amax() < 1e-12 && moved.residual < 1e-12);
        let change: Vec<f64> = v.iter().zip(&start).map(|(v, s)| v - s).collect();
        assert!(all(q.len()).into_iter().all(|i| m.free().contains(&i) || change[i] == 0.0));
        let largest = change.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert_relative_eq!(moved.largest, largest, epsilon = 1e-13);
        assert_eq!(change[moved.coordinate].abs(), largest);
        assert!(largest > 0.05);

        let momentum = pick(product(&mass(m), &change).as_slice(), m.free());
        assert!(outside_range(m, &q, &momentum) < 1e-12 && momentum.amax() > 1e-2);
        let again = projector.velocity(&q, &mut v).unwrap();
        assert!(again.largest < 1e-12, "idempotent");
        // The unconstrained change against dense algebra.
        let rate = product(&jacobian(m, &q), &start);
        let (expected, _) = dense_solve(m, &q, &DVector::zeros(m.free().len()), &-rate);
        assert!((pick(&change, m.free()) - expected).amax() < 1e-11);
    });
}

#[test]
fn velocity_after_an_impulse() {
    each(|m, q, r| {
        let mut projector = Projector::new(m).unwrap();
        let (mut prescribed, mut v) = (q.clone(), r.vector(q.len(), 1.0));
        m.prescribe(0.1, &mut prescribed, &mut v);
        let p = DVector::from_vec(r.vector(m.free().len(), 2.0));
        // An impulse that brings M q̇ to p, up to what the constraints add.
        let bring = |v: &[f64], p: &DVector<f64>| p - pick(product(&mass(m), v).as_slice(), m.free());
        let impulse = bring(&v, &p);
        let fill = |impulse: &DVector<f64>, rhs: &mut [f64]| {
            rhs[..impulse.len()].copy_from_slice(impulse.as_slice());
        };
        projector.velocity_after_impulse(&q, |_, rhs| fill(&impulse, rhs), &mut v).unwrap();
        assert!(product(&jacobian(m, &q), &v).amax() < 1e-12);
        let momentum = pick(product(&mass(m), &v).as_slice(), m.free());
        assert!(outside_range(m, &q, &(p - momentum)) < 1e-11);
        // The momentum of an admissible velocity gives that velocity back, whatever the guess.
        let momentum = pick(product(&mass(m), &v).as_slice(), m.free());
        let mut found = v.clone();
        for &i in m.free() {
            found[i] = r.value();
        }
        let impulse = bring(&found, &momentum);
        projector.velocity_after_impulse(&q, |_, rhs| fill(&impulse, rhs), &mut found).unwrap();
        for (found, v) in found.iter().zip(&v) {
            assert_relative_eq!(*found, *v, epsilon = 1e-11);
        }
    });
}

#[test]
fn accelerations_and_multipliers_against_dense_algebra() {
    each(|m, q, r| {
        let n = q.len();
        let (force, rates) = (r.vector(n, 5.0), r.vector(m.sizes().constraints, 3.0));
        let mut a = r.vector(n, 1.0);
        let mut prescribed = a.clone();
        for &i in m.free() {
            prescribed[i] = 0.0;
        }
        let mut lambda = vec![0.0; rates.len()];
        Projector::new(m).unwrap().acceleration(&q, &force, &rates, &mut a, &mut lambda).unwrap();
        // M_ff a_f - A_fᵀ λ = F_f - M_fp a_p,  A_f a_f = -rates - A_p a_p.
        let f = pick(&force, m.free()) - pick(product(&mass(m), &prescribed).as_slice(), m.free());
        let g = -DVector::from_vec(rates) - product(&jacobian(m, &q), &prescribed);
        let (expected, multipliers) = dense_solve(m, &q, &f, &g);
        let size = expected.amax().max(multipliers.amax()).max(1.0);
        assert!((pick(&a, m.free()) - expected).amax() < 1e-11 * size);
        assert!((DVector::from_vec(lambda) - multipliers).amax() < 1e-11 * size);
        for i in all(n).into_iter().filter(|i| !m.free().contains(i)) {
            assert_eq!(a[i], prescribed[i]);
        }
    });
}

/// A horizontal rod released at rest falls with 3g/2 at its tip and rests on its hinge with a quarter of its weight.
#[test]
fn acceleration_of_a_released_rod() {
    let mut bar = None;
    let model = build::<2>(|b| {
        b.gravity([0.0, -9.81])?;
        let (peg, rod) = (b.anchor("peg", [0.0, 0.0])?, b.bar("rod", 2.0, [0.0, 0.0], [0.5, 0.0])?);
        bar = Some(rod);
        b.joint("hinge", &[peg.into(), rod.node(0)], Constrain)
    });
    let model = model.unwrap();
    let (q, v) = (model.initial_coordinates(), model.velocities_at_rest());
    let force = crate::support::force(&model, tg_model::At { q: &q, v: &v, u: &[], taut: None });
    let (mut a, mut lambda) = (vec![0.0; q.len()], vec![0.0; 3]);
    Projector::new(&model).unwrap().acceleration(&q, &force, &[0.0; 3], &mut a, &mut lambda).unwrap();
    let tip = model.form(bar.unwrap().node(1)).unwrap().eval(&a);
    assert_relative_eq!(tip.x, 0.0, epsilon = 1e-12);
    assert_relative_eq!(tip.y, -1.5 * 9.81, max_relative = 1e-12);
    // Multipliers of the hinge, the rows after the rod's rigidity, act on the rod.
    assert_relative_eq!(lambda[1], 0.0, epsilon = 1e-12);
    assert_relative_eq!(lambda[2], 2.0 * 9.81 / 4.0, max_relative = 1e-12);
}

#[test]
fn moving_supports_are_part_of_the_rate() {
    let mut tip = None;
    let model = build::<2>(|b| {
        let bar = b.bar("bar", 1.0, [0.0, 0.0], [1.0, 0.0])?;
        b.shake("quake", bar.node(0), Signal::sine(0.5 / std::f64::consts::TAU, 1.0))?;
        tip = Some(bar.node(1));
        Ok(())
    });
    let model = model.unwrap();
    let mut v = model.velocities_at_rest();
    let q = model.initial_coordinates();
    Projector::new(&model).unwrap().velocity(&q, &mut v).unwrap();
    let tip = model.form(tip.unwrap()).unwrap().eval(&v);
    assert_relative_eq!(tip, nalgebra::Vector2::new(0.5, 0.0), epsilon = 1e-14);
}

#[test]
fn velocities_without_constraints_stay() {
    let model = build::<3>(|b| b.particle("ball", 1.0, [0.0; 3]).map(drop)).unwrap();
    let mut projector = Projector::new(&model).unwrap();
    let (mut q, mut v) = (vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]);
    assert_eq!(projector.position(&mut q).unwrap().largest, 0.0);
    assert_eq!(projector.velocity(&q, &mut v).unwrap().largest, 0.0);
    assert_eq!((q, v), (vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 6.0]));
    let joined = build::<2>(|b| {
        let bars = [b.bar("a", 1.0, [0.0, 0.0], [1.0, 0.0])?, b.bar("b", 1.0, [1.0, 0.0], [1.0, 1.0])?];
        b.joint("knee", &[bars[0].node(1), bars[1].node(0)], Share)
    });
    assert_eq!(Projector::new(&joined.unwrap()).unwrap().fallbacks(), 0);
}

/// Two bars of length one and mass one between pegs, their hinge `height` above the line: nothing can move, and an impulse on
/// the hinge is carried by ν along the bars, 2 x (ν_1 - ν_2) = -m v_x and 2 h (ν_1 + ν_2) = -m v_y with m = 2/3 kg.
/// The equations for ν have the condition h⁻²: what one solve leaves is refined, down to the rounding of the rates.
#[test]
fn a_structure_that_cannot_move_takes_every_velocity_as_an_impulse() {
    for height in [0.5_f64, 1e-3, 1e-4, 1e-6] {
        let x = (1.0 - height * height).sqrt();
        let model = build::<2>(|b| {
            let pegs = [b.anchor("A", [-x, 0.0])?, b.anchor("B", [x, 0.0])?];
            let bar = |b: &mut tg_model::ModelBuilder<2>, name, from| b.bar(name, 1.0, from, [0.0, height]);
            let bars = [bar(b, "left", [-x, 0.0])?, bar(b, "right", [x, 0.0])?];
            b.joint("foot A", &[pegs[0].into(), bars[0].node(0)], Share)?;
            b.joint("foot B", &[pegs[1].into(), bars[1].node(0)], Share)?;
            b.joint("knee", &[bars[0].node(1), bars[1].node(1)], Share)
        });
        let model = model.unwrap();
        let q = model.initial_coordinates();
        let start = [0.3, -0.7];
        let mut v = vec![0.0; q.len()];
        for (&i, start) in model.free().iter().zip(start) {
            v[i] = start;
        }
        let mut projector = Projector::new(&model).unwrap();
        let moved = projector.velocity(&q, &mut v).unwrap();
        let left = product(&jacobian(&model, &q), &v).amax();
        assert!((moved.residual - left).abs() < 1e-20 && left < 1e-14, "{height:e}: {moved:?} {left:e}");
        assert!(v.iter().all(|v| v.abs() < 1e-14 / height), "{height:e}: {v:?}");
        let (difference, sum) = (-start[0] / (3.0 * x), -start[1] / (3.0 * height));
        let expected = [0.5 * (sum + difference), 0.5 * (sum - difference)];
        for (found, expected) in projector.multipliers().iter().zip(expected) {
            assert_relative_eq!(*found, expected, max_relative = 1e-14 / height);
        }
    }
}
