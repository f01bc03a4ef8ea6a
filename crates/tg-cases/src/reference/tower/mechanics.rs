//! Geometry, mass matrix, generalised force and energy of the tower.

use super::super::linkage::{ANGLES, Form, Rotations};
use super::{CABLE_ENDS, CABLES, POINTS, Tower, TowerState};
use std::array::from_fn;

/// Length of a bar b \[m\].
pub(super) const BAR: f64 = 0.1;
/// Half the base of a triangle, also its height \[m\].
const HALF: f64 = 0.05;

/// The tower with its points, mass centres and cables as forms of the angles.
#[derive(Clone, Debug)]
pub(super) struct Mechanics {
    pub(super) tower: Tower,
    pub(super) points: [Form; POINTS],
    /// Mass centres of members 1 to 7.
    pub(super) centres: [Form; 7],
    /// Masses of members 1 to 7 \[kg\].
    masses: [f64; 7],
    /// Moment of inertia turning with each angle \[kg m²\].
    inertias: [f64; ANGLES],
    pub(super) cables: [Form; CABLES],
    pub(super) rest_lengths: [f64; CABLES],
}

impl Mechanics {
    pub(super) fn new(tower: &Tower) -> Self {
        // The three vertices, hung by the apex `p3` and turning with `angle`, and the mass centre a third of the height
        // above the base.
        let hung = |p3: Form, angle: usize| {
            [
                p3.arm(angle, [-HALF, -HALF]),
                p3.arm(angle, [HALF, -HALF]),
                p3,
                p3.arm(angle, [0.0, -2.0 * HALF / 3.0]),
            ]
        };
        let (up, half_up) = ([0.0, BAR], [0.0, 0.5 * BAR]);
        let r1i = Form::ground([0.0, 0.0], true);
        let r2i = Form::ground([2.0 * HALF, 0.0], true);
        let (p31, p32) = (r1i.arm(0, up), r2i.arm(0, up));
        let p33 = p31.shifted([HALF, HALF]);
        let [p51, p52, p53, c5] = hung(p33.arm(1, up), 2);
        let [p71, p72, p73, c7] = hung(p53.arm(3, up), 4);
        let points = [
            r1i,
            r2i,
            Form::ground([-0.1, 0.0], tower.anchors_move),
            Form::ground([0.2, 0.0], tower.anchors_move),
            p31,
            p32,
            p33,
            p51,
            p52,
            p53,
            p71,
            p72,
            p73,
        ];
        let c3 = p31.shifted([HALF, HALF / 3.0]);
        let centres =
            [r1i.arm(0, half_up), r2i.arm(0, half_up), c3, p33.arm(1, half_up), c5, p53.arm(3, half_up), c7];
        let (bar, triangle) = (tower.bar_mass, tower.triangle_mass);
        let cables = CABLE_ENDS.map(|[a, b]| points[b].minus(&points[a]));
        let upright = Rotations::new(&[0.0; ANGLES]);
        let rest_lengths = from_fn(|j| {
            let [x, y] = cables[j].position(&upright, &tower.ground(0.0));
            x.hypot(y) * if j < 2 { tower.beta } else { tower.alpha }
        });
        Self {
            tower: *tower,
            points,
            centres,
            masses: [bar, bar, triangle, bar, triangle, bar, triangle],
            inertias: [
                2.0 * tower.bar_inertia,
                tower.bar_inertia,
                tower.triangle_inertia,
                tower.bar_inertia,
                tower.triangle_inertia,
            ],
            cables,
            rest_lengths,
        }
    }

    /// M(θ), symmetric.
    pub(super) fn mass_matrix(&self, r: &Rotations) -> [[f64; ANGLES]; ANGLES] {
        let mut m = [[0.0; ANGLES]; ANGLES];
        for (centre, mass) in self.centres.iter().zip(self.masses) {
            let j = centre.jacobian(r);
            for a in 0..ANGLES {
                for b in 0..=a {
                    m[a][b] += mass * (j[a][0] * j[b][0] + j[a][1] * j[b][1]);
                }
            }
        }
        for a in 0..ANGLES {
            m[a][a] += self.inertias[a];
            (0..a).for_each(|b| m[b][a] = m[a][b]);
        }
        m
    }

    /// Q(θ, θ̇, t) with the tensions of the cables in `pulls` and none in the others.
    pub(super) fn force(
        &self,
        t: f64,
        s: &TowerState,
        r: &Rotations,
        pulls: &[bool; CABLES],
    ) -> [f64; ANGLES] {
        let ground = self.tower.ground(t);
        let mut q = [0.0; ANGLES];
        for (centre, mass) in self.centres.iter().zip(self.masses) {
            let (j, bias) = (centre.jacobian(r), centre.bias(r, &s.omega, &ground));
            let f = [-mass * bias[0], -mass * (self.tower.gravity + bias[1])];
            (0..ANGLES).for_each(|a| q[a] += f[0] * j[a][0] + f[1] * j[a][1]);
        }
        for (k, cable) in self.cables.iter().enumerate().filter(|(k, _)| pulls[*k]) {
            let ([x, y], j) = (cable.position(r, &ground), cable.jacobian(r));
            let length = x.hypot(y);
            let [vx, vy] = cable.velocity(&j, &s.omega, &ground);
            let rate = (x * vx + y * vy) / length;
            let density = self.law(k, length, rate) / length;
            (0..ANGLES).for_each(|a| q[a] -= density * (x * j[a][0] + y * j[a][1]));
        }
        q
    }

    /// f⁺ = κ (l - μ) + η l̇ of cable k.
    fn law(&self, k: usize, length: f64, rate: f64) -> f64 {
        self.tower.kappa * (length - self.rest_lengths[k]) + self.tower.eta * rate
    }

    /// l - μ and f⁺ of each cable.
    pub(super) fn cable_laws(&self, t: f64, s: &TowerState) -> [(f64, f64); CABLES] {
        let (r, ground) = (Rotations::new(&s.theta), self.tower.ground(t));
        from_fn(|k| {
            let cable = &self.cables[k];
            let [x, y] = cable.position(&r, &ground);
            let length = x.hypot(y);
            let [vx, vy] = cable.velocity(&cable.jacobian(&r), &s.omega, &ground);
            (length - self.rest_lengths[k], self.law(k, length, (x * vx + y * vy) / length))
        })
    }

    /// Tensions f \[N\]; a cable that slackens and is not in `pulls` has none.
    pub(super) fn tensions(&self, t: f64, s: &TowerState, pulls: &[bool; CABLES]) -> [f64; CABLES] {
        let laws = self.cable_laws(t, s);
        from_fn(|k| if pulls[k] || !self.tower.slacking { laws[k].1 } else { 0.0 })
    }

    /// T + V.
    pub(super) fn energy(&self, t: f64, s: &TowerState) -> f64 {
        let (r, ground) = (Rotations::new(&s.theta), self.tower.ground(t));
        let mut energy = 0.0;
        for (centre, mass) in self.centres.iter().zip(self.masses) {
            let [vx, vy] = centre.velocity(&centre.jacobian(&r), &s.omega, &ground);
            energy +=
                mass * (0.5 * (vx * vx + vy * vy) + self.tower.gravity * centre.position(&r, &ground)[1]);
        }
        energy += (0..ANGLES).map(|a| 0.5 * self.inertias[a] * s.omega[a] * s.omega[a]).sum::<f64>();
        for (stretch, _) in self.cable_laws(t, s) {
            if stretch > 0.0 || !self.tower.slacking {
                energy += 0.5 * self.tower.kappa * stretch * stretch;
            }
        }
        energy
    }

    /// θ̈ = M⁻¹ Q by Cholesky's factors without roots; not finite if M is singular.
    pub(super) fn acceleration(&self, t: f64, s: &TowerState, pulls: &[bool; CABLES]) -> [f64; ANGLES] {
        let r = Rotations::new(&s.theta);
        let (mut l, mut x) = (self.mass_matrix(&r), self.force(t, s, &r, pulls));
        for k in 0..ANGLES {
            for i in k + 1..ANGLES {
                let factor = l[i][k] / l[k][k];
                (k + 1..=i).for_each(|j| l[i][j] -= factor * l[j][k]);
                x[i] -= factor * x[k];
            }
        }
        for k in (0..ANGLES).rev() {
            x[k] = (k + 1..ANGLES).fold(x[k], |sum, i| sum - l[i][k] * x[i]) / l[k][k];
        }
        x
    }
}
