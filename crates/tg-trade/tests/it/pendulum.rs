//! A bar that swings about its end, held by a spring: as a model, and in one angle.

use tg_model::{CableLaw, Joining, Model, ModelBuilder};
use tg_trade::{LOOKS, Motion};

/// Mass, length, spring.
const M: f64 = 1.2;
const L: f64 = 0.8;
const KAPPA: f64 = 40.0;
const REST: f64 = 0.7;
const PEG: [f64; 2] = [1.0, -0.6];
const G: f64 = 9.81;
/// Simulated time \[s\].
pub(crate) const END: f64 = 2.0;

pub(crate) fn model() -> Model<2> {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -G]).unwrap();
    let pivot = b.anchor("pivot", [0.0, 0.0]).unwrap();
    let peg = b.anchor("peg", PEG).unwrap();
    let bar = b.bar("bar", M, [0.0, 0.0], [L, 0.0]).unwrap();
    b.joint("hinge", &[pivot.into(), bar.node(0)], Joining::Share).unwrap();
    b.cable("spring", peg, bar.node(1), CableLaw::linear(KAPPA), REST).unwrap();
    b.build().unwrap()
}

/// Angular acceleration: weight and spring about the hinge.
fn acceleration(angle: f64) -> f64 {
    let (s, c) = angle.sin_cos();
    let tip = [L * c, L * s];
    let to = [PEG[0] - tip[0], PEG[1] - tip[1]];
    let length = to[0].hypot(to[1]);
    let tension = KAPPA * (length - REST);
    let torque = (tip[0] * to[1] - tip[1] * to[0]) * tension / length - 0.5 * M * G * L * c;
    3.0 * torque / (M * L * L)
}

/// Positions of the tip at the looks, by the classical Runge–Kutta method with a step of 8 µs: error some 1e-15.
pub(crate) fn tip() -> Vec<[f64; 2]> {
    let per_look = 2000;
    let h = END / f64::from(LOOKS) / f64::from(per_look);
    let (mut angle, mut rate) = (0.0_f64, 0.0_f64);
    let mut tips = vec![[L, 0.0]];
    for _ in 0..LOOKS {
        for _ in 0..per_look {
            let (a, b) = (rate, acceleration(angle));
            let (c, d) = (rate + 0.5 * h * b, acceleration(angle + 0.5 * h * a));
            let (e, f) = (rate + 0.5 * h * d, acceleration(angle + 0.5 * h * c));
            let (g, i) = (rate + h * f, acceleration(angle + h * e));
            angle += h / 6.0 * (a + 2.0 * c + 2.0 * e + g);
            rate += h / 6.0 * (b + 2.0 * d + 2.0 * f + i);
        }
        tips.push([L * angle.cos(), L * angle.sin()]);
    }
    tips
}

/// Largest distance of a motion's tip from the truth \[m\].
pub(crate) fn error(motion: &Motion, tips: &[[f64; 2]]) -> f64 {
    assert_eq!(motion.times.len(), tips.len());
    // Two points a look, the tip is the second.
    let points = motion.positions.chunks_exact(4).zip(tips);
    points.map(|(p, tip)| (p[2] - tip[0]).hypot(p[3] - tip[1])).fold(0.0, f64::max)
}
