//! Example 1 (Sec. 6.1): double pendulum of a bar and a triangle, in its two angles.
//!
//! θ1 is the bar's angle, θ2 that of the line from the joint to the triangle's mass centre, both counted from the downward
//! vertical, counterclockwise positive; ω = θ̇. With the bar's length l1, its mass m1 with centre at l1/2, the distance c
//! from the joint to the triangle's mass centre, and I1, I2 about the own mass centres:
//! ```text
//! A = I1 + m1 l1²/4 + m2 l1²,   B = m2 l1 c,   C = I2 + m2 c²
//! G1 = (m1/2 + m2) g l1,        G2 = m2 g c,   Δ = θ1 - θ2
//! A θ̈1 + B cosΔ θ̈2 + B sinΔ ω2² + G1 sinθ1 = 0
//! B cosΔ θ̈1 + C θ̈2 - B sinΔ ω1² + G2 sinθ2 = 0
//! E = ½ A ω1² + ½ C ω2² + B cosΔ ω1 ω2 - G1 cosθ1 - G2 cosθ2
//! ```

use super::ode::{Flow, integrate};
use super::{ReferenceError, Trajectory};

/// Parameters and start of the double pendulum; the pivot is the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulum {
    /// Mass of the bar m1 \[kg\].
    pub bar_mass: f64,
    /// Length of the bar l1 \[m\].
    pub bar_length: f64,
    /// Moment of inertia of the bar about its mass centre I1 \[kg m²\].
    pub bar_inertia: f64,
    /// Mass of the triangle m2 \[kg\].
    pub triangle_mass: f64,
    /// Distance from the joint to the triangle's mass centre c \[m\].
    pub triangle_arm: f64,
    /// Moment of inertia of the triangle about its mass centre I2 \[kg m²\].
    pub triangle_inertia: f64,
    /// Gravity g along -y \[m/s²\].
    pub gravity: f64,
    /// State at t = 0.
    pub start: PendulumState,
}

/// Angles and angular velocities of the double pendulum.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PendulumState {
    /// θ1, θ2 \[rad\].
    pub theta: [f64; 2],
    /// ω1, ω2 \[rad/s\].
    pub omega: [f64; 2],
}

impl DoublePendulum {
    /// The paper's pendulum, released from rest at θ1 = 45°, θ2 = 90° + atan(1/3).
    pub fn paper() -> Self {
        let (bar_mass, triangle_mass) = (2.693_497_779_8e-2, 0.127_142_559_7);
        let bar_length = 0.05 * std::f64::consts::SQRT_2;
        Self {
            bar_mass,
            bar_length,
            bar_inertia: bar_mass * bar_length * bar_length / 12.0,
            triangle_mass,
            triangle_arm: 0.05_f64.hypot(0.05 / 3.0),
            triangle_inertia: triangle_mass * (0.1 * 0.1 / 24.0 + 0.05 * 0.05 / 18.0),
            gravity: 9.81,
            start: PendulumState {
                theta: [std::f64::consts::FRAC_PI_4, std::f64::consts::FRAC_PI_2 + (1.0_f64 / 3.0).atan()],
                omega: [0.0; 2],
            },
        }
    }

    /// States at `times` \[s\], ascending and counted from the start.
    ///
    /// Rounding is the only error left. The motion of [`Self::paper`] multiplies it by about 1e3 until 4 s, where the
    /// angles are good to 2e-13 and the angular velocities to 2e-12.
    ///
    /// # Errors
    /// [`ReferenceError::Times`] for bad times; [`ReferenceError::StepTooSmall`] if parameters or start make the motion
    /// undefined.
    pub fn solve(&self, times: &[f64]) -> Result<Trajectory<PendulumState>, ReferenceError> {
        let PendulumState { theta, omega } = self.start;
        let mut flow = *self;
        let states = integrate(&mut flow, [theta[0], theta[1], omega[0], omega[1]], vec![], times)?;
        let state = |y: &[f64; 4]| PendulumState { theta: [y[0], y[1]], omega: [y[2], y[3]] };
        Ok(Trajectory { t: times.to_vec(), states: states.iter().map(state).collect() })
    }

    /// Mechanical energy E = T + V \[J\], V = 0 with every mass at the pivot's height.
    pub fn energy(&self, state: &PendulumState) -> f64 {
        let ([a, b, c], [g1, g2]) = self.coefficients();
        let ([t1, t2], [w1, w2]) = (state.theta, state.omega);
        0.5 * a * w1 * w1 + 0.5 * c * w2 * w2 + b * (t1 - t2).cos() * w1 * w2 - g1 * t1.cos() - g2 * t2.cos()
    }

    /// Position of the joint of bar and triangle \[m\].
    pub fn joint(&self, state: &PendulumState) -> [f64; 2] {
        let (s, c) = state.theta[0].sin_cos();
        [self.bar_length * s, -self.bar_length * c]
    }

    /// Position of the triangle's mass centre \[m\].
    pub fn triangle_centre(&self, state: &PendulumState) -> [f64; 2] {
        let [x, y] = self.joint(state);
        let (s, c) = state.theta[1].sin_cos();
        [x + self.triangle_arm * s, y - self.triangle_arm * c]
    }

    /// (A, B, C) and (G1, G2) of the module's equations.
    fn coefficients(&self) -> ([f64; 3], [f64; 2]) {
        let (m1, l, i1) = (self.bar_mass, self.bar_length, self.bar_inertia);
        let (m2, c, i2) = (self.triangle_mass, self.triangle_arm, self.triangle_inertia);
        let inertia = [i1 + (0.25 * m1 + m2) * l * l, m2 * l * c, i2 + m2 * c * c];
        (inertia, [(0.5 * m1 + m2) * self.gravity * l, m2 * self.gravity * c])
    }
}

impl Flow<4> for DoublePendulum {
    fn rate(&self, _t: f64, y: &[f64; 4]) -> [f64; 4] {
        let ([a, b, c], [g1, g2]) = self.coefficients();
        let [t1, t2, w1, w2] = *y;
        let (sin, cos) = (t1 - t2).sin_cos();
        let q1 = -b * sin * w2 * w2 - g1 * t1.sin();
        let q2 = b * sin * w1 * w1 - g2 * t2.sin();
        let coupling = b * cos;
        let det = a * c - coupling * coupling;
        [w1, w2, (c * q1 - coupling * q2) / det, (a * q2 - coupling * q1) / det]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Framework reference values, minimal-coordinate high-precision model: t, θ1, θ2, ω1, ω2.
    const EXACT: [[f64; 5]; 9] = [
        [0.0, std::f64::consts::FRAC_PI_4, 1.892546881191539, 0.0, 0.0],
        [0.5, -0.47349766785882125, -1.3007886271613862, 0.24268573087198347, 16.093957504565367],
        [1.0, 0.3640123860387474, -1.0906605155143851, -6.806669667553429, -15.62341063219045],
        [1.5, 0.3267531878807273, 1.703472005978412, -9.732265926655767, 6.55037466818096],
        [2.0, -0.7715897021793574, 0.6500787323827419, 4.649560629294233, 16.986815152990836],
        [2.5, -1.5571321557311955, -0.0009542549380557145, 4.30906165126639, -7.772448795392879],
        [3.0, 0.06698737412429974, 0.875762240601908, 10.976334274322662, -26.046489632081173],
        [3.5, 1.6375817248470173, -0.3094199150098389, 3.641685153330027, 5.777907585360429],
        [4.0, 0.11754504309792366, -1.7144247877918897, 2.789432395799691, 13.976808034654036],
    ];

    #[test]
    fn agrees_with_the_framework_reference_values() -> Result<(), ReferenceError> {
        let p = DoublePendulum::paper();
        let run = p.solve(&EXACT.map(|row| row[0]))?;
        for (row, s) in EXACT.iter().zip(&run.states) {
            for k in 0..2 {
                assert!((s.theta[k] - row[1 + k]).abs() < 1e-12, "θ at {} s: {s:?}", row[0]);
                assert!((s.omega[k] - row[3 + k]).abs() < 5e-12, "ω at {} s: {s:?}", row[0]);
            }
        }
        Ok(())
    }

    #[test]
    fn start_is_the_papers_figure() {
        let p = DoublePendulum::paper();
        for k in 0..2 {
            assert!((p.joint(&p.start)[k] - [0.05, -0.05][k]).abs() < 1e-17);
            assert!((p.triangle_centre(&p.start)[k] - [0.1, -0.05 + 0.05 / 3.0][k]).abs() < 2e-17);
        }
        // Framework reference value E0; by hand: the bar's centre at -0.025, the triangle's at -0.1/3.
        assert!((p.energy(&p.start) + 0.048_181_420_326_859_5).abs() < 1e-16);
        let by_hand = -9.81 * (p.bar_mass * 0.025 + p.triangle_mass * 0.1 / 3.0);
        assert!((p.energy(&p.start) - by_hand).abs() < 1e-16);
    }

    #[test]
    fn energy_is_constant() -> Result<(), ReferenceError> {
        let p = DoublePendulum::paper();
        let times: Vec<f64> = (0..=1000).map(|k| 0.02 * f64::from(k)).collect();
        let e0 = p.energy(&p.start);
        for (t, s) in times.iter().zip(&p.solve(&times)?.states) {
            assert!((p.energy(s) - e0).abs() < 1e-12 * e0.abs(), "{t}");
        }
        Ok(())
    }

    /// Kinetic energy from the velocities of the mass centres, which are differences of their positions.
    #[test]
    fn energy_is_that_of_the_moving_bodies() -> Result<(), ReferenceError> {
        let p = DoublePendulum::paper();
        let d = 1e-5;
        let run = p.solve(&[0.7 - 2.0 * d, 0.7 - d, 0.7, 0.7 + d, 0.7 + 2.0 * d])?;
        let rate = |f: &dyn Fn(&PendulumState) -> f64| {
            let v: Vec<f64> = run.states.iter().map(f).collect();
            (v[0] - 8.0 * v[1] + 8.0 * v[3] - v[4]) / (12.0 * d)
        };
        let mut kinetic = 0.0;
        for k in 0..2 {
            let omega = rate(&|s| s.theta[k]);
            assert!((omega - run.states[2].omega[k]).abs() < 1e-8, "ω is not dθ/dt");
            kinetic += 0.5 * [p.bar_inertia, p.triangle_inertia][k] * omega * omega;
            kinetic += 0.5 * p.bar_mass * rate(&|s| 0.5 * p.joint(s)[k]).powi(2);
            kinetic += 0.5 * p.triangle_mass * rate(&|s| p.triangle_centre(s)[k]).powi(2);
        }
        let s = &run.states[2];
        let height = p.bar_mass * 0.5 * p.joint(s)[1] + p.triangle_mass * p.triangle_centre(s)[1];
        assert!((kinetic + p.gravity * height - p.energy(s)).abs() < 1e-10);
        Ok(())
    }

    /// Small swings: det(G - ω² M) = 0 is a quadratic in ω²; each mode swings as a cosine.
    #[test]
    fn small_swings_have_the_closed_form_frequencies() -> Result<(), ReferenceError> {
        let mut p = DoublePendulum::paper();
        let (m1, m2, l, c) = (p.bar_mass, p.triangle_mass, p.bar_length, p.triangle_arm);
        // Moments of inertia about pivot and joint (rod: m l²/3), coupling and gravity.
        let (a, b, d) = (m1 * l * l / 3.0 + m2 * l * l, m2 * l * c, p.triangle_inertia + m2 * c * c);
        let (g1, g2) = (9.81 * l * (m1 / 2.0 + m2), 9.81 * m2 * c);
        let (q2, q1, q0) = (a * d - b * b, -(a * g2 + d * g1), g1 * g2);
        for sign in [-1.0, 1.0] {
            let w2 = (-q1 + sign * (q1 * q1 - 4.0 * q2 * q0).sqrt()) / (2.0 * q2);
            let size = 1e-6;
            let shape = [size, size * (g1 - w2 * a) / (w2 * b)];
            p.start = PendulumState { theta: shape, omega: [0.0; 2] };
            let times = [0.1, 0.37, 1.0, 3.0];
            for (t, s) in times.iter().zip(&p.solve(&times)?.states) {
                for k in 0..2 {
                    // The next term of the expansion is cubic in the amplitude.
                    assert!((s.theta[k] - shape[k] * (w2.sqrt() * t).cos()).abs() < 1e-15, "{t} {s:?}");
                }
            }
        }
        Ok(())
    }
}
