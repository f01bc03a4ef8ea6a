//! All equilibria on the torus of angles, by branch and bound in interval arithmetic.
//!
//! ```text
//! 0 not in ∂V(X)                       X has none
//! K = m - Y ∂V(m) + (I - Y ∂²V(X))(X - m),   m in X, Y ≈ ∂²V(m)⁻¹
//! K ∩ X empty                          X has none
//! K inside X                           X has exactly one                 (Krawczyk)
//! ```
//! A box that is neither is halved. K is taken of a box somewhat larger than X, or an equilibrium on a common side would
//! be halved for ever.

use super::super::ReferenceError;
use super::interval::Interval;
use super::{Equilibrium, Model};

type Box2 = [Interval; 2];

/// Half the side of the square that is searched: more than half a turn \[rad\].
const HALF_SIDE: f64 = 3.15;
/// By how much a box is larger for Krawczyk's test.
const INFLATION: f64 = 0.1;
/// Largest side of a box on which that test is worth its cost \[rad\].
const WORTHWHILE: f64 = 0.5;
/// Side below which a box stays undecided \[rad\].
const SMALLEST: f64 = 1e-10;
/// A continuum of equilibria would be halved into boxes without number.
const MOST_BOXES: usize = 200_000;
const MOST_CONTRACTIONS: usize = 30;

/// What the search of a branch found.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// The equilibria, by γ1.
    pub equilibria: Vec<Equilibrium>,
    /// Boxes of angles \[rad\] of which nothing is known, as around equilibria that are not isolated; all
    /// others hold the equilibria above and no more.
    pub undecided: Vec<[Interval; 2]>,
    /// Number of boxes that were looked at.
    pub boxes: usize,
}

/// A box with exactly one equilibrium, and a tiny one around that.
struct Proof {
    unique: Box2,
    enclosure: Box2,
}

enum Outcome {
    None,
    One(Proof),
    Halve(Box2),
    Undecided,
}

impl Model {
    /// All equilibria of this branch.
    ///
    /// # Errors
    /// [`ReferenceError::Equilibrium`] if Newton's method fails from the middle of a tiny box that holds an equilibrium.
    pub fn search(&self) -> Result<Search, ReferenceError> {
        let side = Interval::new(-HALF_SIDE, HALF_SIDE);
        let (mut open, mut proofs, mut undecided) = (vec![[side; 2]], Vec::new(), Vec::new());
        let mut boxes = 0;
        while let Some(candidate) = open.pop() {
            if boxes == MOST_BOXES {
                undecided.push(candidate);
                continue;
            }
            boxes += 1;
            match self.look(candidate) {
                Outcome::None => {}
                Outcome::One(proof) => match known(&proofs, &proof) {
                    Some(true) => {}
                    Some(false) => undecided.push(proof.enclosure),
                    None => proofs.push(proof),
                },
                Outcome::Halve(rest) => open.extend(halves(rest)),
                Outcome::Undecided => undecided.push(candidate),
            }
        }
        let found = proofs.iter().map(|proof| self.equilibrium(proof.enclosure.map(Interval::middle)));
        let mut equilibria = found.collect::<Result<Vec<_>, _>>()?;
        equilibria.sort_by(|a, b| a.angles[0].total_cmp(&b.angles[0]));
        Ok(Search { equilibria, undecided, boxes })
    }

    fn look(&self, candidate: Box2) -> Outcome {
        let split =
            || if widest(candidate) < SMALLEST { Outcome::Undecided } else { Outcome::Halve(candidate) };
        let jets = [0, 1].map(|s| self.squared(s).at(candidate));
        let cone = |s: usize| self.rest[s] != 0.0 && jets[s].value.low <= 0.0;
        if let Some(s) = (0..2).find(|&s| cone(s)) {
            return if self.balances_nowhere(s, candidate, &jets[s], &jets[1 - s]) {
                Outcome::None
            } else {
                split()
            };
        }
        let gradient = self.derivatives(candidate, self.rest.map(Interval::from)).0;
        if gradient.iter().any(|g| !g.contains(0.0)) {
            return Outcome::None;
        }
        if widest(candidate) > WORTHWHILE {
            return split();
        }
        let larger = candidate.map(|side| side.inflated(INFLATION));
        let Some(image) = self.krawczyk(larger) else { return split() };
        let Some(rest) = meet(image, candidate) else { return Outcome::None };
        if (0..2).all(|i| image[i].inside(larger[i])) {
            return Outcome::One(Proof { unique: larger, enclosure: self.contracted(image) });
        }
        if widest(rest) < SMALLEST { Outcome::Undecided } else { Outcome::Halve(rest) }
    }

    /// K(X), if V is smooth on X and ∂²V not singular at its middle.
    fn krawczyk(&self, x: Box2) -> Option<Box2> {
        let smooth = |s: usize| self.rest[s] == 0.0 || self.squared(s).at(x).value.low > 0.0;
        if !(smooth(0) && smooth(1)) {
            return None;
        }
        let rest = self.rest.map(Interval::from);
        let middle = x.map(Interval::middle);
        let y = self.hessian(middle).try_inverse()?;
        let gradient = self.derivatives(middle.map(Interval::from), rest).0;
        let [a, b, c] = self.derivatives(x, rest).1;
        let hessian = [[a, b], [b, c]];
        let y = |i: usize, j: usize| Interval::from(y[(i, j)]);
        let image = |i: usize| {
            let mut sum = Interval::from(middle[i]) - y(i, 0) * gradient[0] - y(i, 1) * gradient[1];
            for j in 0..2 {
                let unit = Interval::from(f64::from(u8::from(i == j)));
                let defect = unit - y(i, 0) * hessian[0][j] - y(i, 1) * hessian[1][j];
                sum = sum + defect * (x[j] - Interval::from(middle[j]));
            }
            sum
        };
        Some([image(0), image(1)])
    }

    /// K(K(...)) as far as it shrinks.
    fn contracted(&self, mut enclosure: Box2) -> Box2 {
        for _ in 0..MOST_CONTRACTIONS {
            let next = self.krawczyk(enclosure).and_then(|image| meet(image, enclosure));
            match next {
                Some(next) if widest(next) < widest(enclosure) => enclosure = next,
                _ => break,
            }
        }
        enclosure
    }
}

/// Whether an equilibrium is one of those already found, whole turns aside: `None` if it is another, `Some(false)` if
/// that cannot be told.
fn known(proofs: &[Proof], new: &Proof) -> Option<bool> {
    let turn = Interval::new(std::f64::consts::TAU, std::f64::consts::TAU.next_up());
    let shifts = [Interval::from(0.0), turn, Interval::from(0.0) - turn];
    for old in proofs {
        for shift in shifts.iter().flat_map(|a| shifts.iter().map(move |b| [*a, *b])) {
            let moved: Box2 = [new.enclosure[0] + shift[0], new.enclosure[1] + shift[1]];
            if meet(moved, old.enclosure).is_some() {
                return Some((0..2).all(|i| moved[i].inside(old.unique[i])));
            }
        }
    }
    None
}

fn meet(a: Box2, b: Box2) -> Option<Box2> {
    Some([a[0].meet(b[0])?, a[1].meet(b[1])?])
}

fn widest(x: Box2) -> f64 {
    x[0].width().max(x[1].width())
}

fn halves(x: Box2) -> [Box2; 2] {
    let i = usize::from(x[1].width() > x[0].width());
    let (mut low, mut high) = (x, x);
    low[i].high = x[i].middle();
    high[i].low = x[i].middle();
    [low, high]
}
