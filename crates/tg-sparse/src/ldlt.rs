//! `K = L D Lᵀ` of a symmetric matrix in the static order, front by front, and its solves.
//!
//! A front of width w with r later positions keeps its w rows in two blocks whose rows are padded to whole chunks of
//! [`LANES`] numbers: the square block, and the rest. Above the diagonal stand the rows of `D Lᵀ`, below it those of L, so
//! that both halves of a solve add multiples of contiguous rows. Update matrices are stored in full: adding whole rows is
//! cheaper than finding their upper halves.

use crate::kernels::{Chunk, LANES, chunks, dot};
use crate::pattern::SaddlePattern;
use crate::pivot::{PIVOT_WEAK, PivotTrouble};
use crate::symbolic::{Front, Symbolic};

/// Where one front keeps its numbers.
#[derive(Clone, Debug)]
struct Shape {
    first: usize,
    width: usize,
    rest: usize,
    /// Chunks of a row in the square block and in the rest.
    square_chunks: usize,
    rest_chunks: usize,
    /// Offset of the square block in the panels; the rest follows it.
    panel: usize,
    /// Offset of the update matrix.
    update: usize,
}

impl Shape {
    fn square_len(&self) -> usize {
        self.width * self.square_chunks * LANES
    }

    fn panel_len(&self) -> usize {
        self.square_len() + self.width * self.rest_chunks * LANES
    }

    fn update_len(&self) -> usize {
        self.rest * self.rest_chunks * LANES
    }
}

/// Places of all fronts.
#[derive(Clone, Debug)]
pub(crate) struct LdltLayout {
    shapes: Vec<Shape>,
    /// The fronts by their height above the leaves: neighbours do not wait for each other, and the processor works on
    /// several at a time.
    sequence: Vec<u32>,
    panel_len: usize,
    update_len: usize,
    longest: usize,
}

impl LdltLayout {
    pub(crate) fn new(symbolic: &Symbolic) -> Self {
        let mut shapes: Vec<Shape> = Vec::with_capacity(symbolic.fronts.len());
        let (mut panel_len, mut update_len, mut longest) = (0, 0, 0);
        let mut height = vec![0_u32; symbolic.fronts.len()];
        for (at, front) in symbolic.fronts.iter().enumerate() {
            let children = symbolic.children[front.children.clone()].iter();
            height[at] = children.map(|&child| height[child as usize] + 1).max().unwrap_or(0);
            let (width, rest) = (front.width, front.rest_len());
            let shape = Shape {
                first: front.first,
                width,
                rest,
                square_chunks: chunks(width),
                rest_chunks: chunks(rest),
                panel: panel_len,
                update: update_len,
            };
            panel_len += shape.panel_len();
            update_len += shape.update_len();
            longest = longest.max((shape.square_chunks + shape.rest_chunks) * LANES);
            shapes.push(shape);
        }
        let mut sequence: Vec<u32> = (0..shapes.len() as u32).collect();
        sequence.sort_by_key(|&front| height[front as usize]);
        Self { shapes, sequence, panel_len, update_len, longest }
    }

    /// Length of the panels.
    pub(crate) fn len(&self) -> usize {
        self.panel_len
    }

    /// Place in the panels of each slot of the compressed rows; those below the diagonal have none, which
    /// [`LdltLayout::len`] stands for, as it does for the slot of entries outside of the system.
    pub(crate) fn places(&self, pattern: &SaddlePattern) -> Vec<u32> {
        let rows = &pattern.slots.rows;
        let mut places = vec![self.panel_len as u32; rows.column().len() + 1];
        for (front, shape) in pattern.symbolic.fronts.iter().zip(&self.shapes) {
            let later = &pattern.symbolic.rest[front.rest.clone()];
            for row in 0..shape.width {
                let position = shape.first + row;
                for slot in rows.start()[position]..rows.start()[position + 1] {
                    let column = rows.column()[slot] as usize;
                    if column >= position {
                        places[slot] = shape.place(row, column, later) as u32;
                    }
                }
            }
        }
        places
    }
}

impl Shape {
    /// Place of an entry on or above the diagonal.
    fn place(&self, row: usize, column: usize, later: &[u32]) -> usize {
        if column < self.first + self.width {
            self.panel + row * self.square_chunks * LANES + column - self.first
        } else {
            let at = later.partition_point(|&i| (i as usize) < column);
            self.panel + self.square_len() + row * self.rest_chunks * LANES + at
        }
    }
}

/// Calls a function with width, chunks of the square block and chunks of the rest as constants, which unrolls its loops, for
/// the fronts of one or two bars with their node in the plane or in space, or one that takes any sizes.
macro_rules! sized {
    ($shape:expr, $function:ident($($argument:expr),*), $any:ident) => {
        match ($shape.width, $shape.rest_chunks) {
            (3, 0) => $function::<3, 1, 0>($($argument),*),
            (3, 1) => $function::<3, 1, 1>($($argument),*),
            (3, 2) => $function::<3, 1, 2>($($argument),*),
            (4, 0) => $function::<4, 1, 0>($($argument),*),
            (4, 1) => $function::<4, 1, 1>($($argument),*),
            (4, 2) => $function::<4, 1, 2>($($argument),*),
            (6, 0) => $function::<6, 2, 0>($($argument),*),
            (6, 1) => $function::<6, 2, 1>($($argument),*),
            (8, 0) => $function::<8, 2, 0>($($argument),*),
            (8, 1) => $function::<8, 2, 1>($($argument),*),
            (_, rest_chunks) => $any($shape.square_chunks, rest_chunks, $($argument),*),
        }
    };
}

/// Factors and buffers.
#[derive(Clone, Debug)]
pub(crate) struct Ldlt {
    panels: Vec<f64>,
    /// Reciprocal pivots.
    inverse: Vec<f64>,
    /// Sum of magnitudes that went into each pivot.
    scale: Vec<f64>,
    /// Update matrices.
    updates: Vec<f64>,
    /// One front's part of a vector.
    local: Vec<f64>,
}

impl Ldlt {
    pub(crate) fn new(layout: &LdltLayout) -> Self {
        let size = layout.shapes.iter().map(|shape| shape.width).sum();
        Self {
            panels: vec![0.0; layout.panel_len + 1],
            inverse: vec![0.0; size],
            scale: vec![0.0; size],
            updates: vec![0.0; layout.update_len],
            local: vec![0.0; layout.longest],
        }
    }

    /// The panels with these values, for more to be added.
    pub(crate) fn start(&mut self, constant: &[f64]) -> &mut [f64] {
        self.panels.copy_from_slice(constant);
        &mut self.panels
    }

    /// Factors what stands in the panels.
    pub(crate) fn factor(&mut self, symbolic: &Symbolic, layout: &LdltLayout) -> Result<(), PivotTrouble> {
        self.scale.fill(0.0);
        for &at in &layout.sequence {
            let (shape, front) = (&layout.shapes[at as usize], &symbolic.fronts[at as usize]);
            let panel = &mut self.panels[shape.panel..shape.panel + shape.panel_len()];
            let (square, rest) = panel.split_at_mut(shape.square_len());
            // Children come before their parents, also in memory.
            let (below, own) = self.updates.split_at_mut(shape.update);
            let update = &mut own[..shape.update_len()];
            update.fill(0.0);
            for row in 0..shape.width {
                self.scale[shape.first + row] += square[row * (shape.square_chunks * LANES + 1)].abs();
            }
            for &child in &symbolic.children[front.children.clone()] {
                let relative = &symbolic.relative[symbolic.fronts[child as usize].rest.clone()];
                let child = &layout.shapes[child as usize];
                let values = &below[child.update..child.update + child.update_len()];
                add_child(shape, square, rest, update, values, child.rest_chunks * LANES, relative);
            }
            let own = shape.first..shape.first + shape.width;
            let elimination = Elimination {
                square,
                rest,
                update,
                inverse: &mut self.inverse[own.clone()],
                scale: &mut self.scale[own],
                later: &mut self.local[..shape.rest_chunks * LANES],
            };
            let failed = sized!(shape, eliminate(elimination), eliminate_any);
            if let Some(row) = failed {
                let position = shape.first + row;
                let (pivot, scale) = (1.0 / self.inverse[position], self.scale[position]);
                return Err(PivotTrouble { position, pivot, scale });
            }
            let sums = self.local.iter().take(shape.rest);
            for (&i, sum) in symbolic.rest[front.rest.clone()].iter().zip(sums) {
                self.scale[i as usize] += sum;
            }
        }
        Ok(())
    }

    /// `x ← L⁻ᵀ D⁻¹ L⁻¹ x` in elimination order.
    pub(crate) fn solve(&mut self, symbolic: &Symbolic, layout: &LdltLayout, x: &mut [f64]) {
        for &at in &layout.sequence {
            let (shape, front) = (&layout.shapes[at as usize], &symbolic.fronts[at as usize]);
            let parts = self.parts(symbolic, shape, front);
            sized!(shape, forward(parts, x), forward_any);
        }
        for &at in layout.sequence.iter().rev() {
            let (shape, front) = (&layout.shapes[at as usize], &symbolic.fronts[at as usize]);
            let parts = self.parts(symbolic, shape, front);
            sized!(shape, backward(parts, x), backward_any);
        }
    }

    fn parts<'a>(&'a mut self, symbolic: &'a Symbolic, shape: &Shape, front: &Front) -> Parts<'a> {
        let panel = &self.panels[shape.panel..shape.panel + shape.panel_len()];
        let (square, rest) = panel.split_at(shape.square_len());
        Parts {
            square,
            rest,
            inverse: &self.inverse[shape.first..shape.first + shape.width],
            first: shape.first,
            later: &symbolic.rest[front.rest.clone()],
            local: &mut self.local,
        }
    }
}

/// What a solve needs of one front.
struct Parts<'a> {
    square: &'a [f64],
    rest: &'a [f64],
    inverse: &'a [f64],
    first: usize,
    later: &'a [u32],
    local: &'a mut [f64],
}

/// Adds a child's update matrix to the panel and the update matrix of its parent.
fn add_child(
    shape: &Shape,
    square: &mut [f64],
    rest: &mut [f64],
    update: &mut [f64],
    child: &[f64],
    stride: usize,
    relative: &[u32],
) {
    let w = shape.width;
    let split = relative.partition_point(|&p| (p as usize) < w);
    let (in_square, in_rest) = relative.split_at(split);
    let (square_stride, rest_stride) = (shape.square_chunks * LANES, shape.rest_chunks * LANES);
    let mut rows = child.chunks_exact(stride.max(1));
    for (&p, row) in in_square.iter().zip(&mut rows) {
        let target = &mut square[p as usize * square_stride..][..square_stride];
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

/// What the elimination of one front reads and writes.
struct Elimination<'a> {
    square: &'a mut [f64],
    rest: &'a mut [f64],
    update: &'a mut [f64],
    /// Reciprocal pivots.
    inverse: &'a mut [f64],
    /// Magnitudes that went into the pivots.
    scale: &'a mut [f64],
    /// Receives what the rows add to those of later pivots.
    later: &'a mut [f64],
}

/// The reciprocal of a pivot that is not lost. Not of NaN either.
#[inline(always)]
fn invert(pivot: f64, scale: f64) -> Option<f64> {
    (pivot.abs() > PIVOT_WEAK * scale && pivot.is_finite()).then(|| 1.0 / pivot)
}

/// Eliminates a front of width W whose rows have P and R chunks. The row of a pivot that is lost.
fn eliminate<const W: usize, const P: usize, const R: usize>(front: Elimination<'_>) -> Option<usize> {
    let Elimination { square, rest, update, inverse, scale, later: sums } = front;
    let inverse = &mut inverse[..W];
    let scale = &mut scale[..W];
    let square = &mut rows_mut::<P>(square)[..W];
    let mut magnitude = [[0.0; LANES]; P];
    magnitude.as_flattened_mut()[..W].copy_from_slice(scale);
    let mut later = [[0.0; LANES]; R];
    // Without rest there are no such rows.
    let rest = if R == 0 { &mut [][..] } else { &mut rows_mut::<R>(rest)[..W] };
    for k in 0..W {
        let row = square[k];
        let Some(reciprocal) = invert(row[k / LANES][k % LANES], magnitude[k / LANES][k % LANES]) else {
            inverse[k] = 1.0 / row[k / LANES][k % LANES];
            scale[k] = magnitude[k / LANES][k % LANES];
            return Some(k);
        };
        inverse[k] = reciprocal;
        for c in 0..P {
            add_squares(&mut magnitude[c], &row[c], reciprocal);
        }
        let flat = row.as_flattened();
        for i in k + 1..W {
            let l = flat[i] * reciprocal;
            for c in 0..P {
                subtract(&mut square[i][c], &row[c], l);
            }
        }
        if R > 0 {
            let own = rest[k];
            for c in 0..R {
                add_squares(&mut later[c], &own[c], reciprocal);
            }
            for i in k + 1..W {
                let l = flat[i] * reciprocal;
                for c in 0..R {
                    subtract(&mut rest[i][c], &own[c], l);
                }
            }
        }
    }
    // Whole rows were subtracted: what stands below the diagonal is to be written only now.
    for k in 0..W {
        let (row, reciprocal) = (square[k], inverse[k]);
        let flat = row.as_flattened();
        for i in k + 1..W {
            square[i][k / LANES][k % LANES] = flat[i] * reciprocal;
        }
    }
    if R > 0 {
        sums.copy_from_slice(later.as_flattened());
        for (i, target) in rows_mut::<R>(update).iter_mut().enumerate() {
            let mut row = *target;
            for (own, &reciprocal) in rest.iter().zip(&*inverse) {
                let l = own[i / LANES][i % LANES] * reciprocal;
                for c in 0..R {
                    subtract(&mut row[c], &own[c], l);
                }
            }
            *target = row;
        }
    }
    None
}

/// As [`eliminate`] with any number of chunks.
fn eliminate_any(square_chunks: usize, rest_chunks: usize, front: Elimination<'_>) -> Option<usize> {
    let Elimination { square, rest, update, inverse, scale, later: sums } = front;
    let (w, stride, rest_stride) = (inverse.len(), square_chunks * LANES, rest_chunks * LANES);
    for k in 0..w {
        let (row, below) = square[k * stride..].split_at_mut(stride);
        let Some(reciprocal) = invert(row[k], scale[k]) else {
            inverse[k] = 1.0 / row[k];
            return Some(k);
        };
        inverse[k] = reciprocal;
        let (own, below_rest) = rest[k * rest_stride..].split_at_mut(rest_stride);
        for i in k + 1..w {
            let l = row[i] * reciprocal;
            scale[i] += (l * row[i]).abs();
            let target = &mut below[(i - k - 1) * stride..][..stride];
            target[i..].iter_mut().zip(&row[i..]).for_each(|(t, s)| *t -= l * s);
            let target = &mut below_rest[(i - k - 1) * rest_stride..][..rest_stride];
            target.iter_mut().zip(&*own).for_each(|(t, s)| *t -= l * s);
            below[(i - k - 1) * stride + k] = l;
        }
    }
    if rest_chunks == 0 {
        return None;
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
    None
}

fn rows<const N: usize>(values: &[f64]) -> &[[Chunk; N]] {
    values.as_chunks().0.as_chunks().0
}

fn rows_mut<const N: usize>(values: &mut [f64]) -> &mut [[Chunk; N]] {
    values.as_chunks_mut().0.as_chunks_mut().0
}

#[inline(always)]
fn subtract(target: &mut Chunk, source: &Chunk, factor: f64) {
    for (t, s) in target.iter_mut().zip(source) {
        *t -= factor * s;
    }
}

/// `sums ← sums + |u² / pivot|`.
#[inline(always)]
fn add_squares(sums: &mut Chunk, u: &Chunk, reciprocal: f64) {
    for (sum, u) in sums.iter_mut().zip(u) {
        *sum += (u * u * reciprocal).abs();
    }
}

/// `L⁻¹` of one front; also changes the later positions.
fn forward<const W: usize, const P: usize, const R: usize>(parts: Parts<'_>, x: &mut [f64]) {
    let inverse = &parts.inverse[..W];
    let own = &mut x[parts.first..parts.first + W];
    let mut local = [[0.0; LANES]; P];
    local.as_flattened_mut()[..W].copy_from_slice(own);
    let mut sums = [[0.0; LANES]; R];
    let square = &rows::<P>(parts.square)[..W];
    for k in 0..W {
        let z = local[k / LANES][k % LANES];
        let t = z * inverse[k];
        own[k] = z;
        for c in 0..P {
            subtract(&mut local[c], &square[k][c], t);
        }
        if R > 0 {
            let row = &rows::<R>(parts.rest)[k];
            for c in 0..R {
                subtract(&mut sums[c], &row[c], t);
            }
        }
    }
    for (&i, sum) in parts.later.iter().zip(sums.as_flattened()) {
        x[i as usize] += sum;
    }
}

/// As [`forward`] with any number of chunks.
fn forward_any(square_chunks: usize, rest_chunks: usize, parts: Parts<'_>, x: &mut [f64]) {
    let (w, stride, rest_stride) = (parts.inverse.len(), square_chunks * LANES, rest_chunks * LANES);
    let own = &mut x[parts.first..parts.first + w];
    let sums = &mut parts.local[..rest_stride];
    sums.fill(0.0);
    for k in 0..w {
        let (before, after) = own.split_at_mut(k + 1);
        let t = before[k] * parts.inverse[k];
        let row = &parts.square[k * stride + k + 1..k * stride + w];
        after.iter_mut().zip(row).for_each(|(x, u)| *x -= t * u);
        let row = &parts.rest[k * rest_stride..][..rest_stride];
        sums.iter_mut().zip(row).for_each(|(sum, u)| *sum -= t * u);
    }
    for (&i, sum) in parts.later.iter().zip(sums) {
        x[i as usize] += *sum;
    }
}

/// `L⁻ᵀ D⁻¹` of one front.
fn backward<const W: usize, const P: usize, const R: usize>(parts: Parts<'_>, x: &mut [f64]) {
    let inverse = &parts.inverse[..W];
    let mut later = [[0.0; LANES]; R];
    for (value, &i) in later.as_flattened_mut().iter_mut().zip(parts.later) {
        *value = x[i as usize];
    }
    let own = &mut x[parts.first..parts.first + W];
    let mut local = [[0.0; LANES]; P];
    for k in 0..W {
        let mut sums = [0.0; LANES];
        if R > 0 {
            let row = &rows::<R>(parts.rest)[k];
            for c in 0..R {
                for lane in 0..LANES {
                    sums[lane] += row[c][lane] * later[c][lane];
                }
            }
        }
        let sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        local[k / LANES][k % LANES] = (own[k] - sum) * inverse[k];
    }
    let square = &rows::<P>(parts.square)[..W];
    for i in (0..W).rev() {
        let value = local[i / LANES][i % LANES];
        own[i] = value;
        for c in 0..P {
            subtract(&mut local[c], &square[i][c], value);
        }
    }
}

/// As [`backward`] with any number of chunks.
fn backward_any(square_chunks: usize, rest_chunks: usize, parts: Parts<'_>, x: &mut [f64]) {
    let (w, stride, rest_stride) = (parts.inverse.len(), square_chunks * LANES, rest_chunks * LANES);
    let later = &mut parts.local[..parts.later.len()];
    for (value, &i) in later.iter_mut().zip(parts.later) {
        *value = x[i as usize];
    }
    let own = &mut x[parts.first..parts.first + w];
    for k in 0..w {
        let row = &parts.rest[k * rest_stride..][..rest_stride];
        own[k] = (own[k] - dot(&row[..later.len()], later)) * parts.inverse[k];
    }
    for i in (0..w).rev() {
        let (before, from) = own.split_at_mut(i);
        let row = &parts.square[i * stride..i * stride + i];
        before.iter_mut().zip(row).for_each(|(x, l)| *x -= from[0] * l);
    }
}
