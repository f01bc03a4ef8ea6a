//! Error against processor time.

use tg_scene::Scheme;
use tg_trade::{Budget, Curve, Quantity, Reference, Subject, cheapest};

use crate::pendulum::{END, model};

#[test]
fn errors_fall_with_the_order_of_the_scheme() {
    let model = model();
    let rest = model.velocities_at_rest();
    let subject = Subject::new(&model, &rest, END);
    let reference = Reference::new(&subject, 1.0).unwrap();
    let budget = Budget { run: 0.1 };
    let curves = [Scheme::Symplectic, Scheme::Leapfrog, Scheme::Composition4]
        .map(|scheme| Curve::measure(&subject, &reference, scheme, 0.7, budget));
    for curve in &curves {
        assert!(curve.failure.is_none() && curve.rungs.len() >= 2, "{curve:?}");
        let [first, second] = [0, 1].map(|k| curve.rungs[k].errors[Quantity::Positions]);
        let order = (first / second).log2();
        let expected = f64::from(curve.scheme.order());
        assert!((order - expected).abs() < 0.2, "{}: order {order}", curve.scheme);
        assert_eq!(curve.rungs[1].steps, 2 * curve.rungs[0].steps);
    }
    let wanted = curves[0].rungs[1].errors[Quantity::Positions];
    let found = cheapest(&curves, Quantity::Positions, wanted).unwrap();
    assert!(found.errors[Quantity::Positions] <= wanted);
    let all = curves.iter().flat_map(|curve| &curve.rungs);
    let exact = all.filter(|rung| rung.errors[Quantity::Positions] <= wanted);
    assert!(exact.into_iter().all(|rung| rung.seconds >= found.seconds));
    assert!(cheapest(&curves, Quantity::Positions, 0.0).is_none());
}
