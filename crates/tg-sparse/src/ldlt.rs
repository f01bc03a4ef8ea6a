//! `K = L D Lᵀ` of a symmetric matrix in the static order, front by front, and its solves.
//!
//! Small fronts of one shape go side by side through the processor's vector lanes (`batch`): of a structure made of many equal
//! parts that is nearly all. What is large or has no equal works alone (`single`), after them: whatever has a front of that kind
//! below it is of that kind itself.
//!
//! Vectors are kept in an order of their own, by *places*: a batch takes one chunk for each of its positions.

mod batch;
mod batching;
mod layout;
mod single;

use bytemuck::{cast_slice, cast_slice_mut};

use crate::kernels::LANES;
use crate::pivot::PivotTrouble;
use crate::symbolic::Symbolic;
pub(crate) use batch::Lanes;
use batch::{Elimination, Solve, is_sound};
pub(crate) use layout::LdltLayout;
use layout::NONE;

/// A matrix to factor, put into the panels piece by piece, shortly before each is used: a large one does not stay in the
/// cache from one end to the other.
pub(crate) struct Matrix<'a> {
    /// Panels of what is constant.
    constant: &'a [Lanes],
    /// Magnitudes on its diagonal, by places.
    diagonal: &'a [Lanes],
    /// Places in the panels, ascending, and which value is subtracted there.
    slots: &'a [(u32, u32)],
    values: &'a [f64],
    /// Chunks that are there.
    done: usize,
}

impl<'a> Matrix<'a> {
    pub(crate) fn new(
        constant: &'a [Lanes],
        diagonal: &'a [Lanes],
        slots: &'a [(u32, u32)],
        values: &'a [f64],
    ) -> Self {
        Self { constant, diagonal, slots, values, done: 0 }
    }

    /// Puts what is missing of the first `until` chunks.
    fn put(&mut self, panels: &mut [Lanes], until: usize) {
        if until <= self.done {
            return;
        }
        panels[self.done..until].copy_from_slice(&self.constant[self.done..until]);
        let panels: &mut [f64] = cast_slice_mut(panels);
        let here = self.slots.iter().take_while(|(slot, _)| (*slot as usize) < until * LANES);
        let mut count = 0;
        for &(slot, value) in here {
            panels[slot as usize] -= self.values[value as usize];
            count += 1;
        }
        self.slots = &self.slots[count..];
        self.done = until;
    }
}

/// Factors and buffers.
#[derive(Clone, Debug)]
pub(crate) struct Ldlt {
    panels: Vec<Lanes>,
    /// Reciprocal pivots, by places.
    inverse: Vec<Lanes>,
    /// Sum of magnitudes that went into each pivot.
    scale: Vec<Lanes>,
    /// Update matrices of single fronts.
    updates: Vec<f64>,
    local: Vec<Lanes>,
}

impl Ldlt {
    pub(crate) fn new(layout: &LdltLayout) -> Self {
        let zeros = |len: usize| vec![Lanes::ZERO; len / LANES];
        Self {
            panels: zeros(layout.panels_len()),
            inverse: zeros(layout.vector_len()),
            scale: zeros(layout.vector_len()),
            updates: vec![0.0; layout.update_len],
            local: zeros(layout.local_len),
        }
    }

    /// Factors the matrix.
    pub(crate) fn factor(
        &mut self,
        mut matrix: Matrix<'_>,
        symbolic: &Symbolic,
        layout: &LdltLayout,
    ) -> Result<(), PivotTrouble> {
        let Self { panels, inverse, scale, updates, local } = self;
        scale.copy_from_slice(matrix.diagonal);
        for batch in &layout.batches {
            matrix.put(panels, batch.reach);
            if !batch::eliminate(
                batch,
                Elimination { panels, inverse, scale, local, targets: &layout.targets },
            ) {
                return Err(self.trouble(layout, batch.first * LANES));
            }
        }
        matrix.put(panels, layout.panels_len() / LANES);
        let panels: &mut [f64] = cast_slice_mut(panels);
        let (inverse, scale): (&mut [f64], &mut [f64]) = (cast_slice_mut(inverse), cast_slice_mut(scale));
        let local: &mut [f64] = cast_slice_mut(local);
        for single in &layout.singles {
            // Children come before their parents, also in memory.
            let (below, own) = updates.split_at_mut(single.update);
            let update = &mut own[..single.update_len()];
            update.fill(0.0);
            let (square, rest) = single.blocks_mut(panels);
            for &child in &single.children {
                let child = &layout.singles[child as usize];
                let values = &below[child.update..][..child.update_len()];
                let relative = &symbolic.relative[child.rest.clone()];
                single.add_child((&mut *square, &mut *rest), update, values, child.rest_stride(), relative);
            }
            let own = single.first..single.first + single.width;
            let sums = &mut local[..single.rest_stride()];
            if !single.eliminate((square, rest), update, &mut inverse[own.clone()], &mut scale[own], sums) {
                return Err(self.trouble(layout, single.first));
            }
            for (&i, sum) in layout.later[single.rest.clone()].iter().zip(&*sums) {
                scale[i as usize] += sum;
            }
        }
        Ok(())
    }

    /// The first pivot from a place on that cannot be trusted.
    #[cold]
    fn trouble(&self, layout: &LdltLayout, from: usize) -> PivotTrouble {
        let (inverse, scale): (&[f64], &[f64]) = (cast_slice(&self.inverse), cast_slice(&self.scale));
        let unsound =
            |&place: &usize| layout.position[place] != NONE && !is_sound(1.0 / inverse[place], scale[place]);
        let place = (from..layout.position.len()).find(unsound).unwrap_or(from);
        let (pivot, scale) = (1.0 / inverse[place], scale[place]);
        PivotTrouble { position: layout.position[place] as usize, pivot, scale }
    }

    /// `x ← L⁻ᵀ D⁻¹ L⁻¹ x`, by places.
    pub(crate) fn solve(&mut self, layout: &LdltLayout, x: &mut [Lanes]) {
        let Self { panels, inverse, local, .. } = self;
        let work = Solve { panels, inverse, targets: &layout.targets };
        for batch in &layout.batches {
            batch::forward(batch, work, x);
        }
        if !layout.singles.is_empty() {
            let (panels, inverse) = (cast_slice(panels), cast_slice(inverse));
            let (local, x) = (cast_slice_mut(local), cast_slice_mut(x));
            for single in &layout.singles {
                single.forward(panels, inverse, &layout.later[single.rest.clone()], local, x);
            }
            for single in layout.singles.iter().rev() {
                single.backward(panels, inverse, &layout.later[single.rest.clone()], local, x);
            }
        }
        for batch in layout.batches.iter().rev() {
            batch::backward(batch, work, local, x);
        }
    }
}
