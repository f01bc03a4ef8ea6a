//! Factors turned into blocks that a solve only multiplies with, for factors that serve many solves.
//!
//! With the rows and columns of a front as `[A₁₁ A₁₂; A₂₁ ·]`, its own positions first, eliminating it is
//!
//! ```text
//! x₂ ← x₂ − G x₁,   G = A₂₁ A₁₁⁻¹         forward
//! x₁ ← P x₁ − W x₂,  P = A₁₁⁻¹,  W = A₁₁⁻¹ A₁₂    backward
//! ```
//! Triangular solves wait for one unknown after the other; products do not. The explicit inverse costs as much as the
//! factorisation, and some digits where a block is ill-conditioned: only iterations that check their own residual use it.

use crate::static_lu::Factored;
use crate::symbolic::Symbolic;

const LANES: usize = 4;

type Chunk = [f64; LANES];

fn chunks(len: usize) -> usize {
    len.div_ceil(LANES)
}

/// G, then P and W of each front, by columns that are padded to whole chunks.
#[derive(Clone, Debug)]
pub(crate) struct BlockInverse {
    values: Vec<Chunk>,
    /// Where the blocks of each front start.
    start: Vec<u32>,
    /// x₁ and −x₂ of one front.
    local: Vec<f64>,
    /// One column while it is made.
    column: Vec<f64>,
}

impl BlockInverse {
    pub(crate) fn new(symbolic: &Symbolic) -> Self {
        let mut start = vec![0];
        let mut len = 0;
        for front in &symbolic.fronts {
            let (w, r) = (front.width, front.rest_len());
            len += w * chunks(r) + (w + r) * chunks(w);
            start.push(len as u32);
        }
        Self {
            values: vec![[0.0; LANES]; len],
            start,
            local: vec![0.0; symbolic.longest],
            column: vec![0.0; symbolic.longest],
        }
    }

    /// Makes the blocks from factors.
    pub(crate) fn set(&mut self, symbolic: &Symbolic, factored: Factored<'_>) {
        for (at, front) in symbolic.fronts.iter().enumerate() {
            let (w, r, stride) = (front.width, front.rest_len(), front.stride());
            let panel = &factored.panels[front.panel..front.panel + w * stride];
            let inverse = &factored.inverse[front.first..front.first + w];
            let blocks = &mut self.values[self.start[at] as usize..self.start[at + 1] as usize];
            let (left, right) = blocks.split_at_mut(w * chunks(r));
            if r > 0 {
                // G L₁₁ = L₂₁, last column first.
                for k in (0..w).rev() {
                    let (before, after) = left.split_at_mut((k + 1) * chunks(r));
                    let column = before[k * chunks(r)..].as_flattened_mut();
                    column[..r].copy_from_slice(&panel[k * stride + w + r..][..r]);
                    for (i, g) in (k + 1..w).zip(after.chunks_exact(chunks(r))) {
                        let l = panel[i * stride + k];
                        column.iter_mut().zip(g.as_flattened()).for_each(|(c, g)| *c -= l * g);
                    }
                }
            }
            let column = &mut self.column[..w];
            for (c, target) in right.chunks_exact_mut(chunks(w)).enumerate() {
                if c < w {
                    // L₁₁ z = e_c.
                    column.fill(0.0);
                    column[c] = 1.0;
                    for i in c + 1..w {
                        let row = &panel[i * stride + c..i * stride + i];
                        column[i] = -row.iter().zip(&column[c..i]).map(|(l, z)| l * z).sum::<f64>();
                    }
                } else {
                    (0..w).for_each(|k| column[k] = panel[k * stride + c]);
                }
                // U₁₁ x = z.
                for k in (0..w).rev() {
                    let row = &panel[k * stride + k + 1..k * stride + w];
                    let sum: f64 = row.iter().zip(&column[k + 1..]).map(|(u, x)| u * x).sum();
                    column[k] = (column[k] - sum) * inverse[k];
                }
                target.as_flattened_mut()[..w].copy_from_slice(column);
            }
        }
    }

    /// Solves in elimination order.
    pub(crate) fn apply(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        let Self { values, start, local, .. } = self;
        for (at, front) in symbolic.fronts.iter().enumerate() {
            let (w, r) = (front.width, front.rest_len());
            if r == 0 {
                continue;
            }
            let blocks = &values[start[at] as usize..][..w * chunks(r)];
            let sums = &mut local[..r];
            product(blocks, chunks(r), &x[front.first..front.first + w], sums);
            for (&i, sum) in symbolic.rest[front.rest.clone()].iter().zip(sums) {
                x[i as usize] -= *sum;
            }
        }
        for (at, front) in symbolic.fronts.iter().enumerate().rev() {
            let (w, r) = (front.width, front.rest_len());
            let blocks = &values[start[at] as usize + w * chunks(r)..start[at + 1] as usize];
            let own = front.first..front.first + w;
            local[..w].copy_from_slice(&x[own.clone()]);
            for (value, &i) in local[w..w + r].iter_mut().zip(&symbolic.rest[front.rest.clone()]) {
                *value = -x[i as usize];
            }
            product(blocks, chunks(w), &local[..w + r], &mut x[own]);
        }
    }
}

/// `out ← B x` with the columns of B padded to `rows` chunks.
fn product(blocks: &[Chunk], rows: usize, x: &[f64], out: &mut [f64]) {
    match rows {
        1 => in_registers::<1>(blocks, x, out),
        2 => in_registers::<2>(blocks, x, out),
        3 => in_registers::<3>(blocks, x, out),
        4 => in_registers::<4>(blocks, x, out),
        _ => {
            out.fill(0.0);
            for (column, x) in blocks.chunks_exact(rows).zip(x) {
                out.iter_mut().zip(column.as_flattened()).for_each(|(sum, b)| *sum += b * x);
            }
        }
    }
}

#[inline(always)]
fn in_registers<const R: usize>(blocks: &[Chunk], x: &[f64], out: &mut [f64]) {
    let mut sums = [[0.0; LANES]; R];
    for (column, x) in blocks.as_chunks::<R>().0.iter().zip(x) {
        for (sum, b) in sums.iter_mut().zip(column) {
            for (sum, b) in sum.iter_mut().zip(b) {
                *sum += b * x;
            }
        }
    }
    out.copy_from_slice(&sums.as_flattened()[..out.len()]);
}
