//! Fronts of one shape side by side: lane by lane the same arithmetic on another front.
//!
//! The panel of a front is its rows of `D Lᵀ` from the diagonal on, each number a chunk of [`LANES`] fronts. Nothing else is
//! kept: row k serves both halves of a solve. What a front leaves to later positions is subtracted at once where it
//! belongs, in the panels of the fronts that eliminate them.

use wide::f64x4;

use crate::kernels::LANES;
use crate::pivot::PIVOT_WEAK;

/// One number of each lane.
pub(crate) type Lanes = f64x4;

/// [`LANES`] fronts of one shape. Idle lanes hold the unit matrix.
#[derive(Clone, Debug)]
pub(super) struct Batch {
    pub(super) width: usize,
    pub(super) rest: usize,
    /// Its first chunk in the panels.
    pub(super) panel: usize,
    /// Its first chunk in vectors.
    pub(super) first: usize,
    /// Where its targets start: the places of the r later positions in vectors, then those of the upper triangle of the
    /// update matrix, by rows, in the panels.
    pub(super) targets: usize,
    /// Whether the targets of all lanes are lanes of one chunk: a target is then a chunk, else as many numbers as there are
    /// lanes.
    pub(super) together: bool,
    /// Chunks of the panels, from the first on, that this batch and those before it reach.
    pub(super) reach: usize,
}

/// Chunks of a panel.
pub(super) fn panel_len(width: usize, rest: usize) -> usize {
    row_start(width, width + rest)
}

/// Where a row of a panel of rows of decreasing length starts.
fn row_start(row: usize, order: usize) -> usize {
    row * (2 * order + 1 - row) / 2
}

/// Chunk in its panel of the entry in `row` and `column`, not left of the diagonal.
pub(super) fn entry(row: usize, column: usize, order: usize) -> usize {
    row_start(row, order) + column - row
}

/// Number of targets of a batch.
pub(super) fn targets_len(rest: usize, together: bool) -> usize {
    (rest + rest * (rest + 1) / 2) * if together { 1 } else { LANES }
}

/// What a factorisation reads and writes.
pub(super) struct Elimination<'a> {
    pub(super) panels: &'a mut [Lanes],
    /// Reciprocal pivots.
    pub(super) inverse: &'a mut [Lanes],
    /// Magnitudes that went into the pivots.
    pub(super) scale: &'a mut [Lanes],
    /// Space for L.
    pub(super) local: &'a mut [Lanes],
    pub(super) targets: &'a [u32],
}

/// What a solve reads.
#[derive(Clone, Copy)]
pub(super) struct Solve<'a> {
    pub(super) panels: &'a [Lanes],
    pub(super) inverse: &'a [Lanes],
    pub(super) targets: &'a [u32],
}

/// Calls a function with the frequent shapes as constants, which unrolls its loops: ends and links of chains of bars in the
/// plane and in space.
macro_rules! sized {
    ($batch:ident, $function:ident($($argument:expr),*)) => {
        match ($batch.width, $batch.rest, $batch.together) {
            (2, 3, true) => $function::<true, 4, 8>(2, 3, $batch, $($argument),*),
            (3, 3, true) => $function::<true, 4, 8>(3, 3, $batch, $($argument),*),
            (3, 4, true) => $function::<true, 4, 8>(3, 4, $batch, $($argument),*),
            (4, 4, true) => $function::<true, 4, 8>(4, 4, $batch, $($argument),*),
            (width, rest, true) => $function::<true, 0, 0>(width, rest, $batch, $($argument),*),
            (width, rest, false) => $function::<false, 0, 0>(width, rest, $batch, $($argument),*),
        }
    };
}

/// Eliminates a batch. Whether all pivots can be trusted.
pub(super) fn eliminate(batch: &Batch, work: Elimination<'_>) -> bool {
    sized!(batch, eliminate_sized(work))
}

/// `D⁻¹ L⁻¹`, with what the batch adds to later positions.
pub(super) fn forward(batch: &Batch, work: Solve<'_>, x: &mut [Lanes]) {
    sized!(batch, forward_sized(work, x));
}

/// `L⁻ᵀ`, with space for the later components.
pub(super) fn backward(batch: &Batch, work: Solve<'_>, local: &mut [Lanes], x: &mut [Lanes]) {
    sized!(batch, backward_sized(work, local, x));
}

/// Whether a pivot can be trusted: not one that has lost its digits or is NaN; with an infinite pivot the scale is infinite too.
#[inline(always)]
pub(super) fn is_sound(pivot: f64, scale: f64) -> bool {
    pivot.abs() > PIVOT_WEAK * scale
}

/// A loop whose first N rounds are written out: where its bounds are constants nothing of it is left.
macro_rules! unrolled {
    ($n:ident, $i:ident from $from:expr, to $to:expr, $body:block) => {{
        let (from, to): (usize, usize) = ($from, $to);
        unrolled!(@ $n, $i, from, to, $body, 0 1 2 3 4 5 6 7);
        for $i in from.max($n)..to $body
    }};
    (@ $n:ident, $i:ident, $from:ident, $to:ident, $body:block, $($at:literal)*) => {
        $(if $at < $n && $from <= $at && $at < $to {
            let $i: usize = $at;
            $body
        })*
    };
}

#[inline(always)]
fn eliminate_sized<const TOGETHER: bool, const W: usize, const N: usize>(
    w: usize,
    r: usize,
    batch: &Batch,
    work: Elimination<'_>,
) -> bool {
    let Elimination { panels, inverse, scale, local, targets } = work;
    let (order, end) = (w + r, batch.panel + panel_len(w, r));
    let (panels, later_panels) = panels.split_at_mut(end);
    let panel = &mut panels[batch.panel..][..panel_len(w, r)];
    let (own_scale, later_scale) = scale[batch.first..].split_at_mut(w);
    let inverse = &mut inverse[batch.first..][..w];
    let targets = &targets[batch.targets..][..targets_len(r, TOGETHER)];
    let factors = &mut local[..w * order];
    let mut sound = Lanes::ZERO.simd_eq(Lanes::ZERO);
    unrolled!(W, k from 0, to w, {
        // Row k is final once the rows above it are subtracted.
        let mut scale = own_scale[k];
        unrolled!(N, c from k, to order, {
            let mut value = panel[entry(k, c, order)];
            unrolled!(W, j from 0, to k, {
                let product = factors[j * order + k] * panel[entry(j, c, order)];
                if c == k {
                    scale += product.abs();
                }
                value -= product;
            });
            panel[entry(k, c, order)] = value;
        });
        let pivot = panel[entry(k, k, order)];
        let reciprocal = Lanes::ONE / pivot;
        own_scale[k] = scale;
        inverse[k] = reciprocal;
        sound &= pivot.abs().simd_gt(scale * PIVOT_WEAK);
        unrolled!(N, i from k + 1, to order, { factors[k * order + i] = panel[entry(k, i, order)] * reciprocal });
    });
    let mut at = r;
    unrolled!(N, i from w, to order, {
        unrolled!(N, c from i, to order, {
            let (mut sum, mut magnitude) = (Lanes::ZERO, Lanes::ZERO);
            unrolled!(W, k from 0, to w, {
                let product = factors[k * order + i] * panel[entry(k, c, order)];
                sum -= product;
                if c == i {
                    magnitude += product.abs();
                }
            });
            scatter::<TOGETHER>(later_panels, end, targets, at, sum);
            at += 1;
            if c == i {
                scatter::<TOGETHER>(later_scale, batch.first + w, targets, i - w, magnitude);
            }
        });
    });
    sound.all()
}

#[inline(always)]
fn forward_sized<const TOGETHER: bool, const W: usize, const N: usize>(
    w: usize,
    r: usize,
    batch: &Batch,
    work: Solve<'_>,
    x: &mut [Lanes],
) {
    let (order, end) = (w + r, batch.first + w);
    let panel = &work.panels[batch.panel..][..panel_len(w, r)];
    let targets = &work.targets[batch.targets..][..targets_len(r, TOGETHER)];
    let inverse = &work.inverse[batch.first..][..w];
    let (own, later) = x[batch.first..].split_at_mut(w);
    unrolled!(W, k from 0, to w, {
        own[k] *= inverse[k];
        unrolled!(W, i from k + 1, to w, { own[i] -= own[k] * panel[entry(k, i, order)] });
    });
    unrolled!(N, c from w, to order, {
        let mut sum = Lanes::ZERO;
        unrolled!(W, k from 0, to w, { sum -= own[k] * panel[entry(k, c, order)] });
        scatter::<TOGETHER>(later, end, targets, c - w, sum);
    });
}

#[inline(always)]
fn backward_sized<const TOGETHER: bool, const W: usize, const N: usize>(
    w: usize,
    r: usize,
    batch: &Batch,
    work: Solve<'_>,
    local: &mut [Lanes],
    x: &mut [Lanes],
) {
    let (order, end) = (w + r, batch.first + w);
    let panel = &work.panels[batch.panel..][..panel_len(w, r)];
    let targets = &work.targets[batch.targets..][..targets_len(r, TOGETHER)];
    let inverse = &work.inverse[batch.first..][..w];
    let (own, after) = x[batch.first..].split_at_mut(w);
    let later = &mut local[..r];
    unrolled!(W, c from 0, to r, { later[c] = gather::<TOGETHER>(after, end, targets, c) });
    // What does not wait for the rows below comes first.
    unrolled!(W, k from 0, to w, {
        let mut sum = Lanes::ZERO;
        unrolled!(W, c from 0, to r, { sum += panel[entry(k, w + c, order)] * later[c] });
        own[k] -= sum * inverse[k];
    });
    unrolled!(W, k from 0, to w, {
        let k = w - 1 - k;
        let mut sum = Lanes::ZERO;
        unrolled!(W, i from k + 1, to w, { sum += panel[entry(k, i, order)] * own[i] });
        own[k] -= sum * inverse[k];
    });
}

/// Adds a chunk at its target; `values` starts with chunk `offset`.
#[inline(always)]
fn scatter<const TOGETHER: bool>(
    values: &mut [Lanes],
    offset: usize,
    targets: &[u32],
    at: usize,
    chunk: Lanes,
) {
    if TOGETHER {
        values[targets[at] as usize - offset] += chunk;
    } else {
        let values: &mut [f64] = bytemuck::cast_slice_mut(values);
        for (&target, value) in targets[at * LANES..][..LANES].iter().zip(chunk.to_array()) {
            values[target as usize - offset * LANES] += value;
        }
    }
}

/// The chunk at a target.
#[inline(always)]
fn gather<const TOGETHER: bool>(values: &[Lanes], offset: usize, targets: &[u32], at: usize) -> Lanes {
    if TOGETHER {
        values[targets[at] as usize - offset]
    } else {
        let (values, targets): (&[f64], _) = (bytemuck::cast_slice(values), &targets[at * LANES..][..LANES]);
        Lanes::new(std::array::from_fn(|lane| values[targets[lane] as usize - offset * LANES]))
    }
}
