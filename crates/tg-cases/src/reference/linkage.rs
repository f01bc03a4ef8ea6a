//! Points carried by rotating arms: the kinematics of a planar linkage with independent angles.
//!
//! Every point of a linkage whose angles θ are independent is
//! ```text
//! p = p0 + γ x_g e_x + Σ_a R(θ_a) ρ_a,   R(θ) the rotation by θ
//! ṗ = γ ẋ_g e_x + Σ_a θ̇_a R(θ_a) ρ_a⊥,   ρ⊥ = (-ρ_y, ρ_x)          (columns of the Jacobian: R(θ_a) ρ_a⊥)
//! p̈ = J θ̈ + γ ẍ_g e_x - Σ_a θ̇_a² R(θ_a) ρ_a                        (the last two terms: the bias)
//! ```
//! with constants p0 \[m\], arms ρ_a \[m\] and share γ (0 or 1) of the ground's motion x_g. Differences of points, such as
//! cables, have the same form.

/// Number of angles.
pub(super) const ANGLES: usize = 5;

/// Horizontal motion of the ground: displacement \[m\], velocity \[m/s\], acceleration \[m/s²\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    pub(super) x: f64,
    pub(super) v: f64,
    pub(super) a: f64,
}

/// A point, or a difference of points, of the linkage.
#[derive(Clone, Copy, Debug)]
pub(super) struct Form {
    fixed: [f64; 2],
    ground: f64,
    arms: [[f64; 2]; ANGLES],
}

impl Form {
    /// A point of the ground at `fixed`, moving with it if `moves`.
    pub(super) fn ground(fixed: [f64; 2], moves: bool) -> Self {
        Self { fixed, ground: f64::from(u8::from(moves)), arms: [[0.0; 2]; ANGLES] }
    }

    /// The point displaced by `d` without rotation.
    pub(super) fn shifted(mut self, d: [f64; 2]) -> Self {
        (0..2).for_each(|k| self.fixed[k] += d[k]);
        self
    }

    /// The point displaced by `rho`, which rotates with angle number `angle`.
    pub(super) fn arm(mut self, angle: usize, rho: [f64; 2]) -> Self {
        (0..2).for_each(|k| self.arms[angle][k] += rho[k]);
        self
    }

    /// The vector from `from` to `self`.
    pub(super) fn minus(mut self, from: &Self) -> Self {
        for k in 0..2 {
            self.fixed[k] -= from.fixed[k];
            (0..ANGLES).for_each(|a| self.arms[a][k] -= from.arms[a][k]);
        }
        self.ground -= from.ground;
        self
    }

    /// p at the rotations `r`.
    pub(super) fn position(&self, r: &Rotations, ground: &Motion) -> [f64; 2] {
        let mut p = [self.fixed[0] + self.ground * ground.x, self.fixed[1]];
        for a in 0..ANGLES {
            let d = r.turn(a, self.arms[a]);
            (0..2).for_each(|k| p[k] += d[k]);
        }
        p
    }

    /// Columns of the Jacobian ∂p/∂θ.
    pub(super) fn jacobian(&self, r: &Rotations) -> [[f64; 2]; ANGLES] {
        std::array::from_fn(|a| {
            let [x, y] = self.arms[a];
            r.turn(a, [-y, x])
        })
    }

    /// ṗ for the Jacobian `jacobian` and the angular velocities `omega`.
    pub(super) fn velocity(
        &self,
        jacobian: &[[f64; 2]; ANGLES],
        omega: &[f64; ANGLES],
        ground: &Motion,
    ) -> [f64; 2] {
        let mut v = [self.ground * ground.v, 0.0];
        for a in 0..ANGLES {
            (0..2).for_each(|k| v[k] += omega[a] * jacobian[a][k]);
        }
        v
    }

    /// p̈ at θ̈ = 0.
    pub(super) fn bias(&self, r: &Rotations, omega: &[f64; ANGLES], ground: &Motion) -> [f64; 2] {
        let mut b = [self.ground * ground.a, 0.0];
        for a in 0..ANGLES {
            let d = r.turn(a, self.arms[a]);
            (0..2).for_each(|k| b[k] -= omega[a] * omega[a] * d[k]);
        }
        b
    }
}

/// Sines and cosines of the angles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rotations([(f64, f64); ANGLES]);

impl Rotations {
    pub(super) fn new(theta: &[f64; ANGLES]) -> Self {
        Self(theta.map(f64::sin_cos))
    }

    /// R(θ_a) d.
    fn turn(&self, a: usize, d: [f64; 2]) -> [f64; 2] {
        let (s, c) = self.0[a];
        [c * d[0] - s * d[1], s * d[0] + c * d[1]]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point on two arms and the ground, along θ(t) = θ0 + ω t + α t²/2 with x_g = sin t, against central differences.
    #[test]
    fn velocity_and_acceleration_are_derivatives_of_the_position() {
        let point =
            Form::ground([0.3, 0.1], true).arm(1, [0.2, -0.4]).arm(4, [-0.1, 0.7]).shifted([0.05, 0.0]);
        let other = Form::ground([0.0, 0.1], false).arm(1, [0.1, 0.1]);
        let form = point.minus(&other);
        let (omega, alpha) = ([0.4, -1.3, 2.0, 0.1, 0.9], [0.3, 0.8, -0.2, 0.5, -2.1]);
        let ground = |t: f64| Motion { x: t.sin(), v: t.cos(), a: -t.sin() };
        let at = |t: f64| {
            let theta = std::array::from_fn(|a| 0.3 * a as f64 + omega[a] * t + 0.5 * alpha[a] * t * t);
            let [p, q] = [point, other].map(|f| f.position(&Rotations::new(&theta), &ground(t)));
            [p[0] - q[0], p[1] - q[1]]
        };
        let r = Rotations::new(&std::array::from_fn(|a| 0.3 * a as f64));
        let jacobian = form.jacobian(&r);
        let velocity = form.velocity(&jacobian, &omega, &ground(0.0));
        let bias = form.bias(&r, &omega, &ground(0.0));
        let d = 1e-3;
        for k in 0..2 {
            let (m, z, p) = (at(-d)[k], at(0.0)[k], at(d)[k]);
            assert!(((p - m) / (2.0 * d) - velocity[k]).abs() < 1e-5);
            let acceleration: f64 = bias[k] + (0..ANGLES).map(|a| jacobian[a][k] * alpha[a]).sum::<f64>();
            assert!(((p - 2.0 * z + m) / (d * d) - acceleration).abs() < 1e-5);
        }
    }
}
