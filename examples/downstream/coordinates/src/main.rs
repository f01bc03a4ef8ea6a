//! Tracks a marker on a spinning body with natural coordinates alone.

use std::error::Error;

use nalgebra::Vector3;
use tg_coords::{CoordType, MassProperties, Member, Pose, Twist};

fn main() -> Result<(), Box<dyn Error>> {
    let mass = MassProperties::from_principal_moments(2.0, Vector3::zeros(), [0.03, 0.04, 0.05])?;
    let nodes = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let body = Member::new(CoordType::Ruvw, &nodes, mass)?;

    let pose = Pose::from_axis_angle(Vector3::new(0.0, 0.0, 1.0), Vector3::z(), 0.5)?;
    let twist = Twist::spatial(Vector3::new(0.1, 0.0, 0.0), Vector3::new(0.0, 0.0, 3.0));
    let (q, v) = (body.place(&pose), body.place_velocity(&pose, &twist));

    let marker = body.point_weights(Vector3::new(0.2, 0.0, 0.1))?;
    let (at, speed) = (marker.apply(&q), marker.apply(&v).norm());
    let energy = body.kinetic_energy(&v);
    println!(
        "marker at ({:.4}, {:.4}, {:.4}) m, {speed:.4} m/s; kinetic energy {energy:.4} J",
        at.x, at.y, at.z
    );

    let expected = 0.5 * 2.0 * 0.1_f64.powi(2) + 0.5 * 0.05 * 3.0_f64.powi(2);
    if (energy - expected).abs() < 1e-12 { Ok(()) } else { Err("the energy is not ½mv² + ½Iω²".into()) }
}
