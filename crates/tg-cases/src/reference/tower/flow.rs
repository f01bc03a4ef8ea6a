//! The tower's motion between switches, and the record of what switched.
//!
//! Indicators: l - μ and f⁺ of each cable (together they decide whether it pulls), heights of the triangles' vertices,
//! and cos θ_0, which vanishes in the singular pose.

use super::super::Trajectory;
use super::super::linkage::{ANGLES, Rotations};
use super::super::ode::Flow;
use super::mechanics::Mechanics;
use super::{CABLES, POINTS, SlackInterval, TowerRun, TowerState};
use std::array::from_fn;

const NUMBER: usize = 2 * ANGLES;
/// First of the nine triangle vertices in the list of points.
const FIRST_VERTEX: usize = 4;
/// Where the indicators begin that follow l - μ: f⁺, heights, cos θ_0.
const LAWS: usize = CABLES;
const HEIGHTS: usize = 2 * CABLES;
const FLAT: usize = HEIGHTS + POINTS - FIRST_VERTEX;

pub(super) fn pack(s: &TowerState) -> [f64; NUMBER] {
    from_fn(|i| if i < ANGLES { s.theta[i] } else { s.omega[i - ANGLES] })
}

pub(super) fn unpack(y: &[f64; NUMBER]) -> TowerState {
    TowerState { theta: from_fn(|i| y[i]), omega: from_fn(|i| y[ANGLES + i]) }
}

/// The motion with every cable in a fixed state until an indicator changes sign, and the record of what changed.
pub(super) struct TowerFlow {
    mechanics: Mechanics,
    /// l ≥ μ, f⁺ ≥ 0 and both (or a law without slacking), per cable.
    long: [bool; CABLES],
    pulling: [bool; CABLES],
    pulls: [bool; CABLES],
    /// Beginning of the running slack interval of each cable.
    slack_since: [Option<f64>; CABLES],
    slack: Vec<SlackInterval>,
    vertex_on_ground: Option<f64>,
    singular_pose: Option<f64>,
}

impl TowerFlow {
    pub(super) fn new(mechanics: Mechanics, start: &TowerState) -> Self {
        let laws = mechanics.cable_laws(0.0, start);
        // Without damping f⁺ ≥ 0 is l ≥ μ and not followed on its own.
        let undamped = mechanics.tower.eta == 0.0;
        let mut flow = Self {
            long: laws.map(|(stretch, _)| stretch >= 0.0),
            pulling: laws.map(|(_, law)| law >= 0.0 || undamped),
            pulls: [true; CABLES],
            slack_since: laws.map(|(stretch, _)| (stretch < 0.0).then_some(0.0)),
            slack: Vec::new(),
            vertex_on_ground: None,
            singular_pose: None,
            mechanics,
        };
        flow.update();
        flow
    }

    /// Signs of the indicators at the start.
    pub(super) fn signs(&self, start: &TowerState) -> Vec<bool> {
        let mut g = Vec::new();
        self.indicators(0.0, &pack(start), &mut g);
        g.iter().map(|v| *v >= 0.0).collect()
    }

    fn update(&mut self) {
        let slacking = self.mechanics.tower.slacking;
        self.pulls = from_fn(|k| !slacking || (self.long[k] && self.pulling[k]));
    }

    pub(super) fn finish(mut self, trajectory: Trajectory<TowerState>, end: f64) -> TowerRun {
        for (k, since) in self.slack_since.iter().enumerate() {
            if let Some(from) = *since {
                self.slack.push(SlackInterval { cable: k + 1, from, to: end });
            }
        }
        self.slack.retain(|s| s.from < end);
        self.slack.iter_mut().for_each(|s| s.to = s.to.min(end));
        self.slack.sort_by(|a, b| a.from.total_cmp(&b.from));
        let until_end = |t: Option<f64>| t.filter(|t| *t <= end);
        TowerRun {
            trajectory,
            slack: self.slack,
            vertex_on_ground: until_end(self.vertex_on_ground),
            singular_pose: until_end(self.singular_pose),
        }
    }
}

impl Flow<NUMBER> for TowerFlow {
    fn rate(&self, t: f64, y: &[f64; NUMBER]) -> [f64; NUMBER] {
        let s = unpack(y);
        let a = self.mechanics.acceleration(t, &s, &self.pulls);
        from_fn(|i| if i < ANGLES { s.omega[i] } else { a[i - ANGLES] })
    }

    fn indicators(&self, t: f64, y: &[f64; NUMBER], g: &mut Vec<f64>) {
        let s = unpack(y);
        let tower = &self.mechanics.tower;
        let laws = self.mechanics.cable_laws(t, &s);
        g.clear();
        g.extend(laws.map(|(stretch, _)| stretch));
        // Nothing depends on the sign of f⁺ unless the cables slacken and are damped.
        let matters = tower.slacking && tower.eta != 0.0;
        g.extend(laws.map(|(_, law)| if matters { law } else { 1.0 }));
        let (r, ground) = (Rotations::new(&s.theta), tower.ground(t));
        g.extend(self.mechanics.points[FIRST_VERTEX..].iter().map(|p| p.position(&r, &ground)[1]));
        g.push(s.theta[0].cos());
    }

    fn switch(&mut self, t: f64, which: usize, positive: bool) {
        if which < LAWS {
            self.long[which] = positive;
            match (positive, self.slack_since[which]) {
                (true, Some(from)) => {
                    self.slack.push(SlackInterval { cable: which + 1, from, to: t });
                    self.slack_since[which] = None;
                }
                (false, None) => self.slack_since[which] = Some(t),
                _ => {}
            }
        } else if which < HEIGHTS {
            self.pulling[which - LAWS] = positive;
        } else if which < FLAT {
            self.vertex_on_ground.get_or_insert(t);
        } else {
            self.singular_pose.get_or_insert(t);
        }
        self.update();
    }
}
