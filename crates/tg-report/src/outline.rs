//! What a structure looks like, without where it is.

use serde::{Deserialize, Serialize};

use crate::error::ReportError;

/// The visible shape of a structure: members in their own frames, and its cables.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    /// 2 or 3; a plane structure lies in z = 0.
    pub dimension: usize,
    /// Unit vector that points upwards in pictures.
    pub up: [f64; 3],
    /// Rigid members, in the order of [`crate::Frame::poses`].
    pub members: Vec<MemberOutline>,
    /// Cables, in the order of [`crate::Frame::cables`].
    pub cables: Vec<CableOutline>,
}

/// The shape of one rigid member in its own frame; z = 0 in the plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MemberOutline {
    /// Name.
    pub name: String,
    /// How it is drawn.
    pub kind: MemberKind,
    /// Points of the member \[m\], in its local frame.
    pub vertices: Vec<[f64; 3]>,
    /// Straight edges, as indices of vertices.
    pub edges: Vec<[usize; 2]>,
    /// Triangles, as indices of vertices; counter-clockwise from outside.
    pub faces: Vec<[usize; 3]>,
    /// Radius of edges and particles \[m\]; 0 leaves it to the picture.
    pub radius: f64,
}

/// How a member is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MemberKind {
    /// A rod along its edges.
    Bar,
    /// A body: faces and edges.
    Body,
    /// A ball at its vertices.
    Particle,
}

/// A cable's name and the group it belongs to.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct CableOutline {
    /// Name.
    pub name: String,
    /// Cables of one group are shown together.
    pub group: Option<String>,
}

impl Outline {
    /// An outline without members and cables; `up` is y in the plane and z in space.
    pub fn new(dimension: usize) -> Self {
        let up = if dimension == 2 { [0.0, 1.0, 0.0] } else { [0.0, 0.0, 1.0] };
        Self { dimension, up, members: Vec::new(), cables: Vec::new() }
    }

    /// Number of vertices of all members: the length of [`crate::ModeShape::vertices`].
    pub fn vertex_count(&self) -> usize {
        self.members.iter().map(|m| m.vertices.len()).sum()
    }

    /// Checks that edges and faces name vertices and that all numbers are finite.
    ///
    /// # Errors
    /// The first member that cannot be drawn; a dimension that is not 2 or 3, or an `up` that is zero or not finite.
    pub fn check(&self) -> Result<(), ReportError> {
        let refuse =
            |member: &str, reason: String| Err(ReportError::Outline { member: member.into(), reason });
        if !matches!(self.dimension, 2 | 3) {
            return Err(ReportError::Count { what: "dimensions".into(), got: self.dimension, expected: 3 });
        }
        let square: f64 = self.up.iter().map(|x| x * x).sum();
        if !(square.is_finite() && square > 0.0) {
            return refuse("(all)", format!("the upward direction {:?} is no direction", self.up));
        }
        for m in &self.members {
            let count = m.vertices.len();
            let used = m.edges.iter().flatten().chain(m.faces.iter().flatten());
            if let Some(index) = used.into_iter().find(|&&i| i >= count) {
                return refuse(&m.name, format!("vertex {index} is used, {count} are given"));
            }
            if let Some(v) = m.vertices.iter().find(|v| v.iter().any(|x| !x.is_finite())) {
                return refuse(&m.name, format!("vertex {v:?} is not finite"));
            }
            if !(m.radius.is_finite() && m.radius >= 0.0) {
                return refuse(&m.name, format!("its radius is {}", m.radius));
            }
        }
        Ok(())
    }
}

impl MemberOutline {
    /// A bar between two points of its local frame.
    pub fn bar(name: &str, ends: [[f64; 3]; 2], radius: f64) -> Self {
        let (kind, edges) = (MemberKind::Bar, vec![[0, 1]]);
        Self { name: name.into(), kind, vertices: ends.to_vec(), edges, faces: Vec::new(), radius }
    }

    /// A body with faces between its vertices.
    pub fn body(name: &str, vertices: Vec<[f64; 3]>, edges: Vec<[usize; 2]>, faces: Vec<[usize; 3]>) -> Self {
        Self { name: name.into(), kind: MemberKind::Body, vertices, edges, faces, radius: 0.0 }
    }

    /// A particle at the origin of its local frame.
    pub fn particle(name: &str, radius: f64) -> Self {
        let (kind, vertices) = (MemberKind::Particle, vec![[0.0; 3]]);
        Self { name: name.into(), kind, vertices, edges: Vec::new(), faces: Vec::new(), radius }
    }
}
