//! Inverse statics: the tensions, force densities or rest lengths that hold a configuration under its loads.
//!
//! ```text
//! B f = Nᵀ F₀                                    (32)
//! f_j = γ_j l_j = κ_j (l_j - μ_j)                (33)
//! ⇒ B_x x = b,   x = γ or μ                      (34), (35)
//! ```
//! The answer is a set: a particular solution plus the null space of B_x. A [`Request`] narrows it (given values, tied
//! cables) and chooses in it (minimum norm, closest to given values, bounds on tension).

use tg_model::Tensioned;
use tg_tangent::faer::Mat;
use tg_tangent::{Configuration, dense};

use crate::cable_equilibrium::CableEquilibrium;
use crate::cutting_list::CuttingRow;
use crate::inverse_error::InverseError;
use crate::program::{Program, ProgramError};
use crate::rank::{Rank, TOLERANCE};
use crate::request::{Goal, Request, Unknown};

/// Largest residual force per largest force at which a configuration can be held: what rounding of coordinates to twelve
/// digits leaves. A load that no cable resists leaves a share of itself.
const CONSISTENT: f64 = 1e-9;
/// Tension beyond a bound, per largest tension, that the programmes' accuracy explains.
const BOUND_ACCURACY: f64 = 1e-7;

/// Inverse statics of one configuration.
pub struct InverseStatics<'s> {
    structure: &'s dyn Tensioned,
    at: Configuration,
    cables: CableEquilibrium,
    load: Mat<f64>,
}

/// All values of the unknowns that hold the configuration: x = particular + Σ w_k null_space_k.
#[derive(Clone, Debug)]
pub struct SolutionSet {
    /// Which unknowns.
    pub unknown: Unknown,
    /// Rank of B_x over the unknowns that are not given, ties applied.
    pub rank: Rank,
    /// Solution of minimum norm among the unknowns that are not given, all cables.
    pub particular: Vec<f64>,
    /// Orthonormal directions in which the solution may change, all cables; empty where it is unique.
    pub null_space: Vec<Vec<f64>>,
    /// Largest residual force per largest force.
    pub residual: f64,
}

/// One choice of rest lengths, and what follows from it.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Tension f \[N\] of each cable, positive when it pulls.
    pub tensions: Vec<f64>,
    /// Force density γ = f/l \[N/m\] of each cable.
    pub force_densities: Vec<f64>,
    /// Rest length μ \[m\] of each cable: the inputs that hold the configuration.
    pub rest_lengths: Vec<f64>,
    /// Cables whose law only pulls and that would have to push: the configuration cannot be held so.
    pub pushing: Vec<usize>,
    /// The set that the answer was chosen from.
    pub set: SolutionSet,
    lengths: Vec<f64>,
    names: Vec<String>,
}

/// f = slope · x + offset, cable by cable.
struct Affine {
    slope: Vec<f64>,
    offset: Vec<f64>,
}

impl<'s> InverseStatics<'s> {
    /// Prepares a configuration: full coordinates `q` and inputs `u`, of which the force components are the loads; its
    /// rest lengths hold for cables between prescribed points only.
    ///
    /// # Errors
    /// A decomposition fails, or a force is not finite.
    pub fn new(structure: &'s dyn Tensioned, q: &[f64], u: &[f64]) -> Result<Self, InverseError> {
        let at = Configuration::at(structure.mechanics(), q, u)?;
        let cables = CableEquilibrium::new(structure, &at)?;
        let load = cables.reduced_load(structure, &at);
        Ok(Self { structure, at, cables, load })
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
        let affine = self.affine(unknown)?;
        let mut matrix = Mat::zeros(self.load.nrows(), self.cables.lengths.len());
        let mut right: Vec<f64> = self.load.col(0).iter().copied().collect();
        for (column, &cable) in self.cables.acting.iter().enumerate() {
            for row in 0..matrix.nrows() {
                let b = self.cables.matrix[(row, column)];
                matrix[(row, cable)] = b * affine.slope[cable];
                right[row] -= b * affine.offset[cable];
            }
        }
        Ok((matrix, right))
    }

    /// The set of solutions under a request's given values and ties; its goal and bounds are not looked at.
    ///
    /// # Errors
    /// The request names a cable twice or one that does not exist, or no solution holds the configuration.
    pub fn solutions(&self, request: &Request) -> Result<SolutionSet, InverseError> {
        let count = self.cables.lengths.len();
        request.check(count)?;
        let affine = self.affine(request.unknown)?;
        let (matrix, mut right) = self.equations(request.unknown)?;
        let mut given = vec![None; count];
        for cable in (0..count).filter(|cable| !self.cables.acting.contains(cable)) {
            let tension = self.structure.static_tension(cable, self.cables.lengths[cable], self.at.u[cable]);
            given[cable] = Some((tension - affine.offset[cable]) / affine.slope[cable]);
        }
        for &(cable, value) in &request.given {
            let tension = value.tension(self.structure, cable, self.cables.lengths[cable]);
            given[cable] = Some((tension - affine.offset[cable]) / affine.slope[cable]);
        }
        for (row, right) in right.iter_mut().enumerate() {
            let known = given.iter().enumerate().filter_map(|(c, x)| x.map(|x| matrix[(row, c)] * x));
            *right -= known.sum::<f64>();
        }
        let groups = request.groups(&given)?;
        // Orthonormal columns: norms over groups are norms over cables.
        let ties = Mat::from_fn(count, groups.len(), |c, g| {
            if groups[g].contains(&c) { 1.0 / (groups[g].len() as f64).sqrt() } else { 0.0 }
        });
        let svd = dense::svd(&(&matrix * &ties))?;
        let rank = Rank::new(svd.values, request.tolerance.unwrap_or(TOLERANCE));
        let mut particular: Vec<f64> = given.iter().map(|x| x.unwrap_or(0.0)).collect();
        for k in 0..rank.rank {
            let share =
                (0..right.len()).map(|r| svd.left[(r, k)] * right[r]).sum::<f64>() / rank.singular_values[k];
            let direction = &ties * svd.right.col(k);
            particular.iter_mut().zip(direction.iter()).for_each(|(x, d)| *x += share * d);
        }
        let null_space =
            (rank.rank..groups.len()).map(|k| (&ties * svd.right.col(k)).iter().copied().collect()).collect();
        let tensions: Vec<f64> =
            (0..count).map(|c| affine.slope[c] * particular[c] + affine.offset[c]).collect();
        let (residual, worst) = self.residual(&tensions);
        if residual > CONSISTENT {
            let mechanics = self.structure.mechanics();
            let coordinate = mechanics.coordinate_name(mechanics.free()[worst]);
            return Err(InverseError::NotHeld { residual, coordinate });
        }
        Ok(SolutionSet { unknown: request.unknown, rank, particular, null_space, residual })
    }

    /// Chooses in the set of solutions.
    ///
    /// # Errors
    /// As [`InverseStatics::solutions`]; bounds that cannot be met, with the cables and by how much; a cable that
    /// cannot carry its tension at any rest length.
    pub fn solve(&self, request: &Request) -> Result<Answer, InverseError> {
        let set = self.solutions(request)?;
        let affine = self.affine(request.unknown)?;
        let inner = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let goal: Vec<f64> = match &request.goal {
            Goal::MinimumNorm => vec![0.0; set.null_space.len()],
            Goal::Closest(values) => {
                let apart: Vec<f64> = values.iter().zip(&set.particular).map(|(t, x)| t - x).collect();
                set.null_space.iter().map(|z| inner(z, &apart)).collect()
            }
        };
        let tension_rows = TensionRows { set: &set, affine: &affine };
        let w = match request.bounds {
            None => goal,
            Some(bounds) => self.bounded(&tension_rows, &goal, bounds)?,
        };
        let tensions = (0..self.cables.lengths.len()).map(|c| tension_rows.tension(c, &w)).collect();
        self.answer(tensions, set)
    }

    fn bounded(
        &self,
        rows: &TensionRows<'_>,
        goal: &[f64],
        bounds: (f64, f64),
    ) -> Result<Vec<f64>, InverseError> {
        let free = goal.len();
        let mut program = Program::new(free);
        goal.iter().enumerate().for_each(|(k, &target)| program.near(k, target));
        for &cable in &self.cables.acting {
            let (row, offset) = rows.row(cable);
            program.between(&row, bounds.0 - offset, (bounds.1 - offset).min(f64::MAX));
        }
        let found = if free == 0 { Ok(Vec::new()) } else { program.solve() };
        match found {
            Ok(w) if self.violations(rows, &w, bounds).is_empty() => Ok(w),
            Ok(_) | Err(ProgramError::Infeasible) => self.least_violation(rows, free, bounds),
            Err(error) => Err(error.into()),
        }
    }

    /// Tensions beyond the bounds: (cable, tension).
    fn violations(&self, rows: &TensionRows<'_>, w: &[f64], (low, high): (f64, f64)) -> Vec<(usize, f64)> {
        let tensions: Vec<_> = self.cables.acting.iter().map(|&c| (c, rows.tension(c, w))).collect();
        let slack = BOUND_ACCURACY * tensions.iter().fold(0.0_f64, |a, (_, f)| a.max(f.abs()));
        tensions.into_iter().filter(|&(_, f)| f < low - slack || f > high + slack).collect()
    }

    /// The smallest sum of violations tells which bounds cannot be met together.
    fn least_violation(
        &self,
        rows: &TensionRows<'_>,
        free: usize,
        bounds: (f64, f64),
    ) -> Result<Vec<f64>, InverseError> {
        let mut program = Program::new(free + self.cables.acting.len());
        for (s, &cable) in self.cables.acting.iter().enumerate() {
            let (mut row, offset) = rows.row(cable);
            program.cost(free + s, 1.0);
            program.at_least(&[(free + s, 1.0)], 0.0);
            row.push((free + s, 1.0));
            program.at_least(&row, bounds.0 - offset);
            if let Some(last) = row.last_mut() {
                last.1 = -1.0;
            }
            if bounds.1.is_finite() {
                program.at_most(&row, bounds.1 - offset);
            }
        }
        let x = program.solve()?;
        let violated = self.violations(rows, &x[..free], bounds);
        if violated.is_empty() {
            return Ok(x[..free].to_vec());
        }
        let named = |&(c, f): &(usize, f64)| {
            let bound = if f < bounds.0 { bounds.0 } else { bounds.1 };
            (self.structure.cable_name(c), f, bound)
        };
        Err(InverseError::Infeasible { violated: violated.iter().map(named).collect() })
    }

    fn answer(&self, tensions: Vec<f64>, set: SolutionSet) -> Result<Answer, InverseError> {
        let lengths = self.cables.lengths.clone();
        let names: Vec<String> = (0..lengths.len()).map(|c| self.structure.cable_name(c)).collect();
        let mut rest_lengths = Vec::new();
        for (cable, (&f, &l)) in tensions.iter().zip(&lengths).enumerate() {
            let rest = if self.cables.acting.contains(&cable) {
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

    /// Largest residual force per largest force with these tensions, and where.
    fn residual(&self, tensions: &[f64]) -> (f64, usize) {
        let basis = &self.cables.null_space.basis;
        let mut reduced = self.load.to_owned();
        for (column, &cable) in self.cables.acting.iter().enumerate() {
            for row in 0..reduced.nrows() {
                reduced[(row, 0)] -= self.cables.matrix[(row, column)] * tensions[cable];
            }
        }
        let force = basis * &reduced;
        let largest = tensions.iter().fold(self.at.force_scale, |a, f| a.max(f.abs()));
        let (worst, residual) = force
            .col(0)
            .iter()
            .enumerate()
            .fold((0, 0.0_f64), |best, (k, r)| if r.abs() > best.1 { (k, r.abs()) } else { best });
        (if residual == 0.0 { 0.0 } else { residual / largest }, worst)
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

/// Tensions as functions of the coordinates w in the null space.
struct TensionRows<'a> {
    set: &'a SolutionSet,
    affine: &'a Affine,
}

impl TensionRows<'_> {
    /// Coefficients of w, and the constant.
    fn row(&self, cable: usize) -> (Vec<(usize, f64)>, f64) {
        let slope = self.affine.slope[cable];
        let row = self.set.null_space.iter().map(|z| slope * z[cable]).enumerate().collect();
        (row, slope * self.set.particular[cable] + self.affine.offset[cable])
    }

    fn tension(&self, cable: usize, w: &[f64]) -> f64 {
        let (row, offset) = self.row(cable);
        offset + row.iter().map(|&(k, a)| a * w[k]).sum::<f64>()
    }
}

impl Answer {
    /// What a workshop needs: each cable with its length, rest length, tension and strain.
    pub fn cutting_list(&self) -> Vec<CuttingRow> {
        let row = |c: usize| CuttingRow {
            cable: self.names[c].clone(),
            length: self.lengths[c],
            rest_length: self.rest_lengths[c],
            tension: self.tensions[c],
            strain: (self.lengths[c] - self.rest_lengths[c]) / self.rest_lengths[c],
        };
        (0..self.lengths.len()).map(row).collect()
    }

    /// The inputs that hold the configuration: these rest lengths, and the loads of `u`.
    pub fn inputs(&self, u: &[f64]) -> Vec<f64> {
        self.rest_lengths.iter().chain(&u[self.rest_lengths.len()..]).copied().collect()
    }
}
