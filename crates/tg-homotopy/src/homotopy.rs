//! The two homotopies H(X, t), t from 1 to 0, in affine or multiprojective unknowns.
//!
//! ```text
//! H(X, t) = γ t G(X) + (1 - t) F(X; p)          start system, γ random on the unit circle
//! H(X, t) = F(X; t p₁ + (1 - t) p₀)             parameters (Morgan & Sommese, Appl. Math. Comput. 29, 1989)
//! a_g · X_g = 1                                 patch of group g, multiprojective only
//! ```
//!
//! Sommese & Wampler, *The Numerical Solution of Systems of Polynomials* (2005), ch. 3, 7, 8. Patches are chosen per path
//! and live in the tracker; this module fills the rows of H.

use num_complex::Complex64;

use crate::error::HomotopyError;
use crate::evaluate::Evaluator;
use crate::grouping::Grouping;
use crate::random::Random;
use crate::scalar::{Field, Scalar};
use crate::start::StartSystem;
use crate::system::PolynomialSystem;

#[derive(Clone, Debug)]
enum Kind {
    Start { start: StartSystem, gamma: Complex64, parameters: Vec<Complex64>, scales: Vec<f64> },
    Parameters { from: Vec<Complex64>, to: Vec<Complex64> },
}

/// A homotopy; immutable, shared by all paths.
#[derive(Clone, Debug)]
pub(crate) struct Homotopy {
    system: PolynomialSystem,
    kind: Kind,
    /// Unknowns before homogenisation.
    affine: usize,
    /// Group of every unknown, homogenising ones at the end; empty if affine.
    group_of: Vec<usize>,
    groups: usize,
    /// Largest coefficient of each row of H at t = 0; 1 for patches.
    row_sizes: Vec<f64>,
}

/// What evaluating a homotopy needs and yields: H, ∂H/∂X, ∂H/∂t.
#[derive(Clone, Debug)]
pub(crate) struct Rows<S> {
    pub(crate) h: Vec<S>,
    pub(crate) jacobian: Vec<S>,
    pub(crate) rate: Vec<S>,
    evaluator: Evaluator<S>,
    g: Vec<S>,
    products: (Vec<S>, Vec<S>),
    parameters: Vec<S>,
    rates: Vec<S>,
    parameters_at: Option<Complex64>,
}

impl Homotopy {
    /// From a start system for `grouping` to F(·; `parameters`), in multiprojective unknowns.
    pub(crate) fn from_start(
        system: &PolynomialSystem,
        parameters: &[Complex64],
        grouping: &Grouping,
        random: &mut Random,
    ) -> Result<(Self, Vec<Vec<Complex64>>), HomotopyError> {
        let start = StartSystem::new(system, grouping, random);
        let points = start.solutions();
        let mut evaluator = Evaluator::new(system);
        evaluator.set_parameters(system, parameters);
        // Equations of unit largest coefficient stand beside start equations of the same size.
        let scales = evaluator.largest_coefficients(system).into_iter().map(|c| 1.0 / c).collect();
        let kind = Kind::Start { start, gamma: random.unit(), parameters: parameters.to_vec(), scales };
        Ok((Self::assemble(system, kind, Some(grouping))?, points))
    }

    /// From the parameters `from` to `to`; multiprojective if a grouping is given.
    pub(crate) fn between(
        system: &PolynomialSystem,
        from: &[Complex64],
        to: &[Complex64],
        grouping: Option<&Grouping>,
    ) -> Result<Self, HomotopyError> {
        Self::assemble(system, Kind::Parameters { from: from.to_vec(), to: to.to_vec() }, grouping)
    }

    fn assemble(
        system: &PolynomialSystem,
        kind: Kind,
        grouping: Option<&Grouping>,
    ) -> Result<Self, HomotopyError> {
        let affine = system.unknowns();
        let Some(grouping) = grouping else {
            let row_sizes = row_sizes(system, &kind, affine);
            return Ok(Self { system: system.clone(), kind, affine, group_of: vec![], groups: 0, row_sizes });
        };
        let groups = grouping.groups();
        let system = system.homogenized(grouping.group_of(), groups)?;
        let mut group_of = grouping.group_of().to_vec();
        group_of.extend(0..groups);
        let row_sizes = row_sizes(&system, &kind, affine + groups);
        Ok(Self { system, kind, affine, group_of, groups, row_sizes })
    }

    /// The same homotopy with other parameters at its ends.
    pub(crate) fn set_ends(&mut self, new_from: &[Complex64], new_to: &[Complex64]) {
        if let Kind::Parameters { from, to } = &mut self.kind {
            from.copy_from_slice(new_from);
            to.copy_from_slice(new_to);
        }
        self.row_sizes = row_sizes(&self.system, &self.kind, self.unknowns());
    }

    pub(crate) fn row_sizes(&self) -> &[f64] {
        &self.row_sizes
    }

    /// Unknowns of a path, homogenising ones included.
    pub(crate) fn unknowns(&self) -> usize {
        self.affine + self.groups
    }

    pub(crate) fn affine_unknowns(&self) -> usize {
        self.affine
    }

    pub(crate) fn groups(&self) -> usize {
        self.groups
    }

    pub(crate) fn group_of(&self) -> &[usize] {
        &self.group_of
    }

    /// Affine start point to unknowns of a path.
    pub(crate) fn lift(&self, x: &[Complex64]) -> Vec<Complex64> {
        let mut lifted = x.to_vec();
        lifted.resize(self.unknowns(), Complex64::one());
        lifted
    }

    pub(crate) fn rows<S: Field>(&self) -> Rows<S> {
        let (n, size) = (self.affine, self.unknowns());
        let mut evaluator = Evaluator::new(&self.system);
        let longest = match &self.kind {
            Kind::Start { start, parameters, .. } => {
                let parameters: Vec<S> = parameters.iter().map(|&p| S::from_c64(p)).collect();
                evaluator.set_parameters(&self.system, &parameters);
                start.longest
            }
            Kind::Parameters { .. } => 0,
        };
        let zeros = |count: usize| vec![S::zero(); count];
        Rows {
            h: zeros(size),
            jacobian: zeros(size * size),
            rate: zeros(size),
            evaluator,
            g: zeros(n),
            products: (zeros(longest), zeros(longest)),
            parameters: zeros(self.system.parameters()),
            rates: zeros(self.system.parameters()),
            parameters_at: None,
        }
    }

    /// H, ∂H/∂X, ∂H/∂t at (x, t) with the patches a.
    pub(crate) fn evaluate<S: Field>(&self, x: &[S], t: Complex64, patch: &[Complex64], rows: &mut Rows<S>) {
        let (n, size) = (self.affine, self.unknowns());
        let s = S::from_c64(t);
        let rest = S::one() - s;
        if let Kind::Parameters { from, to } = &self.kind
            && rows.parameters_at != Some(t)
        {
            for (j, (&a, &b)) in from.iter().zip(to).enumerate() {
                let (a, b) = (S::from_c64(a), S::from_c64(b));
                rows.parameters[j] = s * a + rest * b;
                rows.rates[j] = a - b;
            }
            rows.evaluator.set_parameters_and_rates(&self.system, &rows.parameters, &rows.rates);
            rows.parameters_at = Some(t);
        }
        let (values, jacobian) = (&mut rows.h[..n], &mut rows.jacobian);
        rows.evaluator.values_and_jacobian(&self.system, x, values, jacobian, size);
        match &self.kind {
            Kind::Parameters { .. } => rows.evaluator.rates(&self.system, &mut rows.rate[..n]),
            Kind::Start { start, gamma, scales, .. } => {
                for i in 0..n {
                    rows.rate[i] = -values[i].times(scales[i]);
                    let weight = rest.times(scales[i]);
                    values[i] = values[i] * weight;
                    for entry in &mut jacobian[i * size..(i + 1) * size] {
                        *entry = *entry * weight;
                    }
                }
                let gamma = S::from_c64(*gamma);
                start.add_to(gamma * s, x, &mut rows.g, values, jacobian, size, &mut rows.products);
                for i in 0..n {
                    rows.rate[i] = rows.rate[i] + gamma * rows.g[i];
                }
            }
        }
        for g in 0..self.groups {
            let row = n + g;
            let mut sum = -S::one();
            for v in 0..size {
                let a = if self.group_of[v] == g { S::from_c64(patch[v]) } else { S::zero() };
                jacobian[row * size + v] = a;
                if self.group_of[v] == g {
                    sum = sum + a * x[v];
                }
            }
            rows.h[row] = sum;
            rows.rate[row] = S::zero();
        }
    }
}

fn row_sizes(system: &PolynomialSystem, kind: &Kind, rows: usize) -> Vec<f64> {
    let mut sizes = match kind {
        // `scales` has made them so.
        Kind::Start { .. } => vec![],
        Kind::Parameters { to, .. } => {
            let mut evaluator = Evaluator::new(system);
            evaluator.set_parameters(system, to);
            evaluator.largest_coefficients(system)
        }
    };
    sizes.resize(rows, 1.0);
    sizes
}
