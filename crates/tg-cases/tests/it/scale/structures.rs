//! The structures, described without dimension.

use nalgebra::{Vector2, Vector3};
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::{BuildError, CableLaw, Joining, Model, ModelBuilder, Place, Signal};

use super::{Outcome, Units};

/// A crane: a mast on shaken ground, guyed by damped cables that go slack, with a body hinged to its top, under weight and
/// a load that swings.
pub(crate) fn crane(units: Units) -> Outcome<Model<3>> {
    let at = |x| units.place(x);
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -9.81 * units.acceleration()])?;
    let foot = b.anchor("foot", at([0.0, 0.0, 0.0]))?;
    let mast = b.bar("mast", 2.0 * units.mass, at([0.0, 0.0, 0.0]), at([0.1, 0.05, 2.0]))?;
    b.joint("hinge", &[foot.into(), mast.node(0)], Joining::Share)?;
    b.shake("ground", foot, Signal::sine(0.02 * units.length, 0.7 / units.time))?;
    let jib = b.member("jib", body(units)?, Pose::translation(at([0.1, 0.05, 2.0]).into()))?;
    b.joint("pivot", &[mast.node(1), jib.at([0.0; 3])], Joining::Constrain)?;
    b.load(
        "wind",
        jib.mass_centre(),
        [3.0, -2.0, 1.0].map(|f| f * units.force()),
        Signal::sine(1.0, 1.3 / units.time),
    )?;
    let guy = CableLaw::slacking(400.0 * units.stiffness()).with_damping(3.0 * units.damping());
    let line = CableLaw::slacking(90.0 * units.stiffness());
    let spring = CableLaw::linear(60.0 * units.stiffness());
    let (top, far) = (mast.node(1), jib.at(at([0.9, 0.1, 0.0])));
    let cables: [(Place<3>, [f64; 3], CableLaw, f64); 7] = [
        (top, [-2.0, 0.0, 0.0], guy.clone(), 2.8),
        (top, [1.2, 1.7, 0.0], guy.clone(), 2.8),
        (top, [1.2, -1.7, 0.1], guy, 2.8),
        (far, [1.5, 1.5, 3.5], line.clone(), 2.1),
        (far, [1.5, -1.5, 3.5], line.clone(), 2.1),
        (far, [1.1, 0.4, 0.0], line, 2.06),
        (jib.at(at([-0.3, 0.2, 0.3])), [-1.0, 0.7, 3.0], spring, 0.9),
    ];
    for (k, (to, peg, law, rest)) in cables.into_iter().enumerate() {
        let peg = b.anchor(&format!("peg {k}"), at(peg))?;
        b.cable(&format!("cable {k}"), peg, to, law, rest * units.length)?;
    }
    Ok(b.build()?)
}

fn body(units: Units) -> Outcome<Member<3>> {
    let inertia = units.mass * units.length * units.length;
    let centre = Vector3::from(units.place([0.4, 0.0, 0.1]));
    let moments = [0.02, 0.05, 0.06].map(|m| m * inertia);
    let mass = MassProperties::from_principal_moments(1.5 * units.mass, centre, moments)?;
    let nodes = [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.1, 0.4, 0.0], [0.0, 0.1, 0.3]];
    Ok(Member::new(CoordType::Ruvw, &nodes.map(|x| units.place(x).into()), mass)?)
}

/// A free prism of three bars, prestressed: one state of self-stress, one internal mechanism, six rigid motions.
pub(crate) fn prism(units: Units) -> Result<Model<3>, BuildError> {
    // Of unit radius and height, in equilibrium at a twist of 30°: force densities √3 in the vertical cables, 1 in the others.
    let (twist, third) = (std::f64::consts::FRAC_PI_6, std::f64::consts::TAU / 3.0);
    let corner = |k: usize, turn: f64, z: f64| {
        let angle = k as f64 * third + turn;
        [angle.cos(), angle.sin(), z]
    };
    let (low, high) = (|k| corner(k, 0.0, 0.0), |k| corner(k, twist, 1.0));
    let mut b = ModelBuilder::<3>::new();
    let mut bars = Vec::new();
    for k in 0..3 {
        let ends = [units.place(low(k)), units.place(high(k + 1))];
        bars.push(b.bar(&format!("bar {k}"), units.mass, ends[0], ends[1])?);
    }
    let stiffness = 100.0;
    let mut cable = |name: String, a: Place<3>, c: Place<3>, ends: [[f64; 3]; 2], density: f64| {
        let length = (Vector3::from(ends[0]) - Vector3::from(ends[1])).norm();
        let law = CableLaw::slacking(stiffness * units.stiffness());
        b.cable(&name, a, c, law, length * (1.0 - density / stiffness) * units.length)
    };
    for k in 0..3 {
        let next = (k + 1) % 3;
        let before = (k + 2) % 3;
        cable(format!("low {k}"), bars[k].node(0), bars[next].node(0), [low(k), low(next)], 1.0)?;
        cable(format!("high {k}"), bars[k].node(1), bars[next].node(1), [low(k), low(next)], 1.0)?;
        let ends = [low(k), high(k)];
        cable(format!("up {k}"), bars[k].node(0), bars[before].node(1), ends, 3.0_f64.sqrt())?;
    }
    b.build()
}

/// A net of particles between two walls: many cables, no constraint.
pub(crate) fn net(units: Units, rows: usize, columns: usize) -> Result<Model<3>, BuildError> {
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -0.5 * units.acceleration()])?;
    let at = |r: usize, c: usize| {
        let (x, y) = (c as f64, r as f64);
        [x, y, 0.1 * x * (columns as f64 + 1.0 - x) - 0.05 * y * (rows as f64 + 1.0 - y)]
    };
    let mut places = vec![vec![None; columns + 2]; rows + 2];
    for (r, row) in places.iter_mut().enumerate() {
        for (c, place) in row.iter_mut().enumerate() {
            let (name, x) = (format!("{r}.{c}"), units.place(at(r, c)));
            let inside = (1..=rows).contains(&r) && (1..=columns).contains(&c);
            *place = Some(if inside {
                b.particle(&name, 0.1 * units.mass, x)?.node(0)
            } else {
                b.anchor(&name, x)?.into()
            });
        }
    }
    let law = CableLaw::slacking(50.0 * units.stiffness());
    for r in 0..rows + 2 {
        for c in 0..columns + 2 {
            for (r2, c2) in [(r + 1, c), (r, c + 1)] {
                let border = |r: usize, c: usize| r == 0 || c == 0 || r == rows + 1 || c == columns + 1;
                if r2 > rows + 1 || c2 > columns + 1 || (border(r, c) && border(r2, c2)) {
                    continue;
                }
                let length = (Vector3::from(at(r, c)) - Vector3::from(at(r2, c2))).norm();
                if let (Some(a), Some(z)) = (places[r][c], places[r2][c2]) {
                    b.cable(&format!("{r}.{c} {r2}.{c2}"), a, z, law.clone(), 0.9 * length * units.length)?;
                }
            }
        }
    }
    b.build()
}

/// A plate on two springs with free lengths and a bar on a third: several equilibria.
pub(crate) fn linkage(units: Units) -> Outcome<Model<2>> {
    let at = |x| units.place(x);
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -1.5 * units.acceleration()])?;
    let foot = b.anchor("foot", at([0.0, 0.0]))?;
    let bar = b.bar("bar", units.mass, at([0.0, 0.0]), at([0.3, 1.0]))?;
    b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share)?;
    let inertia = units.mass * units.length * units.length;
    let mass =
        MassProperties::from_polar_moment(0.5 * units.mass, Vector2::from(at([0.2, 0.1])), 0.02 * inertia)?;
    let nodes = [[0.0, 0.0], [0.5, 0.0], [0.2, 0.4]].map(|x| at(x).into());
    let plate = Member::new(CoordType::Rrr, &nodes, mass)?;
    let plate = b.member("plate", plate, Pose::translation(at([0.3, 1.0]).into()))?;
    b.joint("pin", &[bar.node(1), plate.node(0)], Joining::Share)?;
    b.load("push", plate.node(2), [0.4, -0.2].map(|f| f * units.force()), 1.0)?;
    for (name, peg, to, rest) in
        [("left", [-1.0, 0.2], plate.node(2), 1.1), ("right", [1.4, 0.1], plate.node(1), 0.8)]
    {
        let peg = b.anchor(name, at(peg))?;
        let law = CableLaw::linear(8.0 * units.stiffness());
        b.cable(&format!("{name} spring"), peg, to, law, rest * units.length)?;
    }
    Ok(b.build()?)
}

/// An upright bar on a hinge between two springs of 8 units, pressed down by a load at its top: it stands up to 16 units.
pub(crate) fn column(units: Units) -> Result<Model<2>, BuildError> {
    let at = |x| units.place(x);
    let mut b = ModelBuilder::<2>::new();
    let foot = b.anchor("foot", at([0.0, 0.0]))?;
    let bar = b.bar("bar", units.mass, at([0.0, 0.0]), at([0.0, 1.0]))?;
    b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share)?;
    for (name, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(name, at([x, 1.0]))?;
        let law = CableLaw::linear(8.0 * units.stiffness());
        b.cable(&format!("{name} spring"), peg, bar.node(1), law, units.length)?;
    }
    b.load("weight", bar.node(1), [0.0, 0.0], 1.0)?;
    b.build()
}
