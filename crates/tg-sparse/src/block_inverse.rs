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
//! They correct an error that is known to a few digits by factors that are a little off, so that single precision serves
//! as well: half of the memory to read, which large systems wait for, and half of the arithmetic.

use crate::kernels::{LANES, add_multiple, chunks};
use crate::static_lu::Factored;
use crate::symbolic::Symbolic;

/// As many numbers as the loops over padded columns take at a time.
type Chunk = [f32; LANES];

/// G, P and W of each front, by columns that are padded to whole chunks, in the order in which solves read them: of a large
/// system that is what they wait for.
#[derive(Clone, Debug)]
pub(crate) struct BlockInverse {
    /// G of each front.
    left: Vec<Chunk>,
    /// P and W of each front, from the last.
    right: Vec<Chunk>,
    /// Where the blocks of each front start in both.
    start: Vec<(u32, u32)>,
    /// x₁ and −x₂ of one front, and what is subtracted from x₂.
    local: Vec<f32>,
    sums: Vec<f32>,
    /// A column of G while it is made.
    column: Vec<f64>,
    /// The rows of a front while its blocks are made.
    rows: Vec<f64>,
}

impl BlockInverse {
    pub(crate) fn new(symbolic: &Symbolic) -> Self {
        let mut start = vec![(0, 0); symbolic.fronts.len()];
        let (mut left, mut right, mut largest) = (0, 0, 0);
        for (start, front) in start.iter_mut().zip(&symbolic.fronts) {
            start.0 = left as u32;
            left += front.width * chunks(front.rest_len());
            largest = largest.max(front.width * (front.width + front.rest_len()));
        }
        for (start, front) in start.iter_mut().zip(&symbolic.fronts).rev() {
            start.1 = right as u32;
            right += (front.width + front.rest_len()) * chunks(front.width);
        }
        Self {
            left: vec![[0.0; LANES]; left],
            right: vec![[0.0; LANES]; right],
            start,
            local: vec![0.0; symbolic.longest],
            sums: vec![0.0; symbolic.longest],
            column: vec![0.0; symbolic.longest],
            rows: vec![0.0; largest],
        }
    }

    /// Makes the blocks from factors. Every loop adds a multiple of one row or column to another.
    pub(crate) fn set(&mut self, symbolic: &Symbolic, factored: Factored<'_>) {
        for (at, front) in symbolic.fronts.iter().enumerate() {
            let (w, r, stride) = (front.width, front.rest_len(), front.stride());
            let panel = &factored.panels[front.panel..front.panel + w * stride];
            let inverse = &factored.inverse[front.first..front.first + w];
            let (left, right) = self.start[at];
            let left = &mut self.left[left as usize..][..w * chunks(r)];
            let right = &mut self.right[right as usize..][..(w + r) * chunks(w)];
            // Rows of [L₁₁⁻¹ | U₁₂].
            let rows = &mut self.rows[..w * (w + r)];
            for k in 0..w {
                let (above, row) = rows.split_at_mut(k * (w + r));
                let row = &mut row[..w + r];
                row[..w].fill(0.0);
                row[k] = 1.0;
                row[w..].copy_from_slice(&panel[k * stride + w..][..r]);
                for (source, l) in above.chunks_exact(w + r).zip(&panel[k * stride..]) {
                    add_multiple(&mut row[..k], source, -l);
                }
            }
            // G = L₂₁ L₁₁⁻¹ by columns.
            if r > 0 {
                for (c, target) in left.chunks_exact_mut(chunks(r)).enumerate() {
                    let column = &mut self.column[..r];
                    column.copy_from_slice(&panel[c * stride + w + r..][..r]);
                    for k in c + 1..w {
                        add_multiple(column, &panel[k * stride + w + r..][..r], rows[k * (w + r) + c]);
                    }
                    for (target, g) in target.as_flattened_mut().iter_mut().zip(column) {
                        *target = *g as f32;
                    }
                }
            }
            // U₁₁⁻¹ of these rows, from the last, is [P | W].
            for k in (0..w).rev() {
                let (row, below) = rows[k * (w + r)..].split_at_mut(w + r);
                for (source, u) in below.chunks_exact(w + r).zip(&panel[k * stride + k + 1..]) {
                    add_multiple(row, source, -u);
                }
                row.iter_mut().for_each(|x| *x *= inverse[k]);
            }
            for (k, row) in rows.chunks_exact(w + r).enumerate() {
                for (column, x) in right.chunks_exact_mut(chunks(w)).zip(row) {
                    column.as_flattened_mut()[k] = *x as f32;
                }
            }
        }
    }

    /// Solves in elimination order. The largest component should be near one: single precision has a short range.
    pub(crate) fn apply(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        let Self { left, right, start, local, sums, .. } = self;
        for (at, front) in symbolic.fronts.iter().enumerate() {
            let (w, r) = (front.width, front.rest_len());
            if r == 0 {
                continue;
            }
            let blocks = &left[start[at].0 as usize..][..w * chunks(r)];
            for (local, x) in local.iter_mut().zip(&x[front.first..front.first + w]) {
                *local = *x as f32;
            }
            product(blocks, chunks(r), &local[..w], &mut sums[..r]);
            for (&i, sum) in symbolic.rest[front.rest.clone()].iter().zip(&*sums) {
                x[i as usize] -= f64::from(*sum);
            }
        }
        for (at, front) in symbolic.fronts.iter().enumerate().rev() {
            let (w, r) = (front.width, front.rest_len());
            let blocks = &right[start[at].1 as usize..][..(w + r) * chunks(w)];
            let own = front.first..front.first + w;
            for (local, x) in local.iter_mut().zip(&x[own.clone()]) {
                *local = *x as f32;
            }
            for (local, &i) in local[w..w + r].iter_mut().zip(&symbolic.rest[front.rest.clone()]) {
                *local = -x[i as usize] as f32;
            }
            product(blocks, chunks(w), &local[..w + r], &mut sums[..w]);
            for (x, sum) in x[own].iter_mut().zip(&*sums) {
                *x = f64::from(*sum);
            }
        }
    }
}

/// `out ← B x` with the columns of B padded to `rows` chunks.
fn product(blocks: &[Chunk], rows: usize, x: &[f32], out: &mut [f32]) {
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
fn in_registers<const R: usize>(blocks: &[Chunk], x: &[f32], out: &mut [f32]) {
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
