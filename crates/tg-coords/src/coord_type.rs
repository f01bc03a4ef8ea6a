//! The polymorphism of Table 1: which nodes describe a member.
//!
//! A type is two integers, the number of basic points (R) and of base vectors (U, V, W). The
//! standard type of the same span keeps one point:
//!
//! ```text
//! q_std = Y q,   Y = y ⊗ I_D                                         (2), (7), (11)
//! y_0 = e_0,   y_a = e_a - e_0 if node a is a point, e_a if it is a vector    (3), (8), (11)
//! ```
//!
//! The paper prints (3) with a row missing in Y_rrvw and a wrong second row in Y_rrrr; the rule
//! above gives the correct ones. `R`, one point and no vector, is a particle; it is not in Table 1.

use core::fmt;
use core::str::FromStr;

use nalgebra::SVector;

use crate::{CoordsError, NodeMatrix};

/// Largest number of nodes of a member.
pub const MAX_NODES: usize = 4;
/// Largest number of base vectors of a standard type.
pub(crate) const MAX_SPAN: usize = MAX_NODES - 1;

/// Type of natural coordinates (Table 1), named by its nodes in order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CoordType {
    /// Body in space, one point, three vectors: the standard type.
    Ruvw,
    /// Body in space, two points, two vectors.
    Rrvw,
    /// Body in space, three points, one vector.
    Rrrw,
    /// Body in space, four points.
    Rrrr,
    /// Body in the plane, one point, two vectors: the standard type.
    Ruv,
    /// Body in the plane, two points, one vector.
    Rrv,
    /// Body in the plane, three points.
    Rrr,
    /// Bar in the plane or in space, one point, one vector: the standard type.
    Ru,
    /// Bar in the plane or in space, two points.
    Rr,
    /// Particle: one point.
    R,
}

impl CoordType {
    /// All types, in the order of Table 1, the particle last.
    pub const ALL: [CoordType; 10] = [
        CoordType::Ruvw,
        CoordType::Rrvw,
        CoordType::Rrrw,
        CoordType::Rrrr,
        CoordType::Ruv,
        CoordType::Rrv,
        CoordType::Rrr,
        CoordType::Ru,
        CoordType::Rr,
        CoordType::R,
    ];

    /// Number of basic points; they are the first nodes.
    pub const fn points(self) -> usize {
        match self {
            CoordType::Ruvw | CoordType::Ruv | CoordType::Ru | CoordType::R => 1,
            CoordType::Rrvw | CoordType::Rrv | CoordType::Rr => 2,
            CoordType::Rrrw | CoordType::Rrr => 3,
            CoordType::Rrrr => 4,
        }
    }

    /// Number of base vectors; they are the last nodes.
    pub const fn vectors(self) -> usize {
        match self {
            CoordType::Ruvw => 3,
            CoordType::Rrvw | CoordType::Ruv => 2,
            CoordType::Rrrw | CoordType::Rrv | CoordType::Ru => 1,
            CoordType::Rrrr | CoordType::Rrr | CoordType::Rr | CoordType::R => 0,
        }
    }

    /// Number of nodes, points and vectors together, at most [`MAX_NODES`].
    pub const fn nodes(self) -> usize {
        self.points() + self.vectors()
    }

    /// Number of directions that the base vectors of the standard form span: 3 or 2 for a body, 1
    /// for a bar, 0 for a particle.
    pub const fn span(self) -> usize {
        self.nodes() - 1
    }

    /// Standard type of the same span: RUVW, RUV, RU or R.
    pub const fn standard(self) -> CoordType {
        match self.span() {
            3 => CoordType::Ruvw,
            2 => CoordType::Ruv,
            1 => CoordType::Ru,
            _ => CoordType::R,
        }
    }

    /// Whether `node` is a basic point (otherwise a base vector).
    pub const fn is_point(self, node: usize) -> bool {
        node < self.points()
    }

    /// Whether the type describes a member of `dimension`-D space: a body of full span, a bar or a
    /// particle.
    pub const fn fits(self, dimension: usize) -> bool {
        self.span() <= 1 || self.span() == dimension
    }

    /// Name in capitals, such as `RUVW`.
    pub const fn name(self) -> &'static str {
        match self {
            CoordType::Ruvw => "RUVW",
            CoordType::Rrvw => "RRVW",
            CoordType::Rrrw => "RRRW",
            CoordType::Rrrr => "RRRR",
            CoordType::Ruv => "RUV",
            CoordType::Rrv => "RRV",
            CoordType::Rrr => "RRR",
            CoordType::Ru => "RU",
            CoordType::Rr => "RR",
            CoordType::R => "R",
        }
    }

    /// Scalar conversion matrix y of `q_std = (y ⊗ I_D) q` (eq. 3, 8, 11).
    ///
    /// Row 0 is the form of the standard point r_i, row a that of the a-th base vector.
    pub fn conversion(self) -> NodeMatrix {
        NodeMatrix::from_fn(self.nodes(), |row, column| match (row, column) {
            _ if row == column => 1.0,
            (_, 0) if self.is_point(row) => -1.0,
            _ => 0.0,
        })
    }

    /// Converts a list of natural coordinates (or their velocities) of this type to those of the
    /// same member in type `to`, `q_to = Y_to⁻¹ Y q` (eq. 2, 7, 11).
    ///
    /// # Errors
    /// [`CoordsError::NodeCount`] for a list of the wrong length, [`CoordsError::Span`] if the two
    /// types do not span the same number of directions.
    pub fn convert<const D: usize>(
        self,
        to: CoordType,
        nodes: &[SVector<f64, D>],
    ) -> Result<Vec<SVector<f64, D>>, CoordsError> {
        self.check_count(nodes.len())?;
        if self.span() != to.span() {
            return Err(CoordsError::Span { from: self, to });
        }
        let mut converted = nodes.to_vec();
        for a in 1..self.nodes() {
            // Where both are points or both vectors the node is copied without rounding.
            match (self.is_point(a), to.is_point(a)) {
                (true, false) => converted[a] -= nodes[0],
                (false, true) => converted[a] += nodes[0],
                _ => {}
            }
        }
        Ok(converted)
    }

    /// Checks the length of a list of nodes.
    pub(crate) fn check_count(self, found: usize) -> Result<(), CoordsError> {
        if found == self.nodes() {
            return Ok(());
        }
        Err(CoordsError::NodeCount { coord_type: self, expected: self.nodes(), found })
    }

    /// The `k`-th base vector (k = 0 for u) of a list of nodes of this type.
    pub(crate) fn base_vector<const D: usize>(self, nodes: &[SVector<f64, D>], k: usize) -> SVector<f64, D> {
        if self.is_point(k + 1) { nodes[k + 1] - nodes[0] } else { nodes[k + 1] }
    }
}

impl fmt::Display for CoordType {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for CoordType {
    type Err = CoordsError;

    /// Reads a name, in capitals or small letters.
    fn from_str(name: &str) -> Result<Self, CoordsError> {
        CoordType::ALL
            .into_iter()
            .find(|t| t.name().eq_ignore_ascii_case(name))
            .ok_or_else(|| CoordsError::UnknownType { name: name.to_owned() })
    }
}
