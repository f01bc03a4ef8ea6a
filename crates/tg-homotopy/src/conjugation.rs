//! Antiholomorphic symmetries of a system: what "real" means.
//!
//! ```text
//! σ(x)_i = conj(x_π(i))
//! ```
//!
//! with an involution π. Plain conjugation has π = identity; in isotropic coordinates (z, z̄) π exchanges z and z̄. A
//! system whose equations σ maps to ± each other has σ(x) among its solutions with x, and the fixed points are the real
//! solutions.

use num_complex::Complex64;

use crate::error::{HomotopyError, check_length};
use crate::polynomial::{Exponents, Monomial, Polynomial};
use crate::system::PolynomialSystem;

/// Rounding allowed by [`PolynomialSystem::symmetrized`], relative to the largest coefficient of an equation.
const ROUNDING: f64 = 1e-12;

/// Conjugation together with permutations of unknowns and parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conjugation {
    unknowns: Vec<usize>,
    parameters: Vec<usize>,
}

fn involution(
    what: &'static str,
    count: usize,
    pairs: &[(usize, usize)],
) -> Result<Vec<usize>, HomotopyError> {
    let mut map: Vec<usize> = (0..count).collect();
    for &(a, b) in pairs {
        for (from, to) in [(a, b), (b, a)] {
            if from >= count || to >= count || (map[from] != from && map[from] != to) {
                return Err(HomotopyError::NotInvolution { what, index: from });
            }
            map[from] = to;
        }
    }
    Ok(map)
}

impl Conjugation {
    /// Plain conjugation of all unknowns and parameters.
    pub fn plain(system: &PolynomialSystem) -> Self {
        Self { unknowns: (0..system.unknowns()).collect(), parameters: (0..system.parameters()).collect() }
    }

    /// Conjugation that exchanges these pairs of unknowns and of parameters.
    pub fn exchanging(
        system: &PolynomialSystem,
        unknowns: &[(usize, usize)],
        parameters: &[(usize, usize)],
    ) -> Result<Self, HomotopyError> {
        Ok(Self {
            unknowns: involution("unknowns", system.unknowns(), unknowns)?,
            parameters: involution("parameters", system.parameters(), parameters)?,
        })
    }

    /// π of the unknowns.
    pub fn unknowns(&self) -> &[usize] {
        &self.unknowns
    }

    /// σ(F): conjugate coefficients, exchanged variables.
    fn image(&self, polynomial: &Polynomial) -> Polynomial {
        let exchanged = |list: &Exponents, map: &[usize]| -> Exponents {
            let mut image: Exponents = list.iter().map(|&(v, e)| (map[v], e)).collect();
            image.sort_unstable();
            image
        };
        let mut image = Polynomial::default();
        for (m, c) in polynomial.terms() {
            let monomial = Monomial {
                unknowns: exchanged(&m.unknowns, &self.unknowns),
                parameters: exchanged(&m.parameters, &self.parameters),
            };
            image.add_term(monomial, c.conj());
        }
        image
    }

    /// Whether σ maps the system to itself exactly, and the parameters too.
    pub(crate) fn check(
        &self,
        system: &PolynomialSystem,
        parameters: &[Complex64],
    ) -> Result<(), HomotopyError> {
        check_length("conjugation of the unknowns", system.unknowns(), self.unknowns.len())?;
        check_length("conjugation of the parameters", system.parameters(), self.parameters.len())?;
        for (j, &k) in self.parameters.iter().enumerate() {
            if parameters[j] != parameters[k].conj() {
                return Err(HomotopyError::ParameterNotInvariant { parameter: j });
            }
        }
        for (i, equation) in system.polynomials().iter().enumerate() {
            let image = self.image(equation);
            if !system.polynomials().iter().any(|f| *f == image || *f == -&image) {
                return Err(HomotopyError::NotInvariant { equation: i });
            }
        }
        Ok(())
    }
}

/// Whether a = b up to rounding.
fn nearly_equal(a: &Polynomial, b: &Polynomial) -> bool {
    let scale = a.terms().map(|(_, c)| c.norm()).fold(0.0, f64::max);
    (a - b).terms().all(|(_, c)| c.norm() <= ROUNDING * scale)
}

impl PolynomialSystem {
    /// The system with rounding errors of its coefficients removed such that the conjugation maps it to itself exactly:
    /// each equation becomes the mean of itself and its image.
    pub fn symmetrized(&self, conjugation: &Conjugation) -> Result<Self, HomotopyError> {
        check_length("conjugation of the unknowns", self.unknowns(), conjugation.unknowns.len())?;
        check_length("conjugation of the parameters", self.parameters(), conjugation.parameters.len())?;
        let old = self.polynomials();
        let mut new = old.to_vec();
        for (i, equation) in old.iter().enumerate() {
            let image = conjugation.image(equation);
            let partner = (0..old.len()).find_map(|j| {
                let sign = if nearly_equal(&old[j], &image) { 1.0 } else { -1.0 };
                nearly_equal(&old[j], &(sign * &image)).then_some((j, sign))
            });
            match partner {
                Some((j, sign)) if j == i => new[i] = 0.5 * (equation + &(sign * image)),
                Some((j, sign)) if j > i => new[j] = sign * image,
                Some(_) => {}
                None => return Err(HomotopyError::NotInvariant { equation: i }),
            }
        }
        Self::compile(self.unknown_names().to_vec(), self.parameter_names().to_vec(), new)
    }
}
