//! Bodies that spin freely.

use tg_coords::{CoordType, MassProperties, Member, Pose};
use tg_integrate::State;
use tg_model::ModelBuilder;

use super::axis::{Axis, Probe};
use super::scheme::{Scheme, worse};
use super::verdict::Verdict;
use crate::TaskError;

/// Principal moments \[kg m²\], and the direction of the first spin: near the unstable middle axis.
const MOMENTS: [f64; 3] = [1.0, 2.0, 2.5];
const SPIN: [f64; 3] = [0.36, 0.8, 0.48];
/// Angle of all probes \[rad\].
const ANGLE: f64 = 10.0;
/// Angle of a step of the reference \[rad\]: its error is some 1e-13.
const FINE: f64 = 1e-3;

const SETUP: &str = "A free body of principal moments 1, 2 and 2.5 kg m² tumbles through 10 rad; distance of its three base vectors \
                     from Euler's equations with a quaternion. The limit is the scheme's order, with θ the angle a step: \
                     θ^p 10, at most 0.05.";

/// The axes of this file.
pub(super) fn axes() -> Vec<Axis> {
    let rates = [1.0, 1e2, 1e4, 1e6, 1e8, 1e12]
        .map(|rate: f64| Probe::new(format!("{rate:.0e}"), move |_| tumble(Scheme::Symplectic, rate, 0.01)));
    let schemes = Scheme::ALL
        .map(|scheme| Probe::new(format!("1e4, {}", scheme.name()), move |_| tumble(scheme, 1e4, 0.01)));
    let angles = [1e-3, 1e-2, 0.1, 0.3, 0.5, 1.0, 2.0, 3.0, std::f64::consts::TAU, 10.0];
    let coarse = angles.into_iter().flat_map(|angle| {
        [Scheme::Symplectic, Scheme::Leapfrog, Scheme::GeneralizedAlpha, Scheme::Fixed(Default::default())]
            .map(|scheme| {
                Probe::new(format!("{angle:.3}, {}", scheme.name()), move |_| tumble(scheme, 1e4, angle))
            })
    });
    vec![
        Axis {
            title: "Spin of a body, rad/s",
            setup: SETUP,
            probes: rates.into_iter().chain(schemes).collect(),
            cause: "",
        },
        Axis {
            title: "Angle of a step of a spinning body, rad",
            setup: SETUP,
            probes: coarse.collect(),
            cause: "",
        },
    ]
}

/// Largest distance of the base vectors from the reference.
fn tumble(scheme: Scheme, rate: f64, angle: f64) -> Verdict {
    let (h, end) = (angle / rate, ANGLE.max(5.0 * angle) / rate);
    let run = || -> Result<_, TaskError> {
        let mass = MassProperties::from_principal_moments(1.0, [0.0; 3].into(), MOMENTS)?;
        let nodes = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let member = Member::new(CoordType::Ruvw, &nodes.map(Into::into), mass)?;
        let mut b = ModelBuilder::<3>::new();
        let body = b.member("body", member, Pose::identity())?;
        let model = b.build()?;
        let mut v = model.velocities_at_rest();
        let spin = SPIN.map(|s| s * rate);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (node, axis) in model.member_node_ids(body)[1..].iter().zip(axes) {
            v[3 * node..3 * node + 3].copy_from_slice(&cross(spin, axis));
        }
        let tips =
            [model.form(body.at(axes[0]))?, model.form(body.at(axes[1]))?, model.form(body.at(axes[2]))?];
        let mut exact = Tumbling { quaternion: [1.0, 0.0, 0.0, 0.0], spin: SPIN, angle: 0.0 };
        let off = |state: &State| {
            exact.go_to(rate * state.t);
            let offs = tips.iter().zip(exact.axes()).map(|(tip, axis)| {
                let tip = tip.eval(&state.q);
                (0..3).map(|i| (tip[i] - axis[i]).powi(2)).sum::<f64>().sqrt()
            });
            offs.fold(0.0, worse)
        };
        scheme.follow(&model, &v, (h, end), off)
    };
    Verdict::of_motion(run(), scheme.bound(rate, (h, end)))
}

/// Euler's equations and the quaternion, by the classical scheme of order 4; time in units of 1/rate.
struct Tumbling {
    quaternion: [f64; 4],
    /// Angular velocity along the body's axes.
    spin: [f64; 3],
    angle: f64,
}

impl Tumbling {
    fn go_to(&mut self, angle: f64) {
        let steps = ((angle - self.angle) / FINE).ceil();
        let h = (angle - self.angle) / steps;
        for _ in 0..steps as usize {
            let y = self.state();
            let k1 = rate(y);
            let k2 = rate(along(y, k1, 0.5 * h));
            let k3 = rate(along(y, k2, 0.5 * h));
            let k4 = rate(along(y, k3, h));
            let sum = std::array::from_fn(|i| (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]) / 6.0);
            let y = along(y, sum, h);
            (self.quaternion, self.spin) = ([y[0], y[1], y[2], y[3]], [y[4], y[5], y[6]]);
        }
        self.angle = angle;
    }

    fn state(&self) -> [f64; 7] {
        let ([w, x, y, z], [a, b, c]) = (self.quaternion, self.spin);
        [w, x, y, z, a, b, c]
    }

    /// The body's axes in space.
    fn axes(&self) -> [[f64; 3]; 3] {
        let [w, x, y, z] = self.quaternion;
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
            [2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)],
            [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)],
        ]
    }
}

/// q̇ = ½ q ∘ ω, I ω̇ = I ω × ω.
fn rate([w, x, y, z, a, b, c]: [f64; 7]) -> [f64; 7] {
    let [i, j, k] = MOMENTS;
    [
        -0.5 * (x * a + y * b + z * c),
        0.5 * (w * a + y * c - z * b),
        0.5 * (w * b + z * a - x * c),
        0.5 * (w * c + x * b - y * a),
        (j - k) * b * c / i,
        (k - i) * c * a / j,
        (i - j) * a * b / k,
    ]
}

fn along(y: [f64; 7], k: [f64; 7], h: f64) -> [f64; 7] {
    std::array::from_fn(|i| y[i] + h * k[i])
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
