//! Dense kernels on rows: products of a few rows kept in registers, axpy, dot.

/// Rows and columns of a product that are computed together: with four by four the sums fill the registers of the
/// baseline instruction set.
pub(crate) const TILE: usize = 4;

/// Numbers that the loops over padded rows and columns take at a time.
pub(crate) const LANES: usize = 4;

/// Chunks that hold so many numbers.
pub(crate) fn chunks(len: usize) -> usize {
    len.div_ceil(LANES)
}

/// Copies `columns` columns of the rows in `source` so that the rows of a strip of [`TILE`] columns follow each other
/// (zeros beyond the last column): the product then reads memory in sequence. Returns the part of `packed` filled.
pub(crate) fn pack<'a>(
    packed: &'a mut [[f64; TILE]],
    source: &[f64],
    stride: usize,
    count: usize,
    columns: usize,
) -> &'a [[f64; TILE]] {
    let packed = &mut packed[..count * columns.div_ceil(TILE)];
    for (k, row) in source.chunks(stride).take(count).enumerate() {
        for (strip, values) in packed.chunks_exact_mut(count).zip(row[..columns].chunks(TILE)) {
            let mut padded = [0.0; TILE];
            padded[..values.len()].copy_from_slice(values);
            strip[k] = padded;
        }
    }
    packed
}

/// `target_i ← target_i − Σ_k coefficients[k][i] · source_k` for up to [`TILE`] rows i, as many as `target` holds at
/// distance `stride`, with the sources as [`pack`] left them.
pub(crate) fn subtract_product(
    target: &mut [f64],
    stride: usize,
    coefficients: &[[f64; TILE]],
    packed: &[[f64; TILE]],
    columns: usize,
) {
    for (strip, first) in packed.chunks_exact(coefficients.len()).zip((0..columns).step_by(TILE)) {
        let mut sums = [[0.0_f64; TILE]; TILE];
        for (factors, values) in coefficients.iter().zip(strip) {
            for (sums, factor) in sums.iter_mut().zip(factors) {
                for (sum, value) in sums.iter_mut().zip(values) {
                    *sum += factor * value;
                }
            }
        }
        let last = columns.min(first + TILE);
        for (sums, row) in sums.iter().zip(target.chunks_mut(stride)) {
            for (value, sum) in row[first..last].iter_mut().zip(sums) {
                *value -= sum;
            }
        }
    }
}

/// `target ← target − Σ_k factors[k] · rows[k]` in one pass.
#[inline(always)]
pub(crate) fn subtract_rows<const K: usize>(target: &mut [f64], rows: [&[f64]; K], factors: [f64; K]) {
    let length = target.len();
    let rows = rows.map(|row| &row[..length]);
    for i in 0..length {
        let mut sum = 0.0;
        for k in 0..K {
            sum += factors[k] * rows[k][i];
        }
        target[i] -= sum;
    }
}

/// `target ← target + factor · source`.
pub(crate) fn add_multiple(target: &mut [f64], source: &[f64], factor: f64) {
    for (t, s) in target.iter_mut().zip(source) {
        *t += factor * s;
    }
}

/// Scalar product in four partial sums, so that the additions do not wait for each other.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
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
