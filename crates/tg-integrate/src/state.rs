//! The state of a simulation: plain numbers, cheap to clone, serialisable. A checkpoint is a state.

use serde::{Deserialize, Serialize};
/// Everything that the next step depends on.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time \[s\].
    pub t: f64,
    /// What rounding has taken from `t` \[s\]; the next step adds it. Without it the time of half a million steps is
    /// off by some 1e-6 of a step, and a run would make one step too many.
    pub t_rest: f64,
    /// Full coordinates q.
    pub q: Vec<f64>,
    /// Full velocities q̇; they satisfy A q̇ = 0 where the stepper projects.
    pub v: Vec<f64>,
    /// Multipliers λ of the last step \[N/m for dot products, N for joints\]; the constraints' force is Aᵀ λ.
    pub lambda: Vec<f64>,
    /// What a stepper carries besides (generalised-α: accelerations q̈ and a); empty for one-step schemes.
    pub memory: Vec<f64>,
}

impl State {
    /// Adds `h` to the time, carrying the rounding error along (Knuth's two-sum).
    pub(crate) fn advance_time(&mut self, h: f64) {
        let added = h + self.t_rest;
        let sum = self.t + added;
        let part = sum - self.t;
        self.t_rest = (self.t - (sum - part)) + (added - part);
        self.t = sum;
    }

    /// Overwrites this state without allocating; sizes must agree.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        (self.t, self.t_rest) = (other.t, other.t_rest);
        self.q.copy_from_slice(&other.q);
        self.v.copy_from_slice(&other.v);
        self.lambda.copy_from_slice(&other.lambda);
        self.memory.copy_from_slice(&other.memory);
    }
}
