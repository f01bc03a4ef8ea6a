//! A structure with 12 000 coordinates.

use crate::support::{as_built, mass_product, relative};
use tg_fixtures::spine;
use tg_modal::{ModeKind, ModeOptions, SupportMotion, modes, participation};
use tg_model::Mechanics;
use tg_tangent::Method;

/// A slender spine bends like a cantilever: ω ~ β², β = 1.8751, 4.6941 (first two roots of cos β cosh β = -1), in pairs.
#[test]
fn ten_modes_of_a_thousand_bodies() {
    let spine = spine(1000, 8.0, 0.0).unwrap();
    assert_eq!(spine.model.free().len(), 12_000);
    let at = as_built(&spine.model);
    let found = modes(&spine.model, &at, &ModeOptions::new(10)).unwrap();
    assert_eq!(found.method, Method::Sparse);
    assert_eq!((found.list.len(), found.degrees_of_freedom()), (10, 6000));
    assert_eq!((found.counts.negative, found.counts.zero), (0, 0));
    let values: Vec<f64> = found.list.iter().map(|mode| mode.omega_squared).collect();
    println!("{values:?} accuracy {:.1e} largest {:.3e}", found.list[0].accuracy, found.largest);
    for mode in &found.list {
        assert!(matches!(mode.kind, ModeKind::Vibration { .. }));
        assert!((mass_product(&spine.model, &mode.shape, &mode.shape) - 1.0).abs() < 1e-9);
    }
    let ratio = values[0] / values[2];
    let slender = (1.8751_f64 / 4.6941).powi(4);
    println!("pair {:.1e} ratio {ratio:.6} of {slender:.6}", values[1] - values[0]);
    // What remains is 1.6e-4: shear, and the masses' own moments of inertia.
    assert!((ratio / slender - 1.0).abs() < 5e-4);
    // A slender cantilever's first bending modes carry 61.31 %, 18.83 %, 6.47 %, 3.31 % and 2.00 % of its mass.
    let motion = SupportMotion::translation(&spine.model, &at, 0).unwrap();
    let parts = participation(&spine.model, &at, &found, &motion).unwrap();
    assert!((parts.total / 300.0 - 1.0).abs() < 1e-9 && (parts.rigid_mass / 300.0 - 1.0).abs() < 1e-12);
    for (pair, share) in parts.list.chunks(2).zip([0.6131, 0.1883, 0.0647, 0.0331, 0.0200]) {
        let carried = (pair[0].effective_mass + pair[1].effective_mass) / parts.total;
        println!("carried {carried:.5} of {share}");
        assert!((carried - share).abs() < 1e-3);
    }
    for pair in values.chunks(2) {
        assert!((pair[1] - pair[0]).abs() <= 2.0 * found.list[0].accuracy);
    }
}

/// The quasi-static response to all pegs at once, through 1000 bodies.
#[test]
fn a_long_structure_follows_its_supports() {
    let spine = spine(1000, 8.0, 0.0).unwrap();
    let at = as_built(&spine.model);
    let rigid = SupportMotion::translation(&spine.model, &at, 0).unwrap();
    let is_free = |i: &usize| spine.model.free().binary_search(i).is_ok();
    let direction: Vec<_> =
        (0..at.q.len()).filter(|i| !is_free(i)).map(|i| (i, rigid.influence[i])).collect();
    let response = SupportMotion::quasi_static(&spine.model, &at, "base", &direction).unwrap();
    let error = relative(&response.influence, &rigid.influence);
    println!("quasi-static response {error:.1e}");
    // 1.4e-6: rounding by the spread of K's eigenvalues, 4e4 to 2.6e-7 per unit mass.
    assert!(error < 1e-5);
}
