//! A spine of rigid tetrahedra that touch only through prestressed cables; its base is fixed.

use nalgebra::Vector3;
use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_model::{BuildError, CableId, CableLaw, MemberId, Model, ModelBuilder, Place};

/// Height of a vertebra \[m\].
const HEIGHT: f64 = 0.07;
/// Distance from base to base \[m\].
const RISE: f64 = 0.035;
/// Circumradius of the base \[m\].
const RADIUS: f64 = 0.1;
/// κ \[N/m\].
const STIFFNESS: f64 = 500.0;

/// A spine.
#[derive(Clone, Debug)]
pub struct Spine {
    /// The model.
    pub model: Model<3>,
    /// Vertebrae above the fixed base, from below.
    pub bodies: Vec<MemberId>,
    /// For each vertebra three outer cables (vertical, base to base) and three inner ones (lower apex to upper base).
    pub cables: Vec<CableId>,
    /// Tension of the outer and of the inner cables \[N\].
    pub tensions: [f64; 2],
}

/// A spine of `count` vertebrae of mass 0.3 kg in coordinates RUVW above a fixed one, without gravity, with `tension`
/// \[N\] in the outer cables and damping η \[N s/m\] in all of them. The built configuration is in equilibrium: the
/// inner cables push the vertebrae apart as the outer ones pull them together.
///
/// # Errors
/// Never for a tension that 500 N/m can carry.
pub fn spine(count: usize, tension: f64, damping: f64) -> Result<Spine, BuildError> {
    let corner = |k: usize, z: f64| {
        let angle = 2.0 * std::f64::consts::PI / 3.0 * k as f64;
        [RADIUS * angle.cos(), RADIUS * angle.sin(), z]
    };
    let apex = [0.0, 0.0, HEIGHT];
    let inner = (RADIUS * RADIUS + (HEIGHT - RISE) * (HEIGHT - RISE)).sqrt();
    let tensions = [tension, tension * inner / (HEIGHT - RISE)];
    let rest = [RISE - tensions[0] / STIFFNESS, inner - tensions[1] / STIFFNESS];
    let law = CableLaw::slacking(STIFFNESS).with_damping(damping);

    let mut b = ModelBuilder::<3>::new();
    let mut lower: Vec<Place<3>> = Vec::new();
    for k in 0..3 {
        lower.push(b.anchor(&format!("corner {k}"), corner(k, 0.0))?.into());
    }
    lower.push(b.anchor("apex", apex)?.into());
    let mass = |source| BuildError::Coordinates { kind: "member", name: "vertebra".into(), source };
    let centre = Vector3::new(0.0, 0.0, 0.015);
    let properties =
        MassProperties::from_principal_moments(0.3, centre, [7.6e-4, 7.6e-4, 1.2e-3]).map_err(mass)?;
    let axes = [[0.0, 0.0, HEIGHT], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.0, 0.0, 0.1]].map(Vector3::from);
    let (mut bodies, mut cables) = (Vec::new(), Vec::new());
    for i in 0..count {
        let member = Member::new(CoordType::Ruvw, &axes, properties).map_err(mass)?;
        let pose = Pose::translation(Vector3::new(0.0, 0.0, RISE * (i + 1) as f64));
        let body = b.member(&format!("vertebra {i}"), member, pose)?;
        let upper: Vec<Place<3>> = (0..3).map(|k| body.at(corner(k, 0.0))).chain([body.at(apex)]).collect();
        for k in 0..3 {
            cables.push(b.cable(&format!("outer {i}.{k}"), lower[k], upper[k], law.clone(), rest[0])?);
        }
        for k in 0..3 {
            cables.push(b.cable(&format!("inner {i}.{k}"), lower[3], upper[k], law.clone(), rest[1])?);
        }
        bodies.push(body);
        lower = upper;
    }
    Ok(Spine { model: b.build()?, bodies, cables, tensions })
}
