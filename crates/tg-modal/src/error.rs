//! What can go wrong with linearised dynamics.

use tg_coords::CoordsError;
use tg_tangent::TangentError;
use thiserror::Error;

/// Why modes, responses or state matrices cannot be had.
#[derive(Clone, Debug, Error)]
pub enum ModalError {
    /// Forces do not balance: the linearisation (41) holds about an equilibrium only.
    #[error(
        "no equilibrium: the force left on the {coordinate} is {imbalance:.3e} of the largest force (at most {tolerance:.1e} is allowed); find the equilibrium first"
    )]
    NotInEquilibrium {
        /// The free coordinate with the largest residual force.
        coordinate: String,
        /// Its residual force per largest single force.
        imbalance: f64,
        /// What is allowed.
        tolerance: f64,
    },
    /// The coordinates violate a constraint.
    #[error(
        "{constraint} is violated by {residual:.3e} of its size (at most {tolerance:.1e} is allowed); project the coordinates first (Projector::position)"
    )]
    Inconsistent {
        /// The worst constraint.
        constraint: String,
        /// Its residual per size.
        residual: f64,
        /// What is allowed.
        tolerance: f64,
    },
    /// The tangent cannot be had, factored or decomposed.
    #[error(transparent)]
    Tangent(#[from] TangentError),
    /// A vector has the wrong length.
    #[error("the {what} has length {got}; it must have length {expected}")]
    Length {
        /// Which vector.
        what: &'static str,
        /// Its length.
        got: usize,
        /// The length expected.
        expected: usize,
    },
    /// An axis, cable, input or coordinate that the structure does not have.
    #[error("there is no {what} {index}; the structure has {count}, counted from 0")]
    NoSuch {
        /// What is asked for.
        what: &'static str,
        /// Its number.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A derivative is not finite.
    #[error(
        "the derivative of {what} is not finite; look for a cable of length zero or an input that is not finite"
    )]
    NotFinite {
        /// Of what by what.
        what: String,
    },
    /// A support motion that gives a free coordinate a component.
    #[error("the {coordinate} is not prescribed; a support motion can move prescribed coordinates only")]
    NotPrescribed {
        /// Its name.
        coordinate: String,
    },
    /// A direction of support motion moves nothing.
    #[error(
        "the support motion \"{name}\" moves no prescribed coordinate; give it a component that is not zero"
    )]
    NoSupportMoves {
        /// Its name.
        name: String,
    },
    /// A motion without stiffness leaves the quasi-static response undetermined.
    #[error(
        "the quasi-static response to \"{name}\" is not determined: {zero} independent motions have no stiffness; brace them, or move all supports together"
    )]
    NoQuasiStaticResponse {
        /// The support motion.
        name: String,
        /// Number of zero eigenvalues of the tangent stiffness.
        zero: usize,
    },
    /// A damped mode does not satisfy its equation.
    #[error(
        "the damped mode with eigenvalue {re:.6e} {im:+.6e}i leaves a residual of {residual:.1e} (backward error)"
    )]
    InaccurateMode {
        /// Re s \[1/s\].
        re: f64,
        /// Im s \[rad/s\].
        im: f64,
        /// Normwise backward error.
        residual: f64,
    },
    /// The velocities of a shape do not make a twist of a member.
    #[error("member \"{member}\": {source}")]
    Member {
        /// Its name.
        member: String,
        /// The reason.
        source: CoordsError,
    },
}
