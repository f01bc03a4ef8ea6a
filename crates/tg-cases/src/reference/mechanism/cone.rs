//! Where a spring with a free length has no length, V has a cone: a peak for L0 > 0, a pit for L0 < 0.
//!
//! With g the gradient of the other spring and b_i = ∂P/∂γi of the spring's end P, forces can balance at or near the
//! cone only if some unit vector n has g_i + f n·b_i = 0, f = k (d - L0), which is
//! ```text
//! f² (b_1 × b_2)² = |g_1 b_2 - g_2 b_1|²
//! ```
//! an equation without the direction n that no search can resolve there. At the cone itself n is any vector of length up
//! to one: V has an extremum there, though no derivative, if the left side is the larger.

use nalgebra::Vector2;

use super::interval::Interval;
use super::number::Number;
use super::{Jet, Model};

/// Angles at which a spring with a free length has no length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The spring, 0 or 1.
    pub spring: usize,
    /// γ1, γ2 \[rad\].
    pub angles: [f64; 2],
    /// |f| at the cone less the force that the other spring asks of it \[N\]: an extremum of V where positive.
    pub excess: f64,
}

impl Model {
    /// All cones of the potential.
    pub fn cones(&self) -> Vec<Cone> {
        (0..2).filter(|&s| self.rest[s] != 0.0).flat_map(|s| self.cones_of(s)).collect()
    }

    /// The arm of the bar and the body reaches a fixed point in two ways or none.
    fn cones_of(&self, s: usize) -> Vec<Cone> {
        let reach = Vector2::from(self.fixed[s + 1]) - Vector2::from(self.fixed[0]);
        let end = Vector2::from(self.body[s]);
        let (distance, arm) = (reach.norm(), end.norm());
        let cos = (distance * distance + self.bar * self.bar - arm * arm) / (2.0 * distance * self.bar);
        if cos.is_nan() || cos.abs() > 1.0 {
            return Vec::new();
        }
        let cone = |side: f64| {
            let bar = reach.y.atan2(reach.x) + side * cos.acos();
            let rest = reach - Vector2::new(bar.cos(), bar.sin()) * self.bar;
            let angles = [bar, rest.y.atan2(rest.x) - end.y.atan2(end.x)].map(super::wrapped);
            Cone { spring: s, angles, excess: self.excess(s, angles) }
        };
        vec![cone(1.0), cone(-1.0)]
    }

    fn excess(&self, s: usize, angles: [f64; 2]) -> f64 {
        let other = 1 - s;
        let g = self.spring(other, &self.squared(other).at(angles), self.rest[other]).0;
        let (asked, cross) = self.balance(s, angles, g);
        (self.stiffness[s] * self.rest[s]).abs() - asked.max(0.0).sqrt() / cross.abs()
    }

    /// |g_1 b_2 - g_2 b_1|² and b_1 × b_2.
    fn balance<T: Number>(&self, s: usize, angles: [T; 2], [g1, g2]: [T; 2]) -> (T, T) {
        let [(s1, c1), (s2, c2)] = angles.map(Number::sin_cos);
        let [x, y] = self.body[s].map(T::from);
        let l = T::from(self.bar);
        let (arm, end) = ([l * c1, l * s1], [c2 * x - s2 * y, s2 * x + c2 * y]);
        // b_1 and b_2 are these, both turned by a right angle.
        let asked = [0, 1].map(|i| (g1 * end[i] - g2 * arm[i]).square());
        (asked[0] + asked[1], arm[0] * end[1] - arm[1] * end[0])
    }

    /// Whether the box around a cone of spring `s` is free of equilibria for sure.
    pub(super) fn balances_nowhere(
        &self,
        s: usize,
        angles: [Interval; 2],
        own: &Jet<Interval>,
        other: &Jet<Interval>,
    ) -> bool {
        let o = 1 - s;
        if self.rest[o] != 0.0 && other.value.low <= 0.0 {
            return false;
        }
        let g = self.spring(o, other, self.rest[o].into()).0;
        let (asked, cross) = self.balance(s, angles, g);
        let force = Interval::from(self.stiffness[s]) * (own.value.sqrt() - self.rest[s].into());
        (force * cross).square().meet(asked).is_none()
    }
}
