//! The tangent against finite differences; the null space and multipliers against their definitions.

use approx::assert_relative_eq;
use nalgebra::Vector2;
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_fixtures::{prism, spine};
use tg_model::{At, CableLaw, Mechanics, Model, ModelBuilder};
use tg_tangent::{Augmentation, Configuration, NullSpace, Reduced, Tangent, TangentError};

/// F + Aᵀλ on the free coordinates with λ kept.
fn forces(model: &Model<3>, at: &Configuration, q: &[f64]) -> Vec<f64> {
    let rest = vec![0.0; q.len()];
    let mut force = rest.clone();
    model.force(At { q, v: &rest, u: &at.u, taut: None }, &mut force);
    let mut jacobian = vec![0.0; model.jacobian_pattern().len()];
    model.jacobian(q, &mut jacobian);
    for (&(row, i), a) in model.jacobian_pattern().iter().zip(&jacobian) {
        force[i] += a * at.lambda[row];
    }
    model.free().iter().map(|&i| force[i]).collect()
}

#[test]
fn stiffness_is_the_derivative_of_the_forces_with_multipliers() {
    let prism = prism(4, 50.0, 9.81, CableLaw::slacking).unwrap();
    let q = prism.model.initial_coordinates();
    let at = Configuration::at(&prism.model, &q, &prism.model.inputs_at(0.0)).unwrap();
    assert!(at.lambda.iter().any(|l| l.abs() > 1.0), "the multiplier term has work to do");
    let stiffness = Tangent::new(&prism.model, &at).stiffness.dense();
    for (column, &i) in prism.model.free().iter().enumerate() {
        let h = 1e-4;
        let at_distance = |k: f64| {
            let mut moved = q.clone();
            moved[i] += k * h;
            forces(&prism.model, &at, &moved)
        };
        let (near, far) = ((at_distance(1.0), at_distance(-1.0)), (at_distance(2.0), at_distance(-2.0)));
        for row in 0..stiffness.nrows() {
            let difference = (8.0 * (near.0[row] - near.1[row]) - (far.0[row] - far.1[row])) / (12.0 * h);
            assert_relative_eq!(stiffness[(row, column)], -difference, epsilon = 1e-7, max_relative = 1e-8);
        }
    }
}

#[test]
fn residuals_are_what_no_constraint_balances() {
    let spine = spine(2, 8.0, 0.0).unwrap();
    let mut q = spine.model.initial_coordinates();
    let balanced = Configuration::at(&spine.model, &q, &spine.model.inputs_at(0.0)).unwrap();
    assert!(balanced.imbalance().0 < 1e-13);
    let member = spine.bodies[1];
    // Lift the upper vertebra: forces no longer balance, and A r = 0.
    let top = spine.model.form(member.node(0)).unwrap().terms()[0].0;
    q[3 * top + 2] += 0.01;
    let at = Configuration::at(&spine.model, &q, &spine.model.inputs_at(0.0)).unwrap();
    assert!(at.imbalance().0 > 0.1);
    let tangent = Tangent::new(&spine.model, &at);
    let mut rate = vec![0.0; spine.model.sizes().constraints];
    tangent.jacobian.add_product(1.0, &at.residual, &mut rate);
    assert!(rate.iter().all(|r| r.abs() < 1e-12));
}

#[test]
fn the_null_space_is_orthonormal_and_allowed() {
    let prism = prism(5, 10.0, 0.0, CableLaw::slacking).unwrap();
    let q = prism.model.initial_coordinates();
    let at = Configuration::at(&prism.model, &q, &prism.model.inputs_at(0.0)).unwrap();
    let tangent = Tangent::new(&prism.model, &at);
    let null = NullSpace::new(&tangent).unwrap();
    assert_eq!((null.rank, null.basis.ncols()), (5, 25));
    let gram = null.basis.transpose() * &null.basis;
    for r in 0..25 {
        for c in 0..25 {
            assert_relative_eq!(gram[(r, c)], f64::from(u8::from(r == c)), epsilon = 1e-13);
        }
    }
    let product = tangent.jacobian.times(&null.basis);
    assert!((0..5).all(|r| (0..25).all(|c| product[(r, c)].abs() < 1e-13)));
    assert_eq!(Reduced::new(&tangent).unwrap().degrees_of_freedom(), 25);
}

/// ϱ AᵀPA has rows of A as its range and ϱ as its largest eigenvalue per independent row.
#[test]
fn augmentation_is_the_product_with_normalised_rows() {
    let spine = spine(1, 8.0, 0.0).unwrap();
    let model = &spine.model;
    let mut jacobian = vec![0.0; model.jacobian_pattern().len()];
    model.jacobian(&model.initial_coordinates(), &mut jacobian);
    let mut augmentation = Augmentation::new(model);
    let mut values = Vec::new();
    augmentation.values(model, &jacobian, 7.0, &mut values);
    let trace: f64 =
        augmentation.pattern.iter().zip(&values).filter(|((r, c), _)| r == c).map(|(_, v)| v).sum();
    assert_relative_eq!(trace, 7.0 * model.sizes().constraints as f64, max_relative = 1e-13);
}

#[test]
fn a_force_that_is_not_finite_is_named() {
    let prism = prism(3, 10.0, 0.0, CableLaw::slacking).unwrap();
    let mut q = prism.model.initial_coordinates();
    q[4] = f64::NAN;
    let error = Configuration::at(&prism.model, &q[1..], &prism.model.inputs_at(0.0)).unwrap_err();
    assert!(error.to_string().contains("17 coordinates for a structure that has 18"), "{error}");
    let error = Configuration::at(&prism.model, &q, &prism.model.inputs_at(0.0)).unwrap_err();
    assert!(matches!(error, TangentError::NotFinite { .. }), "{error}");
    assert!(error.to_string().contains("bar"), "{error}");
}

#[test]
fn a_motion_without_mass_is_named() {
    let mut b = ModelBuilder::<2>::new();
    let hook = b.anchor("hook", [0.0, 0.0]).unwrap();
    let massless = MassProperties::massless(Vector2::zeros()).unwrap();
    let particle = Member::new(CoordType::R, &[Vector2::zeros()], massless).unwrap();
    let knot = b.member("knot", particle, Pose::planar(0.0, -1.0, 0.0)).unwrap();
    let weight = b.particle("weight", 1.0, [0.0, -2.0]).unwrap();
    b.cable("upper", hook, knot.node(0), CableLaw::linear(100.0), 0.9).unwrap();
    b.cable("lower", knot.node(0), weight.node(0), CableLaw::linear(100.0), 0.9).unwrap();
    let model = b.build().unwrap();
    let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap();
    let options = tg_tangent::EigenOptions::new(2, tg_tangent::Metric::Mass);
    let error = tg_tangent::lowest(&model, &at, &options).unwrap_err();
    assert!(error.to_string().contains("knot"), "{error}");
}
