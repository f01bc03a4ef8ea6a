//! Members of the planar examples: uniform bars and the isosceles right-angled triangle (Tables 2 and 3).

use nalgebra::{Matrix2, Vector2};
use tg_coords::{CoordType, CoordsError, MassProperties, Member};
use tg_model::{MemberId, Place};

/// Acceleration of gravity \[m/s²\].
pub const G: f64 = 9.81;
/// Mass of every planar bar \[kg\].
pub const BAR_MASS: f64 = 2.6934977798e-2;
/// Mass of the triangle \[kg\].
pub const TRIANGLE_MASS: f64 = 0.1271425597;
/// Vertices of the triangle in its local frame \[m\]: the base, then the apex.
pub const VERTICES: [[f64; 2]; 3] = [[0.0, 0.0], [0.1, 0.0], [0.05, 0.05]];

/// The triangle in a coordinate type of the plane: RUV on unit axes, RRV on the base with v = (0, 0.1), RRR on its
/// vertices. `split` is the part of I_z that goes into J_xx; only the sum matters to the motion.
///
/// # Errors
/// The type is not one of a planar body, or the split leaves [0, 1].
pub fn triangle(coord_type: CoordType, split: f64) -> Result<Member<2>, CoordsError> {
    let [p1, p2, p3] = VERTICES.map(Vector2::from);
    let nodes = match coord_type {
        CoordType::Ruv => [p1, Vector2::x(), Vector2::y()],
        CoordType::Rrv => [p1, p2, Vector2::new(0.0, 0.1)],
        _ => [p1, p2, p3],
    };
    let (jx, jy) = (TRIANGLE_MASS * 0.1 * 0.1 / 24.0, TRIANGLE_MASS * 0.05 * 0.05 / 18.0);
    let polar = jx + jy;
    let second_moment = Matrix2::new(split * polar, 0.0, 0.0, (1.0 - split) * polar);
    let centre = (p1 + p2 + p3) / 3.0;
    Member::new(coord_type, &nodes, MassProperties::from_second_moment(TRIANGLE_MASS, centre, second_moment)?)
}

/// The split of I_z of the real triangle, J = diag(m 0.1²/24, m 0.05²/18).
pub const SPLIT: f64 = 0.75;

/// Vertex `k` of a triangle: a basic point where its type has one there, else a material point.
pub fn vertex(triangle: MemberId, coord_type: CoordType, k: usize) -> Place<2> {
    if coord_type.is_point(k) { triangle.node(k) } else { triangle.at(VERTICES[k]) }
}
