//! The product-force test: can a self-stress stiffen the mechanisms? (Calladine and Pellegrino 1991.)
//!
//! ```text
//! Q_i = Wᵀ K_g(s_i) W,   find α:  Σ α_i Q_i positive definite,   Σ α_i s_i ≥ 0 in cables that only pull
//! ```
//! W are the internal mechanisms, K_g the geometric stiffness of the i-th state of self-stress with its constraint forces.
//! The smallest eigenvalue is concave in α: cutting planes `t ≤ Σ α_i wᵀ Q_i w`, one linear programme each, find its
//! maximum over |α_i| ≤ 1 or prove that none is positive.

use tg_model::{Layout, Tensioned};
use tg_tangent::faer::Mat;
use tg_tangent::{Configuration, Entries, TangentError, balance, dense};

use crate::cable_equilibrium::lengths;
use crate::program::{Program, ProgramError};
use crate::self_stress::SelfStress;

/// Relative gap between bound and value at which the maximum is known.
const GAP: f64 = 1e-6;
const MOST_CUTS: usize = 400;
/// A smallest eigenvalue below this part of the largest entry of the Q_i is no stiffness.
const NO_STIFFNESS: f64 = 1e-9;

/// What the product-force test finds.
#[derive(Clone, Debug, PartialEq)]
pub enum PrestressStability {
    /// There is no internal mechanism: nothing to stiffen.
    NoMechanism,
    /// This self-stress (tensions of all cables \[N\], largest |α| one) stiffens every internal mechanism.
    Stable {
        /// Tensions, one per cable.
        tensions: Vec<f64>,
        /// Smallest eigenvalue of WᵀK_gW for it \[N/m\].
        stiffness: f64,
    },
    /// No combination of self-stress states does.
    NotStable {
        /// Upper bound of the smallest eigenvalue over all combinations \[N/m\], zero or below to within rounding.
        bound: f64,
    },
}

/// Why the test has no result.
#[derive(Clone, Debug, thiserror::Error)]
pub enum PrestressError {
    /// A decomposition or a sparse system failed.
    #[error(transparent)]
    Tangent(#[from] TangentError),
    /// The linear programme failed.
    #[error(transparent)]
    Program(#[from] ProgramError),
}

/// Tests whether some self-stress stiffens all internal mechanisms to first order.
///
/// # Errors
/// A decomposition or the linear programme fails.
pub fn prestress_stability(
    structure: &dyn Tensioned,
    at: &Configuration,
    analysis: &SelfStress,
) -> Result<PrestressStability, PrestressError> {
    if analysis.mechanisms.is_empty() {
        return Ok(PrestressStability::NoMechanism);
    }
    let forms = product_forms(structure, at, analysis)?;
    let states = forms.len();
    let size = forms.iter().flat_map(|q| (0..q.nrows()).map(|i| q[(i, i)].abs())).fold(0.0, f64::max);
    if size == 0.0 {
        return Ok(PrestressStability::NotStable { bound: 0.0 });
    }
    // Unknowns α, then t per size of the Q_i; maximise t.
    let mut program = Program::new(states + 1);
    program.cost(states, -1.0);
    for i in 0..states {
        program.between(&[(i, 1.0)], -1.0, 1.0);
    }
    for cable in (0..structure.cable_count()).filter(|&c| structure.only_pulls(c)) {
        let row: Vec<_> = analysis.states.iter().map(|s| s[cable]).enumerate().collect();
        if row.iter().any(|&(_, s)| s != 0.0) {
            program.at_least(&row, 0.0);
        }
    }
    program.at_most(&[(states, 1.0)], 2.0 * states as f64 * analysis.mechanisms.len() as f64);
    let mut best = (f64::NEG_INFINITY, vec![0.0; states]);
    let mut bound = f64::INFINITY;
    for _ in 0..MOST_CUTS {
        let x = program.solve()?;
        bound = bound.min(x[states] * size);
        let sum = Mat::from_fn(forms[0].nrows(), forms[0].ncols(), |r, c| {
            forms.iter().zip(&x).map(|(q, a)| a * q[(r, c)]).sum()
        });
        let (values, vectors) = dense::symmetric_eigen(&sum)?;
        if values[0] > best.0 {
            best = (values[0], x[..states].to_vec());
        }
        if bound - best.0 <= GAP * size || bound <= NO_STIFFNESS * size {
            break;
        }
        for k in (0..values.len()).take_while(|&k| values[k] <= bound) {
            let w = vectors.col(k);
            let value = |q: &Mat<f64>| {
                let product = q * w;
                (0..w.nrows()).map(|i| w[i] * product[i]).sum::<f64>() / size
            };
            let cut: Vec<_> = forms.iter().map(|q| -value(q)).enumerate().chain([(states, 1.0)]).collect();
            program.at_most(&cut, 0.0);
        }
    }
    if best.0 <= NO_STIFFNESS * size {
        return Ok(PrestressStability::NotStable { bound });
    }
    let tension = |c: usize| analysis.states.iter().zip(&best.1).map(|(s, a)| a * s[c]).sum();
    let tensions = (0..structure.cable_count()).map(tension).collect();
    Ok(PrestressStability::Stable { tensions, stiffness: best.0 })
}

/// Q_i, one per state of self-stress.
fn product_forms(
    structure: &dyn Tensioned,
    at: &Configuration,
    analysis: &SelfStress,
) -> Result<Vec<Mat<f64>>, TangentError> {
    let mechanics = structure.mechanics();
    let layout = Layout::new(mechanics);
    let n = layout.unknowns();
    let free = mechanics.free();
    let w = Mat::from_fn(n, analysis.mechanisms.len(), |r, c| analysis.mechanisms[c][free[r]]);
    let mut values = vec![0.0; mechanics.stiffness_pattern().len()];
    let (_, gradient) = lengths(structure, &at.q);
    let mut forms = Vec::new();
    for state in &analysis.states {
        structure.geometric_stiffness(&at.q, state, &mut values);
        let places = mechanics.stiffness_pattern().iter();
        let geometric =
            places.zip(&values).map(|(&(r, c), &value)| (layout.unknown(r), layout.unknown(c), value));
        let mut force = vec![0.0; n];
        gradient.add_transposed_product(-1.0, state, &mut force);
        let (lambda, _) = balance(mechanics, &at.q, &force)?;
        let hessian = mechanics
            .constraint_hessian()
            .iter()
            .map(|e| (layout.unknown(e.row), layout.unknown(e.col), -lambda[e.constraint] * e.value));
        let stiffness = Entries::new(n, n, geometric.chain(hessian));
        forms.push(w.transpose() * stiffness.times(&w));
    }
    Ok(forms)
}
