//! The tower against the framework's reference values, closed forms, balances and symmetry.
//!
//! - `runs`: published values, falls and slackening of the seismic runs, what the solution may not depend on;
//! - `linear`: figure, forces and inertia at a pose, small oscillations;
//! - `balances`: energy and work along the motion.

mod balances;
mod linear;
mod runs;

use super::*;

fn some_state() -> TowerState {
    TowerState { theta: [0.3, -0.2, 0.5, 0.1, -0.4], omega: [1.3, -2.0, 0.7, 2.9, -1.1] }
}

/// A tower whose ground rests.
fn still(setup: Setup) -> Tower {
    Tower { ground_amplitude: 0.0, ..Tower::paper(setup) }
}
