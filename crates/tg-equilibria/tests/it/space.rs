//! Structures of space against closed forms and against the same structures in the plane.

use nalgebra::{Matrix3, Matrix4, Rotation3, SymmetricEigen, Vector3};
use tg_equilibria::{EquilibriaOptions, all_equilibria};
use tg_model::{Joining, Model, ModelBuilder};

use crate::support::{Spring, add_springs, assert_complete, body};

fn all<const D: usize>(model: &Model<D>) -> tg_equilibria::EquilibriaReport {
    let report = all_equilibria(model, &model.inputs_at(0.0), &EquilibriaOptions::default()).unwrap();
    assert_complete(&report);
    report
}

/// A body on a ball joint at the origin.
fn pivoted(springs: &[Spring<3>]) -> Model<3> {
    let mut b = ModelBuilder::<3>::new();
    let ground = b.anchor("pivot", [0.0; 3]).unwrap();
    let top = body(&mut b, "top", [0.0; 3]);
    b.joint("ball", &[ground.into(), top.node(0)], Joining::Share).unwrap();
    add_springs(&mut b, top, springs);
    b.build().unwrap()
}

/// A body on a ball joint with springs of zero free length: V = const - tr(Bᵀ R) with B = Σ k a bᵀ, whose critical points
/// are the eigenvectors of Davenport's matrix and V = const - its eigenvalue (Davenport's q method).
#[test]
fn a_pivoted_body_has_the_four_equilibria_of_davenports_matrix() {
    let springs = [
        Spring { from: [2.0, 0.3, 0.1], to: [1.0, 0.2, 0.0], stiffness: 3.0, free: 0.0 },
        Spring { from: [-0.4, 1.7, 0.5], to: [0.1, 0.9, 0.3], stiffness: 2.0, free: 0.0 },
        Spring { from: [0.2, -0.6, 1.9], to: [-0.3, 0.1, 1.2], stiffness: 4.0, free: 0.0 },
    ];
    let report = all(&pivoted(&springs));

    let mut profile = Matrix3::zeros();
    let mut constant = 0.0;
    for s in &springs {
        let (a, b) = (Vector3::from(s.from), Vector3::from(s.to));
        profile += s.stiffness * a * b.transpose();
        constant += 0.5 * s.stiffness * (a.norm_squared() + b.norm_squared());
    }
    let z = Vector3::new(
        profile[(2, 1)] - profile[(1, 2)],
        profile[(0, 2)] - profile[(2, 0)],
        profile[(1, 0)] - profile[(0, 1)],
    );
    let trace = profile.trace();
    let mut davenport = Matrix4::zeros();
    davenport
        .fixed_view_mut::<3, 3>(0, 0)
        .copy_from(&(profile + profile.transpose() - Matrix3::identity() * trace));
    davenport.fixed_view_mut::<3, 1>(0, 3).copy_from(&z);
    davenport.fixed_view_mut::<1, 3>(3, 0).copy_from(&z.transpose());
    davenport[(3, 3)] = trace;
    let mut energies: Vec<f64> =
        SymmetricEigen::new(davenport).eigenvalues.iter().map(|value| constant - value).collect();
    energies.sort_by(f64::total_cmp);

    assert_eq!((report.certified, report.equilibria.len(), report.stable().count()), (4, 4, 1));
    for (index, (found, expected)) in report.equilibria.iter().zip(&energies).enumerate() {
        assert!((found.energy - expected).abs() < 1e-11, "{} {expected}", found.energy);
        assert_eq!(found.negative, Some(index));
    }
    assert_eq!(report.euler_characteristic, Some(0));
}

/// Springs, a weight and a pivot in one plane: the equilibria in space of a bar held in that plane by no support.
#[test]
fn a_bar_on_a_ball_joint_has_those_of_the_plane_where_it_has_two_springs() {
    let plane = |lift: f64| {
        let mut b = ModelBuilder::<2>::new();
        b.gravity([0.0, -9.81]).unwrap();
        let ground = b.anchor("pivot", [0.0; 2]).unwrap();
        let bar = b.bar("bar", 1.0, [0.0, 0.0], [0.6, 0.8]).unwrap();
        b.joint("hinge", &[ground.into(), bar.node(0)], Joining::Share).unwrap();
        let from = b.anchor("hook", [0.3, 1.4]).unwrap();
        b.cable("spring", from, bar.node(1), tg_model::CableLaw::linear(40.0), lift).unwrap();
        b.build().unwrap()
    };
    let space = |lift: f64| {
        let mut b = ModelBuilder::<3>::new();
        b.gravity([0.0, -9.81, 0.0]).unwrap();
        let ground = b.anchor("pivot", [0.0; 3]).unwrap();
        let bar = b.bar("bar", 1.0, [0.0; 3], [0.6, 0.64, 0.48]).unwrap();
        b.joint("ball", &[ground.into(), bar.node(0)], Joining::Share).unwrap();
        let from = b.anchor("hook", [0.3, 1.4, 0.0]).unwrap();
        b.cable("spring", from, bar.node(1), tg_model::CableLaw::linear(40.0), lift).unwrap();
        b.build().unwrap()
    };
    for lift in [0.0, 0.9] {
        let (flat, full) = (all(&plane(lift)), all(&space(lift)));
        assert_eq!(flat.physical().count(), full.physical().count());
        for (a, b) in flat.physical().zip(full.physical()) {
            assert!((a.energy - b.energy).abs() < 1e-11, "{} {}", a.energy, b.energy);
            // Out of the plane there is one more direction: a minimum of the plane need not be one of space.
            assert!(b.negative >= a.negative);
        }
        assert_eq!(flat.equilibria.len(), full.equilibria.len());
    }
}

/// A lever on a hinge along z is a lever of the plane.
#[test]
fn a_body_on_a_fixed_hinge_turns_as_in_the_plane() {
    let free = [0.7, 0.0];
    let springs = [([1.8, 0.4], [1.0, 0.1], 5.0), ([-0.9, 1.3], [-0.2, 0.8], 3.0)];
    let mut b = ModelBuilder::<2>::new();
    let ground = b.anchor("pivot", [0.0; 2]).unwrap();
    let nodes = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]].map(nalgebra::Vector2::from);
    let mass = tg_coords::MassProperties::from_polar_moment(1.0, nalgebra::Vector2::zeros(), 1.0).unwrap();
    let lever = tg_coords::Member::new(tg_coords::CoordType::Ruv, &nodes, mass).unwrap();
    let lever = b.member("lever", lever, tg_coords::Pose::planar(0.0, 0.0, 0.0)).unwrap();
    b.joint("hinge", &[ground.into(), lever.node(0)], Joining::Share).unwrap();
    let flat: Vec<Spring<2>> = (springs.iter().zip(free))
        .map(|(&(from, to, stiffness), free)| Spring { from, to, stiffness, free })
        .collect();
    add_springs(&mut b, lever, &flat);
    let flat = all(&b.build().unwrap());

    let mut b = ModelBuilder::<3>::new();
    let lever = body(&mut b, "lever", [0.0; 3]);
    b.fix("pivot", lever.node(0)).unwrap();
    b.fix("axis", lever.node(3)).unwrap();
    let full: Vec<Spring<3>> = (springs.iter().zip(free))
        .map(|(&(from, to, stiffness), free)| {
            let lifted = |x: [f64; 2]| [x[0], x[1], 0.2];
            Spring { from: lifted(from), to: lifted(to), stiffness, free }
        })
        .collect();
    add_springs(&mut b, lever, &full);
    let full = all(&b.build().unwrap());
    assert_eq!((flat.certified, flat.equilibria.len()), (full.certified, full.equilibria.len()));
    for (a, b) in flat.equilibria.iter().zip(&full.equilibria) {
        assert!((a.energy - b.energy).abs() < 1e-11);
        assert_eq!(a.negative, b.negative);
    }
}

/// Newton's method for ∇V = 0 in rotation vectors, from `starts` random rotations; the energies of what it finds.
fn searched(springs: &[Spring<3>], starts: u64) -> Vec<f64> {
    let potential = |r: &Rotation3<f64>| -> f64 {
        let length = |s: &Spring<3>| (Vector3::from(s.from) - r * Vector3::from(s.to)).norm();
        springs.iter().map(|s| 0.5 * s.stiffness * (length(s) - s.free).powi(2)).sum()
    };
    let mut energies: Vec<f64> = Vec::new();
    for k in 0..starts {
        let golden = |step: f64| (k as f64 * step).fract() * 2.0 - 1.0;
        let axis = Vector3::new(golden(0.8191725134), golden(0.6710436067), golden(0.5497004779));
        let mut r = Rotation3::new(axis * 3.0);
        for _ in 0..100 {
            let h = 1e-4;
            let at = |x: Vector3<f64>| potential(&(Rotation3::new(x) * r));
            let unit = |i: usize| Vector3::ith(i, h);
            let gradient = Vector3::from_fn(|i, _| (at(unit(i)) - at(-unit(i))) / (2.0 * h));
            let hessian = Matrix3::from_fn(|i, j| {
                let mixed = |a: f64, b: f64| at(unit(i) * a + unit(j) * b);
                (mixed(1.0, 1.0) - mixed(1.0, -1.0) - mixed(-1.0, 1.0) + mixed(-1.0, -1.0)) / (4.0 * h * h)
            });
            let Some(step) = hessian.try_inverse().map(|inverse| inverse * gradient) else { break };
            r = Rotation3::new(-step * (0.3 / step.norm()).min(1.0)) * r;
            if step.norm() < 1e-7 {
                let found = potential(&r);
                if !energies.iter().any(|e| (e - found).abs() < 1e-6) {
                    energies.push(found);
                }
                break;
            }
        }
    }
    energies.sort_by(f64::total_cmp);
    energies
}

/// A body on a ball joint with two springs that have a free length and one that has none.
#[test]
fn a_pivoted_body_with_free_lengths_has_what_a_search_from_everywhere_finds() {
    for free in [[0.8, 0.0, 0.0], [1.9, 2.2, 0.0]] {
        let ends = [
            ([2.0, 0.3, 0.1], [1.0, 0.2, 0.0], 3.0),
            ([-0.4, 1.7, 0.5], [0.1, 0.9, 0.3], 2.0),
            ([0.2, -0.6, 1.9], [-0.3, 0.1, 1.2], 1.0),
        ];
        let spring = |((from, to, stiffness), free)| Spring { from, to, stiffness, free };
        let springs: Vec<Spring<3>> = ends.into_iter().zip(free).map(spring).collect();
        let report = all(&pivoted(&springs));
        let found: Vec<f64> = report.physical().map(|e| e.energy).collect();
        let expected = searched(&springs, 400);

        assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
        assert!(found.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?} {expected:?}");
    }
}
