//! Values, Jacobian by unknowns and derivative by parameters of a [`PolynomialSystem`], without allocation.
//!
//! ```text
//! ∂(Π_k x_k^e_k)/∂x_j = e_j x_j^(e_j - 1) Π_{k≠j} x_k^e_k       products from both sides, no division
//! ```

use crate::scalar::{Field, Scalar};
use crate::system::PolynomialSystem;

/// Buffers for evaluating one system with one kind of number.
#[derive(Clone, Debug)]
pub struct Evaluator<S> {
    powers: Vec<S>,
    monomials: Vec<S>,
    /// ∂monomial/∂x of each factor, as `monomial_factors`.
    gradients: Vec<S>,
    coefficients: Vec<S>,
    rates: Vec<S>,
}

impl<S: Scalar> Evaluator<S> {
    /// Buffers for `system`.
    pub fn new(system: &PolynomialSystem) -> Self {
        Self {
            powers: vec![S::one(); system.power_starts[system.unknowns()]],
            monomials: vec![S::zero(); system.monomial_starts.len() - 1],
            gradients: vec![S::zero(); system.monomial_factors.len()],
            coefficients: vec![S::zero(); system.slots.len()],
            rates: vec![S::zero(); system.slots.len()],
        }
    }

    /// Sets the parameters: C_s(p).
    pub fn set_parameters(&mut self, system: &PolynomialSystem, parameters: &[S]) {
        self.coefficients.fill(S::zero());
        for term in &system.coefficient_terms {
            let factors = &system.coefficient_factors[term.start..term.end];
            let value = factors.iter().fold(S::from_c64(term.value), |value, &(p, e)| {
                (0..e).fold(value, |value, _| value * parameters[p])
            });
            self.coefficients[term.slot] = self.coefficients[term.slot] + value;
        }
    }

    /// Sets the parameters and their rates: C_s(p) and Σ_j ∂C_s/∂p_j ṗ_j.
    pub fn set_parameters_and_rates(&mut self, system: &PolynomialSystem, parameters: &[S], rates: &[S]) {
        self.set_parameters(system, parameters);
        self.rates.fill(S::zero());
        for term in &system.coefficient_terms {
            let factors = &system.coefficient_factors[term.start..term.end];
            for (k, &(p, e)) in factors.iter().enumerate() {
                let mut value = S::from_c64(term.value).times(f64::from(e)) * rates[p];
                for _ in 1..e {
                    value = value * parameters[p];
                }
                for (l, &(q, f)) in factors.iter().enumerate() {
                    if l != k {
                        value = (0..f).fold(value, |value, _| value * parameters[q]);
                    }
                }
                self.rates[term.slot] = self.rates[term.slot] + value;
            }
        }
    }

    fn set_powers(&mut self, system: &PolynomialSystem, x: &[S]) {
        for (j, &xj) in x.iter().enumerate() {
            let powers = &mut self.powers[system.power_starts[j]..system.power_starts[j + 1]];
            powers[1] = xj;
            for e in 2..powers.len() {
                powers[e] = powers[e - 1] * xj;
            }
        }
    }

    /// F(x; p) into `values`.
    pub fn values(&mut self, system: &PolynomialSystem, x: &[S], values: &mut [S]) {
        self.set_powers(system, x);
        for m in 0..self.monomials.len() {
            let mut product = S::one();
            for &(v, e) in &system.monomial_factors[system.monomial_starts[m]..system.monomial_starts[m + 1]]
            {
                product = product * self.powers[system.power_starts[v] + e as usize];
            }
            self.monomials[m] = product;
        }
        values.fill(S::zero());
        for (&(i, m), &c) in system.slots.iter().zip(&self.coefficients) {
            values[i] = values[i] + c * self.monomials[m];
        }
    }

    /// F(x; p) into `values` and ∂F/∂x into the first n columns of `jacobian`, whose rows are `stride` long.
    pub fn values_and_jacobian(
        &mut self,
        system: &PolynomialSystem,
        x: &[S],
        values: &mut [S],
        jacobian: &mut [S],
        stride: usize,
    ) {
        self.set_powers(system, x);
        for m in 0..self.monomials.len() {
            let (start, end) = (system.monomial_starts[m], system.monomial_starts[m + 1]);
            let factors = &system.monomial_factors[start..end];
            let gradients = &mut self.gradients[start..end];
            let power = |v: usize, e: u32| self.powers[system.power_starts[v] + e as usize];
            match *factors {
                [] => self.monomials[m] = S::one(),
                [(v, 1)] => {
                    self.monomials[m] = power(v, 1);
                    gradients[0] = S::one();
                }
                _ => {
                    // gradients[k] = Π of the factors before k, then times those after k.
                    gradients[0] = S::one();
                    for k in 1..factors.len() {
                        let (v, e) = factors[k - 1];
                        gradients[k] = if k == 1 { power(v, e) } else { gradients[k - 1] * power(v, e) };
                    }
                    let mut after = S::one();
                    for k in (0..factors.len()).rev() {
                        let (v, e) = factors[k];
                        let last = k + 1 == factors.len();
                        let others = if last { gradients[k] } else { gradients[k] * after };
                        gradients[k] =
                            if e == 1 { others } else { others * power(v, e - 1).times(f64::from(e)) };
                        after = if last { power(v, e) } else { after * power(v, e) };
                    }
                    self.monomials[m] = after;
                }
            }
        }
        values.fill(S::zero());
        for i in 0..system.equations() {
            jacobian[i * stride..i * stride + system.unknowns()].fill(S::zero());
        }
        for (&(i, m), &c) in system.slots.iter().zip(&self.coefficients) {
            values[i] = values[i] + c * self.monomials[m];
            for f in system.monomial_starts[m]..system.monomial_starts[m + 1] {
                let entry = &mut jacobian[i * stride + system.monomial_factors[f].0];
                *entry = *entry + c * self.gradients[f];
            }
        }
    }

    /// Σ_j ∂F/∂p_j ṗ_j at the x evaluated last, for the rates set last.
    pub fn rates(&self, system: &PolynomialSystem, rates: &mut [S]) {
        rates.fill(S::zero());
        for (&(i, m), &c) in system.slots.iter().zip(&self.rates) {
            rates[i] = rates[i] + c * self.monomials[m];
        }
    }
}

impl<S: Field> Evaluator<S> {
    /// Size of the largest coefficient of each equation at the parameters set last; 1 where all vanish.
    pub(crate) fn largest_coefficients(&self, system: &PolynomialSystem) -> Vec<f64> {
        let mut largest = vec![0.0_f64; system.equations()];
        for (&(i, _), c) in system.slots.iter().zip(&self.coefficients) {
            largest[i] = largest[i].max(c.size());
        }
        largest.into_iter().map(|c| if c > 0.0 { c } else { 1.0 }).collect()
    }
}

impl PolynomialSystem {
    /// F(x; p), allocating.
    pub fn values<S: Scalar>(&self, x: &[S], parameters: &[S]) -> Vec<S> {
        let mut evaluator = Evaluator::new(self);
        evaluator.set_parameters(self, parameters);
        let mut values = vec![S::zero(); self.equations()];
        evaluator.values(self, x, &mut values);
        values
    }

    /// ∂F/∂x row by row, allocating.
    pub fn jacobian<S: Scalar>(&self, x: &[S], parameters: &[S]) -> Vec<S> {
        let mut evaluator = Evaluator::new(self);
        evaluator.set_parameters(self, parameters);
        let mut values = vec![S::zero(); self.equations()];
        let mut jacobian = vec![S::zero(); self.equations() * self.unknowns()];
        evaluator.values_and_jacobian(self, x, &mut values, &mut jacobian, self.unknowns());
        jacobian
    }

    /// ∂F/∂p column by column (one column of n entries a parameter), allocating.
    pub fn parameter_jacobian<S: Scalar>(&self, x: &[S], parameters: &[S]) -> Vec<S> {
        let mut evaluator = Evaluator::new(self);
        let mut values = vec![S::zero(); self.equations()];
        let mut columns = vec![S::zero(); self.equations() * self.parameters()];
        let mut direction = vec![S::zero(); self.parameters()];
        for j in 0..self.parameters() {
            direction.fill(S::zero());
            direction[j] = S::one();
            evaluator.set_parameters_and_rates(self, parameters, &direction);
            evaluator.values(self, x, &mut values);
            evaluator.rates(self, &mut columns[j * self.equations()..(j + 1) * self.equations()]);
        }
        columns
    }
}
