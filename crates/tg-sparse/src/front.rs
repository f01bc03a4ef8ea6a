//! Dense work on one front: children's contributions, elimination of its rows, Schur complement on the rest.
//!
//! A front of width w with r later positions is a panel of w rows `[U row: w + r | L column: r]`, where the strictly
//! lower triangle of the first w columns holds the rest of L, and an update matrix r × r.

use crate::kernels::{TILE, pack, subtract_product, subtract_rows};
use crate::pivot::PivotTrouble;

/// Rows that a product takes at a time: a block of a large front stays in the second-level cache.
const BLOCK: usize = 64;

/// Rows of a panel that are eliminated among themselves before the rows below, which then take them in as products.
/// At most [`BLOCK`].
const PANEL_BLOCK: usize = 64;

/// Rows that one pass over another row takes in.
const FUSED: usize = 4;

/// Fronts with a larger product of width and rest use register tiles; their setup costs more than it gains on smaller.
const TILED: usize = 300;

/// Buffer for packed rows that a front of this length needs.
pub(crate) fn packed_len(longest: usize) -> usize {
    BLOCK * (2 * longest.div_ceil(TILE) + 2)
}

/// Adds a child's update matrix to the panel and the update matrix of its parent.
pub(crate) fn add_child(
    panel: &mut [f64],
    update: &mut [f64],
    w: usize,
    r: usize,
    child: &[f64],
    relative: &[u32],
) {
    let count = relative.len();
    let stride = w + 2 * r;
    let split = relative.partition_point(|&p| (p as usize) < w);
    let (in_panel, in_rest) = relative.split_at(split);
    let (top, bottom) = child.split_at(split * count);
    for (row, &p) in top.chunks_exact(count).zip(in_panel) {
        let target = &mut panel[p as usize * stride..][..w + r];
        for (&value, &q) in row.iter().zip(relative) {
            target[q as usize] += value;
        }
    }
    for (row, &p) in bottom.chunks_exact(count).zip(in_rest) {
        let (left, right) = row.split_at(split);
        for (&value, &q) in left.iter().zip(in_panel) {
            panel[q as usize * stride + r + p as usize] += value;
        }
        let target = &mut update[(p as usize - w) * r..][..r];
        for (&value, &q) in right.iter().zip(in_rest) {
            target[q as usize - w] += value;
        }
    }
}

/// Eliminates the panel's w rows, by blocks of rows: within the block, then from the rows below it. `invert` gives the
/// reciprocal of a pivot from (row, pivot, scale).
pub(crate) fn eliminate(
    panel: &mut [f64],
    w: usize,
    r: usize,
    inverse: &mut [f64],
    scale: &mut [f64],
    packed: &mut [[f64; TILE]],
    mut invert: impl FnMut(usize, f64, f64) -> Result<f64, PivotTrouble>,
) -> Result<(), PivotTrouble> {
    let stride = w + 2 * r;
    let mut first = 0;
    while first < w {
        // A few rows more than a block are still faster row by row.
        let end = if w - first <= 2 * PANEL_BLOCK { w } else { first + PANEL_BLOCK };
        for start in (first..end).step_by(FUSED) {
            for i in start..end {
                let (above, row) = panel[..(i + 1) * stride].split_at_mut(i * stride);
                let block = &above[start * stride..];
                let (inverse, scale) = (&mut inverse[start..], &mut scale[i]);
                match i - start {
                    0 => {}
                    1 => eliminate_row::<1>(row, block, start, i, w + r, inverse, scale),
                    2 => eliminate_row::<2>(row, block, start, i, w + r, inverse, scale),
                    3 => eliminate_row::<3>(row, block, start, i, w + r, inverse, scale),
                    _ => eliminate_row::<FUSED>(row, block, start, i, w + r, inverse, scale),
                }
                if i < start + FUSED {
                    let reciprocal = invert(i, row[i], *scale)?;
                    inverse[i - start] = reciprocal;
                    row[w + r..].iter_mut().for_each(|l| *l *= reciprocal);
                }
            }
        }
        if end < w {
            eliminate_below(panel, first..end, w, r, inverse, scale, packed);
        }
        first = end;
    }
    Ok(())
}

/// Eliminates K rows, the first of `block` and of number `start`, from row `i`, all in one pass over it.
#[allow(clippy::too_many_arguments)]
#[inline(always)]
fn eliminate_row<const K: usize>(
    row: &mut [f64],
    block: &[f64],
    start: usize,
    i: usize,
    upper_len: usize,
    inverse: &[f64],
    scale: &mut f64,
) {
    let stride = row.len();
    let rows: [&[f64]; K] = std::array::from_fn(|k| &block[k * stride..(k + 1) * stride]);
    let (upper, lower) = row.split_at_mut(upper_len);
    let mut l = [0.0; K];
    for k in 0..K {
        l[k] = upper[start + k] * inverse[k];
        upper[start + k] = l[k];
        for j in k + 1..K {
            upper[start + j] -= l[k] * rows[k][start + j];
        }
    }
    let u = rows.map(|row| row[i]);
    for k in 0..K {
        *scale += (l[k] * u[k]).abs();
    }
    subtract_rows(&mut upper[start + K..], rows.map(|row| &row[start + K..]), l);
    subtract_rows(lower, rows.map(|row| &row[upper_len..]), u);
}

/// Eliminates the rows in `range` of a panel from all rows below them.
fn eliminate_below(
    panel: &mut [f64],
    range: std::ops::Range<usize>,
    w: usize,
    r: usize,
    inverse: &[f64],
    scale: &mut [f64],
    packed: &mut [[f64; TILE]],
) {
    let stride = w + 2 * r;
    let (first, end, count) = (range.start, range.end, range.len());
    let (above, below) = panel.split_at_mut(end * stride);
    let block = &above[first * stride..];
    let (packed_upper, packed_lower) = packed.split_at_mut(count * (w + r - end).div_ceil(TILE));
    let packed_upper = pack(packed_upper, &block[end..], stride, count, w + r - end);
    let packed_lower = pack(packed_lower, &block[w + r..], stride, count, r);
    for (rows, i) in below.chunks_mut(TILE * stride).zip((end..w).step_by(TILE)) {
        let mut lower = [[0.0; TILE]; BLOCK];
        let mut upper = [[0.0; TILE]; BLOCK];
        for (at, (row, scale)) in rows.chunks_exact_mut(stride).zip(&mut scale[i..]).enumerate() {
            for (k, source) in block.chunks_exact(stride).enumerate() {
                let l = row[first + k] * inverse[first + k];
                row[first + k] = l;
                subtract_rows(&mut row[first + k + 1..end], [&source[first + k + 1..end]], [l]);
                lower[k][at] = l;
                upper[k][at] = source[i + at];
                *scale += (l * source[i + at]).abs();
            }
        }
        subtract_product(&mut rows[end..], stride, &lower[..count], packed_upper, w + r - end);
        subtract_product(&mut rows[w + r..], stride, &upper[..count], packed_lower, r);
    }
}

/// `update ← update − L U` on the rest.
pub(crate) fn subtract_products(
    update: &mut [f64],
    panel: &[f64],
    w: usize,
    r: usize,
    packed: &mut [[f64; TILE]],
) {
    let stride = w + 2 * r;
    if w * r < TILED {
        let mut four = panel.chunks_exact(FUSED * stride);
        for rows in &mut four {
            update_rows::<FUSED>(update, rows, w, r);
        }
        return match four.remainder().len() / stride {
            0 => {}
            1 => update_rows::<1>(update, four.remainder(), w, r),
            2 => update_rows::<2>(update, four.remainder(), w, r),
            _ => update_rows::<3>(update, four.remainder(), w, r),
        };
    }
    for rows in panel.chunks(BLOCK * stride) {
        let count = rows.len() / stride;
        let source = pack(packed, &rows[w..], stride, count, r);
        for (target, i) in update.chunks_mut(TILE * r).zip((0..r).step_by(TILE)) {
            let mut coefficients = [[0.0; TILE]; BLOCK];
            for (coefficient, row) in coefficients.iter_mut().zip(rows.chunks_exact(stride)) {
                for (c, l) in coefficient.iter_mut().zip(&row[w + r + i..]) {
                    *c = *l;
                }
            }
            subtract_product(target, r, &coefficients[..count], source, r);
        }
    }
}

/// The part of K panel rows in `update ← update − L U`.
#[inline(always)]
fn update_rows<const K: usize>(update: &mut [f64], panel: &[f64], w: usize, r: usize) {
    let stride = w + 2 * r;
    let rows: [&[f64]; K] = std::array::from_fn(|k| &panel[k * stride..(k + 1) * stride]);
    let (upper, lower) = (rows.map(|row| &row[w..w + r]), rows.map(|row| &row[w + r..]));
    for (i, target) in update.chunks_exact_mut(r).enumerate() {
        subtract_rows(target, upper, lower.map(|row| row[i]));
    }
}
