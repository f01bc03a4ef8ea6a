//! Influence vectors, participation factors and effective masses.

use crate::support::{all_modes, as_built, equilibrium, mass_product, mast, relative};
use tg_fixtures::{prism, spine};
use tg_modal::{ModeOptions, SupportMotion, modes, participation};
use tg_model::{CableLaw, Joining, Mechanics, ModelBuilder};

/// All modes together carry vᵀ 𝓜⁻¹ v; on a spine nothing but massless pegs is attached to the ground.
#[test]
fn effective_masses_add_up() {
    let spine = spine(4, 8.0, 0.0).unwrap();
    let at = as_built(&spine.model);
    let found = all_modes(&spine.model, &at);
    for axis in 0..3 {
        let motion = SupportMotion::translation(&spine.model, &at, axis).unwrap();
        let parts = participation(&spine.model, &at, &found, &motion).unwrap();
        let sum: f64 = parts.list.iter().map(|part| part.effective_mass).sum();
        println!("{}: {sum} {} {}", motion.name, parts.total, parts.rigid_mass);
        assert!((sum / parts.total - 1.0).abs() < 1e-12);
        assert!((parts.rigid_mass / 1.2 - 1.0).abs() < 1e-12);
        assert!((parts.total / 1.2 - 1.0).abs() < 1e-12);
        assert!((parts.list.last().unwrap().cumulative - 1.0).abs() < 1e-12);
        assert!(parts.list.windows(2).all(|w| w[0].cumulative <= w[1].cumulative));
        for (mode, part) in found.list.iter().zip(&parts.list) {
            let exact = mass_product(&spine.model, &mode.shape, &motion.influence);
            assert!((part.factor - exact).abs() < 1e-13 && part.effective_mass == part.factor * part.factor);
        }
    }
    // A truncated list knows what it lacks.
    let motion = SupportMotion::translation(&spine.model, &at, 0).unwrap();
    let few = modes(&spine.model, &at, &ModeOptions::new(4)).unwrap();
    let parts = participation(&spine.model, &at, &few, &motion).unwrap();
    let carried: f64 = parts.list.iter().map(|part| part.effective_mass).sum();
    assert!((parts.list[3].cumulative - carried / parts.total).abs() < 1e-14 && carried < parts.total);
}

/// A rod hinged to the shaken ground: Γ = (mL/2)/√(mL²/3), effective mass 3m/4 of the rigid m.
#[test]
fn a_hinged_rod_carries_three_quarters_of_its_mass() {
    let mass = 1.6;
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let pivot = b.anchor("pivot", [0.0, 0.0]).unwrap();
    let bar = b.bar("bar", mass, [0.0, 0.0], [0.0, -0.7]).unwrap();
    b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share).unwrap();
    let model = b.build().unwrap();
    let at = as_built(&model);
    let found = all_modes(&model, &at);
    let motion = SupportMotion::translation(&model, &at, 0).unwrap();
    let parts = participation(&model, &at, &found, &motion).unwrap();
    assert!((parts.list[0].factor - (0.75 * mass).sqrt()).abs() < 1e-14);
    assert!((parts.total / (0.75 * mass) - 1.0).abs() < 1e-14);
    assert!((parts.rigid_mass / mass - 1.0).abs() < 1e-14);
    // Up and down it moves no rod that hangs.
    let vertical = SupportMotion::translation(&model, &at, 1).unwrap();
    let parts = participation(&model, &at, &found, &vertical).unwrap();
    assert!(parts.total.abs() < 1e-14 && parts.list[0].effective_mass < 1e-28);
}

/// A prism that slides on a plane: sideways its whole mass is in zero modes, upwards the ground carries it along.
#[test]
fn a_sliding_prism_has_its_whole_mass_in_zero_modes() {
    // A breath of weight puts the feet on the plane and leaves the prism in balance within the tolerance.
    let prism = prism(3, 20.0, 1e-9, CableLaw::slacking).unwrap();
    let at = as_built(&prism.model);
    let found = all_modes(&prism.model, &at);
    assert_eq!((found.counts.negative, found.counts.zero), (0, 3));
    let [sideways, upwards] = [0, 2].map(|axis| {
        let motion = SupportMotion::translation(&prism.model, &at, axis).unwrap();
        participation(&prism.model, &at, &found, &motion).unwrap()
    });
    assert!((sideways.total / 3.0 - 1.0).abs() < 1e-12 && (upwards.rigid_mass / 3.0 - 1.0).abs() < 1e-12);
    assert!((sideways.list[2].cumulative - 1.0).abs() < 1e-12);
    assert!(upwards.list[2].cumulative < 1e-12);
}

/// All pegs by the quasi-static response: the rigid translation, though nobody said so.
#[test]
fn equal_support_motions_are_rigid_translations() {
    let spine = spine(3, 8.0, 0.0).unwrap();
    let at = as_built(&spine.model);
    let mast = mast(2.0, 0.0);
    let leaning = equilibrium(&mast.model, &mast.model.initial_coordinates(), &mast.model.inputs_at(0.0));
    for axis in 0..3 {
        let rigid = SupportMotion::translation(&spine.model, &at, axis).unwrap();
        check(&spine.model, &at, &rigid);
    }
    for axis in 0..2 {
        let rigid = SupportMotion::translation(&mast.model, &leaning, axis).unwrap();
        check(&mast.model, &leaning, &rigid);
    }
}

fn check(mechanics: &dyn Mechanics, at: &tg_tangent::Configuration, rigid: &SupportMotion) {
    let prescribed = (0..at.q.len()).filter(|i| !mechanics.free().contains(i));
    let direction: Vec<_> = prescribed.map(|i| (i, rigid.influence[i])).collect();
    let response = SupportMotion::quasi_static(mechanics, at, "all", &direction).unwrap();
    let error = relative(&response.influence, &rigid.influence);
    println!("{}: {error:.1e}", rigid.name);
    assert!(error < 1e-9, "{error:.1e}");
}

/// One support moves: the response is the derivative of the nonlinear equilibrium.
#[test]
fn single_support_motions_move_the_equilibrium() {
    let mast = mast(0.0, 0.0);
    let model = &mast.model;
    let u = model.inputs_at(0.0);
    let at = equilibrium(model, &model.initial_coordinates(), &u);
    for support in mast.supports {
        for coordinate in [support, support + 1] {
            let motion = SupportMotion::quasi_static(model, &at, "support", &[(coordinate, 1.0)]).unwrap();
            let difference = |h: f64| -> Vec<f64> {
                let [plus, minus] = [h, -h].map(|h| {
                    let mut q = at.q.clone();
                    q[coordinate] += h;
                    equilibrium(model, &q, &u).q
                });
                plus.iter().zip(&minus).map(|(p, m)| (p - m) / (2.0 * h)).collect()
            };
            let (coarse, fine) = (difference(2e-3), difference(1e-3));
            let moved: Vec<f64> = coarse.iter().zip(&fine).map(|(c, f)| (4.0 * f - c) / 3.0).collect();
            let error = relative(&motion.influence, &moved);
            println!("coordinate {coordinate}: {error:.1e}");
            assert!(error < 1e-8, "{error:.1e}");
        }
    }
}
