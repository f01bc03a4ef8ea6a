//! The fallback: faer's sparse LU with partial pivoting (column ordering by COLAMD).
//!
//! The matrix is equilibrated first, `K̂ = R K C` with powers of two for R and C, so that the choice of pivots does not
//! depend on the units of unknowns and multipliers. faer can return factors of a singular matrix without an error;
//! therefore each factorisation is probed: for a vector r of random signs, `z = K⁻¹ r` and the correction
//! `d = K⁻¹ (r − K z)`. On a singular matrix z runs along the null vector and d is as large as z.

use crate::pattern::SaddlePattern;
use crate::refinement::{Vectors, stands_probe};
use crate::slot_map::SlotMap;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};

/// Sweeps of row and column scaling.
const SWEEPS: usize = 3;

/// A component of the null vector above this share of the largest takes part in it.
const NULL_SHARE: f64 = 1e-3;

/// Factors with partial pivoting, made at the first use.
pub(crate) struct PivotingLu {
    symbolic: SymbolicLu<u32>,
    numeric: NumericLu<u32, f64>,
    /// Compressed columns; the pattern is symmetric, so they are those of the rows.
    start: Vec<u32>,
    index: Vec<u32>,
    /// Slot of each entry in the compressed rows.
    slot: Vec<u32>,
    values: Vec<f64>,
    row_scale: Vec<f64>,
    column_scale: Vec<f64>,
    memory: MemBuffer,
}

impl std::fmt::Debug for PivotingLu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PivotingLu").field("size", &self.row_scale.len()).finish_non_exhaustive()
    }
}

impl PivotingLu {
    /// `None` when faer cannot analyse the pattern (out of memory).
    pub(crate) fn new(slots: &SlotMap) -> Option<Self> {
        let rows = &slots.rows;
        let size = rows.len();
        let start: Vec<u32> = rows.start().iter().map(|&s| s as u32).collect();
        let index = rows.column().to_vec();
        let mut slot = Vec::with_capacity(index.len());
        for column in 0..size {
            slot.extend(rows.row(column).iter().map(|&row| {
                let row = row as usize;
                (rows.start()[row] + rows.row(row).partition_point(|&c| (c as usize) < column)) as u32
            }));
        }
        let columns = SymbolicSparseColMatRef::new_checked(size, size, &start, None, &index);
        let symbolic = factorize_symbolic_lu(columns, LuSymbolicParams::default()).ok()?;
        let required = symbolic
            .factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Some(Self {
            memory: MemBuffer::try_new(required).ok()?,
            numeric: NumericLu::new(),
            values: vec![0.0; index.len()],
            row_scale: vec![1.0; size],
            column_scale: vec![1.0; size],
            symbolic,
            start,
            index,
            slot,
        })
    }

    /// Factors and probes. On failure the position to name: `suspect`, where the static order failed, if it takes part
    /// in the null vector, otherwise the largest component of that.
    pub(crate) fn factor(
        &mut self,
        pattern: &SaddlePattern,
        values: &[f64],
        vectors: &mut Vectors,
        suspect: usize,
    ) -> Result<(), usize> {
        for (value, &slot) in self.values.iter_mut().zip(&self.slot) {
            *value = values[slot as usize];
        }
        self.equilibrate();
        let size = self.row_scale.len();
        let columns = SymbolicSparseColMatRef::new_checked(size, size, &self.start, None, &self.index);
        self.symbolic
            .factorize_numeric_lu(
                &mut self.numeric,
                SparseColMatRef::new(columns, &self.values),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .map_err(|_| suspect)?;

        let mut state = 1_u64;
        for (b, scale) in vectors.right.iter_mut().zip(&self.row_scale) {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let size = 0.5 + (state >> 12) as f64 / (1_u64 << 53) as f64;
            let signed = if state >> 63 == 0 { size } else { -size };
            *b = signed / scale;
        }
        let (solution, correction) = vectors.solve_and_correct(pattern, values, |x| self.solve(x));
        let largest = |vector: &[f64]| {
            let mut best = (0.0, suspect);
            for (at, (x, scale)) in vector.iter().zip(&self.column_scale).enumerate() {
                let x = (x / scale).abs();
                if !x.is_finite() {
                    return (f64::INFINITY, at);
                }
                if x > best.0 {
                    best = (x, at);
                }
            }
            best
        };
        let (z, worst) = largest(solution);
        let (d, _) = largest(correction);
        if stands_probe(z, d) {
            return Ok(());
        }
        let takes_part =
            !z.is_finite() || (solution[suspect] / self.column_scale[suspect]).abs() >= NULL_SHARE * z;
        Err(if takes_part { suspect } else { worst })
    }

    /// `x ← K⁻¹ x` in elimination order.
    pub(crate) fn solve(&mut self, x: &mut [f64]) {
        x.iter_mut().zip(&self.row_scale).for_each(|(x, r)| *x *= r);
        let size = x.len();
        LuRef::new_unchecked(&self.symbolic, &self.numeric).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(x, size, 1),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        x.iter_mut().zip(&self.column_scale).for_each(|(x, c)| *x *= c);
    }

    /// Scales rows and columns by powers of two until their largest entries are close to one.
    fn equilibrate(&mut self) {
        let size = self.row_scale.len();
        self.row_scale.fill(1.0);
        self.column_scale.fill(1.0);
        let mut row_largest = vec![0.0_f64; size];
        let mut column_largest = vec![0.0_f64; size];
        for _ in 0..SWEEPS {
            row_largest.fill(0.0);
            column_largest.fill(0.0);
            for column in 0..size {
                for at in self.start[column] as usize..self.start[column + 1] as usize {
                    let row = self.index[at] as usize;
                    let value = self.values[at].abs();
                    row_largest[row] = row_largest[row].max(value);
                    column_largest[column] = column_largest[column].max(value);
                }
            }
            let factor =
                |largest: f64| if largest > 0.0 { (-0.5 * largest.log2()).round().exp2() } else { 1.0 };
            row_largest.iter_mut().for_each(|largest| *largest = factor(*largest));
            column_largest.iter_mut().for_each(|largest| *largest = factor(*largest));
            for column in 0..size {
                for at in self.start[column] as usize..self.start[column + 1] as usize {
                    self.values[at] *= row_largest[self.index[at] as usize] * column_largest[column];
                }
            }
            self.row_scale.iter_mut().zip(&row_largest).for_each(|(scale, factor)| *scale *= factor);
            self.column_scale.iter_mut().zip(&column_largest).for_each(|(scale, factor)| *scale *= factor);
        }
    }
}
