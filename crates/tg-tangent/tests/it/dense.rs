//! Dense decompositions and constrained solutions.

use tg_fixtures::spine;
use tg_model::Mechanics;
use tg_tangent::faer::{Mat, c64};
use tg_tangent::{Configuration, Constrained, Tangent, dense};

/// Damped modes of a symmetric spine come in equal pairs: each vector must still belong to its eigenvalue.
#[test]
fn eigenvectors_of_repeated_pairs() {
    let spine = spine(3, 8.0, 2.0).unwrap();
    let q = spine.model.initial_coordinates();
    let at = Configuration::at(&spine.model, &q, &spine.model.inputs_at(0.0)).unwrap();
    let reduced = tg_tangent::Reduced::new(&Tangent::new(&spine.model, &at)).unwrap();
    let (values, modes) = dense::generalized_eigen(&reduced.stiffness, &reduced.mass).unwrap().unwrap();
    let damping = modes.transpose() * &reduced.damping * &modes;
    let k = values.len();
    let w = |i: usize| values[i].sqrt();
    let a = Mat::from_fn(2 * k, 2 * k, |r, c| match (r < k, c < k) {
        (true, true) => 0.0,
        (true, false) if r == c - k => w(r),
        (false, true) if r - k == c => -w(c),
        (false, false) => -damping[(r - k, c - k)],
        _ => 0.0,
    });
    let (values, vectors) = dense::eigen(&a).unwrap();
    for (column, &s) in values.iter().enumerate() {
        let x = |row: usize| vectors[(row, column)];
        let row = |r: usize| (0..2 * k).map(|c| x(c) * a[(r, c)]).sum::<c64>() - s * x(r);
        let norm = |f: &dyn Fn(usize) -> c64| (0..2 * k).map(|r| f(r).norm_sqr()).sum::<f64>().sqrt();
        let residual = norm(&row) / (a.norm_l2() * norm(&x));
        assert!(residual < 1e-14, "{s}: {residual:.1e}");
        assert!(s.im == 0.0 || values.contains(&s.conj()));
    }
}

/// X x - b in the range of Aᵀ, A x = g, on the null space's own basis.
#[test]
fn constrained_solutions_satisfy_their_equations() {
    let spine = spine(2, 8.0, 0.0).unwrap();
    let q = spine.model.initial_coordinates();
    let at = Configuration::at(&spine.model, &q, &spine.model.inputs_at(0.0)).unwrap();
    let tangent = Tangent::new(&spine.model, &at);
    let null = tg_tangent::NullSpace::new(&tangent).unwrap();
    let b: Vec<f64> = (0..tangent.unknowns()).map(|k| (1.0 + k as f64).sin()).collect();
    let g: Vec<f64> = (0..spine.model.sizes().constraints).map(|k| 0.1 * (2.0 + k as f64).cos()).collect();
    let systems = [
        (Constrained::stiffness(&spine.model, &at).unwrap(), &tangent.stiffness),
        (Constrained::mass(&spine.model, &at).unwrap(), &tangent.mass),
    ];
    for (mut system, matrix) in systems {
        let x = system.solve(&b, &g).unwrap();
        let mut left = b.iter().map(|b| -b).collect::<Vec<_>>();
        matrix.add_product(1.0, &x, &mut left);
        let mut size = vec![0.0; x.len()];
        matrix.add_product(1.0, &x, &mut size);
        let size = size.iter().fold(1.0_f64, |a, x| a.max(x.abs()));
        for column in 0..null.basis.ncols() {
            let share: f64 = left.iter().enumerate().map(|(k, r)| r * null.basis[(k, column)]).sum();
            assert!(share.abs() < 1e-12 * size, "{share:.1e} {size:.1e}");
        }
        let mut gap = g.iter().map(|g| -g).collect::<Vec<_>>();
        tangent.jacobian.add_product(1.0, &x, &mut gap);
        assert!(gap.iter().all(|gap| gap.abs() < 1e-13), "{gap:?}");
    }
}
