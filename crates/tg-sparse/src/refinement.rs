//! Residual check and iterative refinement (Arioli, Demmel, Duff 1989; Higham 2002, ch. 12).
//!
//! A solution x of `K x = b` is judged by its componentwise backward error
//!
//! ```text
//! ω = max_i |b − K x|_i / d_i,   d = |K| |x| + |b|,
//! ```
//!
//! the smallest relative change of the entries of `K` and b that makes x exact. It does not depend on the units of
//! unknowns and multipliers. Where `d_i` is below a share of the largest of its block (rows of `H`, rows of `A`), that
//! share is used instead: x is all rounding error there.
//!
//! Where multipliers balance f alone (a structure at rest, or one that cannot move), the whole of x is rounding error of
//! size `ε e`, `e_j = d_j / |h_jj|`, which no refinement lowers, and so is every row of `A x = g`. Before factors are
//! blamed, rows of `A` are therefore held against a share of `Σ_j |a_ij| e_j` if that is larger than `d_i`.

use crate::pattern::SaddlePattern;

/// An ω up to this is accepted without refinement: some hundred ε, what elimination leaves when it loses no digits.
const GOOD: f64 = 1e-13;

/// An ω that stays above this after refinement is a failure of the factors: refinement with factors good to a few
/// digits gets below it.
const BAD: f64 = 1e-10;

/// Most steps of one solve. Factors good for one digit reach [`BAD`] in ten steps, but a refactorisation with pivoting
/// is cheaper by then.
const MOST_STEPS: u32 = 5;

/// Share of the block's largest `d_i` that `d_i` is raised to: √ε.
const FLOOR: f64 = 1.5e-8;

/// A second solve that changes a component by more than this share says that the factors do not determine it. For a
/// singular matrix the share is one, for factors good to d digits 10^−d.
const PROBE_LIMIT: f64 = 0.1;

/// True when a correction leaves the component that was solved for in place. NaN and infinity do not.
pub(crate) fn stands_probe(solution: f64, correction: f64) -> bool {
    solution.is_finite() && correction.abs() <= PROBE_LIMIT * solution.abs()
}

/// Share of `|A| e` that `d_i` of a row of `A` is raised to in the last resort: rounding errors of some ε then count as
/// [`GOOD`].
const REACHABLE: f64 = 1e-2;

/// What refinement reached.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// ω; infinite when the solution is not finite.
    pub(crate) error: f64,
    /// Position of the row with the largest share of it.
    pub(crate) worst: usize,
    pub(crate) steps: u32,
}

impl Outcome {
    /// True when the factors were good enough. A NaN is not.
    pub(crate) fn is_good(&self) -> bool {
        self.error <= BAD
    }
}

/// Vectors in elimination order.
#[derive(Clone, Debug)]
pub(crate) struct Vectors {
    /// b.
    pub(crate) right: Vec<f64>,
    /// x.
    pub(crate) solution: Vec<f64>,
    /// b − K x, then the correction.
    residual: Vec<f64>,
    /// d.
    magnitude: Vec<f64>,
    /// x with the correction, until it proves better.
    candidate: Vec<f64>,
    /// e on the unknowns, zero on the multipliers.
    reachable: Vec<f64>,
}

impl Vectors {
    pub(crate) fn new(size: usize) -> Self {
        let zeros = || vec![0.0; size];
        Self {
            right: zeros(),
            solution: zeros(),
            residual: zeros(),
            magnitude: zeros(),
            candidate: zeros(),
            reachable: zeros(),
        }
    }

    /// Solves `K x = b` by `solve` (in place) with as many steps of refinement as lower the error.
    pub(crate) fn refine(
        &mut self,
        pattern: &SaddlePattern,
        values: &[f64],
        mut solve: impl FnMut(&mut [f64]),
    ) -> Outcome {
        self.solution.copy_from_slice(&self.right);
        solve(&mut self.solution);
        let (mut error, mut worst) = self.measure(pattern, values);
        let mut steps = 0;
        while error > GOOD && error.is_finite() && steps < MOST_STEPS {
            solve(&mut self.residual);
            for ((new, x), d) in self.candidate.iter_mut().zip(&self.solution).zip(&self.residual) {
                *new = x + d;
            }
            steps += 1;
            std::mem::swap(&mut self.candidate, &mut self.solution);
            let (new_error, new_worst) = self.measure(pattern, values);
            if new_error >= error {
                std::mem::swap(&mut self.candidate, &mut self.solution);
                break;
            }
            let falls = new_error < 0.5 * error;
            (error, worst) = (new_error, new_worst);
            if !falls {
                break;
            }
        }
        if error > BAD && error.is_finite() {
            (error, worst) = self.measure_reachable(pattern, values);
        }
        Outcome { error, worst, steps }
    }

    /// Residual of the present solution, its ω and the row with the largest share.
    fn measure(&mut self, pattern: &SaddlePattern, values: &[f64]) -> (f64, usize) {
        let rows = self.residual.iter_mut().zip(&mut self.magnitude).zip(&self.right);
        let products = pattern.slots.products(values, &self.solution);
        for (((residual, magnitude), b), (product, absolute)) in rows.zip(products) {
            *residual = b - product;
            *magnitude = absolute + b.abs();
        }
        self.worst(pattern)
    }

    /// As `measure`, with rows of `A` held against what rounding lets them reach.
    fn measure_reachable(&mut self, pattern: &SaddlePattern, values: &[f64]) -> (f64, usize) {
        self.measure(pattern, values);
        let order = &pattern.symbolic.order;
        let is_unknown = |position: usize| (order[position] as usize) < pattern.n;
        for (position, e) in self.reachable.iter_mut().enumerate() {
            let size = self.magnitude[position] / pattern.slots.diagonal(values, position).abs();
            *e = if is_unknown(position) && size.is_finite() { size } else { 0.0 };
        }
        let products = pattern.slots.products(values, &self.reachable);
        for (position, (_, absolute)) in products.enumerate() {
            if !is_unknown(position) {
                self.magnitude[position] = self.magnitude[position].max(REACHABLE * absolute);
            }
        }
        self.worst(pattern)
    }

    /// The largest share of `residual` in `magnitude`, raised to the floor of its block, and its row.
    fn worst(&self, pattern: &SaddlePattern) -> (f64, usize) {
        let (n, order) = (pattern.n, &pattern.symbolic.order);
        let mut largest = [0.0_f64; 2];
        for (magnitude, &variable) in self.magnitude.iter().zip(order) {
            let block = &mut largest[usize::from(variable as usize >= n)];
            *block = block.max(*magnitude);
        }
        let floor = largest.map(|d| FLOOR * d);
        let (mut error, mut worst) = (0.0, 0);
        for (row, ((residual, magnitude), &variable)) in
            self.residual.iter().zip(&self.magnitude).zip(order).enumerate()
        {
            let scale = magnitude.max(floor[usize::from(variable as usize >= n)]);
            let share = residual.abs() / scale;
            if share > error {
                (error, worst) = (share, row);
            } else if !residual.is_finite() {
                return (f64::INFINITY, row);
            }
        }
        (error, worst)
    }

    /// Solves with the present `right`, then once more for the residual: (solution, correction).
    pub(crate) fn solve_and_correct(
        &mut self,
        pattern: &SaddlePattern,
        values: &[f64],
        mut solve: impl FnMut(&mut [f64]),
    ) -> (&[f64], &[f64]) {
        self.solution.copy_from_slice(&self.right);
        solve(&mut self.solution);
        let rows = self.residual.iter_mut().zip(&self.right);
        for ((residual, b), (product, _)) in rows.zip(pattern.slots.products(values, &self.solution)) {
            *residual = b - product;
        }
        solve(&mut self.residual);
        (&self.solution, &self.residual)
    }
}
