//! The search for the lowest eigenpairs through a sequence of shifts, and the proof that none is missing (Ericsson and Ruhe
//! 1980; Grimes, Lewis and Simon 1994).
//!
//! One Krylov space about a shift σ finds what lies near σ. Pairs that have converged are locked: later spaces are
//! orthogonal to them. The next shift goes amid those that have not, so that a cluster far from the first shift costs
//! a few vectors and not hundreds. In the end the signs of the pivots just above the last wanted pair count how many there
//! must be below; where that is more than were found, the search goes on from there with random vectors.

use crate::entries::Entries;
use crate::error::TangentError;
use crate::lanczos::{Krylov, Operator, RitzPair};
use crate::shift_invert::ShiftInvert;

/// W-norm of a Ritz pair's residual, per θ, at which it has converged: eigenvalues are then good to the square of it.
const CONVERGED: f64 = 1e-9;
/// The same where rounding in the solves, some ε times K's largest eigenvalue by the pair's distance from the shift, ends
/// the descent earlier: the eigenvalue still has all digits that K determines.
const STALLED: f64 = 1e-4;
const ROUNDED: f64 = 16.0 * f64::EPSILON;
/// Residuals below which some more vectors are cheaper than another shift.
const CLOSE: f64 = 1e-4;
/// Eigenvalues closer than this part of each other's size are one multiple eigenvalue.
const CLUSTER: f64 = 1e-6;
/// Vectors beyond those of the wanted pairs after which a space is looked at, and given up for the next.
const FIRST_CHECK: usize = 10;
const LAST_CHECK: usize = 10;
/// Vectors between looks.
const CHECK: usize = 4;
/// A new shift's least distance from what is wanted, per distance of the old one.
const NEAREST: f64 = 1e-3;
/// Spaces that may bring nothing, one after the other.
const MOST_FRUITLESS: u32 = 6;

/// The search from factors at a shift below all eigenvalues.
pub(crate) struct Search<'a, 'm> {
    pub(crate) inverse: ShiftInvert<'m>,
    /// W; none for the identity.
    pub(crate) metric: Option<&'a Entries>,
    /// Number of free coordinates.
    pub(crate) size: usize,
    /// Number of eigenvalues.
    pub(crate) freedom: usize,
    pub(crate) zero_limit: f64,
    /// Largest |ν|.
    pub(crate) largest: f64,
}

/// Eigenvalue and vector.
pub(crate) type Pair = (f64, Vec<f64>);

/// What one space gave: pairs that have converged, estimates of others that are wanted.
struct Harvest {
    good: Vec<Pair>,
    estimates: Vec<Pair>,
    is_full: bool,
}

impl Search<'_, '_> {
    /// The `wanted` lowest pairs, ascending; fewer than the degrees of freedom.
    pub(crate) fn run(&mut self, wanted: usize) -> Result<Vec<Pair>, TangentError> {
        let mut locked: Vec<Pair> = Vec::new();
        let (mut missing, mut below, mut starts) = (wanted, 0, Vec::new());
        let (mut random, mut fruitless) = (1, 0);
        while fruitless < MOST_FRUITLESS {
            let known = locked.iter().map(|pair| pair.1.clone()).collect();
            let mut krylov = Krylov::new(self.freedom, known, random);
            random += 1;
            let harvest = self.harvest(&mut krylov, std::mem::take(&mut starts), missing, below)?;
            fruitless = if harvest.good.is_empty() { fruitless + 1 } else { 0 };
            locked.extend(harvest.good);
            locked.sort_by(|a, b| a.0.total_cmp(&b.0));
            if harvest.is_full {
                locked.truncate(wanted);
                return Ok(locked);
            }
            let is_below = |limit: f64| locked.iter().filter(|pair| pair.0 <= limit).count();
            missing = wanted.saturating_sub(locked.len());
            if missing > 0 {
                let (shift, slack) = self.next_shift(&harvest.estimates);
                let count = self.inverse.count_below(shift, slack)?;
                below = count.saturating_sub(is_below(self.inverse.shift()));
                starts = harvest.estimates.into_iter().map(|pair| pair.1).collect();
                continue;
            }
            // Everything below the gap behind the last wanted pair.
            let last = locked[wanted - 1].0;
            let gap = CLUSTER * last.abs().max(self.zero_limit);
            let expected = self.inverse.count_below(last + gap, 0.1 * gap)?.min(self.freedom);
            missing = expected.saturating_sub(is_below(last + gap));
            if missing == 0 {
                locked.truncate(wanted);
                return Ok(locked);
            }
            below = missing;
        }
        Err(TangentError::NotConverged { wanted, found: wanted - missing.min(wanted), spaces: fruitless })
    }

    /// Grows a space until the wanted pairs have converged, or another shift promises more.
    fn harvest(
        &mut self,
        krylov: &mut Krylov,
        starts: Vec<Vec<f64>>,
        wanted: usize,
        below: usize,
    ) -> Result<Harvest, TangentError> {
        if starts.is_empty() {
            krylov.restart(self)?;
        } else {
            krylov.start(self, starts)?;
        }
        let shift = self.inverse.shift();
        let (mut next, last) = (wanted + FIRST_CHECK, wanted + wanted / 2 + LAST_CHECK);
        loop {
            while krylov.dimension() < next && !krylov.is_full() {
                krylov.extend(self)?;
            }
            let mut pairs = krylov.pairs()?;
            // Those below the shift come first, the one with the most negative θ nearest to it. Other negative θ are
            // rounding.
            let rotation = below.min(pairs.len());
            pairs.rotate_right(rotation);
            let is_full = krylov.is_full();
            let share = |pair: &RitzPair| pair.residual / pair.theta.abs();
            let is_good = |pair: &RitzPair| {
                let rounding = (ROUNDED * self.largest * pair.theta.abs()).min(STALLED);
                is_full || share(pair) <= rounding.max(CONVERGED)
            };
            let open = pairs.iter().take(wanted).filter(|pair| !is_good(pair));
            let worst = open.clone().map(share).fold(0.0, f64::max);
            let is_over = next >= last && (worst > CLOSE || next >= 2 * last);
            if open.count() == 0 || is_full || is_over {
                let value = |pair: &RitzPair| shift + 1.0 / pair.theta;
                // With the wanted ones the rest of a cluster that ends them.
                let end = pairs.get(wanted.min(pairs.len()) - 1).map_or(shift, value);
                let end = end + CLUSTER * end.abs().max(self.zero_limit);
                let mut harvest = Harvest { good: Vec::new(), estimates: Vec::new(), is_full };
                for (k, pair) in pairs.iter().enumerate() {
                    let good = is_good(pair);
                    if k < wanted || (good && k < wanted + BEHIND && value(pair) <= end) {
                        let list = if good { &mut harvest.good } else { &mut harvest.estimates };
                        list.push((value(pair), krylov.vector(self, pair)));
                    }
                }
                return Ok(harvest);
            }
            next = krylov.dimension() + CHECK.max(krylov.dimension() / 8);
        }
    }

    /// A shift amid estimates, and by how much it may be off.
    fn next_shift(&self, estimates: &[Pair]) -> (f64, f64) {
        let values = || estimates.iter().map(|pair| pair.0);
        let (low, high) =
            (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
        let nearest = NEAREST * (low - self.inverse.shift()).abs();
        if high - low > nearest {
            (low + MIDDLE * (high - low), 0.1 * (high - low))
        } else {
            (low - nearest, 0.1 * nearest)
        }
    }
}

/// Pairs beyond the wanted ones that are looked at for the rest of a cluster.
const BEHIND: usize = 6;
/// Where in the range of the estimates the next shift goes: not where symmetry may put one of them.
const MIDDLE: f64 = 0.45;

impl Operator for Search<'_, '_> {
    fn size(&self) -> usize {
        self.size
    }

    fn apply(&mut self, wx: &[f64], y: &mut [f64]) -> Result<(), TangentError> {
        self.inverse.solve(wx, y)
    }

    fn metric(&self, x: &[f64], wx: &mut [f64]) {
        match self.metric {
            Some(mass) => {
                wx.fill(0.0);
                mass.add_product(1.0, x, wx);
            }
            None => wx.copy_from_slice(x),
        }
    }
}
