//! Example 2 (Sec. 6.2): the planar class-3 tower of bars 1, 2, 4, 6 and triangles 3, 5, 7 with twelve cables.

use tg_coords::{CoordType, Pose};
use tg_model::{CableLaw, Joining, MemberId, Model, ModelBuilder, Place, Signal};

use super::{BAR_MASS, GRAVITY, SPLIT, triangle};

/// Rest lengths over initial lengths: cables 3 to 12, and the auxiliary cables 1 and 2.
const ALPHA: f64 = 0.95;
const BETA: f64 = 0.998;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Setup {
    pub(crate) slacking: bool,
    /// η \[N s/m\] of all cables.
    pub(crate) damping: f64,
    /// Amplitude of the ground's motion at 3 Hz \[m\]; 0: at rest.
    pub(crate) amplitude: f64,
    /// Whether the anchors of cables 1 and 2 move with the feet.
    pub(crate) anchors_move: bool,
    /// Coordinate types of triangles 3, 5 and 7.
    pub(crate) types: [CoordType; 3],
    /// Joining of the two joints that the paper shares.
    pub(crate) joining: Joining,
    /// Part of the triangles' I_z that is J_xx.
    pub(crate) split: f64,
}

/// Undamped, cables that push, all anchors moving.
pub(crate) const UN: Setup = Setup {
    slacking: false,
    damping: 0.0,
    amplitude: 0.01,
    anchors_move: true,
    types: [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr],
    joining: Joining::Share,
    split: SPLIT,
};
/// Damped.
pub(crate) const DN: Setup = Setup { damping: 0.1, ..UN };
/// Slacking.
pub(crate) const US: Setup = Setup { slacking: true, ..UN };
/// Slacking, the anchors of the auxiliary cables at rest.
pub(crate) const US_AUX: Setup = Setup { anchors_move: false, ..US };
/// Slacking and damped so much that a step can have no solution.
pub(crate) const DAMPED_SLACKING: Setup = Setup { damping: 1.0, ..US };
/// UN with the ground at rest.
pub(crate) const STILL: Setup = Setup { amplitude: 0.0, ..UN };

pub(crate) struct Tower {
    pub(crate) model: Model<2>,
    pub(crate) triangles: [MemberId; 3],
}

pub(crate) fn tower(setup: Setup) -> Tower {
    let mut b = ModelBuilder::<2>::new();
    b.gravity(GRAVITY).unwrap();
    let bar = |b: &mut ModelBuilder<2>, name, from, to| b.bar(name, BAR_MASS, from, to).unwrap();
    let bar1 = bar(&mut b, "bar 1", [0.0, 0.0], [0.0, 0.1]);
    let bar2 = bar(&mut b, "bar 2", [0.1, 0.0], [0.1, 0.1]);
    let bar4 = bar(&mut b, "bar 4", [0.05, 0.15], [0.05, 0.25]);
    let bar6 = bar(&mut b, "bar 6", [0.05, 0.25], [0.05, 0.35]);
    let mut plate = |name, coord_type, y| {
        b.member(name, triangle(coord_type, setup.split), Pose::planar(0.0, y, 0.0)).unwrap()
    };
    let tri3 = plate("triangle 3", setup.types[0], 0.1);
    let tri5 = plate("triangle 5", setup.types[1], 0.2);
    let tri7 = plate("triangle 7", setup.types[2], 0.3);
    let (p1, p2, p3) = ([0.0, 0.0], [0.1, 0.0], [0.05, 0.05]);
    // Triangle 7 can share its apex only if the apex is a basic point.
    let top = if setup.types[2] == CoordType::Rrr { tri7.node(2) } else { tri7.at(p3) };
    let top_joining = if setup.types[2] == CoordType::Rrr { setup.joining } else { Joining::Constrain };
    let joints: [(&str, [Place<2>; 2], Joining); 6] = [
        ("1-3", [bar1.node(1), tri3.node(0)], setup.joining),
        ("6-7", [bar6.node(1), top], top_joining),
        ("2-3", [bar2.node(1), tri3.at(p2)], Joining::Constrain),
        ("3-4", [tri3.at(p3), bar4.node(0)], Joining::Constrain),
        ("4-5", [bar4.node(1), tri5.at(p3)], Joining::Constrain),
        ("5-6", [tri5.at(p3), bar6.node(0)], Joining::Constrain),
    ];
    for (name, places, joining) in joints {
        b.joint(name, &places, joining).unwrap();
    }

    let ground = |amplitude: f64| match amplitude {
        0.0 => Signal::Constant(0.0),
        amplitude => Signal::sine(amplitude, 3.0),
    };
    let anchors = ground(if setup.anchors_move { setup.amplitude } else { 0.0 });
    let r01 = b.anchor("r01", [-0.1, 0.0]).unwrap();
    let r02 = b.anchor("r02", [0.2, 0.0]).unwrap();
    b.shake("foot 1", bar1.node(0), ground(setup.amplitude)).unwrap();
    b.shake("foot 2", bar2.node(0), ground(setup.amplitude)).unwrap();
    b.shake("anchor 1", r01, anchors.clone()).unwrap();
    b.shake("anchor 2", r02, anchors).unwrap();

    let law = if setup.slacking { CableLaw::slacking(100.0) } else { CableLaw::linear(100.0) };
    let law = law.with_damping(setup.damping);
    let (aux, long, diagonal) = (0.1 * 5.0_f64.sqrt(), 0.1, 0.1 * 2.0_f64.sqrt());
    let short = 0.05 * 2.0_f64.sqrt();
    let cables: [(Place<2>, Place<2>, f64); 12] = [
        (tri5.at(p1), r01.into(), BETA * aux),
        (tri5.at(p2), r02.into(), BETA * aux),
        (bar1.node(0), bar2.node(1), ALPHA * diagonal),
        (bar1.node(1), bar2.node(0), ALPHA * diagonal),
        (tri3.at(p1), tri5.at(p1), ALPHA * long),
        (tri3.at(p2), tri5.at(p2), ALPHA * long),
        (tri3.at(p3), tri5.at(p1), ALPHA * short),
        (tri3.at(p3), tri5.at(p2), ALPHA * short),
        (tri5.at(p1), tri7.at(p1), ALPHA * long),
        (tri5.at(p2), tri7.at(p2), ALPHA * long),
        (tri5.at(p3), tri7.at(p1), ALPHA * short),
        (tri5.at(p3), tri7.at(p2), ALPHA * short),
    ];
    for (k, (from, to, rest)) in cables.into_iter().enumerate() {
        b.cable(&format!("cable {}", k + 1), from, to, law.clone(), rest).unwrap();
    }
    Tower { model: b.build().unwrap(), triangles: [tri3, tri5, tri7] }
}
