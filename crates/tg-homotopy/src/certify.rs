//! Proofs that points are near true solutions: existence, uniqueness, distinctness, reality.
//!
//! Each point is refined in double-double and enclosed by a polydisc that passes the Krawczyk test. Polydiscs that are
//! disjoint hold different solutions. A solution is real with respect to a conjugation σ if its polydisc can be chosen
//! with σ(X) = X: then σ maps the only solution in X to itself. It is not real if X and σ(X) are disjoint. (Breiding, Rose
//! & Timme, *Certifying zeros of polynomial systems using interval arithmetic*, ACM TOMS 49, 2023.)
//!
//! What is proved concerns the system with exactly the double coefficients and parameters given.

use num_complex::Complex64;
use rayon::prelude::*;

use crate::complex_dd::ComplexDd;
use crate::conjugation::Conjugation;
use crate::disc::Disc;
use crate::error::{HomotopyError, check_finite, check_length};
use crate::krawczyk::{Krawczyk, Miss};
use crate::system::PolynomialSystem;
use crate::tracker::distance;

/// Settings of [`certify`].
#[derive(Clone, Debug, PartialEq)]
pub struct CertifyOptions {
    /// What real means; nothing is said about reality without it.
    pub conjugation: Option<Conjugation>,
    /// Refinement may move a point by so much, relative to its norm; one that moves more was no approximate solution
    /// (docs/accuracy-and-speed.md, "Refinement of certificates").
    pub largest_move: f64,
}

impl Default for CertifyOptions {
    fn default() -> Self {
        Self { conjugation: None, largest_move: 1e-6 }
    }
}

/// Whether a solution is a fixed point of the conjugation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Realness {
    /// Proved real.
    Real,
    /// Proved not real.
    NotReal,
    /// Neither proved.
    Undecided,
    /// No conjugation was given.
    NotAsked,
}

/// A proved solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// Number of the point given.
    pub index: usize,
    /// A polydisc with exactly one solution, which is simple.
    pub polydisc: Vec<Disc>,
    /// Its midpoint, rounded.
    pub solution: Vec<Complex64>,
    /// Largest radius relative to the largest modulus of the midpoint.
    pub radius: f64,
    /// Reality.
    pub realness: Realness,
    /// κ∞ of the Jacobian, rows equilibrated and unknowns scaled by their moduli.
    pub condition: f64,
}

/// Why a point has no certificate.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum Rejection {
    /// Newton's method left the point: it is no approximate solution.
    #[error("refinement moved the point by {moved:e} of its norm: it is no approximate solution")]
    NotASolution {
        /// Relative distance.
        moved: f64,
    },
    /// The Jacobian is singular in double-double arithmetic.
    #[error("the Jacobian is singular in double-double arithmetic")]
    Singular,
    /// No polydisc passed the Krawczyk test: a multiple solution, or one too ill-conditioned.
    #[error(
        "the Krawczyk test failed (ratio of radii {ratio:e}): a multiple or very ill-conditioned solution"
    )]
    NotContracting {
        /// Radius of the image over that of the polydisc.
        ratio: f64,
    },
    /// Its polydisc meets that of an earlier point.
    #[error("not proved different from point {other}")]
    Duplicate {
        /// The earlier point.
        other: usize,
    },
}

/// What [`certify`] proved and what not.
#[derive(Clone, Debug, PartialEq)]
pub struct CertificationReport {
    /// Proved solutions, pairwise different.
    pub certificates: Vec<Certificate>,
    /// Points without certificate, and why.
    pub rejections: Vec<(usize, Rejection)>,
}

impl CertificationReport {
    /// Number of different solutions proved.
    pub fn count(&self) -> usize {
        self.certificates.len()
    }

    /// Number proved real.
    pub fn real(&self) -> usize {
        self.with(Realness::Real)
    }

    /// Number with this reality.
    pub fn with(&self, realness: Realness) -> usize {
        self.certificates.iter().filter(|c| c.realness == realness).count()
    }

    /// Largest relative radius.
    pub fn largest_radius(&self) -> f64 {
        self.certificates.iter().map(|c| c.radius).fold(0.0, f64::max)
    }
}

/// Certifies `points` as solutions of F(·; `parameters`) = 0.
pub fn certify(
    system: &PolynomialSystem,
    parameters: &[Complex64],
    points: &[Vec<Complex64>],
    options: &CertifyOptions,
) -> Result<CertificationReport, HomotopyError> {
    check_length("parameters", system.parameters(), parameters.len())?;
    check_finite("parameter", parameters)?;
    for point in points {
        check_length("point", system.unknowns(), point.len())?;
        check_finite("a coordinate of a point", point)?;
    }
    if let Some(conjugation) = &options.conjugation {
        conjugation.check(system, parameters)?;
    }
    let prove =
        |(index, point): (usize, &Vec<Complex64>)| (index, one(system, parameters, index, point, options));
    let proofs: Vec<(usize, Result<Certificate, Rejection>)> =
        points.par_iter().enumerate().map(prove).collect();
    let mut report = CertificationReport { certificates: vec![], rejections: vec![] };
    for (index, proof) in proofs {
        let proof = proof.and_then(|certificate| {
            match report.certificates.iter().find(|c| !disjoint(&c.polydisc, &certificate.polydisc)) {
                Some(earlier) => Err(Rejection::Duplicate { other: earlier.index }),
                None => Ok(certificate),
            }
        });
        match proof {
            Ok(certificate) => report.certificates.push(certificate),
            Err(rejection) => report.rejections.push((index, rejection)),
        }
    }
    Ok(report)
}

fn disjoint(a: &[Disc], b: &[Disc]) -> bool {
    a.iter().zip(b).any(|(a, b)| a.is_disjoint(*b))
}

fn one(
    system: &PolynomialSystem,
    parameters: &[Complex64],
    index: usize,
    point: &[Complex64],
    options: &CertifyOptions,
) -> Result<Certificate, Rejection> {
    let mut test = Krawczyk::new(system, parameters);
    let given: Vec<ComplexDd> = point.iter().map(|&z| z.into()).collect();
    let refined = test.refine(&given).ok_or(Rejection::Singular)?;
    let moved = distance(&given, &refined);
    if !(moved <= options.largest_move) {
        return Err(Rejection::NotASolution { moved });
    }
    let rejected = |miss| match miss {
        Miss::Singular => Rejection::Singular,
        Miss::NotContracting { ratio } => Rejection::NotContracting { ratio },
    };
    let mut polydisc = test.enclose(&refined, |_| {}).map_err(rejected)?;
    let mut realness = Realness::NotAsked;
    if let Some(conjugation) = &options.conjugation {
        realness = reality(&mut test, conjugation, &mut polydisc);
    }
    let solution: Vec<Complex64> = polydisc.iter().map(|d| d.mid.to_c64()).collect();
    let size = solution.iter().map(|z| z.norm()).fold(f64::MIN_POSITIVE, f64::max);
    let radius = polydisc.iter().map(|d| d.radius).fold(0.0, f64::max) / size;
    let condition = test.condition(&refined);
    Ok(Certificate { index, polydisc, solution, radius, realness, condition })
}

/// Proves or disproves reality; a proof replaces the polydisc by a conjugation-invariant one.
fn reality(test: &mut Krawczyk<'_>, conjugation: &Conjugation, polydisc: &mut Vec<Disc>) -> Realness {
    let map = conjugation.unknowns();
    let image: Vec<Disc> = map.iter().map(|&j| polydisc[j].conj()).collect();
    if disjoint(polydisc, &image) {
        return Realness::NotReal;
    }
    // Sums commute exactly, so the mean is invariant to the last bit.
    let mean: Vec<ComplexDd> = polydisc.iter().zip(&image).map(|(x, y)| (x.mid + y.mid).half()).collect();
    if (0..map.len()).any(|i| mean[map[i]] != mean[i].conj()) {
        return Realness::Undecided;
    }
    let tie = |radii: &mut [f64]| {
        for i in 0..map.len() {
            let larger = radii[i].max(radii[map[i]]);
            (radii[i], radii[map[i]]) = (larger, larger);
        }
    };
    match test.enclose(&mean, tie) {
        Ok(symmetric) => {
            *polydisc = symmetric;
            Realness::Real
        }
        Err(_) => Realness::Undecided,
    }
}
