//! Natural coordinates of one rigid member: types, weights of points, intrinsic constraints, scalar mass.
//!
//! A member (body, bar or particle, in the plane or in space) is described by a short list of
//! D-vectors, its *nodes*: basic points first, then base vectors. They obey dot-product constraints
//! instead of angles, so positions are linear in them, the mass matrix is constant, and no
//! trigonometric function appears. Every quantity is a small scalar pattern ⊗ I_D; the ten
//! coordinate types differ in two integers only, and one implementation serves them all.
//!
//! The symbols and equation numbers are those of Luo, Wu and Xu, "A Unified Framework for Dynamic
//! Analysis of Tensegrity Structures with Arbitrary Rigid Bodies and Rigid Bars" (Sec. 2 and Appendix A).
//!
//! ```
//! use nalgebra::Vector2;
//! use tg_coords::{CoordType, MassProperties, Member, Pose, Twist};
//!
//! // A triangular plate by its three corners, I_z = 7e-5 kg m² about its mass centre.
//! let corners = [[0.0, 0.0], [0.1, 0.0], [0.05, 0.05]].map(Vector2::from);
//! let mass = MassProperties::from_polar_moment(0.127, Vector2::new(0.05, 0.05 / 3.0), 7e-5)?;
//! let plate = Member::new(CoordType::Rrr, &corners, mass)?;
//!
//! let (pose, twist) = (Pose::planar(1.0, 2.0, 0.3), Twist::planar(Vector2::new(0.5, 0.0), 4.0));
//! let (q, q_dot) = (plate.place(&pose), plate.place_velocity(&pose, &twist));
//! let tip = plate.point_weights(Vector2::new(0.05, 0.02))?.apply(&q); // C q
//! assert!((tip - pose.apply_point(&Vector2::new(0.05, 0.02))).norm() < 1e-14);
//! assert!(plate.constraints().iter().all(|phi| phi.residual(&q).abs() < 1e-14));
//! assert!((plate.twist(&q, &q_dot)?.angular_velocity() - 4.0).abs() < 1e-10);
//! assert!(plate.kinetic_energy(&q_dot) > 0.5 * 7e-5 * 16.0);
//! # Ok::<(), tg_coords::CoordsError>(())
//! ```
//!
//! | paper | item |
//! |---|---|
//! | Table 1; q of (1), (6) | [`CoordType`] |
//! | Y of (3), (8), (11) | [`CoordType::conversion`], [`CoordType::convert`], [`Member::with_type`] |
//! | C of (4), (9), (12), (14)–(16) | [`Weights`], [`Member::point_weights`] |
//! | Φ of (5), (10), (13) | [`DotConstraint`], [`Member::constraints`] |
//! | T of (17) | [`Member::kinetic_energy`] |
//! | M of (18), (A.3) | [`MassMatrix`], [`Member::mass_matrix`] |
//! | X̄ of (A.1), c of (A.2) | [`Member::condition`], [`CONDITION_LIMIT`], [`Member::point_weights`] |
//! | J of (A.4), (A.6), I of (A.5) | [`MassProperties`] |
//!
//! Beyond the paper: particles, arbitrary local frames, best-fit poses and twists ([`Member::pose`],
//! [`Member::twist`]).
//!
//! Coordinates are in metres, masses in kilograms, angles in radians. Nothing but construction and
//! the methods that return a `Vec` allocates; each of the latter has an `_into` twin.

/// Coordinate types of Table 1 and the conversions between them.
mod coord_type;
/// Linear forms over nodes.
mod weights;

/// Scalar matrices over nodes.
mod node_matrix;

/// Singular value decomposition of up to three vectors.
mod svd;

/// X̄, its pseudoinverse and its condition.
mod basis;
/// Mass, mass centre, second moment.
mod mass;
/// Assembly of the mass matrix.
mod mass_matrix;

/// Intrinsic constraints.
mod constraint;
/// Best-fit rotations.
mod fit;
/// Pose and twist.
mod pose;

/// The member that ties these together.
mod member;

/// What can be wrong.
mod error;

pub use basis::CONDITION_LIMIT;
pub use constraint::DotConstraint;
pub use coord_type::{CoordType, MAX_NODES};
pub use error::CoordsError;
pub use mass::MassProperties;
pub use mass_matrix::MassMatrix;
pub use member::Member;
pub use node_matrix::NodeMatrix;
pub use pose::{Pose, PoseFit, Twist};
pub use weights::Weights;

/// Relative size below which a deviation of input counts as rounding: an offset from a bar's axis, an
/// asymmetry, a violated triangle inequality, a lack of orthonormality.
///
/// Far above the rounding of any computed input, far below what a number typed with seven digits
/// misses: such input is refused with the size of the deviation rather than mended in silence.
pub const ROUNDING_TOLERANCE: f64 = 1e-9;
