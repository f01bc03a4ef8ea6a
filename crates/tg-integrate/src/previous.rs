//! The last step, from which the symplectic scheme extrapolates to the next.
//!
//! Where an iteration starts decides its last bits: like the factors that are kept, this is a part of the state.

use crate::state::State;

/// Steps resolve the motion where the acceleration changes by no more than this share in one, and adds no more than this
/// share to the displacement. Elsewhere the last acceleration is a worse guess than none.
const STEADY: f64 = 0.5;

/// Numbers before the vectors: length of the last step, zero where the next is not to follow it; length of the step of the
/// acceleration.
const HEAD: usize = 2;

/// This part of the memory of a state of `n` full coordinates and `m` multipliers: two numbers, then `h q̇ - Δ` at the end of the
/// last step, which is h²/2 times an acceleration, and the multipliers before that step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Previous {
    n: usize,
    m: usize,
    /// Numbers that stand before.
    offset: usize,
}

impl Previous {
    pub(crate) fn new(n: usize, m: usize, offset: usize) -> Self {
        Self { n, m, offset }
    }

    /// Length of the memory up to the end of this part.
    pub(crate) fn end(self) -> usize {
        self.offset + HEAD + self.n + self.m
    }

    /// `h q̇ - Δ` and the multipliers before, if the last step had the length `h` and the motion is steady.
    pub(crate) fn get(self, state: &State, h: f64) -> Option<(&[f64], &[f64])> {
        let (head, rest) = state.memory[self.offset..].split_at(HEAD);
        (head[0] == h).then(|| rest.split_at(self.n))
    }

    /// Notes a step from its displacement and the velocity at its end, before the state is that of its end.
    pub(crate) fn set(self, state: &mut State, h: f64, delta: &[f64], v: &[f64]) {
        let (head, rest) = state.memory[self.offset..].split_at_mut(HEAD);
        let (excess, lambda) = rest.split_at_mut(self.n);
        let (mut change, mut size, mut straight) = (0.0, 0.0, 0.0);
        for ((excess, delta), v) in excess.iter_mut().zip(delta).zip(v) {
            let now = h * v - delta;
            change += (now - *excess) * (now - *excess);
            size += now * now;
            straight += (h * v) * (h * v);
            *excess = now;
        }
        let limit = STEADY * STEADY;
        let is_steady = head[1] == h && change <= limit * size && size <= limit * straight;
        head[0] = if is_steady { h } else { 0.0 };
        head[1] = h;
        lambda.copy_from_slice(&state.lambda);
    }
}
