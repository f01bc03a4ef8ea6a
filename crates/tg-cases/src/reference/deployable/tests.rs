//! The twenty-four-coordinate model against the framework's reference values and finite differences.

use super::*;
use crate::published::{Upright, framework};

/// Both states with their reference values.
fn states() -> [(Configuration, &'static Upright); 2] {
    let values = &framework().example3;
    [(Configuration::Initial, &values.initial), (Configuration::Target, &values.target)]
}

fn close(a: Vector3<f64>, b: [f64; 3]) -> bool {
    (a - Vector3::from(b)).amax() < 1e-15
}

#[test]
fn the_upright_figure_is_the_references() {
    for (configuration, upright) in states() {
        let figure = Figure::new(configuration, &[0.0; COORDINATES]);
        for i in 0..3 {
            assert!(close(figure.ground[i], upright.nodes.ground[i]));
            assert!(close(figure.ring[i], upright.nodes.ring[i]));
        }
        for (body, published) in figure.bodies.iter().zip(upright.nodes.tetrahedra.values()) {
            assert!(close(body.centre, published.mass_centre) && close(body.apex(), published.apex));
            (0..3).for_each(|i| assert!(close(body.base(i), published.base[i])));
        }
        for ([from, to], length) in figure.cables().iter().zip(upright.lengths) {
            assert!(((to - from).norm() - length).abs() < 1e-15);
        }
    }
}

/// Far from the upright configuration bars keep their length and the tetrahedra their rotations proper.
#[test]
fn coordinates_keep_all_constraints() {
    for (configuration, _) in states() {
        let figure = Figure::new(configuration, &from_fn(|k| 0.02 * ((k * k % 7) as f64 - 3.0)));
        for [from, to] in figure.bars() {
            assert!(((to - from).norm() - BAR_LENGTH).abs() < 1e-15);
        }
        for body in &figure.bodies {
            assert!((body.rotation.tr_mul(&body.rotation) - Matrix3::identity()).amax() < 1e-15);
        }
        assert!((figure.bodies[1].apex() - figure.bodies[2].apex()).amax() < 1e-15);
    }
}

#[test]
fn reference_rest_lengths_are_in_equilibrium() {
    for (configuration, upright) in states() {
        let gradient = Model::new(configuration, &upright.rest).gradient();
        // Lengths are rounded at 1e-16 m, times κ = 1000 N/m, and several cables meet.
        assert!(gradient.amax() < 5e-13, "{configuration:?} {:e}", gradient.amax());
    }
}

#[test]
fn tensions_are_the_references() {
    for (_, upright) in states() {
        for k in 0..CABLES {
            let tension = KAPPA[usize::from(k >= 9)] * (upright.lengths[k] - upright.rest[k]);
            assert!((tension - upright.tensions[k]).abs() < 1e-12);
        }
    }
}

#[test]
fn frequencies_are_the_references() -> Result<(), ReferenceError> {
    for (configuration, upright) in states() {
        let found = Model::new(configuration, &upright.rest).frequencies()?;
        for (f, expected) in found.iter().zip(&upright.frequencies) {
            assert!((f / expected - 1.0).abs() < 1e-9, "{configuration:?} {f} {expected}");
        }
    }
    Ok(())
}

#[test]
fn derivatives_are_those_of_the_potential() {
    for (configuration, upright) in states() {
        // Other rest lengths, so that the gradient is not zero; cable 4 is slack.
        let mut rest = upright.rest.map(|mu| 0.98 * mu);
        rest[3] = 1.1 * upright.lengths[3];
        let model = Model::new(configuration, &rest);
        let (gradient, stiffness) = (model.gradient(), model.stiffness());
        let d = 1e-4;
        let shifted = |moves: &[(usize, f64)]| {
            let mut x = [0.0; COORDINATES];
            moves.iter().for_each(|&(a, by)| x[a] += by);
            model.potential(&x)
        };
        for a in 0..COORDINATES {
            let slope = (shifted(&[(a, d)]) - shifted(&[(a, -d)])) / (2.0 * d);
            assert!((slope - gradient[a]).abs() < 1e-4, "{a} {slope} {}", gradient[a]);
            let b = (5 * a + 2) % COORDINATES;
            let mixed = |p: f64, q: f64| shifted(&[(a, p * d), (b, q * d)]);
            let curvature =
                (mixed(1.0, 1.0) - mixed(1.0, -1.0) - mixed(-1.0, 1.0) + mixed(-1.0, -1.0)) / (4.0 * d * d);
            assert!(
                (curvature - stiffness[(a, b)]).abs() < 1e-2,
                "{a} {b} {curvature} {}",
                stiffness[(a, b)]
            );
        }
        assert!((stiffness - stiffness.transpose()).amax() < 1e-12 * stiffness.amax());
    }
}

#[test]
fn coordinates_carry_the_mass_that_they_move() {
    for (configuration, upright) in states() {
        let mass = Model::new(configuration, &upright.rest).mass_matrix();
        assert!((mass - mass.transpose()).amax() < 1e-16);
        assert!(mass.cholesky().is_some());
        // Tetrahedron 10 alone: its displacement carries its mass, its rotation its inertia.
        (15..18).for_each(|k| assert!((mass[(k, k)] - TETRAHEDRON).abs() < 1e-16));
        assert!((mass[(20, 20)] - INERTIA[2]).abs() < 1e-18);
        // The common apex of tetrahedra 8 and 9 carries both.
        (6..9).for_each(|k| assert!((mass[(k, k)] - 2.0 * TETRAHEDRON).abs() < 1e-16));
    }
}

#[test]
fn limp_cables_leave_no_stiffness_but_that_of_gravity() -> Result<(), ReferenceError> {
    // Nothing holds tetrahedron 10, and whatever stands on the prism falls.
    let limp = Model::new(Configuration::Initial, &[1.0; CABLES]);
    assert_eq!(limp.stiffness().fixed_view::<6, 6>(15, 15).amax(), 0.0);
    assert!(limp.frequencies()?[0] < -0.1);
    Ok(())
}
