//! Self-stress states and mechanisms of a structure with rigid members (Pellegrino and Calladine's counting, the members
//! eliminated by N).
//!
//! ```text
//! B f = 0:  states of self-stress          s = cables - rank B
//! Bᵀ ξ = 0: mechanisms δq = N ξ            degrees of freedom - rank B - rigid motions = internal ones
//! ```

use tg_model::Tensioned;
use tg_tangent::faer::Mat;
use tg_tangent::{Configuration, TangentError, dense};

use crate::cable_equilibrium::CableEquilibrium;
use crate::rank::{Rank, TOLERANCE};
use crate::rigid::RigidMotions;

/// Self-stress states, mechanisms and rigid motions at a configuration.
#[derive(Clone, Debug)]
pub struct SelfStress {
    /// Rank of the reduced equilibrium matrix B.
    pub rank: Rank,
    /// Degrees of freedom.
    pub degrees_of_freedom: usize,
    /// Orthonormal states of self-stress: tensions \[N\] of all cables, one vector per state. Cables between prescribed
    /// points take no part.
    pub states: Vec<Vec<f64>>,
    /// Internal mechanisms, orthonormal velocities over the full coordinates: motions that change no cable's length to
    /// first order, rigid motions taken out.
    pub mechanisms: Vec<Vec<f64>>,
    /// Rigid motions of the whole that the supports leave free, over the full coordinates.
    pub rigid_motions: Vec<Vec<f64>>,
}

impl SelfStress {
    /// Analyses a configuration, which need not be in equilibrium; singular values below 1e-9 of the largest count as
    /// zero.
    ///
    /// # Errors
    /// A decomposition does not converge.
    pub fn new(structure: &dyn Tensioned, at: &Configuration) -> Result<Self, TangentError> {
        Self::with_tolerance(structure, at, TOLERANCE)
    }

    /// As [`SelfStress::new`] with another tolerance: the part of the largest singular value below which others count as
    /// zero. Coordinates rounded to four digits want 1e-3.
    ///
    /// # Errors
    /// A decomposition does not converge.
    pub fn with_tolerance(
        structure: &dyn Tensioned,
        at: &Configuration,
        tolerance: f64,
    ) -> Result<Self, TangentError> {
        let cables = CableEquilibrium::new(structure, at)?;
        let basis = &cables.null_space.basis;
        let freedom = basis.ncols();
        let svd = dense::svd(&cables.matrix)?;
        let rank = Rank::new(svd.values, tolerance);
        let states = (rank.rank..cables.acting.len()).map(|k| {
            let mut tensions = vec![0.0; cables.lengths.len()];
            for (c, &cable) in cables.acting.iter().enumerate() {
                tensions[cable] = svd.right[(c, k)];
            }
            tensions
        });
        let rigid_motions = RigidMotions::free(structure, &at.q)?.fields(structure, &at.q);
        let all = svd.left.subcols(rank.rank, freedom - rank.rank);
        let free = structure.mechanics().free();
        let rigid = Mat::from_fn(free.len(), rigid_motions.len(), |r, c| rigid_motions[c][free[r]]);
        let internal = complement(&all.to_owned(), &(basis.transpose() * rigid))?;
        let shapes = basis * internal;
        let mechanisms = (0..shapes.ncols()).map(|k| {
            let mut full = vec![0.0; at.q.len()];
            free.iter().enumerate().for_each(|(r, &i)| full[i] = shapes[(r, k)]);
            full
        });
        Ok(Self {
            states: states.collect(),
            mechanisms: mechanisms.collect(),
            degrees_of_freedom: freedom,
            rank,
            rigid_motions,
        })
    }
}

/// Orthonormal basis of the part of span(`space`) that is orthogonal to `other`, a subset of it; columns of `space` are
/// orthonormal.
fn complement(space: &Mat<f64>, other: &Mat<f64>) -> Result<Mat<f64>, TangentError> {
    if other.ncols() == 0 || space.ncols() == 0 {
        return Ok(space.to_owned());
    }
    let inside = other.transpose() * space;
    let svd = dense::svd(&inside)?;
    let rank = svd.values.iter().filter(|&&s| s > TOLERANCE * svd.values[0]).count();
    Ok(space * svd.right.subcols(rank, space.ncols() - rank))
}
