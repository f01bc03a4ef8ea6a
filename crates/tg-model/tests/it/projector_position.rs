//! Projection of positions: against brute force, far from the origin, and where it must fail with a name.

use crate::support::examples::{pendulum, pendulum_nodes};
use crate::support::mixed::{Plane, Spatial, mixed};
use crate::support::{Random, all, build, jacobian, mass, pick, seeds, select, violation};
use nalgebra::{DMatrix, DVector};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::Joining::Share;
use tg_model::{Mechanics, Model, ProjectionError, Projector};
use tg_sparse::SparseError;

#[test]
fn perturbed_coordinates_return_to_the_constraints() {
    fn check<const D: usize>(model: &Model<D>, r: &mut Random) {
        let mut q = model.initial_coordinates();
        Projector::new(model).unwrap().position(&mut q).unwrap();
        let consistent = q.clone();
        for size in [0.0, 1e-9, 1e-3, 0.05] {
            q.copy_from_slice(&consistent);
            for &i in model.free() {
                q[i] += size * r.value();
            }
            let start = q.clone();
            let moved = Projector::new(model).unwrap().position(&mut q).unwrap();
            assert!(violation(model, &q) <= 1e-13);
            assert!((moved.residual - violation(model, &q)).abs() < 1e-15);
            let change: Vec<f64> = q.iter().zip(&start).map(|(q, s)| (q - s).abs()).collect();
            assert_eq!(moved.largest, change.iter().fold(0.0, |m, x| x.max(m)));
            assert!(moved.largest == change[moved.coordinate] && moved.largest < 20.0 * size + 1e-14);
            assert!(all(q.len()).into_iter().all(|i| model.free().contains(&i) || q[i] == start[i]));
            assert!(moved.iterations <= 8, "Newton converges quadratically: {moved:?}");
            assert!(size < 1e-3 || moved.iterations >= 2, "once does not suffice: {moved:?}");
            assert!(size > 0.0 || moved.iterations <= 2, "nothing to do but rounding: {moved:?}");
        }
    }
    for seed in 0..seeds(5) {
        check(&mixed::<Plane, 2>(seed, true).model, &mut Random::new(seed));
        check(&mixed::<Spatial, 3>(seed, true).model, &mut Random::new(seed));
    }
}

/// M δq lies in the range of Aᵀ to first order.
#[test]
fn small_corrections_are_impulses_of_the_constraints() {
    let model = mixed::<Spatial, 3>(11, true).model;
    let m = model.mechanics();
    let mut q = model.initial_coordinates();
    let mut projector = Projector::new(m).unwrap();
    projector.position(&mut q).unwrap();
    let r = &mut Random::new(12);
    let size = 1e-6;
    for &i in m.free() {
        q[i] += size * r.value();
    }
    let start = q.clone();
    projector.position(&mut q).unwrap();
    let change: Vec<f64> = q.iter().zip(&start).map(|(q, s)| q - s).collect();
    let momentum = pick((mass(m) * DVector::from_column_slice(&change)).as_slice(), m.free());
    let a = select(&jacobian(m, &q), &all(m.sizes().constraints), m.free());
    let nu = (&a * a.transpose()).full_piv_lu().solve(&(&a * &momentum)).unwrap();
    let outside = (&momentum - a.transpose() * nu).amax();
    assert!(momentum.amax() > 0.1 * size && outside < 1e-4 * size, "{outside}");
}

/// Smallest distance in a metric from the pendulum's configurations, by repeated grids over its two angles.
fn nearest(metric: &DMatrix<f64>, to: &[f64]) -> (f64, DVector<f64>) {
    let at = |a: f64, b: f64| -> DVector<f64> {
        DVector::from_iterator(
            8,
            pendulum_nodes(a, b).iter().flat_map(|x| x.iter().copied().collect::<Vec<_>>()),
        )
    };
    let to = DVector::from_column_slice(to);
    let (mut a, mut b, mut width, mut best) = (45f64.to_radians(), 0.0, 0.2, f64::INFINITY);
    for _ in 0..40 {
        let centre = (a, b);
        for i in -2..=2 {
            for j in -2..=2 {
                let angles = (centre.0 + width * f64::from(i) / 2.0, centre.1 + width * f64::from(j) / 2.0);
                let gap = at(angles.0, angles.1) - &to;
                let distance = (gap.transpose() * metric * &gap)[0].sqrt();
                if distance < best {
                    (best, a, b) = (distance, angles.0, angles.1);
                }
            }
        }
        width *= 0.6;
    }
    (best, at(a, b))
}

#[test]
fn no_consistent_configuration_is_nearer_in_the_mass_metric() {
    let model = pendulum([Share, Share], CoordType::Ruv, 0.5).unwrap().model;
    let (q0, metric) = (model.initial_coordinates(), mass(&model));
    let closed: Vec<f64> = pendulum_nodes(45f64.to_radians(), 0.0)
        .iter()
        .flat_map(|x| x.iter().copied().collect::<Vec<_>>())
        .collect();
    assert!(q0.iter().zip(&closed).all(|(a, b)| (a - b).abs() < 1e-15), "the closed form is the model's");
    let distance = |metric: &DMatrix<f64>, a: &[f64], b: &[f64]| {
        let gap = DVector::from_column_slice(a) - DVector::from_column_slice(b);
        (gap.transpose() * metric * &gap)[0].sqrt()
    };
    let r = &mut Random::new(21);
    let mut other_metric_is_worse = 0.0_f64;
    for _ in 0..seeds(10) {
        let mut start = q0.clone();
        for &i in model.free() {
            start[i] += 1e-4 * r.value();
        }
        let mut q = start.clone();
        Projector::new(&model).unwrap().position(&mut q).unwrap();
        let found = distance(&metric, &q, &start);
        let (best, _) = nearest(&metric, &start);
        // To first order: the excess is of the order of the perturbation, 1e-4 / 0.05.
        assert!(found >= best * (1.0 - 1e-9) && found <= best * 1.005, "{found} against {best}");
        let (_, euclidean) = nearest(&DMatrix::identity(8, 8), &start);
        other_metric_is_worse =
            other_metric_is_worse.max(distance(&metric, euclidean.as_slice(), &start) / best);
    }
    assert!(other_metric_is_worse > 1.05, "the metric must matter: {other_metric_is_worse}");
}

/// Rounding of large coordinates limits the residual; that is no failure.
#[test]
fn structures_far_from_the_origin_and_of_any_size_are_projected() {
    for (offset, size) in [(0.0, 1e-3), (0.0, 1e6), (10.0, 0.1), (1e3, 0.1), (1e5, 1.0)] {
        let mut bars = Vec::new();
        let model = build::<2>(|b| {
            let at = |x: f64, y: f64| [offset + size * x, offset + size * y];
            let peg = b.anchor("peg", at(0.0, 0.0))?;
            bars = vec![
                b.bar("a", 1.0, at(0.0, 0.0), at(1.0, 0.3))?,
                b.bar("b", 1.0, at(1.0, 0.3), at(0.7, 1.1))?,
            ];
            b.joint("foot", &[peg.into(), bars[0].node(0)], tg_model::Joining::Constrain)?;
            b.joint("knee", &[bars[0].node(1), bars[1].at(at(1.0, 0.3))], tg_model::Joining::Constrain)
        });
        let model = model.unwrap();
        let r = &mut Random::new(31);
        for _ in 0..20 {
            let mut q = model.initial_coordinates();
            for &i in model.free() {
                q[i] += 0.05 * size * r.value();
            }
            let moved = Projector::new(&model).unwrap().position(&mut q).unwrap();
            let rounding = 100.0 * f64::EPSILON * (offset / size).max(1.0);
            assert!(violation(&model, &q) < rounding, "{offset} {size}: {moved:?}");
        }
    }
}

#[test]
fn an_unreachable_start_names_a_constraint() {
    // The anchors are further apart than the two bars can reach.
    let model = build::<2>(|b| {
        let pegs = [b.anchor("A", [0.0, 0.0])?, b.anchor("B", [1.0, 0.0])?];
        let bars = [b.bar("near", 1.0, [0.0, 0.0], [0.5, 0.8])?, b.bar("far", 1.0, [0.5, 0.8], [1.0, 0.0])?];
        b.joint("foot A", &[pegs[0].into(), bars[0].node(0)], Share)?;
        b.joint("foot B", &[pegs[1].into(), bars[1].node(1)], Share)?;
        b.joint("knee", &[bars[0].node(1), bars[1].node(0)], Share)?;
        b.support("pull", pegs[1], 0, 3.0)
    });
    let model = model.unwrap();
    let mut q = model.initial_coordinates();
    let error = Projector::new(&model).unwrap().position(&mut q).unwrap_err();
    assert!(error.to_string().contains("rigidity u·u of"), "{error}");
    if let ProjectionError::NotConverged { residual, iterations, .. } = error {
        assert!(residual > 0.1 && iterations > 0);
    }
}

#[test]
fn coordinates_that_are_not_finite_are_refused() {
    let model = mixed::<Plane, 2>(1, true).model;
    let free = model.free();
    for bad in [f64::NAN, f64::INFINITY] {
        for i in [free[0], free[free.len() / 2], free[free.len() - 1]] {
            let mut q = model.initial_coordinates();
            q[i] = bad;
            let touching = (0..model.sizes().constraints)
                .filter(|&c| model.jacobian_pattern().contains(&(c, i)))
                .map(|c| model.constraint_name(c))
                .collect::<Vec<_>>();
            let result = Projector::new(&model).unwrap().position(&mut q);
            if touching.is_empty() {
                continue; // a particle: nothing to be consistent with
            }
            let text = result.unwrap_err().to_string();
            assert!(
                touching.iter().any(|name| text.contains(name.as_str())),
                "{text} names none of {touching:?}"
            );
        }
    }
}

#[test]
fn members_without_mass_are_named() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Into::into);
    let massless = MassProperties::massless([0.3, 0.3].into()).unwrap();
    let model = build::<2>(|b| {
        let ghost = Member::new(CoordType::Rrr, &corners, massless).unwrap();
        let bar = b.bar("solid", 1.0, [0.0, 0.0], [-1.0, 0.0])?;
        let body = b.member("ghost", ghost, Pose::identity())?;
        b.joint("knee", &[bar.node(0), body.node(0)], Share)
    });
    let model = model.unwrap();
    let (q, mut v) = (model.initial_coordinates(), vec![0.1; model.sizes().coordinates]);
    let error = Projector::new(&model).and_then(|mut p| p.velocity(&q, &mut v)).unwrap_err();
    assert!(matches!(error, ProjectionError::Solver { .. }), "{error}");
    let text = error.to_string();
    assert!(text.contains("of \"ghost\"") && text.contains("give mass to what moves"), "{text}");
}

/// A massless member whose motion follows from that of others leaves M singular, but definite where it matters: right
/// with the pivoting factorisation, a named error without.
#[test]
fn a_massless_member_that_follows_others_is_projected_or_named() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(Into::into);
    let ghost = Member::new(CoordType::Rrr, &corners, MassProperties::massless([0.3, 0.3].into()).unwrap());
    let model = build::<2>(|b| {
        let body = b.member("ghost", ghost.unwrap(), Pose::identity())?;
        let balls = [b.particle("one", 1.0, [0.0, 0.0])?, b.particle("two", 2.0, [1.0, 0.0])?];
        b.joint("left", &[balls[0].node(0), body.node(0)], Share)?;
        b.joint("right", &[balls[1].node(0), body.node(1)], Share)
    });
    let model = model.unwrap();
    assert_eq!(model.report().degrees_of_freedom(), 3);
    let (q, mut v) = (model.initial_coordinates(), vec![1.0, 0.0, 0.0, 1.0, 7.0, 7.0]);
    if let Err(error) = Projector::new(&model).unwrap().velocity(&q, &mut v) {
        // The build of this crate alone has no pivoting factorisation: the massless coordinate is named instead.
        let ProjectionError::Solver { source: SparseError::Pivot { .. }, culprit } = error else {
            panic!("{error}")
        };
        assert!(culprit.contains("basic point 2 of \"ghost\""), "{culprit}");
        return;
    }
    // The balls keep their centre's velocity (1, 2)/3 and turn with 1 about it; the corner follows.
    for (found, expected) in v.iter().zip([1.0 / 3.0, 0.0, 1.0 / 3.0, 1.0, 1.0 / 3.0 - 1.0, 0.0]) {
        assert!((found - expected).abs() < 1e-13, "{v:?}");
    }
}

#[test]
fn what_cannot_be_reached_is_no_rounding() {
    // The tip of a bar of 1 m is held 1.2 m from its foot: |u|² - 1 stays above 0.44.
    let model = build::<2>(|b| {
        let foot = b.anchor("foot", [0.0, 0.0])?;
        let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.6, 0.8])?;
        b.joint("hinge", &[foot.into(), bar.node(0)], Share)?;
        b.support("held", bar.node(1), 0, tg_model::Signal::ramp(0.0, 0.6, 1.0))
    });
    let model = model.unwrap();
    for height in [0.8, 0.3, -0.5, 1e-3] {
        let mut q = model.initial_coordinates();
        let mut v = vec![0.0; q.len()];
        model.prescribe(1.0, &mut q, &mut v);
        let y = model.free()[0];
        q[y] = height;
        let error = Projector::new(&model).unwrap().position(&mut q).unwrap_err();
        assert!(matches!(error, ProjectionError::NotConverged { residual, .. } if residual > 0.4), "{error}");
    }
}
