//! Numeric factorisation in the static order, `K = L U` with unit lower triangular `L`, and its solves.
//!
//! Multifrontal: each front gathers its entries of `K` and the update matrices of its children, eliminates its
//! positions, `l_ik = a_ik / u_kk`, `a_ij ← a_ij − l_ik u_kj`, and leaves the Schur complement on the rest to its
//! parent. All loops run over contiguous rows. No allocation after [`StaticLu::new`].
//!
//! **Pivot check.** The pivot of row i is `u_ii = k_ii − Σ l_ik u_ki`. It is compared with
//! `s_i = |k_ii| + Σ |l_ik u_ki|`, the sum of the magnitudes that went into it: the ratio does not depend on the units
//! or the scaling of rows and columns, which differ between unknowns and multipliers. For a multiplier it is, up to a
//! factor of two, the squared sine of the angle (in the metric of `H⁻¹`) between its row of `A` and the rows before it.
//! Rounding leaves about `ε s_i` of a pivot that vanishes.

use crate::pattern::SaddlePattern;
use crate::symbolic::Symbolic;

/// A pivot below this share of `s_i` has lost all digits but one or two (450 ε): trouble.
pub(crate) const PIVOT_LOST: f64 = 1e-13;

/// A pivot below this share of `s_i` has lost half of the digits. It may be the rounding error of a pivot that vanishes
/// where earlier pivots were lossy too; the caller has to probe it.
pub(crate) const PIVOT_DOUBTFUL: f64 = 1e-8;

/// What to do with small pivots.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PivotRule {
    /// Stop at a lost pivot, note doubtful ones.
    Check,
    /// Take a row and column out of the system when its pivot is below this value; its component of every solution is
    /// then zero.
    Drop(f64),
}

/// A pivot that vanishes or is not finite.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PivotTrouble {
    pub(crate) position: usize,
    pub(crate) pivot: f64,
    pub(crate) scale: f64,
}

/// Factors and buffers.
#[derive(Clone, Debug)]
pub(crate) struct StaticLu {
    /// Panels of all fronts.
    panels: Vec<f64>,
    /// Reciprocal of each pivot; zero for a dropped one.
    inverse: Vec<f64>,
    /// `s_i`.
    scale: Vec<f64>,
    /// Update matrices: odd depths, even depths.
    stacks: [Vec<f64>; 2],
    /// One front's part of a vector.
    local: Vec<f64>,
    /// Positions of doubtful pivots.
    pub(crate) doubtful: Vec<u32>,
    /// Positions of dropped pivots.
    pub(crate) dropped: Vec<u32>,
}

impl StaticLu {
    pub(crate) fn new(symbolic: &Symbolic) -> Self {
        let size = symbolic.order.len();
        Self {
            panels: vec![0.0; symbolic.panel_len],
            inverse: vec![0.0; size],
            scale: vec![0.0; size],
            stacks: symbolic.stack_len.map(|length| vec![0.0; length]),
            local: vec![0.0; symbolic.longest],
            doubtful: Vec::with_capacity(size),
            dropped: Vec::with_capacity(size),
        }
    }

    /// Factors the matrix whose compressed rows hold `values`.
    pub(crate) fn factor(
        &mut self,
        pattern: &SaddlePattern,
        values: &[f64],
        rule: PivotRule,
    ) -> Result<(), PivotTrouble> {
        let symbolic = &pattern.symbolic;
        self.scale.fill(0.0);
        self.doubtful.clear();
        self.dropped.clear();
        let [odd, even] = &mut self.stacks;
        for (front, bounds) in symbolic.fronts.iter().zip(pattern.assembly_start.windows(2)) {
            let (w, r, stride) = (front.width, front.rest_len(), front.stride());
            let panel = &mut self.panels[front.panel..front.panel + w * stride];
            panel.fill(0.0);
            for &(slot, target) in &pattern.assembly[bounds[0]..bounds[1]] {
                panel[target as usize] = values[slot as usize];
            }
            let scale = &mut self.scale[front.first..front.first + w];
            for (s, row) in scale.iter_mut().zip(0..) {
                *s += panel[row * (stride + 1)].abs();
            }
            let (own, below) = if front.even { (&mut *even, &*odd) } else { (&mut *odd, &*even) };
            let update = &mut own[front.update..front.update + r * r];
            update.fill(0.0);
            for &child in &symbolic.children[front.children.clone()] {
                let child = &symbolic.fronts[child as usize];
                let count = child.rest_len();
                let relative = &symbolic.relative[child.rest.clone()];
                add_child(panel, update, w, r, &below[child.update..child.update + count * count], relative);
            }

            let inverse = &mut self.inverse[front.first..front.first + w];
            let (doubtful, dropped) = (&mut self.doubtful, &mut self.dropped);
            eliminate(panel, w, r, inverse, scale, |row, pivot, scale| {
                let position = front.first + row;
                match rule {
                    PivotRule::Check => {
                        if pivot.abs() > PIVOT_DOUBTFUL * scale && pivot.is_finite() {
                            return Ok(1.0 / pivot);
                        }
                        if pivot.abs() > PIVOT_LOST * scale && pivot.is_finite() {
                            doubtful.push(position as u32);
                            return Ok(1.0 / pivot);
                        }
                        Err(PivotTrouble { position, pivot, scale })
                    }
                    PivotRule::Drop(below) => {
                        if pivot.abs() > below {
                            return Ok(1.0 / pivot);
                        }
                        dropped.push(position as u32);
                        Ok(0.0)
                    }
                }
            })?;
            if r > 0 {
                subtract_products(update, panel, w, r);
                let sums = &mut self.local[..r];
                sums.fill(0.0);
                for row in panel.chunks_exact(stride) {
                    let (upper, lower) = row[w..].split_at(r);
                    for ((sum, u), l) in sums.iter_mut().zip(upper).zip(lower) {
                        *sum += (u * l).abs();
                    }
                }
                for (&i, &sum) in symbolic.rest[front.rest.clone()].iter().zip(&*sums) {
                    self.scale[i as usize] += sum;
                }
            }
        }
        Ok(())
    }

    /// Pivot and `s_i` at a position.
    pub(crate) fn pivot(&self, position: usize) -> PivotTrouble {
        PivotTrouble { position, pivot: 1.0 / self.inverse[position], scale: self.scale[position] }
    }

    /// `x ← U⁻¹ L⁻¹ x` in elimination order.
    pub(crate) fn solve(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        self.forward(symbolic, 0..symbolic.fronts.len(), x);
        self.backward(symbolic, 0..symbolic.fronts.len(), x);
    }

    /// `L⁻¹` over a run of fronts; also changes the rest of these.
    pub(crate) fn forward(&mut self, symbolic: &Symbolic, range: std::ops::Range<usize>, x: &mut [f64]) {
        for front in &symbolic.fronts[range] {
            let (w, r, stride) = (front.width, front.rest_len(), front.stride());
            let panel = &self.panels[front.panel..front.panel + w * stride];
            let own = &mut x[front.first..front.first + w];
            for (k, row) in panel.chunks_exact(stride).enumerate() {
                let (before, from) = own.split_at_mut(k);
                from[0] -= dot(&row[..k], before);
            }
            if r > 0 {
                let sums = &mut self.local[..r];
                sums.fill(0.0);
                for (row, &x) in panel.chunks_exact(stride).zip(&*own) {
                    add_multiple(sums, &row[w + r..], x);
                }
                for (&i, &sum) in symbolic.rest[front.rest.clone()].iter().zip(&*sums) {
                    x[i as usize] -= sum;
                }
            }
        }
    }

    /// `U⁻¹` over a run of fronts, last first.
    pub(crate) fn backward(&mut self, symbolic: &Symbolic, range: std::ops::Range<usize>, x: &mut [f64]) {
        for front in symbolic.fronts[range].iter().rev() {
            let (w, r, stride) = (front.width, front.rest_len(), front.stride());
            let panel = &self.panels[front.panel..front.panel + w * stride];
            let local = &mut self.local[..w + r];
            local[..w].copy_from_slice(&x[front.first..front.first + w]);
            for (value, &i) in local[w..].iter_mut().zip(&symbolic.rest[front.rest.clone()]) {
                *value = x[i as usize];
            }
            let inverse = &self.inverse[front.first..front.first + w];
            for (k, row) in panel.chunks_exact(stride).enumerate().rev() {
                let sum = dot(&row[k + 1..w + r], &local[k + 1..]);
                local[k] = (local[k] - sum) * inverse[k];
            }
            x[front.first..front.first + w].copy_from_slice(&local[..w]);
        }
    }
}

/// Adds a child's update matrix to the panel and the update matrix of its parent.
fn add_child(panel: &mut [f64], update: &mut [f64], w: usize, r: usize, child: &[f64], relative: &[u32]) {
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

/// Eliminates the panel's w rows. `invert` gives the reciprocal of a pivot from (row, pivot, scale).
fn eliminate(
    panel: &mut [f64],
    w: usize,
    r: usize,
    inverse: &mut [f64],
    scale: &mut [f64],
    mut invert: impl FnMut(usize, f64, f64) -> Result<f64, PivotTrouble>,
) -> Result<(), PivotTrouble> {
    let stride = w + 2 * r;
    for k in 0..w {
        let (above, below) = panel.split_at_mut((k + 1) * stride);
        let (upper, lower) = above[k * stride..].split_at_mut(w + r);
        let reciprocal = invert(k, upper[k], scale[k])?;
        inverse[k] = reciprocal;
        for value in &mut *lower {
            *value *= reciprocal;
        }
        let upper = &upper[k + 1..];
        for ((row, &u), scale) in below.chunks_exact_mut(stride).zip(upper).zip(&mut scale[k + 1..]) {
            let l = row[k] * reciprocal;
            row[k] = l;
            let (row_upper, row_lower) = row[k + 1..].split_at_mut(upper.len());
            // Structural zeros are frequent inside of a front: constraints touch few unknowns.
            if l != 0.0 {
                subtract_multiple(row_upper, upper, l);
                *scale += (l * u).abs();
            }
            if u != 0.0 {
                subtract_multiple(row_lower, lower, u);
            }
        }
    }
    Ok(())
}

/// `update ← update − L U` on the rest.
fn subtract_products(update: &mut [f64], panel: &[f64], w: usize, r: usize) {
    let stride = w + 2 * r;
    let mut four = panel.chunks_exact(4 * stride);
    for rows in &mut four {
        let (u0, l0) = rows[w..stride].split_at(r);
        let (u1, l1) = rows[stride + w..2 * stride].split_at(r);
        let (u2, l2) = rows[2 * stride + w..3 * stride].split_at(r);
        let (u3, l3) = rows[3 * stride + w..].split_at(r);
        for (i, target) in update.chunks_exact_mut(r).enumerate() {
            let (l0, l1, l2, l3) = (l0[i], l1[i], l2[i], l3[i]);
            for ((((t, u0), u1), u2), u3) in target.iter_mut().zip(u0).zip(u1).zip(u2).zip(u3) {
                *t -= (l0 * u0 + l1 * u1) + (l2 * u2 + l3 * u3);
            }
        }
    }
    for row in four.remainder().chunks_exact(stride) {
        let (u, l) = row[w..].split_at(r);
        for (target, &l) in update.chunks_exact_mut(r).zip(l) {
            subtract_multiple(target, u, l);
        }
    }
}

fn subtract_multiple(target: &mut [f64], source: &[f64], factor: f64) {
    for (t, s) in target.iter_mut().zip(source) {
        *t -= factor * s;
    }
}

fn add_multiple(target: &mut [f64], source: &[f64], factor: f64) {
    for (t, s) in target.iter_mut().zip(source) {
        *t += factor * s;
    }
}

/// Four partial sums: the additions do not wait for each other.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a4, a_end) = a.as_chunks::<4>();
    let (b4, b_end) = b.as_chunks::<4>();
    let mut sums = [0.0; 4];
    for (a, b) in a4.iter().zip(b4) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    let end: f64 = a_end.iter().zip(b_end).map(|(a, b)| a * b).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + end
}
