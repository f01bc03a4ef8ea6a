//! Where the two upright configurations stand (Table 5), with exact square roots.
//!
//! With a stage height h, radii r_1 (ground, bases) and r_2 (ring) and bars of length b the twist θ of a stage is
//! ```text
//! γ = acos((h² + r_1² + r_2² - b²) / (2 r_1 r_2)),   θ = γ - 120°
//! ```

use std::array::from_fn;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

use nalgebra::{Matrix3, Rotation3, Vector3};
use tg_coords::Pose;

/// Length b of a bar \[m\].
pub const BAR_LENGTH: f64 = 0.22;
/// Height h_t of a tetrahedron \[m\].
pub const TETRAHEDRON_HEIGHT: f64 = 0.1 * FRAC_1_SQRT_2;
/// Circumradius r_1 of the ground points and of the tetrahedra's bases \[m\].
pub const BASE_RADIUS: f64 = 0.1;
/// Distance d between the bases of a Class-1 module \[m\].
const SEPARATION: f64 = TETRAHEDRON_HEIGHT / 2.0;

/// The two upright states of Table 5.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Configuration {
    /// Folded.
    Initial,
    /// Unfolded.
    Target,
}

impl Configuration {
    /// Both states in the order of deployment.
    pub const ALL: [Self; 2] = [Self::Initial, Self::Target];

    /// Name as the reference values have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Initial => "initial",
            Self::Target => "target",
        }
    }

    /// Height h of a stage of the prism \[m\].
    pub fn stage_height(self) -> f64 {
        match self {
            Self::Initial => 0.1 * FRAC_1_SQRT_2,
            Self::Target => 0.2 * FRAC_1_SQRT_2,
        }
    }

    /// Circumradius r_2 of the ring \[m\].
    pub fn ring_radius(self) -> f64 {
        match self {
            Self::Initial => 0.11,
            Self::Target => 0.07,
        }
    }

    /// Twist θ of a stage \[rad\], from the length of its bars.
    pub fn twist(self) -> f64 {
        let (h, r1, r2, b) = (self.stage_height(), BASE_RADIUS, self.ring_radius(), BAR_LENGTH);
        ((h * h + r1 * r1 + r2 * r2 - b * b) / (2.0 * r1 * r2)).acos() - TAU / 3.0
    }

    /// Ring points R_1 to R_3 \[m\].
    pub fn ring(self) -> [[f64; 3]; 3] {
        triangle(self.ring_radius(), self.twist(), self.stage_height())
    }

    /// Poses of tetrahedra 7 to 10: 7 and 8 with the apex up, 9 and 10 turned over.
    pub fn poses(self) -> [Pose<3>; 4] {
        let up = Rotation3::from_axis_angle(&Vector3::z_axis(), 2.0 * self.twist()).into_inner();
        let down = up * Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0));
        let (base, twice) = (2.0 * self.stage_height(), 2.0 * TETRAHEDRON_HEIGHT);
        let heights = [base, base + SEPARATION, base + SEPARATION + twice, base + 2.0 * SEPARATION + twice];
        from_fn(|k| Pose {
            position: Vector3::new(0.0, 0.0, heights[k]),
            rotation: if k < 2 { up } else { down },
        })
    }
}

/// Ground points G_1 to G_3 \[m\].
pub fn ground_points() -> [[f64; 3]; 3] {
    triangle(BASE_RADIUS, 0.0, 0.0)
}

/// Apex p_1 and base p_2, p_3, p_4 of a tetrahedron in its local frame \[m\], the origin in the base.
pub fn vertices() -> [[f64; 3]; 4] {
    let [p2, p3, p4] = triangle(BASE_RADIUS, 0.0, 0.0);
    [[0.0, 0.0, TETRAHEDRON_HEIGHT], p2, p3, p4]
}

/// A horizontal equilateral triangle by its circumradius, the azimuth of its first corner and its height.
fn triangle(radius: f64, azimuth: f64, height: f64) -> [[f64; 3]; 3] {
    [0.0, TAU / 3.0, -TAU / 3.0].map(|a| {
        let (sin, cos) = (a + azimuth).sin_cos();
        [radius * cos, radius * sin, height]
    })
}
