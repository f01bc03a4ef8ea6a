//! Follows one path of a homotopy along a straight segment of t, choosing step and precision.
//!
//! The step follows the predictor's error estimate, h ← 0.9 h (tol/error)^(1/5), and is halved when Newton's method does
//! not contract. Precision is raised to double-double when ‖J⁻¹‖ times the unit roundoff nears the corrector's tolerance or
//! Newton's steps stagnate above it, and lowered again well below (Bates, Hauenstein, Sommese, Wampler, *Adaptive
//! multiprecision path tracking*, SIAM J. Numer. Anal. 46, 2008).

use num_complex::Complex64;

use crate::complex_dd::ComplexDd;
use crate::homotopy::Homotopy;
use crate::lane::{Lane, Limits, Polish, Step};
use crate::options::TrackerOptions;
use crate::path::{FailureReason, PathCounts};
use crate::scalar::{Field, norm};

/// Accepted steps with room to spare before precision is lowered.
const CALM_STEPS: usize = 5;
/// Failed steps in a row before precision is raised.
const PATIENCE: usize = 4;

/// ‖J⁻¹‖ up to which doubles predict well enough even where the corrector needs more digits: its unit roundoff times this
/// is far below the predictor's tolerance.
const PREDICTABLE: f64 = 1e9;

/// How following a segment ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arrival {
    /// At the end of the segment.
    Reached,
    /// Below the given |t|, with steps still shorter than the way to the end.
    Stalled,
}

/// State of one path.
#[derive(Debug)]
pub(crate) struct Tracker<'a> {
    pub(crate) homotopy: &'a Homotopy,
    options: TrackerOptions,
    double: Lane<Complex64>,
    extended: Option<Box<Lane<ComplexDd>>>,
    in_extended: bool,
    patch: Vec<Complex64>,
    t: Complex64,
    previous_t: Complex64,
    /// Whether patches follow the path.
    moving_patch: bool,
    calm: usize,
    /// ‖J⁻¹‖ of the equilibrated Jacobian at the last accepted point.
    growth: f64,
    only_extended: bool,
    pub(crate) counts: PathCounts,
}

impl<'a> Tracker<'a> {
    pub(crate) fn new(homotopy: &'a Homotopy, options: &TrackerOptions) -> Self {
        Self {
            homotopy,
            options: options.clone(),
            double: Lane::new(homotopy),
            extended: None,
            in_extended: false,
            patch: vec![Complex64::new(0.0, 0.0); homotopy.unknowns()],
            t: Complex64::new(1.0, 0.0),
            previous_t: Complex64::new(1.0, 0.0),
            moving_patch: true,
            calm: 0,
            growth: 0.0,
            only_extended: false,
            counts: PathCounts::default(),
        }
    }

    /// Places the path at the start point, in unknowns of a path, t = 1.
    pub(crate) fn start(&mut self, x: &[Complex64]) {
        self.double.x.copy_from_slice(x);
        self.in_extended = false;
        self.only_extended = false;
        self.moving_patch = true;
        self.t = Complex64::new(1.0, 0.0);
        self.calm = 0;
        self.growth = 0.0;
        self.counts = PathCounts::default();
        self.choose_patch();
    }

    pub(crate) fn t(&self) -> Complex64 {
        self.t
    }

    /// The point with the digits it has.
    pub(crate) fn extended_point(&self) -> Vec<ComplexDd> {
        match &self.extended {
            Some(lane) if self.in_extended => lane.x.clone(),
            _ => self.double.x.iter().map(|&z| z.into()).collect(),
        }
    }

    /// How well the point is known, relative to ‖x‖, with room for ill-conditioned points.
    pub(crate) fn accuracy(&self) -> f64 {
        if self.in_extended { 1e-14 } else { 1e-9 }
    }

    /// The point before the last accepted step, and its t.
    pub(crate) fn previous(&self) -> (Vec<ComplexDd>, Complex64) {
        let x = match &self.extended {
            Some(lane) if self.in_extended => lane.trial.clone(),
            _ => self.double.trial.iter().map(|&z| z.into()).collect(),
        };
        (x, self.previous_t)
    }

    /// Returns to a point seen before.
    pub(crate) fn restore(&mut self, x: &[ComplexDd], t: Complex64) {
        self.t = t;
        if self.in_extended
            && let Some(lane) = &mut self.extended
        {
            lane.x.copy_from_slice(x);
        }
        for (z, w) in self.double.x.iter_mut().zip(x) {
            *z = w.to_c64();
        }
    }

    /// From now on patches stay.
    pub(crate) fn freeze_patch(&mut self) {
        if self.moving_patch {
            self.choose_patch();
        }
        self.moving_patch = false;
    }

    /// Patches a_g = X̄_g/|X_g|² with X_g scaled to largest entry 1: the best conditioned ones at this point.
    fn choose_patch(&mut self) {
        let group_of = self.homotopy.group_of();
        for g in 0..self.homotopy.groups() {
            let members = || (0..group_of.len()).filter(|&v| group_of[v] == g);
            let largest = members().map(|v| self.leading(v).norm()).fold(0.0, f64::max);
            let inverse = 1.0 / largest;
            let mut square = 0.0;
            for v in members() {
                square += (self.leading(v) * inverse).norm_sqr();
            }
            for v in members() {
                self.patch[v] = (self.leading(v) * inverse).conj() / square;
                self.double.x[v] *= inverse;
                if let Some(lane) = &mut self.extended {
                    lane.x[v] = crate::scalar::Scalar::times(lane.x[v], inverse);
                }
            }
        }
    }

    fn leading(&self, v: usize) -> Complex64 {
        match &self.extended {
            Some(lane) if self.in_extended => lane.x[v].to_c64(),
            _ => self.double.x[v],
        }
    }

    fn patch_is_poor(&self) -> bool {
        let group_of = self.homotopy.group_of();
        (0..self.homotopy.groups()).any(|g| {
            let members = (0..group_of.len()).filter(|&v| group_of[v] == g);
            members.map(|v| self.leading(v).norm()).fold(0.0, f64::max) > 3.0
        })
    }

    fn raise_precision(&mut self) {
        let lane = self.extended.get_or_insert_with(|| Box::new(Lane::new(self.homotopy)));
        for (z, &w) in lane.x.iter_mut().zip(&self.double.x) {
            *z = w.into();
        }
        // The point before the last step may be asked for.
        for (z, &w) in lane.trial.iter_mut().zip(&self.double.trial) {
            *z = w.into();
        }
        self.in_extended = true;
        self.calm = 0;
        self.counts.raised += 1;
    }

    /// From now on double-double only.
    pub(crate) fn stay_extended(&mut self) {
        if !self.in_extended {
            self.raise_precision();
        }
        self.only_extended = true;
    }

    fn lower_precision(&mut self) {
        if self.only_extended {
            return;
        }
        if let Some(lane) = &self.extended {
            for (z, w) in self.double.x.iter_mut().zip(&lane.x) {
                *z = w.to_c64();
            }
            for (z, w) in self.double.trial.iter_mut().zip(&lane.trial) {
                *z = w.to_c64();
            }
            self.in_extended = false;
        }
    }

    /// One attempt from t to `to`.
    fn attempt(&mut self, to: Complex64) -> Step {
        let options = &self.options;
        let limits = Limits {
            predictor: options.predictor_tolerance,
            corrector: options.corrector_tolerance,
            corrections: options.corrections,
        };
        match &mut self.extended {
            Some(lane) if self.in_extended && self.growth <= PREDICTABLE => {
                for (z, w) in self.double.x.iter_mut().zip(&lane.x) {
                    *z = w.to_c64();
                }
                let Some(error) = self.double.predict(self.homotopy, &self.patch, self.t, to - self.t) else {
                    self.growth = f64::INFINITY;
                    return Step::Singular;
                };
                for (w, &z) in lane.trial.iter_mut().zip(&self.double.trial) {
                    *w = z.into();
                }
                lane.correct(self.homotopy, &self.patch, to, limits, error)
            }
            Some(lane) if self.in_extended => lane.step(self.homotopy, &self.patch, self.t, to, limits),
            _ => self.double.step(self.homotopy, &self.patch, self.t, to, limits),
        }
    }

    /// Follows the path along the segment from t to `target`, the first step at most `first`; with `stall`, gives up below
    /// that |t| unless the rest is done in one step.
    pub(crate) fn track(
        &mut self,
        target: Complex64,
        first: f64,
        stall: Option<f64>,
    ) -> Result<Arrival, FailureReason> {
        let mut h = first;
        let mut failures = 0;
        loop {
            let rest = target - self.t;
            let distance = rest.norm();
            if distance == 0.0 {
                return Ok(Arrival::Reached);
            }
            if h < distance && stall.is_some_and(|r| self.t.norm() <= r) {
                return Ok(Arrival::Stalled);
            }
            if self.counts.steps() >= self.options.steps {
                return Err(FailureReason::TooManySteps);
            }
            h = h.min(self.options.largest_step);
            let last = h >= distance;
            let to = if last { target } else { self.t + rest * (h / distance) };
            h = h.min(distance);
            match self.attempt(to) {
                Step::Accepted { error, growth } => {
                    failures = 0;
                    self.accept(to, growth);
                    let factor = 0.9 * (self.options.predictor_tolerance / error.max(1e-30)).powf(0.2);
                    h *= factor.clamp(0.3, 4.0);
                    continue;
                }
                Step::TooLong { error } if error.is_finite() => {
                    h *= (0.9 * (self.options.predictor_tolerance / error).powf(0.2)).clamp(0.1, 0.9);
                }
                Step::Stagnation if !self.in_extended => self.raise_precision(),
                _ => {
                    failures += 1;
                    h *= 0.5;
                    if failures >= PATIENCE && !self.in_extended {
                        self.raise_precision();
                        failures = 0;
                    }
                }
            }
            self.counts.rejected += 1;
            if h <= self.options.smallest_step * self.t.norm() {
                if self.in_extended {
                    return Err(FailureReason::StepTooSmall);
                }
                self.raise_precision();
                h *= 16.0;
            }
        }
    }

    fn accept(&mut self, to: Complex64, growth: f64) {
        self.growth = growth;
        self.previous_t = self.t;
        self.t = to;
        self.counts.accepted += 1;
        if self.in_extended {
            self.counts.extended += 1;
            if let Some(lane) = &mut self.extended {
                lane.accept();
            }
            self.calm = if growth < 0.1 * self.options.double_limit { self.calm + 1 } else { 0 };
            if self.calm >= CALM_STEPS {
                self.lower_precision();
            }
        } else {
            self.double.accept();
            if !(growth < self.options.double_limit) {
                self.raise_precision();
            }
        }
        if self.moving_patch && self.patch_is_poor() {
            self.choose_patch();
        }
    }

    /// At most `steps` of Newton's method in double-double from `x` at fixed t; the refined point.
    pub(crate) fn polish(
        &mut self,
        x: &[ComplexDd],
        t: Complex64,
        steps: usize,
    ) -> Option<(Vec<ComplexDd>, Polish)> {
        let lane = self.extended.get_or_insert_with(|| Box::new(Lane::new(self.homotopy)));
        let kept = lane.x.clone();
        lane.x.copy_from_slice(x);
        let result = lane.polish(self.homotopy, &self.patch, t, steps).map(|p| (lane.trial.clone(), p));
        lane.x = kept;
        result
    }
}

/// ‖a - b‖ relative to ‖b‖.
pub(crate) fn distance(a: &[ComplexDd], b: &[ComplexDd]) -> f64 {
    let difference: Vec<ComplexDd> = a.iter().zip(b).map(|(&a, &b)| a - b).collect();
    norm(&difference) / norm(b).max(f64::MIN_POSITIVE)
}

/// The largest modulus.
pub(crate) fn largest(x: &[ComplexDd]) -> f64 {
    x.iter().map(|z| z.size()).fold(0.0, f64::max)
}
