//! A motion so fine that errors can be told by it, with its own uncertainty.
//!
//! Two ways that share no time stepping: the explicit pair of order 8 under tighter and tighter error control, and the
//! symplectic scheme with shorter and shorter steps, extrapolated (its error has even powers of h only; K. Strehmel, W. B. Gragg;
//! E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, Sec. V.1). Each is uncertain by its last improvement; the
//! better one is taken, and what the other contradicts it by beyond its own uncertainty is added.

use tg_scene::Scheme;

use crate::error::TrialError;
use crate::errors::{Errors, Quantity};
use crate::method::Method;
use crate::motion::Motion;
use crate::subject::{LOOKS, Subject};

/// Powers of ten of the tolerances.
const TOLERANCES: std::ops::RangeInclusive<i32> = 7..=13;
/// Steps of the coarsest symplectic run: a multiple of [`LOOKS`].
const COARSEST: u64 = 4 * LOOKS as u64;
/// Steps from which a failure is final.
const FINEST: u64 = 1 << 20;
/// Rounding of some thousand steps, relative: of a pendulum after two seconds it is 1.3e-12.
const ROUNDING: f64 = 3e-12;

/// A motion to tell errors by.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The motion.
    pub motion: Motion,
    /// What it may be off by itself.
    pub uncertainty: Errors,
    /// How it was made.
    pub by: String,
    /// How it was checked, and how far the two are apart; none if the other way gives no motion.
    pub check: Option<(String, Errors)>,
}

/// One way's best.
struct Candidate {
    motion: Motion,
    uncertainty: Errors,
    by: String,
}

impl Reference {
    /// The best motion of runs that take at most `limit` seconds of processor time each.
    ///
    /// # Errors
    /// No scheme gives two runs in that time.
    pub fn new<const D: usize>(subject: &Subject<'_, D>, limit: f64) -> Result<Self, TrialError> {
        let subject = &subject.limited(limit);
        let explicit = by_tolerance(subject);
        let implicit = by_steps(subject);
        let (best, other) = match (explicit, implicit) {
            (Ok(a), Ok(b)) if a.worth() <= b.worth() => (a, Some(b)),
            (Ok(a), Ok(b)) => (b, Some(a)),
            (Ok(one), Err(_)) | (Err(_), Ok(one)) => (one, None),
            (Err(_), Err(error)) => return Err(error),
        };
        let mut uncertainty = best.uncertainty;
        let rounding = best.motion.size();
        uncertainty = uncertainty.zip(&rounding, |own, size| own.max(ROUNDING * size));
        let check = other.map(|other| {
            let apart = best.motion.distance(&other.motion);
            let beyond = apart.zip(&other.uncertainty, |apart, own| (apart - own).max(0.0));
            uncertainty = uncertainty.zip(&beyond, f64::max);
            (other.by, apart)
        });
        Ok(Self { motion: best.motion, uncertainty, by: best.by, check })
    }

    /// Errors of another motion.
    pub fn errors(&self, motion: &Motion) -> Errors {
        self.motion.distance(motion)
    }
}

impl Candidate {
    /// The smaller the better.
    fn worth(&self) -> f64 {
        self.uncertainty[Quantity::Positions]
    }
}

/// The better of two candidates, if there are two.
fn better(best: Option<Candidate>, new: Candidate) -> Option<Candidate> {
    match best {
        Some(best) if best.worth() <= new.worth() => Some(best),
        _ => Some(new),
    }
}

fn by_tolerance<const D: usize>(subject: &Subject<'_, D>) -> Result<Candidate, TrialError> {
    let run = |power: i32| {
        // Halved as well: where steps are never refused, the tolerance alone changes nothing.
        let step = 0.5_f64.powi(power - TOLERANCES.start()) * subject.end() / f64::from(LOOKS);
        let tolerance = Some(10.0_f64.powi(-power));
        subject.motion(&Method { tolerance, ..Method::fixed(Scheme::RungeKutta8, step) })
    };
    let (mut best, mut before) = (None, run(*TOLERANCES.start())?);
    let mut failure = None;
    for power in TOLERANCES.skip(1) {
        match run(power) {
            Ok(motion) => {
                let uncertainty = before.distance(&motion);
                before = motion.clone();
                let by = format!("{}, tolerance {:.0e}", Scheme::RungeKutta8, 10.0_f64.powi(-power));
                best = better(best, Candidate { motion, uncertainty, by });
            }
            Err(error) => {
                failure = Some(error);
                break;
            }
        }
    }
    best.ok_or_else(|| failure.unwrap_or(TrialError::Cancelled))
}

fn by_steps<const D: usize>(subject: &Subject<'_, D>) -> Result<Candidate, TrialError> {
    let run = |steps: u64| subject.motion(&Method::fixed(Scheme::Symplectic, subject.end() / steps as f64));
    // Rows of Romberg's scheme: the motion itself, then one power of h² less each.
    let mut row: Vec<Motion> = Vec::new();
    let mut best: Option<Candidate> = None;
    let mut steps = COARSEST;
    loop {
        let motion = match run(steps) {
            Ok(motion) => motion,
            // A long step may fail where a shorter one does not.
            Err(TrialError::Step(_)) if best.is_none() && steps < FINEST => {
                steps *= 2;
                continue;
            }
            Err(error) => return best.ok_or(error),
        };
        let mut next = vec![motion];
        for (k, coarser) in row.iter().enumerate().take(2) {
            let factor = 1.0 / (4.0_f64.powi(k as i32 + 1) - 1.0);
            let finer = next[k].extrapolate(coarser, factor);
            next.push(finer);
        }
        for (k, (finer, coarser)) in next.iter().zip(&row).enumerate() {
            let uncertainty = finer.distance(coarser);
            let by = format!("{}, {steps} steps, extrapolated {k} times", Scheme::Symplectic);
            best = better(best, Candidate { motion: finer.clone(), uncertainty, by });
        }
        row = next;
        steps *= 2;
    }
}
