//! `K = L D Lᵀ` of a symmetric matrix in the static order, front by front, and its solves.
//!
//! A front of width w with r later positions keeps its w rows in two blocks whose rows are padded to whole chunks of
//! [`LANES`] numbers: the square block, and the rest. Above the diagonal stand the rows of `D Lᵀ`, below it those of L, so
//! that both halves of a solve add multiples of contiguous rows. Update matrices are stored in full: adding whole rows is
//! cheaper than finding their upper halves.

use crate::pattern::SaddlePattern;
use crate::pivot::{PIVOT_DOUBTFUL, PivotTrouble};
use crate::symbolic::{Front, Symbolic};

/// Numbers that the loops take at a time.
const LANES: usize = 4;

type Chunk = [f64; LANES];

fn chunks(len: usize) -> usize {
    len.div_ceil(LANES)
}

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
    /// Offset of the update matrix in its stack.
    update: usize,
    even: bool,
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
    panel_len: usize,
    stack_len: [usize; 2],
    longest: usize,
}

impl LdltLayout {
    pub(crate) fn new(symbolic: &Symbolic) -> Self {
        let mut shapes: Vec<Shape> = Vec::with_capacity(symbolic.fronts.len());
        let (mut panel_len, mut stack_len, mut top, mut longest) = (0, [0; 2], [0; 2], 0);
        for front in &symbolic.fronts {
            for &child in &symbolic.children[front.children.clone()] {
                let child = &shapes[child as usize];
                top[usize::from(child.even)] -= child.update_len();
            }
            let (width, rest) = (front.width, front.rest_len());
            let stack = usize::from(front.even);
            let shape = Shape {
                first: front.first,
                width,
                rest,
                square_chunks: chunks(width),
                rest_chunks: chunks(rest),
                panel: panel_len,
                update: top[stack],
                even: front.even,
            };
            panel_len += shape.panel_len();
            top[stack] += shape.update_len();
            stack_len[stack] = top[stack].max(stack_len[stack]);
            longest = longest.max((shape.square_chunks + shape.rest_chunks) * LANES);
            shapes.push(shape);
        }
        Self { shapes, panel_len, stack_len, longest }
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

/// Factors and buffers.
#[derive(Clone, Debug)]
pub(crate) struct Ldlt {
    panels: Vec<f64>,
    /// Reciprocal pivots.
    inverse: Vec<f64>,
    /// Sum of magnitudes that went into each pivot.
    scale: Vec<f64>,
    /// Update matrices: odd depths, even depths.
    stacks: [Vec<f64>; 2],
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
            stacks: layout.stack_len.map(|length| vec![0.0; length]),
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
        let [odd, even] = &mut self.stacks;
        for (shape, front) in layout.shapes.iter().zip(&symbolic.fronts) {
            let panel = &mut self.panels[shape.panel..shape.panel + shape.panel_len()];
            let (square, rest) = panel.split_at_mut(shape.square_len());
            let (own, below) = if shape.even { (&mut *even, &*odd) } else { (&mut *odd, &*even) };
            let update = &mut own[shape.update..shape.update + shape.update_len()];
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
            let (inverse, scale) = (&mut self.inverse[own.clone()], &mut self.scale[own]);
            let square = square.as_chunks_mut().0;
            let rest = rest.as_chunks_mut().0;
            let update = update.as_chunks_mut().0;
            let sums = &mut self.local.as_chunks_mut().0[..shape.rest_chunks];
            // The sizes as constants let the loops unroll.
            let failed = match (shape.square_chunks, shape.rest_chunks) {
                (1, 0) => eliminate(1, 0, square, rest, update, inverse, scale, sums),
                (1, 1) => eliminate(1, 1, square, rest, update, inverse, scale, sums),
                (2, 0) => eliminate(2, 0, square, rest, update, inverse, scale, sums),
                (2, 1) => eliminate(2, 1, square, rest, update, inverse, scale, sums),
                (3, 1) => eliminate(3, 1, square, rest, update, inverse, scale, sums),
                (p, r) => eliminate(p, r, square, rest, update, inverse, scale, sums),
            };
            if let Some(row) = failed {
                let (pivot, scale) = (1.0 / inverse[row], scale[row]);
                return Err(PivotTrouble { position: shape.first + row, pivot, scale });
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
        for (shape, front) in layout.shapes.iter().zip(&symbolic.fronts) {
            let parts = self.parts(symbolic, shape, front);
            match (shape.square_chunks, shape.rest_chunks) {
                (1, 0) => forward(1, 0, parts, x),
                (1, 1) => forward(1, 1, parts, x),
                (2, 0) => forward(2, 0, parts, x),
                (2, 1) => forward(2, 1, parts, x),
                (3, 1) => forward(3, 1, parts, x),
                (p, r) => forward(p, r, parts, x),
            }
        }
        for (shape, front) in layout.shapes.iter().zip(&symbolic.fronts).rev() {
            let parts = self.parts(symbolic, shape, front);
            match (shape.square_chunks, shape.rest_chunks) {
                (1, 0) => backward(1, 0, parts, x),
                (1, 1) => backward(1, 1, parts, x),
                (2, 0) => backward(2, 0, parts, x),
                (2, 1) => backward(2, 1, parts, x),
                (3, 1) => backward(3, 1, parts, x),
                (p, r) => backward(p, r, parts, x),
            }
        }
    }

    fn parts<'a>(&'a mut self, symbolic: &'a Symbolic, shape: &Shape, front: &Front) -> Parts<'a> {
        let panel = &self.panels[shape.panel..shape.panel + shape.panel_len()];
        let (square, rest) = panel.split_at(shape.square_len());
        Parts {
            square: square.as_chunks().0,
            rest: rest.as_chunks().0,
            inverse: &self.inverse[shape.first..shape.first + shape.width],
            first: shape.first,
            later: &symbolic.rest[front.rest.clone()],
            local: self.local.as_chunks_mut().0,
        }
    }
}

/// What a solve needs of one front.
struct Parts<'a> {
    square: &'a [Chunk],
    rest: &'a [Chunk],
    inverse: &'a [f64],
    first: usize,
    later: &'a [u32],
    local: &'a mut [Chunk],
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

/// Eliminates a front; `sums` receives what its rows add to the scales of later pivots. The row of a pivot that is lost.
#[allow(clippy::too_many_arguments)]
#[inline(always)]
fn eliminate(
    square_chunks: usize,
    rest_chunks: usize,
    square: &mut [Chunk],
    rest: &mut [Chunk],
    update: &mut [Chunk],
    inverse: &mut [f64],
    scale: &mut [f64],
    sums: &mut [Chunk],
) -> Option<usize> {
    let w = inverse.len();
    for k in 0..w {
        let (row, below) = square[k * square_chunks..].split_at_mut(square_chunks);
        let pivot = row.as_flattened()[k];
        inverse[k] = 1.0 / pivot;
        // Also true of NaN.
        if !(pivot.abs() > PIVOT_DOUBTFUL * scale[k] && pivot.is_finite()) {
            return Some(k);
        }
        let (own_rest, below_rest) = rest[k * rest_chunks..].split_at_mut(rest_chunks);
        for i in k + 1..w {
            let target = &mut below[(i - k - 1) * square_chunks..][..square_chunks];
            let u = row.as_flattened()[i];
            let l = u * inverse[k];
            for (target, source) in target.iter_mut().zip(&*row).skip(k / LANES) {
                subtract(target, source, l);
            }
            scale[i] += (l * u).abs();
            let target = &mut below_rest[(i - k - 1) * rest_chunks..][..rest_chunks];
            for (target, source) in target.iter_mut().zip(&*own_rest) {
                subtract(target, source, l);
            }
        }
    }
    // Whole chunks were subtracted: what stands below the diagonal is to be written only now.
    let square = square.as_flattened_mut();
    let stride = square_chunks * LANES;
    for i in 1..w {
        for k in 0..i {
            square[i * stride + k] = square[k * stride + i] * inverse[k];
        }
    }
    sums.fill([0.0; LANES]);
    if rest_chunks == 0 {
        return None;
    }
    for (row, &inverse) in rest.chunks_exact(rest_chunks).zip(&*inverse) {
        for (sum, chunk) in sums.iter_mut().zip(row) {
            for (s, u) in sum.iter_mut().zip(chunk) {
                *s += (u * u * inverse).abs();
            }
        }
    }
    for (i, target) in update.chunks_exact_mut(rest_chunks).enumerate() {
        for (row, &inverse) in rest.chunks_exact(rest_chunks).zip(&*inverse) {
            let l = row.as_flattened()[i] * inverse;
            for (target, source) in target.iter_mut().zip(row) {
                subtract(target, source, l);
            }
        }
    }
    None
}

#[inline(always)]
fn subtract(target: &mut Chunk, source: &Chunk, factor: f64) {
    for (t, s) in target.iter_mut().zip(source) {
        *t -= factor * s;
    }
}

/// `L⁻¹` of one front; also changes the later positions.
#[inline(always)]
fn forward(square_chunks: usize, rest_chunks: usize, parts: Parts<'_>, x: &mut [f64]) {
    let w = parts.inverse.len();
    let (local, sums) = parts.local.split_at_mut(square_chunks);
    let sums = &mut sums[..rest_chunks];
    let own = &mut x[parts.first..parts.first + w];
    local[square_chunks - 1] = [0.0; LANES];
    local.as_flattened_mut()[..w].copy_from_slice(own);
    sums.fill([0.0; LANES]);
    for k in 0..w {
        let z = local.as_flattened()[k];
        let t = z * parts.inverse[k];
        own[k] = z;
        let row = &parts.square[k * square_chunks..][..square_chunks];
        for (target, source) in local.iter_mut().zip(row).skip(k / LANES) {
            subtract(target, source, t);
        }
        for (sum, source) in sums.iter_mut().zip(&parts.rest[k * rest_chunks..][..rest_chunks]) {
            subtract(sum, source, t);
        }
    }
    for (&i, sum) in parts.later.iter().zip(sums.as_flattened()) {
        x[i as usize] += sum;
    }
}

/// `L⁻ᵀ D⁻¹` of one front.
#[inline(always)]
fn backward(square_chunks: usize, rest_chunks: usize, parts: Parts<'_>, x: &mut [f64]) {
    let w = parts.inverse.len();
    let (local, later) = parts.local.split_at_mut(square_chunks);
    let later = &mut later[..rest_chunks];
    if let Some(last) = later.last_mut() {
        *last = [0.0; LANES];
    }
    for (value, &i) in later.as_flattened_mut().iter_mut().zip(parts.later) {
        *value = x[i as usize];
    }
    let own = &mut x[parts.first..parts.first + w];
    for k in 0..w {
        let mut sums = [0.0; LANES];
        for (row, value) in parts.rest[k * rest_chunks..][..rest_chunks].iter().zip(&*later) {
            for lane in 0..LANES {
                sums[lane] += row[lane] * value[lane];
            }
        }
        let sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        local.as_flattened_mut()[k] = (own[k] - sum) * parts.inverse[k];
    }
    for i in (0..w).rev() {
        let value = local.as_flattened()[i];
        own[i] = value;
        let row = &parts.square[i * square_chunks..][..square_chunks];
        for (target, source) in local.iter_mut().zip(row).take(i / LANES + 1) {
            subtract(target, source, value);
        }
    }
}
