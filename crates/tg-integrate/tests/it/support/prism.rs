//! Prestressed prisms of three bars, stacked: the rings of neighbours are shared.
//!
//! Ring k lies at height k H, its points at azimuths 120° i + 30° k. In each prism a vertical cable spans 30° from ring
//! to ring and a bar 150°, the twist 90° - 180°/3 of a self-stressed triangular prism. With force density s of the
//! vertical cables the bars have -s and the cables of a ring s/√3 for each prism that touches it: at a point
//! `-3 s_ring r + s |T_0 - T_1| = -3 s_ring r + s √3 r = 0`.

use tg_model::{CableLaw, Joining, MemberId, Model, ModelBuilder, Place};

/// Radius of the rings and height of a prism \[m\].
const RADIUS: f64 = 0.1;
const HEIGHT: f64 = 0.15;
/// Force density of the vertical cables \[N/m\].
const FORCE_DENSITY: f64 = 20.0;
const STIFFNESS: f64 = 500.0;
pub(crate) const BAR_MASS: f64 = 0.08;

pub(crate) struct Prisms {
    pub(crate) model: Model<3>,
    pub(crate) bars: Vec<MemberId>,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Setup {
    /// Number of prisms.
    pub(crate) count: usize,
    /// Whether the lowest ring is fixed.
    pub(crate) fixed: bool,
    /// g along -z \[m/s²\].
    pub(crate) gravity: f64,
    pub(crate) damping: f64,
    pub(crate) slacking: bool,
}

/// One prism that floats free of gravity.
pub(crate) const FLOATING: Setup =
    Setup { count: 1, fixed: false, gravity: 0.0, damping: 0.0, slacking: false };
/// One prism that stands on the ground.
pub(crate) const STANDING: Setup = Setup { fixed: true, gravity: 9.81, ..FLOATING };

fn point(ring: usize, i: usize) -> [f64; 3] {
    let azimuth = (120.0 * i as f64 + 30.0 * ring as f64).to_radians();
    [RADIUS * azimuth.cos(), RADIUS * azimuth.sin(), HEIGHT * ring as f64]
}

pub(crate) fn prisms(setup: Setup) -> Prisms {
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -setup.gravity]).unwrap();
    let mut bars = Vec::new();
    for k in 0..setup.count {
        for i in 0..3 {
            let name = format!("bar {k}.{i}");
            bars.push(b.bar(&name, BAR_MASS, point(k, i), point(k + 1, (i + 1) % 3)).unwrap());
        }
    }
    // Point i of ring k: the foot of bar k.i, or the head of the bar below for the highest ring.
    let place = |k: usize, i: usize| -> Place<3> {
        if k < setup.count { bars[3 * k + i].node(0) } else { bars[3 * (k - 1) + (i + 2) % 3].node(1) }
    };
    for k in 1..setup.count {
        for i in 0..3 {
            let below = bars[3 * (k - 1) + (i + 2) % 3].node(1);
            b.joint(&format!("joint {k}.{i}"), &[below, place(k, i)], Joining::Share).unwrap();
        }
    }
    if setup.fixed {
        (0..3).for_each(|i| b.fix(&format!("foot {i}"), place(0, i)).unwrap());
    }
    let law = if setup.slacking { CableLaw::slacking(STIFFNESS) } else { CableLaw::linear(STIFFNESS) };
    let law = law.with_damping(setup.damping);
    let mut cable = |name: String, from: (usize, usize), to: (usize, usize), density: f64| {
        let (p, q) = (point(from.0, from.1), point(to.0, to.1));
        let length = (0..3).map(|d| (q[d] - p[d]).powi(2)).sum::<f64>().sqrt();
        let rest = length * (1.0 - density / STIFFNESS);
        b.cable(&name, place(from.0, from.1), place(to.0, to.1), law.clone(), rest).unwrap();
    };
    for k in 0..=setup.count {
        let touching = if k == 0 || k == setup.count { 1.0 } else { 2.0 };
        for i in 0..3 {
            let density = touching * FORCE_DENSITY / 3.0_f64.sqrt();
            cable(format!("ring {k}.{i}"), (k, i), (k, (i + 1) % 3), density);
            if k < setup.count {
                cable(format!("vertical {k}.{i}"), (k, i), (k + 1, i), FORCE_DENSITY);
            }
        }
    }
    Prisms { model: b.build().unwrap(), bars }
}
