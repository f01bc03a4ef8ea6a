//! Fronts that work alone: their rows are padded to whole chunks.
//!
//! A front of width w with r later positions keeps its w rows in two blocks, the square one and the rest. Above the diagonal
//! stand the rows of `D Lᵀ`, below it those of L, so that both halves of a solve add multiples of contiguous rows. Update
//! matrices are stored in full: adding whole rows is cheaper than finding their upper halves.

use std::ops::Range;

use super::batch::is_sound;
use crate::kernels::{LANES, chunks, dot};

/// Where one front keeps its numbers.
#[derive(Clone, Debug)]
pub(super) struct Single {
    /// Place in vectors of its first position.
    pub(super) first: usize,
    pub(super) width: usize,
    /// Its later positions, in lists over all fronts.
    pub(super) rest: Range<usize>,
    /// Offset of the square block in the panels; the rest follows it.
    pub(super) panel: usize,
    /// Offset of the update matrix.
    pub(super) update: usize,
    /// Children of this kind, by their index in it.
    pub(super) children: Vec<u32>,
}

impl Single {
    fn stride(&self) -> usize {
        chunks(self.width) * LANES
    }

    pub(super) fn rest_stride(&self) -> usize {
        chunks(self.rest.len()) * LANES
    }

    fn square_len(&self) -> usize {
        self.width * self.stride()
    }

    pub(super) fn panel_len(&self) -> usize {
        self.width * (self.stride() + self.rest_stride())
    }

    pub(super) fn update_len(&self) -> usize {
        self.rest.len() * self.rest_stride()
    }

    /// Place in the panels of the entry in `row` and `column` of the front, not left of the diagonal.
    pub(super) fn entry(&self, row: usize, column: usize) -> usize {
        let place = match column.checked_sub(self.width) {
            None => row * self.stride() + column,
            Some(rest) => self.square_len() + row * self.rest_stride() + rest,
        };
        self.panel + place
    }

    /// Square block and rest.
    pub(super) fn blocks<'a>(&self, panels: &'a [f64]) -> (&'a [f64], &'a [f64]) {
        panels[self.panel..][..self.panel_len()].split_at(self.square_len())
    }

    /// The same, to be changed.
    pub(super) fn blocks_mut<'a>(&self, panels: &'a mut [f64]) -> (&'a mut [f64], &'a mut [f64]) {
        panels[self.panel..][..self.panel_len()].split_at_mut(self.square_len())
    }

    /// Adds a child's update matrix to the blocks and the update matrix of this front. `relative`: where the child's later
    /// positions stand in the rows of this front.
    pub(super) fn add_child(
        &self,
        (square, rest): (&mut [f64], &mut [f64]),
        update: &mut [f64],
        child: &[f64],
        child_stride: usize,
        relative: &[u32],
    ) {
        let w = self.width;
        let split = relative.partition_point(|&p| (p as usize) < w);
        let (in_square, in_rest) = relative.split_at(split);
        let (stride, rest_stride) = (self.stride(), self.rest_stride());
        let mut rows = child.chunks_exact(child_stride.max(1));
        for (&p, row) in in_square.iter().zip(&mut rows) {
            let target = &mut square[p as usize * stride..][..stride];
            for (&q, value) in in_square.iter().zip(row) {
                target[q as usize] += value;
            }
            if !in_rest.is_empty() {
                let target = &mut rest[p as usize * rest_stride..][..rest_stride];
                for (&q, value) in in_rest.iter().zip(&row[split..]) {
                    target[q as usize - w] += value;
                }
            }
        }
        for (&p, row) in in_rest.iter().zip(&mut rows) {
            let target = &mut update[(p as usize - w) * rest_stride..][..rest_stride];
            for (&q, value) in in_rest.iter().zip(&row[split..]) {
                target[q as usize - w] += value;
            }
        }
    }

    /// Eliminates the front. `sums` receives what its rows add to the magnitudes of later pivots. Whether all pivots can be
    /// trusted.
    pub(super) fn eliminate(
        &self,
        (square, rest): (&mut [f64], &mut [f64]),
        update: &mut [f64],
        inverse: &mut [f64],
        scale: &mut [f64],
        sums: &mut [f64],
    ) -> bool {
        let (w, stride, rest_stride) = (self.width, self.stride(), self.rest_stride());
        for k in 0..w {
            let (row, below) = square[k * stride..].split_at_mut(stride);
            inverse[k] = 1.0 / row[k];
            if !is_sound(row[k], scale[k]) {
                return false;
            }
            let (own, below_rest) = rest[k * rest_stride..].split_at_mut(rest_stride);
            for i in k + 1..w {
                let l = row[i] * inverse[k];
                scale[i] += (l * row[i]).abs();
                let target = &mut below[(i - k - 1) * stride..][..stride];
                target[i..].iter_mut().zip(&row[i..]).for_each(|(t, s)| *t -= l * s);
                let target = &mut below_rest[(i - k - 1) * rest_stride..][..rest_stride];
                target.iter_mut().zip(&*own).for_each(|(t, s)| *t -= l * s);
                below[(i - k - 1) * stride + k] = l;
            }
        }
        if rest_stride == 0 {
            return true;
        }
        sums.fill(0.0);
        for (row, &reciprocal) in rest.chunks_exact(rest_stride).zip(&*inverse) {
            sums.iter_mut().zip(row).for_each(|(s, u)| *s += (u * u * reciprocal).abs());
        }
        for (i, target) in update.chunks_exact_mut(rest_stride).enumerate() {
            for (row, &reciprocal) in rest.chunks_exact(rest_stride).zip(&*inverse) {
                let l = row[i] * reciprocal;
                target.iter_mut().zip(row).for_each(|(t, s)| *t -= l * s);
            }
        }
        true
    }

    /// `L⁻¹`; `later`: places of the later positions, which change too.
    pub(super) fn forward(
        &self,
        panels: &[f64],
        inverse: &[f64],
        later: &[u32],
        sums: &mut [f64],
        x: &mut [f64],
    ) {
        let ((square, rest), w) = (self.blocks(panels), self.width);
        let (stride, rest_stride) = (self.stride(), self.rest_stride());
        let own = &mut x[self.first..self.first + w];
        let sums = &mut sums[..rest_stride];
        sums.fill(0.0);
        for k in 0..w {
            let (before, after) = own.split_at_mut(k + 1);
            let t = before[k] * inverse[self.first + k];
            let row = &square[k * stride + k + 1..k * stride + w];
            after.iter_mut().zip(row).for_each(|(x, u)| *x -= t * u);
            let row = &rest[k * rest_stride..][..rest_stride];
            sums.iter_mut().zip(row).for_each(|(sum, u)| *sum -= t * u);
        }
        for (&i, sum) in later.iter().zip(sums) {
            x[i as usize] += *sum;
        }
    }

    /// `L⁻ᵀ D⁻¹`.
    pub(super) fn backward(
        &self,
        panels: &[f64],
        inverse: &[f64],
        later: &[u32],
        local: &mut [f64],
        x: &mut [f64],
    ) {
        let ((square, rest), w) = (self.blocks(panels), self.width);
        let (stride, rest_stride) = (self.stride(), self.rest_stride());
        let local = &mut local[..later.len()];
        for (value, &i) in local.iter_mut().zip(later) {
            *value = x[i as usize];
        }
        let own = &mut x[self.first..self.first + w];
        for k in 0..w {
            let row = &rest[k * rest_stride..][..rest_stride];
            own[k] = (own[k] - dot(&row[..local.len()], local)) * inverse[self.first + k];
        }
        for i in (0..w).rev() {
            let (before, from) = own.split_at_mut(i);
            let row = &square[i * stride..i * stride + i];
            before.iter_mut().zip(row).for_each(|(x, l)| *x -= from[0] * l);
        }
    }
}
