//! The mast in plain numbers, as another program reads them.

use std::f64::consts::{PI, TAU};

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
/// \[m/s²\], downwards.
const GRAVITY: f64 = 9.81;
/// A guy's anchor is this far outside of its node, and this far above it \[m\].
const REACH: [f64; 2] = [0.3, 0.05];
/// Disturbance δ of the guys' rest lengths \[m\].
const DISTURBANCE: f64 = 0.015;

/// Nodes, bars and cables of the mast, everything that its model is made of.
#[derive(Clone, Debug)]
pub struct MastScene {
    /// Number of stages N.
    pub stages: usize,
    /// Positions \[m\]: level s, corner j is node 3 s + j; the anchors of the guys follow, level by level.
    pub nodes: Vec<[f64; 3]>,
    /// Lower and upper node of each bar, stage by stage.
    pub bars: Vec<[usize; 2]>,
    /// Cables stage by stage: verticals, diagonals, horizontals of the upper level, its guys.
    pub cables: Vec<MastCable>,
}

/// One cable of the mast.
#[derive(Clone, Debug)]
pub struct MastCable {
    /// Kind, level and corner.
    pub name: String,
    /// Its two nodes; a guy's second is its anchor.
    pub nodes: [usize; 2],
    /// κ \[N/m\].
    pub stiffness: f64,
    /// η \[N s/m\].
    pub damping: f64,
    /// μ \[m\].
    pub rest_length: f64,
}

impl MastScene {
    /// Length of a bar \[m\].
    pub const BAR_LENGTH: f64 = BAR;
    /// Mass of a bar \[kg\].
    pub const BAR_MASS: f64 = MASS;
    /// Gravity \[m/s²\], downwards.
    pub const GRAVITY: f64 = GRAVITY;

    /// The scene that other tools were measured on: guys disturbed.
    pub fn new(stages: usize) -> Self {
        Self::disturbed(stages, DISTURBANCE)
    }

    /// The design geometry in equilibrium: guys as they should be.
    pub fn balanced(stages: usize) -> Self {
        Self::disturbed(stages, 0.0)
    }

    fn disturbed(stages: usize, disturbance: f64) -> Self {
        let nodes = (0..=stages).flat_map(|s| [0, 1, 2].map(|j| position(s, j)));
        let mut scene = Self { stages, nodes: nodes.collect(), bars: Vec::new(), cables: Vec::new() };
        for s in 0..stages {
            scene.bars.extend([0, 1, 2].map(|j| [node(s, j), node(s + 1, corner(j, hand(s)))]));
        }
        let densities = Densities::new();
        for s in 0..stages {
            scene.stage(s, &densities);
            scene.guys(s + 1, disturbance);
        }
        scene
    }

    /// Verticals, diagonals and horizontals of the stage above level `s`.
    fn stage(&mut self, s: usize, densities: &Densities) {
        for j in 0..3 {
            let nodes = [node(s, j), node(s + 1, j)];
            self.cable(format!("vertical {s}.{j}"), nodes, CABLE, densities.vertical);
        }
        for j in 0..3 {
            let nodes = [node(s, j), node(s + 1, corner(j, -hand(s)))];
            self.cable(format!("diagonal {s}.{j}"), nodes, CABLE, densities.diagonal);
        }
        let (level, top) = (s + 1, s + 1 == self.stages);
        for j in 0..3 {
            let nodes = [node(level, j), node(level, corner(j, 1))];
            self.cable(format!("horizontal {level}.{j}"), nodes, CABLE, densities.horizontal(top));
        }
    }

    fn guys(&mut self, level: usize, disturbance: f64) {
        let top = level == self.stages;
        for j in 0..3 {
            let [x, y] = direction(level, j);
            let reach = RADIUS + REACH[0];
            let anchor = self.nodes.len();
            self.nodes.push([reach * x, reach * y, level as f64 * height() + REACH[1]]);
            self.cable(format!("guy {level}.{j}"), [node(level, j), anchor], GUY, Densities::guy(top));
            let phase = TAU * (level as f64 / 7.0 + j as f64 / 3.0);
            if let Some(guy) = self.cables.last_mut() {
                guy.rest_length -= disturbance * phase.cos();
            }
        }
    }

    /// Adds a cable whose force density \[N/m\] in the design geometry is given.
    fn cable(&mut self, name: String, nodes: [usize; 2], (stiffness, damping): (f64, f64), density: f64) {
        let [a, b] = nodes.map(|node| self.nodes[node]);
        let length = distance(a, b);
        let rest_length = length - density * length / stiffness;
        self.cables.push(MastCable { name, nodes, stiffness, damping, rest_length });
    }
}

fn node(s: usize, j: usize) -> usize {
    3 * s + j
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
