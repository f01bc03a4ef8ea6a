//! Damped modes.

use std::f64::consts::TAU;

use crate::support::{all_modes, as_built, equilibrium, mast, oscillator};
use tg_fixtures::{prism, spine};
use tg_modal::{DampedKind, DampedMode, ModeOptions, damped, modes};
use tg_model::{CableLaw, Joining, Mechanics, Model, ModelBuilder};
use tg_tangent::faer::{Mat, c64};
use tg_tangent::{Tangent, dense};

fn of_structure<const D: usize>(model: &Model<D>) -> Vec<DampedMode> {
    let at = as_built(model);
    damped(model, &at, &all_modes(model, &at)).unwrap()
}

/// m s² + 2η s + 2κ = 0 along the cables; no damping across them.
#[test]
fn closed_forms_of_one_mass() {
    let (mass, stiffness, tension) = (0.5, 40.0, 3.0);
    for damping in [0.0, 0.3, 2.0, 4.4, 4.6, 30.0] {
        let mut b = ModelBuilder::<2>::new();
        let law = CableLaw::slacking(stiffness).with_damping(damping);
        oscillator(&mut b, "bead", [0.0, 0.0], mass, &law, tension);
        let found = of_structure(&b.build().unwrap());
        let (decay, omega_squared) = (damping / mass, 2.0 * stiffness / mass);
        let across: f64 = 2.0 * tension / mass;
        let root = decay * decay - omega_squared;
        let mut exact = vec![c64::new(0.0, across.sqrt())];
        if root < 0.0 {
            exact.push(c64::new(-decay, (-root).sqrt()));
        } else {
            exact.extend([
                c64::new(-omega_squared / (decay + root.sqrt()), 0.0),
                c64::new(-decay - root.sqrt(), 0.0),
            ]);
        }
        exact.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        assert_eq!(found.len(), exact.len(), "{damping}");
        for (mode, s) in found.iter().zip(&exact) {
            let error = (mode.eigenvalue - s).norm() / s.norm();
            println!("η = {damping}: {} error {error:.1e} residual {:.1e}", mode.eigenvalue, mode.residual);
            assert!(error < 1e-12);
            assert!((mode.frequency - s.norm() / TAU).abs() < 1e-12 * s.norm());
            assert!((mode.damped_frequency - s.im / TAU).abs() < 1e-12 * s.norm());
            assert!((mode.damping_ratio + s.re / s.norm()).abs() < 1e-12);
            let kind = if s.im > 0.0 { DampedKind::Oscillating } else { DampedKind::Overdamped };
            assert_eq!(mode.kind, kind);
        }
    }
}

#[test]
fn without_damping_they_are_the_undamped_ones() {
    let spine = spine(5, 8.0, 0.0).unwrap();
    let at = as_built(&spine.model);
    let undamped = all_modes(&spine.model, &at);
    let found = damped(&spine.model, &at, &undamped).unwrap();
    assert_eq!(found.len(), undamped.list.len());
    for (a, b) in found.iter().zip(&undamped.list) {
        let error = (a.eigenvalue.im / b.omega_squared.sqrt() - 1.0).abs();
        assert!(error < 1e-12 && a.eigenvalue.re.abs() < 1e-12 * a.eigenvalue.im, "{a:?}");
        assert_eq!(a.kind, DampedKind::Oscillating);
        assert!(a.residual < 1e-14, "{:.1e}", a.residual);
    }
}

/// J s² + η L² s + k = 0 with k < 0: one growing and one decaying real mode.
#[test]
fn an_unstable_mast() {
    let (mass, length, stiffness, damping) = (2.0, 1.5, 2.0, 1.0);
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let foot = b.anchor("foot", [0.0, 0.0]).unwrap();
    let bar = b.bar("mast", mass, [0.0, 0.0], [0.0, length]).unwrap();
    b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share).unwrap();
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, [x, length]).unwrap();
        let law = CableLaw::slacking(stiffness).with_damping(damping);
        b.cable(name, peg, bar.node(1), law, 0.5).unwrap();
    }
    let found = of_structure(&b.build().unwrap());
    let inertia = mass * length * length / 3.0;
    let c = 2.0 * damping * length * length / inertia;
    let k = (2.0 * stiffness * length * length - mass * 9.81 * length / 2.0) / inertia;
    let root = (c * c / 4.0 - k).sqrt();
    assert!(k < 0.0);
    let [growth, decay] = [&found[0], &found[1]];
    assert!((growth.eigenvalue.re / (root - c / 2.0) - 1.0).abs() < 1e-12);
    assert!((decay.eigenvalue.re / (-root - c / 2.0) - 1.0).abs() < 1e-12);
    assert_eq!((growth.kind, decay.kind), (DampedKind::Unstable, DampedKind::Overdamped));
    assert_eq!(found.len(), 2);
}

/// Six rigid motions are twelve zeros, damped or not.
#[test]
fn a_free_structure_keeps_its_rigid_motions() {
    for law in [CableLaw::slacking as fn(f64) -> CableLaw, |k| CableLaw::slacking(k).with_damping(3.0)] {
        let prism = prism(3, 20.0, 0.0, law).unwrap();
        let found = of_structure(&prism.model);
        let zero = found.iter().filter(|mode| mode.kind == DampedKind::Zero).count();
        let largest_zero = found.iter().filter(|m| m.kind == DampedKind::Zero).map(|m| m.eigenvalue.norm());
        println!("{zero} zeros up to {:.1e}", largest_zero.fold(0.0, f64::max));
        assert_eq!(zero, 12);
        let eigenvalues: usize = found.iter().map(|mode| if mode.eigenvalue.im > 0.0 { 2 } else { 1 }).sum();
        assert_eq!(eigenvalues, 30);
        assert!(found.iter().all(|mode| mode.kind != DampedKind::Unstable));
    }
}

/// (s² M + s C + K) φ lies in the range of Aᵀ: checked on full coordinates, not on modes.
#[test]
fn shapes_satisfy_the_equations_of_the_whole_structure() {
    let spine = spine(3, 8.0, 2.0).unwrap();
    let mast = mast(4.0, 0.0);
    let at = equilibrium(&mast.model, &mast.model.initial_coordinates(), &mast.model.inputs_at(0.0));
    let structures: [(&dyn Mechanics, _); 2] = [(&spine.model, as_built(&spine.model)), (&mast.model, at)];
    for (mechanics, at) in structures {
        let undamped = modes(mechanics, &at, &ModeOptions::all()).unwrap();
        let found = damped(mechanics, &at, &undamped).unwrap();
        let tangent = Tangent::new(mechanics, &at);
        let [k, c, m, a] =
            [&tangent.stiffness, &tangent.damping, &tangent.mass, &tangent.jacobian].map(|x| x.dense());
        // Projector onto the null space of A, by the pseudo-inverse.
        let svd = dense::svd(&a).unwrap();
        let null = svd.right.subcols(a.nrows(), a.ncols() - a.nrows());
        for mode in &found {
            let s = mode.eigenvalue;
            let free = |part: fn(&c64) -> f64| -> Mat<f64> {
                Mat::from_fn(a.ncols(), 1, |i, _| part(&mode.shape[mechanics.free()[i]]))
            };
            let (x, y) = (free(|z| z.re), free(|z| z.im));
            let s2 = s * s;
            let times = |z: &Mat<f64>| (&m * z, &c * z, &k * z);
            let ((mx, cx, kx), (my, cy, ky)) = (times(&x), times(&y));
            let re = null.transpose() * (&kx + &mx * s2.re - &my * s2.im + &cx * s.re - &cy * s.im);
            let im = null.transpose() * (&ky + &my * s2.re + &mx * s2.im + &cy * s.re + &cx * s.im);
            let size = (k.norm_l2() + s.norm() * c.norm_l2() + s.norm_sqr() * m.norm_l2())
                * (x.norm_l2() + y.norm_l2());
            let residual = (re.norm_l2() + im.norm_l2()) / size;
            let open = (&a * &x).norm_l2() + (&a * &y).norm_l2();
            assert!(residual < 1e-14, "{s}: {residual:.1e}");
            assert!(open < 1e-13 * a.norm_l2() * (x.norm_l2() + y.norm_l2()));
            let norm: c64 =
                mechanics.mass().iter().map(|e| mode.shape[e.row].conj() * e.value * mode.shape[e.col]).sum();
            assert!((norm.re - 1.0).abs() < 1e-12);
        }
        assert!(found.windows(2).all(|w| w[0].eigenvalue.norm() <= w[1].eigenvalue.norm()));
    }
}
