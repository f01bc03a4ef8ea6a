//! Points of a branch: Newton's method on the bordered system, and the unit tangent.
//!
//! ```text
//! F(q, p) + A(q)ᵀλ = 0,   Φ(q) = 0,   t_q·(q - q₀)/L² + t_p (p - p₀)/P² = ds
//! ```

use tg_model::At;
use tg_tangent::{Configuration, EigenOptions, Metric, lowest};

use crate::branch::{BranchEnd, BranchPoint};
use crate::continuation_error::ContinuationError;
use crate::continuation_options::ContinuationOptions;
use crate::family::Family;
use crate::gauge::held_coordinates;
use crate::newton_system::{Border, NewtonSystem};
use crate::size::size;

/// Corrections of one step.
const MOST_CORRECTIONS: u32 = 12;
/// Scaled constraint residual of a converged point.
const CONSISTENT: f64 = 1e-13;
/// Distance from the prediction, in steps, beyond which a point belongs to another branch. Where a cable goes slack the
/// branch has a kink and its points lie off the tangent; ten steps allow for angles up to 84°.
const STRAY: f64 = 10.0;
/// Part of a step to which the end of the range is located.
const LOCATED: f64 = 1e-11;

/// A point with its tangent, which the next step starts from.
#[derive(Clone)]
pub(crate) struct Place {
    pub(crate) point: BranchPoint,
    /// Tangent over the free coordinates, then over the parameter.
    tangent: Vec<f64>,
    /// Arclength from the place that the step started from.
    pub(crate) length: f64,
    pub(crate) corrections: u32,
}

pub(crate) struct Path<'f> {
    pub(crate) family: &'f dyn Family,
    system: NewtonSystem,
    range: (f64, f64),
    options: ContinuationOptions,
    /// 1/L², 1/P².
    weights: (f64, f64),
    free: Vec<usize>,
}

impl<'f> Path<'f> {
    pub(crate) fn new(
        family: &'f dyn Family,
        q: &[f64],
        range: (f64, f64),
        options: &ContinuationOptions,
    ) -> Result<Self, ContinuationError> {
        let span = range.1 - range.0;
        if !span.is_finite() || span == 0.0 {
            return Err(ContinuationError::Range { from: range.0, to: range.1 });
        }
        let instance = family.at(range.0)?;
        let structure = instance.structure();
        let held = held_coordinates(structure, q, &instance.u)?;
        let system = NewtonSystem::new(structure.mechanics(), held, true)?;
        let free = structure.free().to_vec();
        let size = size(structure, q).max(f64::MIN_POSITIVE);
        let weights = (1.0 / (size * size), 1.0 / (span * span));
        Ok(Self { family, system, range, options: *options, weights, free })
    }

    /// The equilibrium at the start of the range; the path sets out towards its end.
    pub(crate) fn start(&mut self, q: &[f64]) -> Result<Place, ContinuationError> {
        let range = self.range;
        let instance = self.family.at(range.0)?;
        let at = Configuration::at(instance.structure().mechanics(), q, &instance.u)?;
        let mut direction = vec![0.0; self.free.len() + 1];
        direction[self.free.len()] = range.1 - range.0;
        let residual = at.imbalance().0;
        let guess = Guess { q: q.to_vec(), lambda: at.lambda, p: range.0 };
        match self.correct(guess, &direction, 0.0, true)? {
            Some(place) => Ok(place),
            None => Err(ContinuationError::NoStart { parameter: range.0, residual }),
        }
    }

    /// The equilibrium at arclength `step` from a place, if Newton's method finds it.
    pub(crate) fn step(&mut self, from: &Place, step: f64) -> Result<Option<Place>, ContinuationError> {
        let n = self.free.len();
        let mut q = from.point.configuration.q.clone();
        self.free.iter().zip(&from.tangent).for_each(|(&i, t)| q[i] += step * t);
        let p = from.point.parameter + step * from.tangent[n];
        let guess = Guess { q: q.clone(), lambda: from.point.configuration.lambda.clone(), p };
        let found = self.correct(guess, &from.tangent, step, false)?;
        Ok(found.filter(|place| {
            let point = &place.point;
            let apart = self.free.iter().map(|&i| point.configuration.q[i] - q[i]);
            let stray: Vec<f64> = apart.chain([point.parameter - p]).collect();
            self.norm(&stray) <= STRAY * step
        }))
    }

    /// The place where the branch meets a bound of the range, within a step from `from`.
    pub(crate) fn at_bound(
        &mut self,
        from: &Place,
        step: f64,
        bound: f64,
    ) -> Result<Place, ContinuationError> {
        let n = self.free.len();
        let (mut low, mut high) = (0.0, step);
        let before = from.point.parameter - bound;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            match self.step(from, middle)? {
                Some(place) if (place.point.parameter - bound) * before > 0.0 => low = middle,
                _ => high = middle,
            }
            if high - low <= LOCATED * step {
                break;
            }
        }
        let Some(near) = self.step(from, low)? else { return Ok(from.clone()) };
        // From here the parameter itself is prescribed.
        let mut direction = vec![0.0; n + 1];
        direction[n] = near.tangent[n].signum();
        let configuration = &near.point.configuration;
        let guess = Guess { q: configuration.q.clone(), lambda: configuration.lambda.clone(), p: bound };
        let place = self.correct(guess, &direction, 0.0, true)?;
        Ok(Place { length: low, ..place.unwrap_or(near) })
    }

    /// Newton's method on the bordered system, from a guess on the plane normal to `tangent`; with `fixed` the parameter
    /// stays. `None` where it does not converge.
    fn correct(
        &mut self,
        guess: Guess,
        tangent: &[f64],
        length: f64,
        fixed: bool,
    ) -> Result<Option<Place>, ContinuationError> {
        let n = self.free.len();
        let Guess { mut q, mut lambda, mut p } = guess;
        let mut row: Vec<f64> = tangent.iter().map(|t| t * self.weights.0).collect();
        row[n] = tangent[n] * self.weights.1;
        if fixed {
            row[..n].fill(0.0);
        }
        for corrections in 0..MOST_CORRECTIONS {
            let instance = self.family.at(p)?;
            let mechanics = instance.structure().mechanics();
            let rest = vec![0.0; q.len()];
            let at = At { q: &q, v: &rest, u: &instance.u, taut: None };
            let scale = mechanics.force_scale(at).max(f64::MIN_POSITIVE);
            let residual = self.system.evaluate(mechanics, &q, &instance.u, &lambda, scale);
            if !residual.merit.is_finite() {
                return Ok(None);
            }
            let rate = self.force_rate(&q, p)?;
            let border = Border { force_rate: &rate, row: &row };
            if self.system.factor(mechanics, &q, &instance.u, &lambda, 0.0, Some(border)).is_err() {
                return Ok(None);
            }
            if residual.force <= self.options.tolerance && residual.constraint <= CONSISTENT {
                return self.place(q, &lambda, p, length, corrections, tangent).map(Some);
            }
            // Steps stay in the plane: the guess lies in it.
            let Ok(step) = self.system.newton_step(mechanics) else { return Ok(None) };
            self.free.iter().zip(step.q).for_each(|(&i, d)| q[i] += d);
            lambda.iter_mut().zip(step.lambda).for_each(|(l, d)| *l += d);
            p += step.p;
        }
        Ok(None)
    }

    /// The converged point, whose bordered matrix is factored, with its tangent along `before`.
    fn place(
        &mut self,
        q: Vec<f64>,
        lambda: &[f64],
        p: f64,
        length: f64,
        corrections: u32,
        before: &[f64],
    ) -> Result<Place, ContinuationError> {
        let n = self.free.len();
        let instance = self.family.at(p)?;
        let mechanics = instance.structure().mechanics();
        let step = self.system.tangent_step(mechanics)?;
        let mut tangent: Vec<f64> = step.q.iter().copied().chain([step.p]).collect();
        let norm = self.norm(&tangent);
        let along = (0..n).map(|k| tangent[k] * before[k] * self.weights.0).sum::<f64>()
            + tangent[n] * before[n] * self.weights.1;
        tangent.iter_mut().for_each(|t| *t /= norm.copysign(along));
        let mut configuration = Configuration::at(mechanics, &q, &instance.u)?;
        configuration.lambda.copy_from_slice(lambda);
        let counts = lowest(mechanics, &configuration, &EigenOptions::new(0, Metric::Coordinates))?.counts;
        let taut = self.taut(&q, p)?;
        let point = BranchPoint {
            parameter: p,
            configuration,
            negative: counts.negative,
            direction: tangent[n],
            taut,
        };
        Ok(Place { point, tangent, length, corrections })
    }

    fn norm(&self, tangent: &[f64]) -> f64 {
        let (q, p) = tangent.split_at(self.free.len());
        let square = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>();
        (self.weights.0 * square(q) + self.weights.1 * square(p)).sqrt()
    }

    /// ∂F/∂p over the free coordinates, by a central difference: exact where F is linear in p, as for rest lengths,
    /// loads and stiffnesses of linear laws.
    fn force_rate(&self, q: &[f64], p: f64) -> Result<Vec<f64>, ContinuationError> {
        let taut = self.taut(q, p)?;
        let h = 1e-5 * (self.range.1 - self.range.0).abs();
        let force = |p: f64| -> Result<Vec<f64>, ContinuationError> {
            let instance = self.family.at(p)?;
            let mechanics = instance.structure().mechanics();
            let (rest, mut force) = (vec![0.0; q.len()], vec![0.0; q.len()]);
            mechanics.force(At { q, v: &rest, u: &instance.u, taut: Some(&taut) }, &mut force);
            Ok(self.free.iter().map(|&i| force[i]).collect())
        };
        Ok(force(p + h)?.iter().zip(force(p - h)?).map(|(a, b)| (a - b) / (2.0 * h)).collect())
    }

    fn taut(&self, q: &[f64], p: f64) -> Result<Vec<bool>, ContinuationError> {
        let instance = self.family.at(p)?;
        let mechanics = instance.structure().mechanics();
        let rest = vec![0.0; q.len()];
        let mut taut = vec![false; mechanics.sizes().switches];
        mechanics.active_set(At { q, v: &rest, u: &instance.u, taut: None }, &mut taut);
        Ok(taut)
    }

    /// The bound that a parameter lies beyond, and what that means.
    pub(crate) fn passed(&self, p: f64) -> Option<(f64, BranchEnd)> {
        let (from, to) = self.range;
        let forward = (to - from).signum();
        if (p - to) * forward >= 0.0 {
            Some((to, BranchEnd::Reached))
        } else if (p - from) * forward < -self.options.behind * (to - from).abs() {
            Some((from - self.options.behind * (to - from), BranchEnd::Returned))
        } else {
            None
        }
    }
}

struct Guess {
    q: Vec<f64>,
    lambda: Vec<f64>,
    p: f64,
}
