//! Momentum of a structure in space from poses and twists of its members: rigid-body formulas, no mass matrix.
//!
//! ```text
//! P = Σ m ṙ_g,   L = Σ m r_g × ṙ_g + R I Rᵀ ω
//! ```

use tg_coords::MassProperties;
use tg_model::{MemberId, Model};

/// P \[kg m/s\] and L about the origin \[kg m²/s\]; mass properties in each member's local frame.
pub(crate) fn momentum(
    model: &Model<3>,
    members: &[(MemberId, MassProperties<3>)],
    q: &[f64],
    v: &[f64],
) -> ([f64; 3], [f64; 3]) {
    let (mut linear, mut angular) = ([0.0; 3], [0.0; 3]);
    for &(member, mass) in members {
        let centre = model.form(member.mass_centre()).unwrap();
        let (r, p) = (centre.eval(q), centre.eval(v) * mass.mass());
        let rotation = model.pose(member, q).unwrap().pose.rotation;
        let omega = model.twist(member, q, v).unwrap().angular_velocity();
        let spin = rotation * mass.inertia_matrix() * rotation.transpose() * omega;
        let moment = r.cross(&p) + spin;
        for d in 0..3 {
            linear[d] += p[d];
            angular[d] += moment[d];
        }
    }
    (linear, angular)
}
