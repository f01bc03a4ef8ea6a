//! Numeric factorisation in the static order, `K = L U` with unit lower triangular `L`, and its solves.
//!
//! Multifrontal: each front gathers its entries of `K` and the update matrices of its children, eliminates its
//! positions, `l_ik = a_ik / u_kk`, `a_ij ← a_ij − l_ik u_kj`, and leaves the Schur complement on the rest to its
//! parent. All loops run over contiguous rows. No allocation after [`StaticLu::new`].

use crate::front::{add_child, eliminate, packed_len, subtract_products};
use crate::kernels::{TILE, add_multiple, dot};
use crate::pattern::SaddlePattern;
use crate::pivot::{PIVOT_DOUBTFUL, PIVOT_LOST, PivotRule, PivotTrouble};
use crate::symbolic::Symbolic;

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
    /// Rows of a large front packed for a product.
    packed: Vec<[f64; TILE]>,
    /// One front's part of a vector.
    local: Vec<f64>,
    /// Positions of doubtful pivots.
    pub(crate) doubtful: Vec<u32>,
    /// Positions of dropped pivots.
    pub(crate) dropped: Vec<u32>,
}

/// What a factorisation leaves.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factored<'a> {
    /// Panels of all fronts.
    pub(crate) panels: &'a [f64],
    /// Reciprocal pivots.
    pub(crate) inverse: &'a [f64],
}

impl StaticLu {
    pub(crate) fn new(symbolic: &Symbolic) -> Self {
        let size = symbolic.order.len();
        Self {
            panels: vec![0.0; symbolic.panel_len],
            inverse: vec![0.0; size],
            scale: vec![0.0; size],
            stacks: symbolic.stack_len.map(|length| vec![0.0; length]),
            packed: vec![[0.0; TILE]; packed_len(symbolic.longest)],
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
        rule: PivotRule<'_>,
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
            eliminate(panel, w, r, inverse, scale, &mut self.packed, |row, pivot, scale| {
                let position = front.first + row;
                let trouble = PivotTrouble { position, pivot, scale };
                match rule {
                    _ if !pivot.is_finite() => Err(trouble),
                    PivotRule::Check if pivot.abs() > PIVOT_DOUBTFUL * scale => Ok(1.0 / pivot),
                    PivotRule::Check if pivot.abs() > PIVOT_LOST * scale => {
                        doubtful.push(position as u32);
                        Ok(1.0 / pivot)
                    }
                    PivotRule::Check => Err(trouble),
                    PivotRule::Drop { below, also } if pivot > below && !also[position] => Ok(1.0 / pivot),
                    PivotRule::Drop { .. } => {
                        dropped.push(position as u32);
                        Ok(0.0)
                    }
                }
            })?;
            if r > 0 {
                subtract_products(update, panel, w, r, &mut self.packed);
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

    /// The last factorisation.
    pub(crate) fn factored(&self) -> Factored<'_> {
        Factored { panels: &self.panels, inverse: &self.inverse }
    }

    /// `1/u_ii` of the last factorisation, in elimination order.
    pub(crate) fn reciprocal_pivots(&self) -> &[f64] {
        &self.inverse
    }

    /// Pivot and `s_i` at a position.
    pub(crate) fn pivot(&self, position: usize) -> PivotTrouble {
        PivotTrouble { position, pivot: 1.0 / self.inverse[position], scale: self.scale[position] }
    }

    /// `x ← U⁻¹ L⁻¹ x` in elimination order.
    pub(crate) fn solve(&mut self, symbolic: &Symbolic, x: &mut [f64]) {
        self.forward(symbolic, 0..symbolic.fronts.len(), x);
        self.backward(symbolic, (0..symbolic.fronts.len()).rev(), x);
    }

    /// `L⁻¹` over ascending fronts; also changes the rest of these.
    pub(crate) fn forward(
        &mut self,
        symbolic: &Symbolic,
        fronts: impl Iterator<Item = usize>,
        x: &mut [f64],
    ) {
        for front in fronts {
            let front = &symbolic.fronts[front];
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

    /// `U⁻¹` over descending fronts.
    pub(crate) fn backward(
        &mut self,
        symbolic: &Symbolic,
        fronts: impl Iterator<Item = usize>,
        x: &mut [f64],
    ) {
        for front in fronts {
            let front = &symbolic.fronts[front];
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
