//! Inverse statics: the tensions, force densities or rest lengths that hold a configuration under its loads.
//!
//! ```text
//! B f = Nᵀ F₀                                    (32)
//! f_j = γ_j l_j = κ_j (l_j - μ_j)                (33)
//! ⇒ B_x x = b,   x = γ or μ                      (34), (35)
//! ```
//! The answer is a set: a particular solution plus the null space of B_x. A [`Request`] narrows it (given values, tied
//! cables) and chooses in it (minimum norm, closest to given values, bounds on tension). Small structures eliminate the
//! constraint forces by N, large ones keep them ([`crate::inverse_sparse`]).

use std::borrow::Cow;

use tg_model::Tensioned;
use tg_tangent::faer::Mat;
use tg_tangent::{Configuration, dense};

use crate::cable_equilibrium::{CableEquilibrium, Cables};
use crate::choice::{Affine, TensionRows};
use crate::inverse_error::InverseError;
use crate::inverse_sparse::{self, LARGEST_GROUP, SPARSE_ABOVE};
use crate::rank::{Rank, TOLERANCE};
use crate::request::{Request, Unknown};
use crate::solution::{Answer, SolutionSet};

/// Largest residual force per largest force at which a configuration can be held: what rounding of coordinates to twelve
/// digits leaves. A load that no cable resists leaves a share of itself.
pub(crate) const CONSISTENT: f64 = 1e-9;

/// Inverse statics of one configuration.
pub struct InverseStatics<'s> {
    structure: &'s dyn Tensioned,
    at: Configuration,
    cables: Cables,
    /// Unless the structure is large.
    reduced: Option<Reduced>,
}

/// The equations without constraint forces, dense.
#[derive(Clone)]
struct Reduced {
    cables: CableEquilibrium,
    load: Mat<f64>,
}

impl<'s> InverseStatics<'s> {
    /// Prepares a configuration: full coordinates `q` and inputs `u`, of which the force components are the loads; its
    /// rest lengths hold for cables between prescribed points only.
    ///
    /// # Errors
    /// A decomposition fails, or a force is not finite.
    pub fn new(structure: &'s dyn Tensioned, q: &[f64], u: &[f64]) -> Result<Self, InverseError> {
        let at = Configuration::at(structure.mechanics(), q, u)?;
        let cables = Cables::new(structure, &at);
        let acting = cables.acts.iter().filter(|&&acts| acts).count();
        let mut statics = Self { structure, at, cables, reduced: None };
        if acting <= SPARSE_ABOVE {
            statics.reduced = Some(statics.reduced()?.into_owned());
        }
        Ok(statics)
    }

    fn reduced(&self) -> Result<Cow<'_, Reduced>, InverseError> {
        if let Some(reduced) = &self.reduced {
            return Ok(Cow::Borrowed(reduced));
        }
        let cables = CableEquilibrium::new(self.structure, &self.at)?;
        let load = cables.reduced(&self.cables.load);
        Ok(Cow::Owned(Reduced { cables, load }))
    }

    /// Lengths of all cables \[m\].
    pub fn lengths(&self) -> &[f64] {
        &self.cables.lengths
    }

    /// The matrix B_x of eqs. (32) or (35) and its right-hand side, degrees of freedom by cables; a column of zeros for a
    /// cable between prescribed points.
    ///
    /// # Errors
    /// Rest lengths as unknowns of a cable whose law is not linear in them.
    pub fn equations(&self, unknown: Unknown) -> Result<(Mat<f64>, Vec<f64>), InverseError> {
        Ok(self.reduced()?.equations(&self.affine(unknown)?))
    }

    /// The set of solutions under a request's given values and ties; its goal and bounds are not looked at.
    ///
    /// # Errors
    /// The request names a cable twice or one that does not exist, or no solution holds the configuration.
    pub fn solutions(&self, request: &Request) -> Result<SolutionSet, InverseError> {
        let count = self.cables.lengths.len();
        request.check(count)?;
        let affine = self.affine(request.unknown)?;
        let reduced = self.reduced()?;
        let (matrix, mut right) = reduced.equations(&affine);
        let given = self.given(request, &affine);
        for (row, right) in right.iter_mut().enumerate() {
            let known = given.iter().enumerate().filter_map(|(c, x)| x.map(|x| matrix[(row, c)] * x));
            *right -= known.sum::<f64>();
        }
        let groups = request.groups(&given)?;
        // Orthonormal columns: norms over groups are norms over cables.
        let mut ties = Mat::zeros(count, groups.len());
        for (g, group) in groups.iter().enumerate() {
            group.iter().for_each(|&c| ties[(c, g)] = 1.0 / (group.len() as f64).sqrt());
        }
        let svd = dense::svd(&(&matrix * &ties))?;
        let rank = Rank::new(svd.values, request.tolerance.unwrap_or(TOLERANCE));
        let mut particular: Vec<f64> = given.iter().map(|x| x.unwrap_or(0.0)).collect();
        for k in 0..rank.rank {
            let share =
                (0..right.len()).map(|r| svd.left[(r, k)] * right[r]).sum::<f64>() / rank.singular_values[k];
            let direction = &ties * svd.right.col(k);
            particular.iter_mut().zip(direction.iter()).for_each(|(x, d)| *x += share * d);
        }
        let null_space: Vec<Vec<f64>> =
            (rank.rank..groups.len()).map(|k| (&ties * svd.right.col(k)).iter().copied().collect()).collect();
        let tensions: Vec<f64> =
            (0..count).map(|c| affine.slope[c] * particular[c] + affine.offset[c]).collect();
        let (residual, worst) = reduced.residual(&tensions, self.at.force_scale);
        if residual > CONSISTENT {
            let mechanics = self.structure.mechanics();
            let coordinate = mechanics.coordinate_name(mechanics.free()[worst]);
            return Err(InverseError::NotHeld { residual, coordinate });
        }
        let freedom = null_space.len();
        Ok(SolutionSet { unknown: request.unknown, rank, particular, freedom, null_space, residual })
    }

    /// Unknowns of cables that do not act, or whose values the request gives.
    fn given(&self, request: &Request, affine: &Affine) -> Vec<Option<f64>> {
        let lengths = &self.cables.lengths;
        let mut given = vec![None; lengths.len()];
        let value = |cable: usize, tension: f64| Some((tension - affine.offset[cable]) / affine.slope[cable]);
        for cable in (0..lengths.len()).filter(|&cable| !self.cables.acts[cable]) {
            given[cable] =
                value(cable, self.structure.static_tension(cable, lengths[cable], self.at.u[cable]));
        }
        for &(cable, wish) in &request.given {
            given[cable] = value(cable, wish.tension(self.structure, cable, lengths[cable]));
        }
        given
    }

    /// Chooses in the set of solutions. With more than 150 cables, and no more than eight of them tied to each other, by
    /// sparse systems: time and memory then grow with the structure, and the set has no basis of its null space.
    ///
    /// # Errors
    /// As [`InverseStatics::solutions`]; bounds that cannot be met, with the cables and by how much; a cable that
    /// cannot carry its tension at any rest length.
    pub fn solve(&self, request: &Request) -> Result<Answer, InverseError> {
        let count = self.cables.lengths.len();
        request.check(count)?;
        let affine = self.affine(request.unknown)?;
        if self.reduced.is_none() {
            let given = self.given(request, &affine);
            let groups = request.groups(&given)?;
            if groups.iter().all(|group| group.len() <= LARGEST_GROUP) {
                let Self { structure, at, cables, .. } = self;
                let (tensions, set) =
                    inverse_sparse::solve(*structure, at, cables, request, &affine, &given, &groups)?;
                return self.answer(tensions, set);
            }
        }
        let set = self.solutions(request)?;
        let row = |c: usize| {
            let row = set.null_space.iter().map(|z| affine.slope[c] * z[c]).enumerate().collect();
            (row, affine.slope[c] * set.particular[c] + affine.offset[c])
        };
        let tension_rows = TensionRows {
            rows: (0..count).map(row).collect(),
            free: set.null_space.len(),
            nearest: set.nearest(&request.goal),
            multipliers: 0,
            equations: Vec::new(),
        };
        let w = if request.is_bounded() {
            let acting: Vec<usize> = (0..count).filter(|&c| self.cables.acts[c]).collect();
            tension_rows.bounded(&acting, request, &|c| self.structure.cable_name(c))?
        } else {
            tension_rows.nearest.clone()
        };
        let tensions = (0..count).map(|c| tension_rows.tension(c, &w)).collect();
        self.answer(tensions, set)
    }

    fn answer(&self, tensions: Vec<f64>, set: SolutionSet) -> Result<Answer, InverseError> {
        let lengths = self.cables.lengths.clone();
        let names: Vec<String> = (0..lengths.len()).map(|c| self.structure.cable_name(c)).collect();
        let mut rest_lengths = Vec::new();
        for (cable, (&f, &l)) in tensions.iter().zip(&lengths).enumerate() {
            let rest = if self.cables.acts[cable] {
                crate::request::rest_length(self.structure, cable, l, f)
            } else {
                Some(self.at.u[cable])
            };
            rest_lengths.push(rest.ok_or_else(|| InverseError::NoRestLength {
                cable: names[cable].clone(),
                tension: f,
                length: l,
            })?);
        }
        let pushes = |&c: &usize| tensions[c] < 0.0 && self.structure.only_pulls(c);
        Ok(Answer {
            force_densities: tensions.iter().zip(&lengths).map(|(f, l)| f / l).collect(),
            pushing: (0..lengths.len()).filter(pushes).collect(),
            rest_lengths,
            tensions,
            set,
            lengths,
            names,
        })
    }

    fn affine(&self, unknown: Unknown) -> Result<Affine, InverseError> {
        let lengths = &self.cables.lengths;
        let count = lengths.len();
        Ok(match unknown {
            Unknown::Tension => Affine { slope: vec![1.0; count], offset: vec![0.0; count] },
            Unknown::ForceDensity => Affine { slope: lengths.clone(), offset: vec![0.0; count] },
            Unknown::RestLength => {
                let stiffness = (0..count).map(|c| match self.structure.linear_stiffness(c) {
                    Some(k) if k > 0.0 => Ok(k),
                    _ => Err(InverseError::NotLinear { cable: self.structure.cable_name(c) }),
                });
                let stiffness = stiffness.collect::<Result<Vec<f64>, _>>()?;
                let offset = stiffness.iter().zip(lengths).map(|(k, l)| k * l).collect();
                Affine { slope: stiffness.iter().map(|k| -k).collect(), offset }
            }
        })
    }
}

impl Reduced {
    /// B_x and its right-hand side, a column for each cable.
    fn equations(&self, affine: &Affine) -> (Mat<f64>, Vec<f64>) {
        let mut matrix = Mat::zeros(self.load.nrows(), self.cables.lengths.len());
        let mut right: Vec<f64> = self.load.col(0).iter().copied().collect();
        for (column, &cable) in self.cables.acting.iter().enumerate() {
            for row in 0..matrix.nrows() {
                let b = self.cables.matrix[(row, column)];
                matrix[(row, cable)] = b * affine.slope[cable];
                right[row] -= b * affine.offset[cable];
            }
        }
        (matrix, right)
    }

    /// Largest residual force per largest force with these tensions, and where.
    fn residual(&self, tensions: &[f64], force_scale: f64) -> (f64, usize) {
        let basis = &self.cables.null_space.basis;
        let mut reduced = self.load.to_owned();
        for (column, &cable) in self.cables.acting.iter().enumerate() {
            for row in 0..reduced.nrows() {
                reduced[(row, 0)] -= self.cables.matrix[(row, column)] * tensions[cable];
            }
        }
        let force = basis * &reduced;
        let largest = tensions.iter().fold(force_scale, |a, f| a.max(f.abs()));
        let (worst, residual) = force
            .col(0)
            .iter()
            .enumerate()
            .fold((0, 0.0_f64), |best, (k, r)| if r.abs() > best.1 { (k, r.abs()) } else { best });
        (if residual == 0.0 { 0.0 } else { residual / largest }, worst)
    }
}
