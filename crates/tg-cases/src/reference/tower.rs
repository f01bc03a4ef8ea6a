//! Example 2 (Sec. 6.2): planar class-3 tower, in its five angles.
//!
//! θ are rotations from the upright start, counterclockwise positive: θ_0 of bars 1 and 2, which swing together because
//! triangle 3 joins them to a parallelogram and only translates; θ_1 of bar 4, θ_2 of triangle 5, θ_3 of bar 6, θ_4 of
//! triangle 7. All mass centres c_b and cables l_j are sums of constants and rotating arms, with Jacobians J, so that
//! ```text
//! M θ̈ = Q,   M = Σ_b m_b J_bᵀ J_b + diag(2 I_bar, I_bar, I_tri, I_bar, I_tri)
//! Q = Σ_b m_b J_bᵀ (g - bias_b) - Σ_j f_j J_jᵀ l̂_j
//! f_j⁺ = κ (l_j - μ_j) + η l̇_j;   slacking law (30): f_j = f_j⁺ where l_j ≥ μ_j and f_j⁺ ≥ 0, else 0
//! x_g = a sin(2πνt);   μ_j = β l_j(0) for the auxiliary cables 1, 2 and α l_j(0) for 3 to 12
//! ```
//! At the start everything but the feet of bars 1 and 2 (and the anchors) rests: upright bars of length b and feet moving
//! with ẋ_g(0) give θ̇_0 = ẋ_g(0)/b and no other velocity.
//!
//! Where bars 1 and 2 lie flat, |θ_0| = π/2, the four-bar linkage is singular. The motion through that pose is still
//! unique: the other branches (one bar stands still on the line of the feet, the other turns with triangle 3) have
//! θ̇_0 = 0 for one of the bars, and velocities do not jump; the parallelogram continues, as it does here.
//!
//! Children: `mechanics`, geometry, M, Q and E; `flow`, the piecewise smooth motion and the record of its switches; `modes`, small
//! oscillations.

use super::linkage::{ANGLES, Form, Motion, Rotations};
use super::ode::integrate;
use super::{ReferenceError, Trajectory};
use flow::TowerFlow;
use mechanics::Mechanics;
pub use modes::{Mode, Square};

mod flow;
mod mechanics;
mod modes;
#[cfg(test)]
mod tests;

/// Number of cables.
pub const CABLES: usize = 12;
/// Number of distinct points.
pub const POINTS: usize = 13;
/// Names of the points in the order of [`Tower::points`]: member and end or vertex. The apex of triangle 3 is bar 4's
/// foot, that of triangle 5 joins bars 4 and 6, that of triangle 7 is bar 6's end; r01 and r02 anchor cables 1 and 2.
pub const POINT_NAMES: [&str; POINTS] = [
    "r1i", "r2i", "r01", "r02", "tri3.p1", "tri3.p2", "tri3.p3", "tri5.p1", "tri5.p2", "tri5.p3", "tri7.p1",
    "tri7.p2", "tri7.p3",
];
/// Ends of cables 1 to 12 as positions in [`POINT_NAMES`].
pub const CABLE_ENDS: [[usize; 2]; CABLES] =
    [[7, 2], [8, 3], [0, 5], [4, 1], [4, 7], [5, 8], [6, 7], [6, 8], [7, 10], [8, 11], [9, 10], [9, 11]];

/// The paper's setups of the seismic runs (Sec. 6.2.2).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setup {
    /// Undamped, no slacking, all ground points move.
    Un,
    /// Damped with η = 0.1 N s/m, no slacking, all ground points move.
    Dn,
    /// Undamped, slacking, all ground points move.
    Us,
    /// As `Us`, but the anchors of cables 1 and 2 stand still.
    UsAux,
}

/// Parameters of the tower; change the fields for variants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tower {
    /// Mass of a bar \[kg\].
    pub bar_mass: f64,
    /// Moment of inertia of a bar about its mass centre \[kg m²\].
    pub bar_inertia: f64,
    /// Mass of a triangle \[kg\].
    pub triangle_mass: f64,
    /// Moment of inertia of a triangle about its mass centre \[kg m²\].
    pub triangle_inertia: f64,
    /// Gravity g along -y \[m/s²\].
    pub gravity: f64,
    /// Cable stiffness κ \[N/m\].
    pub kappa: f64,
    /// Cable damping η \[N s/m\].
    pub eta: f64,
    /// Whether cables slacken by (30); otherwise they push when shorter than their rest length.
    pub slacking: bool,
    /// Rest length over initial length of cables 3 to 12, α.
    pub alpha: f64,
    /// Rest length over initial length of the auxiliary cables 1 and 2, β.
    pub beta: f64,
    /// Amplitude a of the ground motion x_g = a sin(2πνt) \[m\].
    pub ground_amplitude: f64,
    /// Frequency ν of the ground motion \[Hz\].
    pub ground_frequency: f64,
    /// Whether the anchors of cables 1 and 2 move with the ground; the feet of bars 1 and 2 always do.
    pub anchors_move: bool,
}

/// Angles and angular velocities of the tower, in the order of the module's description.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TowerState {
    /// Rotations from the upright start θ \[rad\].
    pub theta: [f64; ANGLES],
    /// Their rates θ̇ \[rad/s\].
    pub omega: [f64; ANGLES],
}

/// Time span in which a cable is shorter than its rest length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlackInterval {
    /// Cable number, 1 to 12 as in the paper.
    pub cable: usize,
    /// Time at which l falls below μ, or the start \[s\].
    pub from: f64,
    /// Time at which l reaches μ again, or the last requested time \[s\].
    pub to: f64,
}

/// Solution of the tower with what happened on the way, up to the last requested time.
#[derive(Clone, Debug, PartialEq)]
pub struct TowerRun {
    /// States at the requested times.
    pub trajectory: Trajectory<TowerState>,
    /// Spans with l < μ (slack, or in compression for the laws without slacking), by time of their beginning.
    pub slack: Vec<SlackInterval>,
    /// First time at which a vertex of a triangle reaches y = 0 \[s\]; the motion continues freely.
    pub vertex_on_ground: Option<f64>,
    /// First time at which bars 1 and 2 lie flat \[s\].
    pub singular_pose: Option<f64>,
}

impl Tower {
    /// The paper's tower in a setup of the seismic runs: α = 0.95, β = 0.998, gravity, x_g = 0.01 sin(6πt).
    pub fn paper(setup: Setup) -> Self {
        let (bar_mass, triangle_mass) = (2.693_497_779_8e-2, 0.127_142_559_7);
        Self {
            bar_mass,
            bar_inertia: bar_mass * 0.1 * 0.1 / 12.0,
            triangle_mass,
            triangle_inertia: triangle_mass * (0.1 * 0.1 / 24.0 + 0.05 * 0.05 / 18.0),
            gravity: 9.81,
            kappa: 100.0,
            eta: if setup == Setup::Dn { 0.1 } else { 0.0 },
            slacking: matches!(setup, Setup::Us | Setup::UsAux),
            alpha: 0.95,
            beta: 0.998,
            ground_amplitude: 0.01,
            ground_frequency: 3.0,
            anchors_move: setup != Setup::UsAux,
        }
    }

    /// Upright, at rest but for the moving ground points: θ̇_0 = ẋ_g(0)/b.
    pub fn start(&self) -> TowerState {
        let mut start = TowerState::default();
        start.omega[0] = self.ground(0.0).v / mechanics::BAR;
        start
    }

    /// The run from [`Self::start`] at t = 0 through `times` \[s\], ascending.
    ///
    /// Rounding is the only error left: positions are good to 1e-13 m until 2 s, those of the falling `US` until 1.6 s;
    /// its tumbling then amplifies rounding to 2e-12 m at 2 s.
    ///
    /// # Errors
    /// [`ReferenceError::Times`] for bad times; the others if the parameters make the motion undefined.
    pub fn solve(&self, times: &[f64]) -> Result<TowerRun, ReferenceError> {
        self.solve_from(&self.start(), times)
    }

    /// As [`Self::solve`] from another state at t = 0.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub fn solve_from(&self, start: &TowerState, times: &[f64]) -> Result<TowerRun, ReferenceError> {
        let mut flow = TowerFlow::new(Mechanics::new(self), start);
        let signs = flow.signs(start);
        let states = integrate(&mut flow, flow::pack(start), signs, times)?;
        let end = times.last().copied().unwrap_or(0.0);
        let trajectory = Trajectory { t: times.to_vec(), states: states.iter().map(flow::unpack).collect() };
        Ok(flow.finish(trajectory, end))
    }

    /// Positions \[m\] of the points named in [`POINT_NAMES`] at time `t` \[s\].
    pub fn points(&self, t: f64, state: &TowerState) -> [[f64; 2]; POINTS] {
        self.positions(&Mechanics::new(self).points, t, state)
    }

    /// Positions \[m\] of the mass centres of members 1 to 7 at time `t` \[s\]; triangle 3 is entry 2.
    pub fn mass_centres(&self, t: f64, state: &TowerState) -> [[f64; 2]; 7] {
        self.positions(&Mechanics::new(self).centres, t, state)
    }

    /// Mass centre of triangle 3 \[m\] at time `t` \[s\].
    pub fn triangle3_centre(&self, t: f64, state: &TowerState) -> [f64; 2] {
        self.mass_centres(t, state)[2]
    }

    /// Lengths l_j \[m\] of cables 1 to 12 at time `t` \[s\].
    pub fn cable_lengths(&self, t: f64, state: &TowerState) -> [f64; CABLES] {
        self.positions(&Mechanics::new(self).cables, t, state).map(|[x, y]| x.hypot(y))
    }

    /// Rest lengths μ_j \[m\] of cables 1 to 12.
    pub fn rest_lengths(&self) -> [f64; CABLES] {
        Mechanics::new(self).rest_lengths
    }

    /// Whether cables 1 to 12 are shorter than their rest lengths at time `t` \[s\].
    pub fn slack(&self, t: f64, state: &TowerState) -> [bool; CABLES] {
        let (l, mu) = (self.cable_lengths(t, state), self.rest_lengths());
        std::array::from_fn(|j| l[j] < mu[j])
    }

    /// Tension forces f_j \[N\] of cables 1 to 12 at time `t` \[s\], negative in compression.
    pub fn tensions(&self, t: f64, state: &TowerState) -> [f64; CABLES] {
        let mechanics = Mechanics::new(self);
        let pulls = mechanics.cable_laws(t, state).map(|(stretch, law)| stretch >= 0.0 && law >= 0.0);
        mechanics.tensions(t, state, &pulls)
    }

    /// Mechanical energy \[J\]: kinetic, gravity (zero at y = 0) and elastic, ½κ(l - μ)² of each cable, nothing for l < μ
    /// if it slackens.
    pub fn energy(&self, t: f64, state: &TowerState) -> f64 {
        Mechanics::new(self).energy(t, state)
    }

    /// Ground displacement x_g, velocity and acceleration at `t`.
    fn ground(&self, t: f64) -> Motion {
        let w = std::f64::consts::TAU * self.ground_frequency;
        let (s, c) = (w * t).sin_cos();
        let a = self.ground_amplitude;
        Motion { x: a * s, v: a * w * c, a: -a * w * w * s }
    }

    fn positions<const K: usize>(&self, forms: &[Form; K], t: f64, state: &TowerState) -> [[f64; 2]; K] {
        let (r, ground) = (Rotations::new(&state.theta), self.ground(t));
        std::array::from_fn(|k| forms[k].position(&r, &ground))
    }
}
