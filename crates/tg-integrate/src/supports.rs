//! Supports that carry mass or constraints: what becomes of their jumps.
//!
//! ```text
//! M_ff δq̇_f = -M_fp δq̇_p + A_fᵀ ν        the impulse of a support whose velocity jumps
//! ```
//! It is finite, and every scheme passes it on. A support that jumps in *position* would have to have an infinite velocity for no
//! time, and what hangs on it by a joint would be thrown with an impulse that grows without bound: that is refused. What
//! hangs on a support by cables alone only feels another length.

use tg_model::Mechanics;

use crate::state::State;
use crate::system::Failure;

/// Share of its displacement that the velocities of a support at both ends of a step must account for.
const ACCOUNTED: f64 = 1e-3;
/// Displacements that are rounding, as a share of the coordinate.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Prescribed coordinates that share mass or a constraint with others; none where no support moves.
pub(crate) struct Supports {
    joined: Vec<usize>,
}

impl Supports {
    pub(crate) fn new(mechanics: &dyn Mechanics) -> Self {
        if !mechanics.features().moving_supports {
            return Self { joined: Vec::new() };
        }
        let mut joined = vec![false; mechanics.sizes().coordinates];
        mechanics
            .mass()
            .iter()
            .filter(|entry| entry.row != entry.col)
            .for_each(|entry| joined[entry.col] = true);
        mechanics.jacobian_pattern().iter().for_each(|&(_, coordinate)| joined[coordinate] = true);
        mechanics.free().iter().for_each(|&i| joined[i] = false);
        Self { joined: (0..joined.len()).filter(|&i| joined[i]).collect() }
    }

    /// Their coordinates.
    pub(crate) fn joined(&self) -> &[usize] {
        &self.joined
    }

    /// Refuses a step of length `h` in which one of them jumps: it moves, but rests before and after.
    pub(crate) fn check(&self, state: &State, q: &[f64], v: &[f64], h: f64) -> Result<(), Failure> {
        for &i in &self.joined {
            let distance = (q[i] - state.q[i]).abs();
            let accounted = h.abs() * (state.v[i].abs() + v[i].abs());
            if accounted < ACCOUNTED * distance && distance > ROUNDING * q[i].abs() {
                return Err(Failure::SupportJumps { coordinate: i, distance });
            }
        }
        Ok(())
    }
}
