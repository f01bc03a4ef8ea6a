//! Where everything is, as a function of the twenty-four coordinates.
//!
//! A tetrahedron turned by the coordinates θ out of its upright rotation R_0 stands at Cayley's rotation
//! ```text
//! R = (I + 4 / (4 + θ·θ) (θ̂ + θ̂ θ̂ / 2)) R_0        θ̂ a = θ × a
//! ```
//! whose rate at θ = 0 is the angular velocity. A ring point R_i hangs on two bars of length b, from A on the ground and B
//! on tetrahedron 7: it lies on the circle around n = (B - A)/|B - A|
//! ```text
//! R_i = (A + B)/2 + ρ (cos φ e_1 + sin φ e_2),   ρ² = b² - |B - A|²/4
//! e_1 = the part of R_i0 - (A + B)/2 across n, normalised;   e_2 = n × e_1
//! ```
//! and the angle φ is its coordinate.

use std::array::from_fn;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use nalgebra::{Matrix3, Rotation3, Vector3};
use num_dual::DualNum;

use super::{BAR_LENGTH, COORDINATES, Configuration, MASS_CENTRE};

/// A number with or without derivatives.
pub(super) trait Number: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> Number for T {}

/// Circumradius r_1 of the ground points and the bases \[m\].
const RADIUS: f64 = 0.1;
/// Height h_t of a tetrahedron \[m\].
const HEIGHT: f64 = 0.1 * FRAC_1_SQRT_2;

/// A tetrahedron's mass centre and rotation.
#[derive(Clone, Copy)]
pub(super) struct Body<T: Number> {
    pub(super) centre: Vector3<T>,
    pub(super) rotation: Matrix3<T>,
}

impl<T: Number> Body<T> {
    /// The tetrahedron with its apex at `apex`.
    fn hung(apex: Vector3<T>, rotation: Matrix3<T>) -> Self {
        Self { centre: apex - rotation * lift(apex_from_centre()), rotation }
    }

    pub(super) fn apex(&self) -> Vector3<T> {
        self.centre + self.rotation * lift(apex_from_centre())
    }

    /// Corner 0, 1 or 2 of the base, p_2 to p_4 of the paper.
    pub(super) fn base(&self, corner: usize) -> Vector3<T> {
        let local = on_circle(RADIUS, corner, 0.0, -MASS_CENTRE);
        self.centre + self.rotation * lift(local)
    }
}

/// The structure in one position.
#[derive(Clone, Copy)]
pub(super) struct Figure<T: Number> {
    pub(super) ground: [Vector3<T>; 3],
    pub(super) ring: [Vector3<T>; 3],
    /// Tetrahedra 7 to 10.
    pub(super) bodies: [Body<T>; 4],
}

impl<T: Number> Figure<T> {
    /// The figure at the coordinates `x`, which are zero in the upright configuration: displacement of the mass centre
    /// and rotation of tetrahedron 7, displacement of the apex of 8 and its rotation, rotation of 9, displacement of the
    /// mass centre and rotation of 10, angles of the ring points.
    pub(super) fn new(configuration: Configuration, x: &[T; COORDINATES]) -> Self {
        let at = |k: usize| Vector3::new(x[k], x[k + 1], x[k + 2]);
        let (h, ring_radius) = configuration.stage();
        let twist = ring_azimuth(h, ring_radius);
        let up = Rotation3::from_axis_angle(&Vector3::z_axis(), 2.0 * twist).into_inner();
        let down = up * Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        let over = |height: f64| lift(Vector3::new(0.0, 0.0, height));
        let apex8 = 2.0 * h + 1.5 * HEIGHT;
        let centre10 = 2.0 * h + 3.0 * HEIGHT - MASS_CENTRE;
        let apex = over(apex8) + at(6);
        let bodies = [
            Body { centre: over(2.0 * h + MASS_CENTRE) + at(0), rotation: turned(&at(3), &up) },
            Body::hung(apex, turned(&at(9), &up)),
            Body::hung(apex, turned(&at(12), &down)),
            Body { centre: over(centre10) + at(15), rotation: turned(&at(18), &down) },
        ];
        let ground = from_fn(|i| lift(on_circle(RADIUS, i, 0.0, 0.0)));
        let ring = from_fn(|i| {
            let upright = lift(on_circle(ring_radius, i, twist, h));
            hanging_point(&upright, &ground[(i + 2) % 3], &bodies[0].base((i + 1) % 3), x[21 + i])
        });
        Self { ground, ring, bodies }
    }

    /// Ends of bars 1 to 6.
    pub(super) fn bars(&self) -> [[Vector3<T>; 2]; 6] {
        from_fn(|k| {
            let (i, next) = (k % 3, (k + 1) % 3);
            if k < 3 { [self.ground[i], self.ring[next]] } else { [self.ring[i], self.bodies[0].base(next)] }
        })
    }

    /// Ends of cables 1 to 24.
    pub(super) fn cables(&self) -> [[Vector3<T>; 2]; 24] {
        let (ground, ring, [b7, b8, b9, b10]) = (&self.ground, &self.ring, &self.bodies);
        from_fn(|k| {
            let i = k % 3;
            match k / 3 {
                0 => [ground[i], ring[i]],
                1 => [ring[i], ring[(i + 1) % 3]],
                2 => [ring[i], b7.base(i)],
                3 => [b7.apex(), b8.base(i)],
                4 => [b7.base(i), b8.base(i)],
                // Turned over, the corners of 9 run the other way round.
                5 => [b8.base(i), b9.base((3 - i) % 3)],
                6 => [b9.base(i), b10.base(i)],
                _ => [b9.base(i), b10.apex()],
            }
        })
    }
}

/// The apex as seen from the mass centre, local \[m\].
fn apex_from_centre() -> Vector3<f64> {
    Vector3::new(0.0, 0.0, HEIGHT - MASS_CENTRE)
}

/// Azimuth of the ring point over ground point 1 \[rad\] by the law of cosines: bar 1 leads from that ground point to the
/// ring point a third of a turn further.
fn ring_azimuth(h: f64, ring_radius: f64) -> f64 {
    let cos = (h * h + RADIUS * RADIUS + ring_radius * ring_radius - BAR_LENGTH * BAR_LENGTH)
        / (2.0 * RADIUS * ring_radius);
    cos.acos() - TAU / 3.0
}

/// Corner `k` of a horizontal equilateral triangle \[m\].
fn on_circle(radius: f64, k: usize, azimuth: f64, height: f64) -> Vector3<f64> {
    let angle = azimuth + TAU / 3.0 * k as f64;
    Vector3::new(radius * angle.cos(), radius * angle.sin(), height)
}

fn lift<T: Number>(v: Vector3<f64>) -> Vector3<T> {
    v.map(T::from)
}

/// Cayley's rotation by `theta` after `upright`.
fn turned<T: Number>(theta: &Vector3<T>, upright: &Matrix3<f64>) -> Matrix3<T> {
    let zero = T::from(0.0);
    let hat = Matrix3::new(zero, -theta.z, theta.y, theta.z, zero, -theta.x, -theta.y, theta.x, zero);
    let factor = (theta.dot(theta) + 4.0).recip() * 4.0;
    (Matrix3::identity() + (hat + hat * hat * T::from(0.5)) * factor) * upright.map(T::from)
}

/// The point at a bar's length from `a` and `b` that is `upright` at φ = 0.
fn hanging_point<T: Number>(upright: &Vector3<T>, a: &Vector3<T>, b: &Vector3<T>, phi: T) -> Vector3<T> {
    let (middle, across) = ((a + b) * T::from(0.5), b - a);
    let squared = across.dot(&across);
    let n = across * squared.sqrt().recip();
    let from_middle = upright - middle;
    let e1 = from_middle - n * n.dot(&from_middle);
    let e1 = e1 * e1.dot(&e1).sqrt().recip();
    let e2 = n.cross(&e1);
    let radius = (-squared * 0.25 + BAR_LENGTH * BAR_LENGTH).sqrt();
    middle + (e1 * phi.cos() + e2 * phi.sin()) * radius
}
