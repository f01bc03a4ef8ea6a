//! The virtual-work model against finite differences and its own geometry.

use super::*;

fn model(feet: Option<Vec<[f64; 2]>>) -> Model {
    Model {
        length: 100.0,
        ties: [(0.5, 35.0), (0.3, 52.0), (1.0, 80.0)],
        feet,
        forces: vec![([1.0, -2.0, -3.0], 60.0), ([0.0, 0.5, 1.0], 100.0), ([0.0; 3], 0.0)],
        moments: vec![[40.0, -10.0], [5.0, 20.0], [-30.0, 7.0]],
    }
}

fn state(model: &Model) -> Vec<f64> {
    let feet = [[33.0, 1.0, -0.1, -0.5], [-16.0, 28.0, 0.5, 0.2], [-17.0, -29.0, -0.4, 0.3]];
    let skip = if model.feet.is_some() { 2 } else { 0 };
    feet.iter().flat_map(|x| x[skip..].to_vec()).collect()
}

#[test]
fn derivatives_are_those_of_the_potential() {
    for feet in [None, Some(vec![[33.0, 0.0], [-16.0, 28.0], [-16.0, -28.0]])] {
        let model = model(feet);
        let x = state(&model);
        let (gradient, hessian) = (model.gradient(&x), model.hessian(&x));
        let h = 1e-4;
        for a in 0..x.len() {
            let shifted = |by: f64| {
                let mut x = x.clone();
                x[a] += by;
                x
            };
            let slope = (model.potential(&shifted(h)) - model.potential(&shifted(-h))) / (2.0 * h);
            assert!((slope - gradient[a]).abs() < 1e-3, "{a} {slope} {}", gradient[a]);
            let rate = (model.gradient(&shifted(h)) - model.gradient(&shifted(-h))) / (2.0 * h);
            assert!((rate - hessian.column(a)).amax() < 1e-2, "{a}");
        }
        assert!((&hessian - hessian.transpose()).amax() < 1e-10 * hessian.amax());
    }
}

#[test]
fn ends_and_coordinates_are_inverse() {
    let model = model(None);
    let x = state(&model);
    let ends = model.ends(&x);
    assert!(ends.iter().all(|[foot, top]| ((top - foot).norm() - 100.0).abs() < 1e-12 && foot.z == 0.0));
    assert!(model.at(&ends).iter().zip(&x).all(|(a, b)| (a - b).abs() < 1e-13));
}

/// With the same load on all struts the symmetric equilibrium is one of the whole model.
#[test]
fn the_symmetric_equilibrium_is_one_of_all_coordinates() -> Result<(), ReferenceError> {
    let mut model = model(None);
    (model.forces, model.moments) = (vec![([0.0, 0.0, -5.0], 100.0); 3], vec![[0.0; 2]; 3]);
    let x = model.symmetric_equilibrium([36.0, -0.1, -0.6])?;
    assert!(model.gradient(&x).amax() < 1e-9);
    assert_eq!(model.signs(&x), (0, 3));
    Ok(())
}
