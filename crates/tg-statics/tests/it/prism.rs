//! The regular prism, whose twist, forces, self-stress and mechanisms are known in closed form.

use approx::assert_relative_eq;
use tg_fixtures::prism;
use tg_model::CableLaw;
use tg_statics::{
    Configuration, PrestressStability, SelfStress, Verdict, prestress_stability, stability, stability_with,
};
use tg_tangent::{EigenOptions, Method, Metric};

/// One state of self-stress, 2n - 5 infinitesimal mechanisms, all of them stiffened by it.
#[test]
fn counts_and_product_forces() {
    for n in 3..8 {
        let prism = prism(n, 10.0, 0.0, CableLaw::slacking).unwrap();
        let q = prism.model.initial_coordinates();
        let at = Configuration::at(&prism.model, &q, &prism.model.inputs_at(0.0)).unwrap();
        assert!(at.imbalance().0 < 1e-12, "{:?}", at.imbalance());
        let analysis = SelfStress::new(&prism.model, &at).unwrap();
        let (counted, not) = analysis.rank.gap();
        assert!(counted.unwrap() > 0.1 && not.unwrap() < 1e-14, "{:?}", analysis.rank);
        assert_eq!(analysis.states.len(), 1);
        assert_eq!(analysis.mechanisms.len(), 2 * n - 5);
        assert_eq!(analysis.rigid_motions.len(), 6);
        let state = &analysis.states[0];
        assert_relative_eq!(state[0] / state[2 * n], prism.forces[0] / prism.forces[1], max_relative = 1e-12);

        let test = prestress_stability(&prism.model, &at, &analysis).unwrap();
        let PrestressStability::Stable { tensions, stiffness } = test else { panic!("{test:?}") };
        assert!(stiffness > 0.1 && tensions.iter().all(|&f| f > 0.0), "{stiffness} {tensions:?}");

        let stability = stability(&prism.model, &at, 8).unwrap();
        assert_eq!(stability.verdict, Verdict::Stable);
        assert_eq!((stability.counts.negative, stability.counts.zero), (0, 6));
        assert_eq!(stability.rigid_motions, 6);
    }
}

/// A cable law that pushes lets the opposite self-stress in, which does not stiffen: only one sign does.
#[test]
fn the_sign_of_the_self_stress_matters() {
    let prism = prism(3, -10.0, 0.0, CableLaw::linear).unwrap();
    let at = Configuration::at(&prism.model, &prism.model.initial_coordinates(), &prism.model.inputs_at(0.0))
        .unwrap();
    assert!(at.imbalance().0 < 1e-12);
    let stability = stability(&prism.model, &at, 1).unwrap();
    assert_eq!(stability.verdict, Verdict::Unstable);
    assert_eq!(stability.counts.negative, 1);
    // The test looks at both signs and finds the one that pulls.
    let analysis = SelfStress::new(&prism.model, &at).unwrap();
    let test = prestress_stability(&prism.model, &at, &analysis).unwrap();
    let PrestressStability::Stable { tensions, .. } = test else { panic!("{test:?}") };
    assert!(tensions.iter().all(|&f| f > 0.0), "{tensions:?}");
}

#[test]
fn unstressed_cables_leave_the_mechanism_neutral() {
    let prism = prism(3, 0.0, 0.0, CableLaw::linear).unwrap();
    let at = Configuration::at(&prism.model, &prism.model.initial_coordinates(), &prism.model.inputs_at(0.0))
        .unwrap();
    let stability = stability(&prism.model, &at, 1).unwrap();
    assert_eq!(stability.verdict, Verdict::Neutral);
    assert_eq!((stability.counts.zero, stability.rigid_motions), (7, 6));
}

#[test]
fn dense_and_sparse_verdicts_agree() {
    for (tension, verdict) in [(10.0, Verdict::Stable), (-10.0, Verdict::Unstable)] {
        let prism = prism(6, tension, 0.0, CableLaw::linear).unwrap();
        let at =
            Configuration::at(&prism.model, &prism.model.initial_coordinates(), &prism.model.inputs_at(0.0))
                .unwrap();
        let options = |method| EigenOptions { method, ..EigenOptions::new(10, Metric::Coordinates) };
        let dense = stability_with(&prism.model, &at, &options(Method::Dense)).unwrap();
        let sparse = stability_with(&prism.model, &at, &options(Method::Sparse)).unwrap();
        assert_eq!(dense.verdict, verdict);
        assert_eq!((dense.verdict, dense.counts), (sparse.verdict, sparse.counts));
        for (a, b) in dense.lowest.iter().zip(&sparse.lowest) {
            assert_relative_eq!(a.value, b.value, max_relative = 1e-9, epsilon = 1e-9);
        }
    }
}
