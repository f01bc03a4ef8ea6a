//! One step of an explicit Runge–Kutta method on the index-1 equations: stages, error, projection.

use tg_sparse::SparseError;

use crate::check::ASSEMBLED;
use crate::dormand_prince::{Tableau, Terms};
use crate::error_control::Tolerances;
use crate::index_one::IndexOne;
use crate::stepper::StepReport;

/// Tolerances by which the projection may move the end of a substep: what drifts from the constraints is a part of its error. Where
/// they all but lose their rank rounding drifts as far.
const MOST_MOVED: f64 = 10.0;

/// What came of the projection of a substep's end.
pub(crate) enum Projected {
    /// The end is the start of what follows.
    Done,
    /// The end is too far from the constraints; their scaled residual. Nothing was accepted.
    Apart(f64),
    /// The projection moved the end by more than the error control allows, most at this coordinate. Nothing was accepted.
    Moved(f64, usize),
}

/// The equations, a method, and where they are in a step. Vectors are packed: free components of q, then of q̇.
pub(crate) struct Substep<'m> {
    pub(crate) tableau: &'static Tableau,
    /// None: no error estimate, and the laws decide at each stage.
    pub(crate) tolerances: Option<Tolerances>,
    /// Largest velocity so far, or the speed that forces could give at the start \[m/s\].
    pub(crate) fastest: f64,
    pub(crate) equations: IndexOne<'m>,
    pub(crate) start: Vec<f64>,
    pub(crate) stage: Vec<f64>,
    pub(crate) end: Vec<f64>,
    /// k_1 … k_s, then the evaluation at the end; one after the other.
    pub(crate) rates: Vec<f64>,
    errors: [Vec<f64>; 2],
    /// λ at the end.
    pub(crate) lambda: Vec<f64>,
    /// The active set of the substep.
    pub(crate) taut: Vec<bool>,
    /// The laws' where they were asked last.
    pub(crate) taut_then: Vec<bool>,
    /// Change of the accelerations by a switch.
    pub(crate) jump: Vec<f64>,
}

impl<'m> Substep<'m> {
    pub(crate) fn new(
        equations: IndexOne<'m>,
        tableau: &'static Tableau,
        tolerances: Option<Tolerances>,
    ) -> Self {
        let (n, sizes) = (equations.unknowns(), equations.mechanics.sizes());
        let packed = || vec![0.0; 2 * n];
        Self {
            tableau,
            tolerances,
            fastest: 0.0,
            equations,
            start: packed(),
            stage: packed(),
            end: packed(),
            rates: vec![0.0; 2 * n * (tableau.stages() + 1)],
            errors: [packed(), packed()],
            lambda: vec![0.0; sizes.constraints],
            taut: vec![false; sizes.switches],
            taut_then: vec![false; sizes.switches],
            jump: vec![0.0; n],
        }
    }

    /// Stages, end and the evaluation there, from `start` and k_1; the scaled error and the coordinate where it is largest. An
    /// error above one, or NaN, leaves the end without its evaluation.
    pub(crate) fn attempt(
        &mut self,
        t: f64,
        h: f64,
        report: &mut StepReport,
    ) -> Result<(f64, usize), SparseError> {
        let tableau = self.tableau;
        for (i, terms) in tableau.stages.iter().enumerate() {
            combine(&self.start, h, terms, &self.rates, &mut self.stage);
            self.evaluate(t + tableau.nodes[i + 1] * h, i + 1, report)?;
        }
        combine(&self.start, h, tableau.weights, &self.rates, &mut self.end);
        self.stage.copy_from_slice(&self.end);
        if tableau.error_uses_end {
            self.evaluate(t + h, tableau.stages(), report)?;
        }
        let (missed, support) = self.equations.jumps((t, h), tableau, self.tolerances);
        let (error, worst) = match self.tolerances {
            Some(tolerances) => match self.error(h, &tolerances) {
                (error, _) if error < missed => (missed, support),
                found => found,
            },
            None => (0.0, 0),
        };
        if error <= 1.0 && !tableau.error_uses_end {
            self.evaluate(t + h, tableau.stages(), report)?;
        }
        self.lambda.copy_from_slice(self.equations.multipliers());
        Ok((error, worst))
    }

    /// k_{i+1} at the packed state `stage`.
    pub(crate) fn evaluate(&mut self, t: f64, i: usize, report: &mut StepReport) -> Result<(), SparseError> {
        let n = self.jump.len();
        report.iterations += 1;
        self.equations.place(t, &self.stage);
        self.equations.factor()?;
        let (velocity, acceleration) = self.rates[2 * n * i..2 * n * (i + 1)].split_at_mut(n);
        velocity.copy_from_slice(&self.stage[n..]);
        let frozen = self.tolerances.is_some() && !self.taut.is_empty();
        self.equations.accelerate(frozen.then_some(&self.taut), acceleration)
    }

    /// Projects the end and makes it the start of what follows; the active set becomes the laws'.
    pub(crate) fn accept(&mut self, t_end: f64, report: &mut StepReport) -> Result<Projected, SparseError> {
        let (n, size) = (self.jump.len(), self.start.len());
        let last = self.rates.len() - size;
        self.equations.place(t_end, &self.end);
        if self.tolerances.is_some() {
            self.equations.active_set(&mut self.taut_then);
            if self.taut != self.taut_then {
                self.equations.accelerate(Some(&self.taut_then), &mut self.rates[last + n..])?;
                self.lambda.copy_from_slice(self.equations.multipliers());
            }
        }
        self.stage.copy_from_slice(&self.end);
        let residual = self.equations.project(&mut self.end)?;
        if residual.is_nan() || residual > ASSEMBLED {
            return Ok(Projected::Apart(residual));
        }
        let kicked = self.equations.kicked();
        if let (Some(tolerances), false) = (self.tolerances, kicked) {
            let (moved, worst) = self.moved(&tolerances);
            if moved > MOST_MOVED {
                return Ok(Projected::Moved(moved, worst));
            }
        }
        report.residual = report.residual.max(residual);
        report.substeps += 1;
        self.taut.copy_from_slice(&self.taut_then);
        if kicked {
            // Velocities behind a kick are others than those that the accelerations were found with.
            self.stage.copy_from_slice(&self.end);
            self.evaluate(t_end, self.tableau.stages(), report)?;
            self.lambda.copy_from_slice(self.equations.multipliers());
        }
        self.start.copy_from_slice(&self.end);
        self.fastest = self.speed_with(&self.start);
        self.rates.copy_within(last.., 0);
        self.rates[..n].copy_from_slice(&self.end[n..]);
        Ok(Projected::Done)
    }

    /// How far the projection has moved the end from `stage`, scaled as errors are, and the coordinate that it moved most.
    fn moved(&self, tolerances: &Tolerances) -> (f64, usize) {
        let (length, speed) = (self.equations.mechanics.size(), self.speed());
        let (mut sum, mut largest, mut worst) = (0.0, 0.0, 0);
        for (i, (end, before)) in self.end.iter().zip(&self.stage).enumerate() {
            let size = if i < self.jump.len() { length } else { speed };
            let moved = (end - before).abs() / tolerances.scale(*end, *end, size);
            sum += moved * moved;
            if moved > largest {
                (largest, worst) = (moved, i);
            }
        }
        ((sum / self.end.len() as f64).sqrt(), self.coordinate(worst))
    }

    /// The full coordinate of a packed component.
    fn coordinate(&self, component: usize) -> usize {
        self.equations.mechanics.free()[component % self.jump.len()]
    }

    /// Scaled error of the end and the coordinate where it is largest.
    fn error(&mut self, h: f64, tolerances: &Tolerances) -> (f64, usize) {
        for (error, terms) in self.errors.iter_mut().zip(self.tableau.errors) {
            error.fill(0.0);
            accumulate(h, terms, &self.rates, error);
        }
        let [first, second] = &self.errors;
        let n = self.jump.len();
        let (length, speed) = (self.equations.mechanics.size(), self.speed());
        let (mut sums, mut largest, mut worst) = ([0.0, 0.0], 0.0_f64, 0);
        for i in 0..first.len() {
            let size = if i < n { length } else { speed };
            let scale = tolerances.scale(self.start[i], self.end[i], size);
            let (e, other) = (first[i] / scale, second[i] / scale);
            sums[0] += e * e;
            sums[1] += other * other;
            // The first that is no number stays.
            if e.abs() > largest || (e.is_nan() && !largest.is_nan()) {
                (largest, worst) = (e.abs(), i);
            }
        }
        // With one estimate the second sum is zero; two of orders 5 and 3 combine to one of order 8
        // (Hairer, Nørsett, Wanner, Sec. II.10).
        let error = if sums[0] == 0.0 { 0.0 } else { sums[0] / (sums[0] + 0.01 * sums[1]).sqrt() };
        (error / (first.len() as f64).sqrt(), self.coordinate(worst))
    }

    /// V of the substep. Where nothing has moved and no force acts, any.
    pub(crate) fn speed(&self) -> f64 {
        self.speed_with(&self.end).max(f64::MIN_POSITIVE)
    }

    /// The largest velocity so far, at a packed state, and where the equations are placed, supports included.
    fn speed_with(&self, packed: &[f64]) -> f64 {
        let supports = self.equations.v.iter();
        packed[self.jump.len()..].iter().chain(supports).fold(self.fastest, |largest, v| largest.max(v.abs()))
    }

    /// A first substep: it changes the state by a hundredth of its size, both scaled by the tolerances (Hairer, Nørsett,
    /// Wanner, Sec. II.4).
    pub(crate) fn first_length(&self, tolerances: &Tolerances) -> f64 {
        let (mut size, mut rate) = (0.0, 0.0);
        let (length, speed) =
            (self.equations.mechanics.size(), self.speed_with(&self.start).max(f64::MIN_POSITIVE));
        for (i, (y, k)) in self.start.iter().zip(&self.rates).enumerate() {
            let scale = tolerances.scale(*y, *y, if i < self.jump.len() { length } else { speed });
            size += (y / scale).powi(2);
            rate += (k / scale).powi(2);
        }
        if size > 0.0 && rate > 0.0 { 0.01 * (size / rate).sqrt() } else { f64::INFINITY }
    }
}

/// Entries that are combined at a time: what stays in the first cache while all rates pass.
const PIECE: usize = 512;

/// `out = y + h Σ c_j k_j`.
fn combine(y: &[f64], h: f64, terms: Terms, rates: &[f64], out: &mut [f64]) {
    out.copy_from_slice(y);
    accumulate(h, terms, rates, out);
}

/// `out += h Σ c_j k_j`.
fn accumulate(h: f64, terms: Terms, rates: &[f64], out: &mut [f64]) {
    let size = out.len();
    for (piece, out) in out.chunks_mut(PIECE).enumerate() {
        for &(j, c) in terms {
            let factor = h * c;
            for (out, k) in out.iter_mut().zip(&rates[size * j + PIECE * piece..]) {
                *out += factor * k;
            }
        }
    }
}
