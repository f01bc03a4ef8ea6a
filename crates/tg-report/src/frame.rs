//! Where everything is at one time, and displacements of modes.

use serde::{Deserialize, Serialize};

use crate::error::ReportError;
use crate::outline::Outline;
use crate::vector::{add, cross, scale};

/// Members and cables at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Frame {
    /// Time \[s\].
    pub time: f64,
    /// Placements of the members, in the order of the outline.
    pub poses: Vec<Placement>,
    /// Cables, in the order of the outline.
    pub cables: Vec<CableFrame>,
}

/// Where a member is: a point of its frame moves from x to `position + rotation x`.
///
/// In JSON one array `[px, py, pz, qx, qy, qz, qw]`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "[Option<f64>; 7]", into = "[f64; 7]")]
pub struct Placement {
    /// Origin of the member's frame \[m\].
    pub position: [f64; 3],
    /// Unit quaternion x, y, z, w.
    pub rotation: [f64; 4],
}

/// One cable at one time.
///
/// In JSON one array `[ax, ay, az, bx, by, bz, tension, length, rest, slack]` with slack 0 or 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "[Option<f64>; 10]", into = "[f64; 10]")]
pub struct CableFrame {
    /// Its two ends \[m\].
    pub ends: [[f64; 3]; 2],
    /// Tension \[N\], positive when it pulls.
    pub tension: f64,
    /// Length \[m\].
    pub length: f64,
    /// Rest length \[m\].
    pub rest: f64,
    /// Whether it hangs loose.
    pub slack: bool,
}

/// A mode as displacements in space axes; their scale is free.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeShape {
    /// What the mode is called.
    pub label: String,
    /// Frequency \[Hz\]; none where it does not oscillate.
    pub frequency: Option<f64>,
    /// Damping ratio.
    pub damping: Option<f64>,
    /// Displacements of all vertices, members in order.
    pub vertices: Vec<[f64; 3]>,
    /// Displacements of the cables' ends.
    pub ends: Vec<[[f64; 3]; 2]>,
}

/// Modes about one placement of the structure: the document `modes` of a results folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ModeSet {
    /// The equilibrium they vibrate about.
    pub reference: Frame,
    /// The modes.
    pub list: Vec<ModeShape>,
}

/// One equilibrium or static answer; a list of them is the document `shapes` of a results folder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// What it is called.
    pub label: String,
    /// Whether it is stable, if known.
    pub stable: Option<bool>,
    /// Potential energy \[J\], if known.
    pub energy: Option<f64>,
    /// Where everything is; its time means nothing.
    pub frame: Frame,
}

impl Frame {
    /// Checks that the numbers of members and cables are those of the outline.
    ///
    /// # Errors
    /// They are not.
    pub fn check(&self, outline: &Outline) -> Result<(), ReportError> {
        let count = |what: &str, got, expected| {
            let what = format!("{what} of the frame at {} s", self.time);
            if got == expected { Ok(()) } else { Err(ReportError::Count { what, got, expected }) }
        };
        count("members", self.poses.len(), outline.members.len())?;
        count("cables", self.cables.len(), outline.cables.len())
    }

    /// Whether every number that is drawn is finite.
    pub fn is_finite(&self) -> bool {
        let poses = self.poses.iter().flat_map(|p| p.position.iter().chain(&p.rotation));
        let cables = self.cables.iter().flat_map(|c| c.ends.iter().flatten());
        self.time.is_finite() && poses.chain(cables).all(|x| x.is_finite())
    }
}

impl ModeShape {
    /// Checks that the numbers of vertices and cables are those of the outline.
    ///
    /// # Errors
    /// They are not.
    pub fn check(&self, outline: &Outline) -> Result<(), ReportError> {
        let count = |what: &str, got, expected| {
            let what = format!("{what} of {}", self.label);
            if got == expected { Ok(()) } else { Err(ReportError::Count { what, got, expected }) }
        };
        count("vertices", self.vertices.len(), outline.vertex_count())?;
        count("cables", self.ends.len(), outline.cables.len())
    }
}

impl Placement {
    /// At the origin, not turned.
    pub const IDENTITY: Self = Self { position: [0.0; 3], rotation: [0.0, 0.0, 0.0, 1.0] };

    /// A member of a plane structure, turned by `angle` \[rad\] about z.
    pub fn plane(position: [f64; 2], angle: f64) -> Self {
        let (sin, cos) = (angle / 2.0).sin_cos();
        Self { position: [position[0], position[1], 0.0], rotation: [0.0, 0.0, sin, cos] }
    }

    /// Where a point of the member's frame is.
    pub fn apply(&self, x: [f64; 3]) -> [f64; 3] {
        let [qx, qy, qz, w] = self.rotation;
        let q = [qx, qy, qz];
        let t = scale(2.0, cross(q, x));
        add(add(self.position, x), add(scale(w, t), cross(q, t)))
    }
}

impl From<Placement> for [f64; 7] {
    fn from(p: Placement) -> Self {
        let ([x, y, z], [a, b, c, w]) = (p.position, p.rotation);
        [x, y, z, a, b, c, w]
    }
}

impl From<[Option<f64>; 7]> for Placement {
    fn from(values: [Option<f64>; 7]) -> Self {
        let [x, y, z, a, b, c, w] = values.map(number);
        Self { position: [x, y, z], rotation: [a, b, c, w] }
    }
}

impl From<CableFrame> for [f64; 10] {
    fn from(c: CableFrame) -> Self {
        let [[ax, ay, az], [bx, by, bz]] = c.ends;
        [ax, ay, az, bx, by, bz, c.tension, c.length, c.rest, f64::from(u8::from(c.slack))]
    }
}

impl From<[Option<f64>; 10]> for CableFrame {
    fn from(values: [Option<f64>; 10]) -> Self {
        let [ax, ay, az, bx, by, bz, tension, length, rest, slack] = values.map(number);
        Self { ends: [[ax, ay, az], [bx, by, bz]], tension, length, rest, slack: slack != 0.0 }
    }
}

/// JSON has no NaN; its writer puts null.
fn number(x: Option<f64>) -> f64 {
    x.unwrap_or(f64::NAN)
}
