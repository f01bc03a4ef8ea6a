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
    /// A projection failed.
    #[error(transparent)]
    Projection(#[from] tg_model::ProjectionError),
    /// The independent reference model cannot be solved.
    #[error("reference model: {0}")]
    Reference(#[from] crate::reference::ReferenceError),
}
