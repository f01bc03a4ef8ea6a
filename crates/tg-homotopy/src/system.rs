//! A square polynomial system F(x; p) = 0, compiled to flat lists.
//!
//! ```text
//! F_i(x; p) = Σ_s C_s(p) x^α_s,      C_s(p) = Σ_k c_k p^β_k
//! ```
//!
//! A *slot* s is one monomial in one equation. Monomials that several equations share are evaluated once, with their
//! gradients; a point then costs one pass over the slots. See [`crate::Evaluator`].

use std::collections::BTreeMap;

use num_complex::Complex64;

use crate::error::{HomotopyError, check_finite};
use crate::polynomial::{Exponents, Monomial, Polynomial};

/// Declares unknowns and parameters, collects equations.
#[derive(Clone, Debug, Default)]
pub struct SystemBuilder {
    unknowns: Vec<String>,
    parameters: Vec<String>,
    equations: Vec<Polynomial>,
}

/// One term c p^β of the coefficient of a slot; its factors are `factors[start..end]`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CoefficientTerm {
    pub(crate) slot: usize,
    pub(crate) value: Complex64,
    pub(crate) start: usize,
    pub(crate) end: usize,
}

/// n polynomials in n unknowns and k parameters; immutable, shared by threads.
#[derive(Clone, Debug)]
pub struct PolynomialSystem {
    unknowns: Vec<String>,
    parameters: Vec<String>,
    equations: Vec<Polynomial>,
    /// (equation, monomial) of each slot.
    pub(crate) slots: Vec<(usize, usize)>,
    pub(crate) coefficient_terms: Vec<CoefficientTerm>,
    pub(crate) coefficient_factors: Vec<(usize, u32)>,
    /// `monomial_factors[monomial_starts[m]..monomial_starts[m + 1]]` are the factors of monomial m.
    pub(crate) monomial_starts: Vec<usize>,
    pub(crate) monomial_factors: Vec<(usize, u32)>,
    /// The powers of unknown j stand at `power_starts[j]..power_starts[j + 1]`, from exponent 0.
    pub(crate) power_starts: Vec<usize>,
}

impl SystemBuilder {
    /// An empty system.
    pub fn new() -> Self {
        Self::default()
    }

    /// A new unknown.
    pub fn unknown(&mut self, name: impl Into<String>) -> Polynomial {
        self.unknowns.push(name.into());
        Polynomial::unknown(self.unknowns.len() - 1)
    }

    /// A new parameter.
    pub fn parameter(&mut self, name: impl Into<String>) -> Polynomial {
        self.parameters.push(name.into());
        Polynomial::parameter(self.parameters.len() - 1)
    }

    /// The equation `polynomial` = 0.
    pub fn equation(&mut self, polynomial: Polynomial) -> &mut Self {
        self.equations.push(polynomial);
        self
    }

    /// Checks and compiles the system.
    pub fn build(self) -> Result<PolynomialSystem, HomotopyError> {
        let (equations, unknowns) = (self.equations.len(), self.unknowns.len());
        if equations != unknowns || unknowns == 0 {
            return Err(HomotopyError::NotSquare { equations, unknowns });
        }
        PolynomialSystem::compile(self.unknowns, self.parameters, self.equations)
    }
}

fn check_equation(
    equation: usize,
    polynomial: &Polynomial,
    unknowns: usize,
    parameters: usize,
) -> Result<(), HomotopyError> {
    let beyond = |list: &Exponents, count: usize| list.iter().map(|f| f.0).find(|&v| v >= count);
    let mut constant = true;
    for (m, c) in polynomial.terms() {
        check_finite("a coefficient of equation", &[c])
            .map_err(|_| HomotopyError::NotFinite { what: "a coefficient of equation", index: equation })?;
        if let Some(index) = beyond(&m.unknowns, unknowns) {
            return Err(HomotopyError::Undeclared { equation, kind: "unknown", index });
        }
        if let Some(index) = beyond(&m.parameters, parameters) {
            return Err(HomotopyError::Undeclared { equation, kind: "parameter", index });
        }
        constant &= m.unknowns.is_empty();
    }
    if constant { Err(HomotopyError::ConstantEquation { equation }) } else { Ok(()) }
}

impl PolynomialSystem {
    /// Also for systems with fewer equations than unknowns: the homogenised ones, whose patches stand elsewhere.
    pub(crate) fn compile(
        unknowns: Vec<String>,
        parameters: Vec<String>,
        equations: Vec<Polynomial>,
    ) -> Result<Self, HomotopyError> {
        let mut monomials: BTreeMap<&Exponents, usize> = BTreeMap::new();
        let mut system = Self {
            slots: vec![],
            coefficient_terms: vec![],
            coefficient_factors: vec![],
            monomial_starts: vec![0],
            monomial_factors: vec![],
            power_starts: vec![0],
            unknowns,
            parameters,
            equations: vec![],
        };
        let mut largest = vec![1; system.unknowns.len()];
        for (i, polynomial) in equations.iter().enumerate() {
            check_equation(i, polynomial, system.unknowns.len(), system.parameters.len())?;
            // Terms are sorted by the exponents of the unknowns first, so equal monomials are neighbours.
            let mut last = None;
            for (m, value) in polynomial.terms() {
                let next = monomials.len();
                let monomial = *monomials.entry(&m.unknowns).or_insert(next);
                if monomial == next {
                    system.monomial_factors.extend_from_slice(&m.unknowns);
                    system.monomial_starts.push(system.monomial_factors.len());
                    for &(v, e) in &m.unknowns {
                        largest[v] = largest[v].max(e);
                    }
                }
                if last != Some(monomial) {
                    system.slots.push((i, monomial));
                    last = Some(monomial);
                }
                let start = system.coefficient_factors.len();
                system.coefficient_factors.extend_from_slice(&m.parameters);
                let end = system.coefficient_factors.len();
                let slot = system.slots.len() - 1;
                system.coefficient_terms.push(CoefficientTerm { slot, value, start, end });
            }
        }
        for e in largest {
            let start = system.power_starts[system.power_starts.len() - 1];
            system.power_starts.push(start + e as usize + 1);
        }
        drop(monomials);
        system.equations = equations;
        Ok(system)
    }

    /// Number of unknowns n.
    pub fn unknowns(&self) -> usize {
        self.unknowns.len()
    }

    /// Number of equations, equal to the number of unknowns.
    pub fn equations(&self) -> usize {
        self.equations.len()
    }

    /// Number of parameters k.
    pub fn parameters(&self) -> usize {
        self.parameters.len()
    }

    /// Names of the unknowns.
    pub fn unknown_names(&self) -> &[String] {
        &self.unknowns
    }

    /// Names of the parameters.
    pub fn parameter_names(&self) -> &[String] {
        &self.parameters
    }

    /// The equations.
    pub fn polynomials(&self) -> &[Polynomial] {
        &self.equations
    }

    /// Largest total degree of equation `i` in the unknowns that `member` selects.
    pub(crate) fn degree(&self, i: usize, member: impl Fn(usize) -> bool) -> u32 {
        self.equations[i].terms().map(|(m, _)| partial_degree(m, &member)).max().unwrap_or(0)
    }

    /// F_i(x) Π_g X_0g^(…): homogeneous of degree d_ig in each group, with the homogenising unknowns at the end.
    pub(crate) fn homogenized(&self, group_of: &[usize], groups: usize) -> Result<Self, HomotopyError> {
        let n = self.unknowns();
        let mut unknowns = self.unknowns.clone();
        unknowns.extend((0..groups).map(|g| format!("homogenising {g}")));
        let equations = (0..self.equations())
            .map(|i| {
                let mut homogeneous = Polynomial::default();
                for (m, c) in self.equations[i].terms() {
                    let mut lifted = m.clone();
                    for g in 0..groups {
                        let missing =
                            self.degree(i, |v| group_of[v] == g) - partial_degree(m, &|v| group_of[v] == g);
                        if missing > 0 {
                            lifted.unknowns.push((n + g, missing));
                        }
                    }
                    homogeneous.add_term(lifted, c);
                }
                homogeneous
            })
            .collect();
        Self::compile(unknowns, self.parameters.clone(), equations)
    }
}

fn partial_degree(m: &Monomial, member: &impl Fn(usize) -> bool) -> u32 {
    m.unknowns.iter().filter(|f| member(f.0)).map(|f| f.1).sum()
}
