//! Examples 1 and 2 of the framework paper (GEOMETRY of the design notes), with a choice of joining and types.

use nalgebra::{Matrix2, SVector, Vector2};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::{BuildError, CableLaw, Joining, MemberId, Model, ModelBuilder, Signal};

pub(crate) const TRIANGLE_MASS: f64 = 0.1271425597;
pub(crate) const TRIANGLE_POLAR: f64 = 7.063475538888889e-5;
pub(crate) const BAR_MASS: f64 = 2.6934977798e-2;

/// Corners of the triangle in its local frame.
pub(crate) const CORNERS: [[f64; 2]; 3] = [[0.0, 0.0], [0.1, 0.0], [0.05, 0.05]];

/// The triangle of a coordinate type; `part` of its polar moment goes to J_xx.
pub(crate) fn triangle(kind: CoordType, part: f64) -> Member<2> {
    let centre = Vector2::new(0.05, 0.05 / 3.0);
    let j = Matrix2::from_diagonal(&Vector2::new(part, 1.0 - part)) * TRIANGLE_POLAR;
    let mass = MassProperties::from_second_moment(TRIANGLE_MASS, centre, j).unwrap();
    let [p1, p2, p3] = CORNERS.map(Vector2::from);
    let v = Vector2::new(0.0, 0.1);
    let nodes = match kind {
        CoordType::Ruv => [p1, p2 - p1, v],
        CoordType::Rrv => [p1, p2, v],
        _ => [p1, p2, p3],
    };
    Member::new(kind, &nodes, mass).unwrap()
}

/// Example 1 with bar and triangle.
pub(crate) struct Pendulum {
    pub(crate) model: Model<2>,
    pub(crate) bar: MemberId,
}

/// Example 1; `joinings` of the foot and of the elbow, triangle of a type and split of J.
pub(crate) fn pendulum(joinings: [Joining; 2], kind: CoordType, split: f64) -> Result<Pendulum, BuildError> {
    let mut b = ModelBuilder::new();
    b.gravity([0.0, -9.81])?;
    let pivot = b.anchor("pivot", [0.0, 0.0])?;
    let bar = b.bar("bar", BAR_MASS, [0.0, 0.0], [0.05, -0.05])?;
    let body = b.member("triangle", triangle(kind, split), Pose::translation(Vector2::new(0.05, -0.05)))?;
    b.joint("pivot joint", &[pivot.into(), bar.node(0)], joinings[0])?;
    b.joint("elbow", &[bar.node(1), body.node(0)], joinings[1])?;
    Ok(Pendulum { model: b.build()?, bar })
}

/// Coordinates of a shared-joint pendulum with a RUV triangle at bar angle `a` from the downward vertical and triangle
/// turned by `b`, in the order of the nodes: pivot, elbow, u, v.
pub(crate) fn pendulum_nodes(a: f64, b: f64) -> [SVector<f64, 2>; 4] {
    let elbow = Vector2::new(a.sin(), -a.cos()) * (0.05 * 2f64.sqrt());
    [Vector2::zeros(), elbow, Vector2::new(b.cos(), b.sin()) * 0.1, Vector2::new(-b.sin(), b.cos()) * 0.1]
}

/// How example 2 is made.
#[derive(Clone, Copy)]
pub(crate) struct TowerChoice {
    pub(crate) shared: Joining,
    pub(crate) constrained: Joining,
    pub(crate) kinds: [CoordType; 3],
    pub(crate) slacking: bool,
    pub(crate) damping: f64,
    /// Amplitude of the ground motion \[m\].
    pub(crate) shake: f64,
}

impl Default for TowerChoice {
    fn default() -> Self {
        Self {
            shared: Joining::Share,
            constrained: Joining::Constrain,
            kinds: [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr],
            slacking: false,
            damping: 0.0,
            shake: 0.0,
        }
    }
}

/// Example 2: the class-3 tower with α = 0.95, β = 0.998.
pub(crate) fn tower(choice: TowerChoice) -> Result<Model<2>, BuildError> {
    let mut b = ModelBuilder::new();
    b.gravity([0.0, -9.81])?;
    let ground = [("r1i", 0.0), ("r2i", 0.1), ("r01", -0.1), ("r02", 0.2)];
    let mut anchors = Vec::new();
    for (name, x) in ground {
        let anchor = b.anchor(name, [x, 0.0])?;
        if choice.shake != 0.0 {
            b.shake(name, anchor, Signal::sine(choice.shake, 3.0))?;
        }
        anchors.push(anchor);
    }
    let bar = |b: &mut ModelBuilder<2>, name, from, to| b.bar(name, BAR_MASS, from, to);
    let bar1 = bar(&mut b, "bar 1", [0.0, 0.0], [0.0, 0.1])?;
    let bar2 = bar(&mut b, "bar 2", [0.1, 0.0], [0.1, 0.1])?;
    let bar4 = bar(&mut b, "bar 4", [0.05, 0.15], [0.05, 0.25])?;
    let bar6 = bar(&mut b, "bar 6", [0.05, 0.25], [0.05, 0.35])?;
    let mut body =
        |name, kind, y: f64| b.member(name, triangle(kind, 0.5), Pose::translation(Vector2::new(0.0, y)));
    let t3 = body("triangle 3", choice.kinds[0], 0.1)?;
    let t5 = body("triangle 5", choice.kinds[1], 0.2)?;
    let t7 = body("triangle 7", choice.kinds[2], 0.3)?;
    // A corner as a basic point where the type has it, else as a material point.
    let corner = |t: MemberId, kind: CoordType, i: usize| {
        if i < kind.points() { t.node(i) } else { t.at(CORNERS[i]) }
    };
    let p3 = |i| corner(t3, choice.kinds[0], i);
    let p5 = |i| corner(t5, choice.kinds[1], i);
    let p7 = |i| corner(t7, choice.kinds[2], i);
    b.joint("foot 1", &[anchors[0].into(), bar1.node(0)], choice.shared)?;
    b.joint("foot 2", &[anchors[1].into(), bar2.node(0)], choice.shared)?;
    b.joint("1-3", &[bar1.node(1), p3(0)], choice.shared)?;
    b.joint("6-7", &[bar6.node(1), p7(2)], choice.shared)?;
    b.joint("2-3", &[bar2.node(1), p3(1)], choice.constrained)?;
    b.joint("3-4", &[p3(2), bar4.node(0)], choice.constrained)?;
    b.joint("4-5-6", &[p5(2), bar4.node(1), bar6.node(0)], choice.constrained)?;

    let (near, far) = (0.1, 0.1 * 5f64.sqrt());
    let apex = (0.05f64.powi(2) * 2.0).sqrt();
    let cables = [
        (p5(0), anchors[2].into(), 0.998 * far),
        (p5(1), anchors[3].into(), 0.998 * far),
        (bar1.node(0), bar2.node(1), 0.95 * near * 2f64.sqrt()),
        (bar1.node(1), bar2.node(0), 0.95 * near * 2f64.sqrt()),
        (p3(0), p5(0), 0.95 * near),
        (p3(1), p5(1), 0.95 * near),
        (p3(2), p5(0), 0.95 * apex),
        (p3(2), p5(1), 0.95 * apex),
        (p5(0), p7(0), 0.95 * near),
        (p5(1), p7(1), 0.95 * near),
        (p5(2), p7(0), 0.95 * apex),
        (p5(2), p7(1), 0.95 * apex),
    ];
    let law = if choice.slacking { CableLaw::slacking(100.0) } else { CableLaw::linear(100.0) };
    for (i, (from, to, rest)) in cables.into_iter().enumerate() {
        b.cable(&format!("cable {}", i + 1), from, to, law.clone().with_damping(choice.damping), rest)?;
    }
    b.build()
}
