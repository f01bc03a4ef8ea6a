//! A guyed, prestressed prism mast: the benchmark scene that other tools were measured on.
//!
//! Level s = 0 … N has three nodes at radius R, a third of a turn apart, at height s H; a level is turned by ±45° against the
//! one below, alternately. A stage has three thin bars (turned by 165°), three vertical and three diagonal cables; each
//! level but the lowest three horizontal cables and three guys to the ground's anchors. Level 0 is hinged to the ground,
//! bars that share a node are hinged to each other. The rest lengths hold the design geometry in equilibrium under its
//! weight; then the guys are shortened by δ cos(2π (s/7 + j/3)), so that the mast, released, sways. No cable goes slack.

use std::f64::consts::{PI, TAU};

use tg_model::{BuildError, CableLaw, Joining, Model, ModelBuilder, Place};

/// Length of a bar \[m\].
const BAR: f64 = 0.22;
/// Mass of a bar \[kg\].
const MASS: f64 = 0.08;
/// Radius of a level \[m\].
const RADIUS: f64 = 0.08;
/// Turn from level to level.
const TURN: f64 = PI / 4.0;
/// (κ \[N/m\], η \[N s/m\]) of the cables within the mast and of the guys.
const CABLE: (f64, f64) = (1000.0, 2.0);
const GUY: (f64, f64) = (100.0, 0.2);
/// Tension of the vertical cables \[N\].
const TENSION: f64 = 15.0;
const GRAVITY: f64 = 9.81;
/// A guy's anchor is this far outside of its node, and this far above it \[m\].
const REACH: [f64; 2] = [0.3, 0.05];
/// Disturbance δ of the guys' rest lengths \[m\].
const DISTURBANCE: f64 = 0.015;

/// The mast and its nodes.
#[derive(Debug)]
pub struct Mast {
    /// The model: 9 free coordinates, 3 constraints and 12 cables a stage.
    pub model: Model<3>,
    /// The free nodes, level by level from 1, corners in order; the ground's three are left out.
    pub nodes: Vec<Place<3>>,
}

/// Height of a stage \[m\].
fn height() -> f64 {
    let chord = 2.0 * RADIUS * ((TURN + TAU / 3.0) / 2.0).sin();
    (BAR * BAR - chord * chord).sqrt()
}

/// +1 or -1: the way in which the stage above level `s` turns.
fn hand(s: usize) -> isize {
    if s.is_multiple_of(2) { 1 } else { -1 }
}

fn corner(j: usize, shift: isize) -> usize {
    (j as isize + shift).rem_euclid(3) as usize
}

/// Direction of a node from the axis.
fn direction(s: usize, j: usize) -> [f64; 2] {
    let level = if s.is_multiple_of(2) { 0.0 } else { TURN };
    let (sine, cosine) = (level + TAU * j as f64 / 3.0).sin_cos();
    [cosine, sine]
}

fn position(s: usize, j: usize) -> [f64; 3] {
    let [x, y] = direction(s, j);
    [RADIUS * x, RADIUS * y, s as f64 * height()]
}

/// Force densities of a stage's verticals and diagonals that balance the design geometry \[N/m\].
struct Densities {
    vertical: f64,
    diagonal: f64,
}

impl Densities {
    /// No torque on a node and no vertical force, from the turns of vertical, diagonal and bar.
    fn new() -> Self {
        let vertical = TENSION / distance(position(0, 0), position(1, 0));
        let (of_diagonal, of_bar) = (TURN - TAU / 3.0, TURN + TAU / 3.0);
        let diagonal = vertical * (TURN.sin() - of_bar.sin()) / (of_bar.sin() - of_diagonal.sin());
        Self { vertical, diagonal }
    }

    /// Of the guys of a level: they carry its weight.
    fn guy(top: bool) -> f64 {
        MASS * GRAVITY * if top { 0.5 } else { 1.0 } / REACH[1]
    }

    /// Of the horizontals of a level: no radial force is left.
    fn horizontal(&self, top: bool) -> f64 {
        let bar = -(self.vertical + self.diagonal);
        let inward = |turn: f64| RADIUS * (turn.cos() - 1.0);
        let stage = self.vertical * inward(TURN)
            + self.diagonal * inward(TURN - TAU / 3.0)
            + bar * inward(TURN + TAU / 3.0);
        (stage * if top { 1.0 } else { 2.0 } + Self::guy(top) * REACH[0]) / (3.0 * RADIUS)
    }
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
}

/// The mast of `stages` stages, guys disturbed, at its design geometry.
///
/// # Errors
/// A mast without stages has nothing that is free.
pub fn mast(stages: usize) -> Result<Mast, BuildError> {
    let mut b = ModelBuilder::<3>::new();
    b.gravity([0.0, 0.0, -GRAVITY])?;
    let mut nodes: Vec<[Place<3>; 3]> = Vec::with_capacity(stages + 1);
    for s in 0..stages {
        let top = |j| corner(j, hand(s));
        let bar = |b: &mut ModelBuilder<3>, j| {
            b.bar(&format!("bar {s}.{j}"), MASS, position(s, j), position(s + 1, top(j)))
        };
        let bars = [bar(&mut b, 0)?, bar(&mut b, 1)?, bar(&mut b, 2)?];
        match nodes.last() {
            None => nodes.push(bars.map(|bar| bar.node(0))),
            Some(level) => {
                for (j, (&below, bar)) in level.iter().zip(bars).enumerate() {
                    b.joint(&format!("node {s}.{j}"), &[below, bar.node(0)], Joining::Share)?;
                }
            }
        }
        nodes.push(std::array::from_fn(|j| bars[corner(j, -hand(s))].node(1)));
    }
    for (j, &foot) in nodes.iter().take(1).flatten().enumerate() {
        b.fix(&format!("foot {j}"), foot)?;
    }
    cables(&mut b, &nodes)?;
    Ok(Mast { model: b.build()?, nodes: nodes.into_iter().skip(1).flatten().collect() })
}

fn cables(b: &mut ModelBuilder<3>, nodes: &[[Place<3>; 3]]) -> Result<(), BuildError> {
    let stages = nodes.len().saturating_sub(1);
    let densities = Densities::new();
    let law = |(stiffness, damping)| CableLaw::Slacking { stiffness, damping };
    let rest = |length: f64, density: f64, (stiffness, _): (f64, f64)| length - density * length / stiffness;
    for s in 0..stages {
        let top = s + 1 == stages;
        for j in 0..3 {
            for (kind, other, density) in
                [("vertical", j, densities.vertical), ("diagonal", corner(j, -hand(s)), densities.diagonal)]
            {
                let length = distance(position(s, j), position(s + 1, other));
                let name = format!("{kind} {s}.{j}");
                b.cable(&name, nodes[s][j], nodes[s + 1][other], law(CABLE), rest(length, density, CABLE))?;
            }
        }
        for j in 0..3 {
            let (level, next) = (s + 1, corner(j, 1));
            let length = distance(position(level, j), position(level, next));
            let name = format!("horizontal {level}.{j}");
            let value = rest(length, densities.horizontal(top), CABLE);
            b.cable(&name, nodes[level][j], nodes[level][next], law(CABLE), value)?;
        }
        for j in 0..3 {
            let level = s + 1;
            let [x, y] = direction(level, j);
            let reach = RADIUS + REACH[0];
            let at = [reach * x, reach * y, level as f64 * height() + REACH[1]];
            let anchor = b.anchor(&format!("anchor {level}.{j}"), at)?;
            let phase = TAU * (level as f64 / 7.0 + j as f64 / 3.0);
            let value = rest(distance(position(level, j), at), Densities::guy(top), GUY);
            let name = format!("guy {level}.{j}");
            b.cable(&name, nodes[level][j], anchor, law(GUY), value - DISTURBANCE * phase.cos())?;
        }
    }
    Ok(())
}
