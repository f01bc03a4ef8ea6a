//! Why a case cannot be run.

use thiserror::Error;

/// Any failure of the layers beneath; a case adds nothing of its own.
#[derive(Debug, Error)]
pub enum CaseError {
    /// The model cannot be built.
    #[error(transparent)]
    Build(#[from] tg_model::BuildError),
    /// A place is not of the model.
    #[error(transparent)]
    Place(#[from] tg_model::PlaceError),
    /// A member cannot be made.
    #[error(transparent)]
    Coordinates(#[from] tg_coords::CoordsError),
    /// A simulation cannot start.
    #[error(transparent)]
    Start(#[from] tg_integrate::StartError),
    /// A simulation failed.
    #[error(transparent)]
    Run(#[from] tg_integrate::RunError),
    /// No multipliers or tangent at a configuration.
    #[error(transparent)]
    Tangent(#[from] tg_tangent::TangentError),
    /// No rest lengths hold a configuration.
    #[error(transparent)]
    Inverse(#[from] tg_statics::InverseError),
    /// No equilibrium is found.
    #[error(transparent)]
    Forward(#[from] tg_statics::ForwardError),
    /// No critical parameter is found.
    #[error(transparent)]
    Critical(#[from] tg_statics::CriticalError),
    /// A branch of equilibria cannot be followed.
    #[error(transparent)]
    Continuation(#[from] tg_statics::ContinuationError),
    /// All equilibria of a structure cannot be had.
    #[error(transparent)]
    Equilibria(#[from] tg_equilibria::EquilibriaError),
    /// No modes about an equilibrium.
    #[error(transparent)]
    Modal(#[from] tg_modal::ModalError),
    /// Modes cannot be followed along a parameter.
    #[error(transparent)]
    Sweep(#[from] tg_modal::SweepError),
    /// A projection failed.
    #[error(transparent)]
    Projection(#[from] tg_model::ProjectionError),
    /// No free bodies at a configuration.
    #[error(transparent)]
    FreeBody(#[from] tg_statics::FreeBodyError),
    /// Yin's equations have no solution near the free lengths.
    #[error(
        "no unloaded state of an antiprism with {struts} struts near its free lengths; take at least three struts, and lateral ties shorter than the struts"
    )]
    Unloaded {
        /// Number of struts.
        struts: usize,
    },
    /// The independent reference model cannot be solved.
    #[error("reference model: {0}")]
    Reference(#[from] crate::reference::ReferenceError),
}
