//! Structures and equilibria that several tests share.

use tg_modal::{ModeOptions, Modes, modes};
use tg_model::{CableId, CableLaw, Joining, Mechanics, MemberId, Model, ModelBuilder, Projector};
use tg_tangent::{Configuration, Constrained};

/// The built configuration.
pub(crate) fn as_built<const D: usize>(model: &Model<D>) -> Configuration {
    Configuration::at(model, &model.initial_coordinates(), &model.inputs_at(0.0)).unwrap()
}

pub(crate) fn all_modes<const D: usize>(model: &Model<D>, at: &Configuration) -> Modes {
    modes(model, at, &ModeOptions::all()).unwrap()
}

/// The equilibrium near `q` by Newton's method.
pub(crate) fn equilibrium(mechanics: &dyn Mechanics, q: &[f64], u: &[f64]) -> Configuration {
    let mut q = q.to_vec();
    for _ in 0..30 {
        let at = Configuration::at(mechanics, &q, u).unwrap();
        let mut phi = vec![0.0; mechanics.sizes().constraints];
        mechanics.constraints(&q, &mut phi);
        phi.iter_mut().for_each(|x| *x = -*x);
        let step = Constrained::stiffness(mechanics, &at).unwrap().solve(&at.residual, &phi).unwrap();
        mechanics.free().iter().zip(&step).for_each(|(&i, x)| q[i] += x);
        if step.iter().all(|x| x.abs() < 1e-14) {
            break;
        }
    }
    Configuration::at(mechanics, &q, u).unwrap()
}

/// `q + x`, moved onto the constraints.
pub(crate) fn displaced(mechanics: &dyn Mechanics, q: &[f64], x: impl Fn(usize) -> f64) -> Vec<f64> {
    let mut moved: Vec<f64> = q.iter().enumerate().map(|(i, q)| q + x(i)).collect();
    Projector::new(mechanics).unwrap().position(&mut moved).unwrap();
    moved
}

/// `aᵀ M b`.
pub(crate) fn mass_product(mechanics: &dyn Mechanics, a: &[f64], b: &[f64]) -> f64 {
    mechanics.mass().iter().map(|e| a[e.row] * e.value * b[e.col]).sum()
}

/// Largest component of `a - b` per largest component of `b`.
pub(crate) fn relative(a: &[f64], b: &[f64]) -> f64 {
    let most = |x: &mut dyn Iterator<Item = f64>| x.fold(0.0_f64, |a, x| a.max(x.abs()));
    most(&mut a.iter().zip(b).map(|(a, b)| a - b)) / most(&mut b.iter().copied())
}

/// A particle between two pegs one metre to its left and right, both cables of stiffness κ and tension T: along them
/// m ω² = 2 κ, across them m ω² = 2 T.
pub(crate) fn oscillator(
    b: &mut ModelBuilder<2>,
    name: &str,
    place: [f64; 2],
    mass: f64,
    law: &CableLaw,
    tension: f64,
) -> MemberId {
    let stiffness = match law {
        CableLaw::Linear { stiffness, .. } | CableLaw::Slacking { stiffness, .. } => *stiffness,
        CableLaw::User(_) => panic!("a linear law"),
    };
    let particle = b.particle(name, mass, place).unwrap();
    for (side, x) in [("left", -1.0), ("right", 1.0)] {
        let peg = b.anchor(&format!("{name} {side} peg"), [place[0] + x, place[1]]).unwrap();
        let rest = 1.0 - tension / stiffness;
        b.cable(&format!("{name} {side}"), peg, particle.node(0), law.clone(), rest).unwrap();
    }
    particle
}

/// A hinged mast of length 1 m and mass 2 kg that leans under a load, on guys of different stiffness.
pub(crate) struct Mast {
    pub(crate) model: Model<2>,
    pub(crate) bar: MemberId,
    pub(crate) cables: Vec<CableId>,
    /// First coordinate of the foot and of the left and right peg.
    pub(crate) supports: [usize; 3],
}

/// The mast; `ground` moves the foot along x, not the pegs.
pub(crate) fn mast(damping: f64, ground: impl Into<tg_model::Signal>) -> Mast {
    let mut b = ModelBuilder::<2>::new();
    b.gravity([0.0, -9.81]).unwrap();
    let foot = b.anchor("foot", [0.0, 0.0]).unwrap();
    b.shake("ground", foot, ground).unwrap();
    let bar = b.bar("mast", 2.0, [0.0, 0.0], [0.1, 0.99]).unwrap();
    b.joint("hinge", &[foot.into(), bar.node(0)], Joining::Share).unwrap();
    let mut cables = Vec::new();
    let mut pegs = Vec::new();
    for (name, x, stiffness, rest) in [("left", -1.0, 300.0, 1.35), ("right", 0.8, 200.0, 1.1)] {
        let peg = b.anchor(name, [x, 0.0]).unwrap();
        let law = CableLaw::slacking(stiffness).with_damping(damping);
        cables.push(b.cable(name, peg, bar.node(1), law, rest).unwrap());
        pegs.push(peg);
    }
    // A bob on the mast's top makes a second and third degree of freedom.
    let bob = b.particle("bob", 0.5, [0.1, 0.6]).unwrap();
    let law = CableLaw::slacking(150.0).with_damping(damping);
    cables.push(b.cable("string", bar.node(1), bob.node(0), law, 0.3).unwrap());
    b.load("wind", bar.node(1), [5.0, 0.0], 1.0).unwrap();
    let model = b.build().unwrap();
    let first = |place: tg_model::Place<2>| 2 * model.form(place).unwrap().terms()[0].0;
    let supports = [first(foot.into()), first(pegs[0].into()), first(pegs[1].into())];
    Mast { model, bar, cables, supports }
}
