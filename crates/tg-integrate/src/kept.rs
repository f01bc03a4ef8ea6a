//! Where the symplectic scheme took the factors that it keeps.
//!
//! Factors of the Newton matrix serve many steps, and which ones a step uses decides its last bits. The state therefore
//! carries where they were taken: a run that is resumed takes them there again.

use crate::state::State;

/// Numbers before the vectors: time and length of the step whose factors are kept, and its rounding. A length of zero means
/// none.
const HEAD: usize = 3;

/// This part of the memory of a state of `n` full coordinates: t, h, rounding, then q and Δ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kept {
    n: usize,
    /// Numbers that stand before.
    offset: usize,
}

impl Kept {
    pub(crate) fn new(n: usize, offset: usize) -> Self {
        Self { n, offset }
    }

    /// Length of the memory up to the end of this part.
    pub(crate) fn end(self) -> usize {
        self.offset + HEAD + 2 * self.n
    }

    /// Time, q and Δ of the step whose factors are kept, if it had the length `h`.
    pub(crate) fn get(self, state: &State, h: f64) -> Option<(f64, &[f64], &[f64])> {
        let memory = &state.memory[self.offset..self.end()];
        let (q, delta) = memory[HEAD..].split_at(self.n);
        (memory[1] == h).then_some((memory[0], q, delta))
    }

    /// The residual at which the step stood whose factors are kept.
    pub(crate) fn rounding(self, state: &State) -> f64 {
        state.memory[self.offset + 2]
    }

    /// Notes factors: time, step and rounding, q and Δ. Those of the time and step that it holds are the same, which
    /// [`Kept::get`] was to find out.
    pub(crate) fn set(self, state: &mut State, head: (f64, f64, f64), q: &[f64], delta: &[f64]) {
        let end = self.end();
        let memory = &mut state.memory[self.offset..end];
        if memory[0] == head.0 && memory[1] == head.1 {
            return;
        }
        (memory[0], memory[1], memory[2]) = head;
        memory[HEAD..HEAD + self.n].copy_from_slice(q);
        memory[HEAD + self.n..].copy_from_slice(delta);
    }

    /// The next step takes factors of its own.
    pub(crate) fn clear(self, state: &mut State) {
        state.memory[self.offset + 1] = 0.0;
    }
}
