//! The critical value of a parameter: where the lowest eigenvalue of the reduced Hessian passes through zero.

use tg_model::{BuildError, Tensioned};
use tg_tangent::faer::Mat;
use tg_tangent::{Configuration, EigenOptions, EigenPair, Metric, TangentError, dense, lowest};
use thiserror::Error;

use crate::family::Family;
use crate::forward::Forward;
use crate::forward_error::ForwardError;
use crate::forward_options::ForwardOptions;
use crate::rigid::RigidMotions;
use crate::root::find_root;

/// A critical equilibrium.
#[derive(Clone, Debug)]
pub struct Critical {
    /// Value of the parameter.
    pub parameter: f64,
    /// The equilibrium there.
    pub configuration: Configuration,
    /// The eigenpair that is zero: its shape is the way in which stability is lost.
    pub pair: EigenPair,
    /// Equilibria that were computed.
    pub evaluations: u32,
}

/// Why there is no critical value.
#[derive(Debug, Error)]
pub enum CriticalError {
    /// The family has no structure at a value of the parameter.
    #[error(transparent)]
    Family(#[from] BuildError),
    /// No equilibrium at a value of the parameter.
    #[error("at the parameter {parameter}: {source}")]
    Forward {
        /// The parameter.
        parameter: f64,
        /// The reason.
        source: Box<ForwardError>,
    },
    /// A tangent or decomposition failed.
    #[error(transparent)]
    Tangent(#[from] TangentError),
    /// The eigenvalue has the same sign at both ends.
    #[error(
        "the lowest eigenvalue is {low:.6e} N/m at {from} and {high:.6e} N/m at {to}: no sign change, no critical value between them for certain"
    )]
    NoChange {
        /// One end.
        from: f64,
        /// The other end.
        to: f64,
        /// Eigenvalue at `from` \[N/m\].
        low: f64,
        /// Eigenvalue at `to` \[N/m\].
        high: f64,
    },
    /// Every motion is a rigid one.
    #[error("the structure has no motion but rigid ones")]
    Rigid,
}

/// Finds the critical value between `bracket.0` and `bracket.1`, where the lowest eigenvalues have opposite signs. Each
/// equilibrium starts from full coordinates `q`; rigid motions without work are left out of the eigenvalues.
///
/// # Errors
/// No equilibrium at some value, or no change of sign.
pub fn critical_parameter(
    family: &dyn Family,
    q: &[f64],
    bracket: (f64, f64),
) -> Result<Critical, CriticalError> {
    let mut evaluations = 0;
    let mut at = |parameter: f64| -> Result<(f64, Configuration, EigenPair), CriticalError> {
        evaluations += 1;
        let instance = family.at(parameter)?;
        let options = ForwardOptions { relax: false, ..ForwardOptions::default() };
        let found = Forward::new(instance.structure(), options).solve(q, &instance.u);
        let found = found.map_err(|source| CriticalError::Forward { parameter, source: Box::new(source) })?;
        let pair =
            lowest_internal(instance.structure(), &found.configuration)?.ok_or(CriticalError::Rigid)?;
        Ok((pair.value, found.configuration, pair))
    };
    let (low, high) = (at(bracket.0)?.0, at(bracket.1)?.0);
    if low * high > 0.0 {
        return Err(CriticalError::NoChange { from: bracket.0, to: bracket.1, low, high });
    }
    let parameter = find_root((bracket.0, low), (bracket.1, high), |p| at(p).map(|found| found.0))?;
    let (_, configuration, pair) = at(parameter)?;
    Ok(Critical { parameter, configuration, pair, evaluations })
}

/// The lowest eigenpair that is no rigid motion without work.
fn lowest_internal(structure: &dyn Tensioned, at: &Configuration) -> Result<Option<EigenPair>, TangentError> {
    let motions = RigidMotions::free(structure, &at.q)?.without_work(structure, &at.q, &at.u)?;
    let count = motions.count();
    let options = EigenOptions::new(2 * count + 1, Metric::Coordinates);
    let spectrum = lowest(structure.mechanics(), at, &options)?;
    let free = structure.free();
    let fields = motions.fields(structure, &at.q);
    let rigid = Mat::from_fn(free.len(), count, |r, c| fields[c][free[r]]);
    let basis = if count == 0 { rigid } else { dense::svd(&rigid)?.left.subcols(0, count).to_owned() };
    // Share of a shape in the rigid motions: one for them, zero for all others.
    let share = |pair: &EigenPair| -> f64 {
        let dot =
            |c: usize| free.iter().enumerate().map(|(r, &i)| basis[(r, c)] * pair.shape[i]).sum::<f64>();
        (0..count).map(|c| dot(c).powi(2)).sum()
    };
    Ok(spectrum.pairs.into_iter().find(|pair| share(pair) < 0.5))
}
