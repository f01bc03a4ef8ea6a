//! Inverse statics of large structures: the same choices as [`crate::inverse`] in the cables' own unknowns, with equilibrium
//! as equations and not eliminated.

use tg_model::Tensioned;
use tg_tangent::{Configuration, balance};

use crate::cable_equilibrium::Cables;
use crate::choice::{Affine, Row, TensionRows};
use crate::inverse::CONSISTENT;
use crate::inverse_error::InverseError;
use crate::rank::{Rank, TOLERANCE};
use crate::request::{Goal, Request};
use crate::solution::SolutionSet;
use crate::sparse_equilibrium::{Column, SMALLEST, SparseEquilibrium};

/// Acting cables above which the sparse path is taken: where the cubic cost of singular values begins to show. Estimated, not
/// yet fitted to measured runs.
pub(crate) const SPARSE_ABOVE: usize = 150;
/// Cables tied to each other up to which it is: B Bᵀ has a dense block for each group.
pub(crate) const LARGEST_GROUP: usize = 8;

/// The tensions that a request chooses, with what is known of the set.
pub(crate) fn solve(
    structure: &dyn Tensioned,
    at: &Configuration,
    cables: &Cables,
    request: &Request,
    affine: &Affine,
    given: &[Option<f64>],
    groups: &[Vec<usize>],
) -> Result<(Vec<f64>, SolutionSet), InverseError> {
    let count = cables.lengths.len();
    let mut rows: Vec<Column> = vec![Vec::new(); count];
    cables.gradient.iter().for_each(|(cable, k, value)| rows[cable].push((k, value)));
    // Orthonormal columns over a group: norms over groups are norms over cables.
    let share = |group: &[usize]| 1.0 / (group.len() as f64).sqrt();
    let column = |group: &Vec<usize>| -> Column {
        let entries = group.iter().flat_map(|&c| rows[c].iter().map(move |&(k, a)| (c, k, a)));
        entries.map(|(c, k, a)| (k, affine.slope[c] * share(group) * a)).collect()
    };
    let mut system = SparseEquilibrium::new(structure, &at.q, groups.iter().map(column).collect())?;

    let mut fixed = vec![0.0; count];
    for (c, given) in given.iter().enumerate() {
        fixed[c] = affine.slope[c] * given.unwrap_or(0.0) + affine.offset[c];
    }
    let mut right = cables.load.clone();
    cables.gradient.add_transposed_product(-1.0, &fixed, &mut right);

    let values = |y: &[f64]| -> Vec<f64> {
        let mut x: Vec<f64> = given.iter().map(|x| x.unwrap_or(0.0)).collect();
        groups.iter().zip(y).for_each(|(group, y)| group.iter().for_each(|&c| x[c] = y * share(group)));
        x
    };
    let tensions =
        |x: &[f64]| -> Vec<f64> { (0..count).map(|c| affine.slope[c] * x[c] + affine.offset[c]).collect() };
    let residual = |tensions: &[f64]| -> Result<(f64, usize), InverseError> {
        let mut force = cables.load.clone();
        cables.gradient.add_transposed_product(-1.0, tensions, &mut force);
        let (_, left) = balance(structure.mechanics(), &at.q, &force)?;
        let largest = tensions.iter().fold(at.force_scale, |a, f| a.max(f.abs()));
        let worst = |best: (f64, usize), (k, r): (usize, &f64)| {
            if r.abs() <= best.0 { best } else { (r.abs(), k) }
        };
        let (r, k) = left.iter().enumerate().fold((0.0, 0), worst);
        Ok((if r == 0.0 { 0.0 } else { r / largest }, k))
    };

    let least = system.least(&right)?;
    let particular = values(&least);
    let (left, worst) = residual(&tensions(&particular))?;
    if left.is_nan() || left > CONSISTENT {
        let mechanics = structure.mechanics();
        let coordinate = mechanics.coordinate_name(mechanics.free()[worst]);
        return Err(InverseError::NotHeld { residual: left, coordinate });
    }
    let tolerance = request.tolerance.unwrap_or(TOLERANCE).max(SMALLEST);
    let rank = Rank { rank: system.rank(tolerance)?, singular_values: Vec::new(), tolerance };

    let equations =
        if request.is_bounded() { equations(structure, at, system.columns(), &right) } else { Vec::new() };
    // The least change of a wish that balances.
    let mut nearest_to = |wish: &[f64]| -> Result<Vec<f64>, InverseError> {
        let mut missing = right.clone();
        system.subtract(wish, &mut missing);
        let change = system.least(&missing)?;
        Ok(wish.iter().zip(change).map(|(wish, change)| wish + change).collect())
    };
    let wish: Vec<f64> = match &request.goal {
        Goal::Closest(values) => {
            groups.iter().map(|group| group.iter().map(|&c| values[c]).sum::<f64>() * share(group)).collect()
        }
        Goal::MinimumNorm | Goal::LeastTotalTension => vec![0.0; groups.len()],
    };
    let y = if request.is_bounded() {
        let mut rows: Vec<Row> = fixed.iter().map(|&f| (Vec::new(), f)).collect();
        for (g, group) in groups.iter().enumerate() {
            group.iter().for_each(|&c| rows[c].0.push((g, affine.slope[c] * share(group))));
        }
        let rows = TensionRows {
            rows,
            free: groups.len(),
            nearest: wish,
            multipliers: structure.sizes().constraints,
            equations,
        };
        let acting: Vec<usize> = (0..count).filter(|&c| cables.acts[c]).collect();
        let chosen = rows.bounded(&acting, request, &|c| structure.cable_name(c))?;
        // The programme balances to its own accuracy.
        nearest_to(&chosen[..groups.len()])?
    } else {
        nearest_to(&wish)?
    };
    let set = SolutionSet {
        unknown: request.unknown,
        freedom: groups.len() - rank.rank.min(groups.len()),
        rank,
        particular,
        null_space: Vec::new(),
        residual: left,
    };
    Ok((tensions(&values(&y)), set))
}

/// B y - Aᵀλ = b, row by row, over y, then λ.
fn equations(structure: &dyn Tensioned, at: &Configuration, columns: &[Column], right: &[f64]) -> Vec<Row> {
    let mechanics = structure.mechanics();
    let mut equations: Vec<Row> = right.iter().map(|&b| (Vec::new(), b)).collect();
    for (g, column) in columns.iter().enumerate() {
        column.iter().for_each(|&(k, a)| equations[k].0.push((g, a)));
    }
    let layout = tg_model::Layout::new(mechanics);
    let mut jacobian = vec![0.0; mechanics.jacobian_pattern().len()];
    mechanics.jacobian(&at.q, &mut jacobian);
    for (&(row, i), a) in mechanics.jacobian_pattern().iter().zip(jacobian) {
        if let Some(k) = layout.unknown(i) {
            equations[k].0.push((columns.len() + row, -a));
        }
    }
    equations
}
