//! What can be wrong with a member: one variant per cause, each message with the remedy.

use crate::CoordType;

/// Why a member, a mass, a pose or a list of coordinates was refused.
///
/// Lengths are in metres, moments in kg m².
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoordsError {
    /// A list has the wrong number of nodes for its coordinate type.
    #[error(
        "coordinate type {coord_type} has {expected} nodes (basic points first, then base vectors), \
         {found} were given"
    )]
    NodeCount {
        /// Type of the member.
        coord_type: CoordType,
        /// Number of nodes of the type.
        expected: usize,
        /// Number of nodes given.
        found: usize,
    },
    /// The type spans more or fewer directions than a member of this space can have.
    #[error(
        "coordinate type {coord_type} spans {} directions and describes no member of {dimension}D space; \
         use {} for a body, RU or RR for a bar, R for a particle",
        coord_type.span(),
        if *.dimension == 2 { "RUV, RRV or RRR" } else { "RUVW, RRVW, RRRW or RRRR" }
    )]
    Dimension {
        /// Type that does not fit.
        coord_type: CoordType,
        /// Dimension of the space.
        dimension: usize,
    },
    /// A conversion between types that span different numbers of directions.
    #[error(
        "coordinate type {from} cannot be converted to {to}: they span {} and {} directions, and only \
         types of one span describe the same member",
        from.span(),
        to.span()
    )]
    Span {
        /// Type of the member.
        from: CoordType,
        /// Type asked for.
        to: CoordType,
    },
    /// A name that is none of the ten coordinate types.
    #[error(
        "`{name}` is no coordinate type; the types are RUVW, RRVW, RRRW, RRRR, RUV, RRV, RRR, RU, RR and R"
    )]
    UnknownType {
        /// The name given.
        name: String,
    },
    /// A number is NaN or infinite, or overflowed.
    #[error("{what} is not finite; check the numbers and their units")]
    NotFinite {
        /// The quantity.
        what: &'static str,
    },
    /// The base vectors are collinear, coplanar or of zero length.
    #[error(
        "the base vectors of coordinate type {coord_type} are degenerate (collinear, coplanar or of zero length): \
         condition number {condition:.3e}, at most {limit:.0e} is accepted; choose basic points and base \
         vectors of similar length that point in clearly different directions"
    )]
    DegenerateBasis {
        /// Type of the member.
        coord_type: CoordType,
        /// Condition number of X̄ (eq. A.1), infinite if X̄ is singular.
        condition: f64,
        /// Largest accepted value, [`CONDITION_LIMIT`](crate::CONDITION_LIMIT).
        limit: f64,
    },
    /// The mass is zero or negative.
    #[error("mass {mass} kg is not positive; use `MassProperties::massless` for a member without inertia")]
    Mass {
        /// The mass given \[kg\].
        mass: f64,
    },
    /// A matrix that must be symmetric is not.
    #[error("{what} is not symmetric: two mirrored entries differ by {asymmetry:.3e} of its largest entry")]
    NotSymmetric {
        /// The matrix.
        what: &'static str,
        /// Largest difference of mirrored entries over the largest entry.
        asymmetry: f64,
    },
    /// Moments of inertia that no distribution of mass has.
    #[error(
        "the moments of inertia ({}, {}, {}) kg m² violate the triangle inequality: {violated}; no \
         distribution of mass has them, \
         check that they are taken about the mass centre, and their digits",
        moments[0], moments[1], moments[2]
    )]
    TriangleInequality {
        /// The violated inequality, such as `I_x + I_y < I_z`; `I_1 ≤ I_2 ≤ I_3` are the principal moments.
        violated: &'static str,
        /// The three moments that it compares.
        moments: [f64; 3],
    },
    /// A second moment of mass with a negative eigenvalue.
    #[error(
        "the second moment of mass J has the negative eigenvalue {eigenvalue:.6e} kg m²; J = ∫ρ r rᵀ is \
         positive semidefinite, \
         check that it was not mistaken for the inertia matrix"
    )]
    NegativeSecondMoment {
        /// The smallest eigenvalue \[kg m²\].
        eigenvalue: f64,
    },
    /// A point or vector that a bar cannot carry.
    #[error(
        "the {what} lies {distance:.3e} m off the axis of the bar; the nearest on the axis is {nearest:?}; \
         a member with parts off a line needs a body type (RUV… in the plane, RUVW… in space)"
    )]
    OffAxis {
        /// Point, vector or mass centre.
        what: &'static str,
        /// Distance from the axis \[m\].
        distance: f64,
        /// Nearest point or vector on the axis, local frame \[m\].
        nearest: Vec<f64>,
    },
    /// A point or vector that a particle cannot carry.
    #[error(
        "the {what} lies {distance:.3e} m off the particle, which carries its own point only; use a bar \
         or a body"
    )]
    OffParticle {
        /// Point, vector or mass centre.
        what: &'static str,
        /// Distance from the particle, or length of the vector \[m\].
        distance: f64,
    },
    /// The inertia of a bar in space does not lie along its axis.
    #[error(
        "the second moment of mass of a bar in space must lie along its axis (a thin bar has no inertia \
         about it): \
         axial part {axial:.3e} kg m², rest {rest:.3e} kg m²; use `MassProperties::rod` or `thin_rod` \
         with this axis, or a body type"
    )]
    ThickBar {
        /// Part along the axis \[kg m²\].
        axial: f64,
        /// Size of the rest (Frobenius norm) \[kg m²\].
        rest: f64,
    },
    /// A particle was given rotational inertia.
    #[error(
        "a particle has no rotational inertia, but tr J = {trace:.3e} kg m²; use \
         `MassProperties::point` or a body type"
    )]
    ExtendedParticle {
        /// Trace of the second moment \[kg m²\].
        trace: f64,
    },
    /// A matrix is not a rotation.
    #[error(
        "{what} is not a rotation: RᵀR differs from the identity by {deviation:.3e}, det R = \
         {determinant:.6}; \
         orthonormalise its columns and make them right-handed"
    )]
    NotRotation {
        /// The matrix.
        what: &'static str,
        /// Largest entry of RᵀR − I.
        deviation: f64,
        /// Determinant.
        determinant: f64,
    },
    /// An axis has no direction.
    #[error("{what} has zero length and gives no direction")]
    ZeroAxis {
        /// The axis.
        what: &'static str,
    },
    /// Coordinates so far from any rigid placement that no rotation fits them best.
    #[error(
        "no rotation fits the coordinates of type {coord_type} best: the base vectors have collapsed or \
         are turned inside out"
    )]
    NoOrientation {
        /// Type of the member.
        coord_type: CoordType,
    },
}
