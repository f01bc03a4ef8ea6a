//! Polynomials in unknowns and parameters as people write them: `&x * &x - 2.0 * &p`.

use std::collections::BTreeMap;
use std::ops::{Add, Mul, Neg, Sub};

use num_complex::Complex64;

/// Sparse exponents: (variable, exponent ≥ 1), by increasing variable.
pub(crate) type Exponents = Vec<(usize, u32)>;

/// x^α p^β.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Monomial {
    pub(crate) unknowns: Exponents,
    pub(crate) parameters: Exponents,
}

/// Σ c x^α p^β with complex c, terms merged by their exponents.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Polynomial {
    terms: BTreeMap<Monomial, Complex64>,
}

fn merge(a: &Exponents, b: &Exponents) -> Exponents {
    let mut all: BTreeMap<usize, u32> = a.iter().copied().collect();
    for &(v, e) in b {
        *all.entry(v).or_insert(0) += e;
    }
    all.into_iter().collect()
}

/// One factor less of the entry `at`.
fn lower(list: &mut Exponents, at: usize) {
    list[at].1 -= 1;
    if list[at].1 == 0 {
        list.remove(at);
    }
}

impl Polynomial {
    pub(crate) fn unknown(index: usize) -> Self {
        Self::monomial(Monomial { unknowns: vec![(index, 1)], parameters: vec![] })
    }

    pub(crate) fn parameter(index: usize) -> Self {
        Self::monomial(Monomial { unknowns: vec![], parameters: vec![(index, 1)] })
    }

    fn monomial(monomial: Monomial) -> Self {
        Self { terms: BTreeMap::from([(monomial, Complex64::new(1.0, 0.0))]) }
    }

    /// A constant.
    pub fn constant(value: impl Into<Complex64>) -> Self {
        let mut zero = Self::default();
        zero.add_term(Monomial::default(), value.into());
        zero
    }

    /// The polynomial to a power.
    pub fn pow(&self, exponent: u32) -> Self {
        (0..exponent).fold(Self::constant(1.0), |power, _| &power * self)
    }

    /// Σ of an iterator of polynomials.
    pub fn sum(terms: impl IntoIterator<Item = Self>) -> Self {
        terms.into_iter().fold(Self::default(), |a, b| a + b)
    }

    /// Number of terms.
    pub fn len(&self) -> usize {
        self.terms.len()
    }

    /// Whether this is the zero polynomial.
    pub fn is_empty(&self) -> bool {
        self.terms.is_empty()
    }

    pub(crate) fn add_term(&mut self, monomial: Monomial, coefficient: Complex64) {
        let sum = self.terms.entry(monomial).or_default();
        *sum += coefficient;
        if *sum == Complex64::default() {
            self.terms.retain(|_, c| *c != Complex64::default());
        }
    }

    pub(crate) fn terms(&self) -> impl Iterator<Item = (&Monomial, Complex64)> {
        self.terms.iter().map(|(m, c)| (m, *c))
    }

    /// Degree in the unknowns; of the zero polynomial 0.
    pub fn degree(&self) -> u32 {
        self.terms.keys().map(|m| m.unknowns.iter().map(|f| f.1).sum()).max().unwrap_or(0)
    }

    /// The partial derivative by the unknown with this number, in the order of their declaration.
    pub fn derivative(&self, unknown: usize) -> Self {
        let mut slope = Self::default();
        for (m, c) in self.terms() {
            if let Some(at) = m.unknowns.iter().position(|f| f.0 == unknown) {
                let mut rest = m.clone();
                let exponent = rest.unknowns[at].1;
                lower(&mut rest.unknowns, at);
                slope.add_term(rest, c * f64::from(exponent));
            }
        }
        slope
    }

    /// The polynomial modulo x_a x_b - `product`: the product of unknowns a and b (equal or not) is replaced until no term
    /// holds it.
    pub fn modulo(&self, (a, b): (usize, usize), product: &Self) -> Self {
        let mut done = Self::default();
        let mut rest = self.clone();
        while let Some((mut m, c)) = rest.terms.pop_first() {
            let holds = [a, b].iter().all(|&v| {
                let needed = if a == b { 2 } else { 1 };
                m.unknowns.iter().any(|&(u, e)| u == v && e >= needed)
            });
            if !holds {
                done.add_term(m, c);
                continue;
            }
            for v in [a, b] {
                if let Some(at) = m.unknowns.iter().position(|f| f.0 == v) {
                    lower(&mut m.unknowns, at);
                }
            }
            let term = Self { terms: BTreeMap::from([(m, c)]) };
            rest = rest + &term * product;
        }
        done
    }

    /// Without the terms smaller than this part of the largest: what cancellation leaves of sums that are zero.
    pub fn chopped(mut self, part: f64) -> Self {
        let largest = self.terms.values().map(|c| c.norm()).fold(0.0, f64::max);
        self.terms.retain(|_, c| c.norm() > part * largest);
        self
    }

    /// The value at unknowns x and parameters p.
    ///
    /// # Panics
    /// Numbers of unknowns or parameters beyond the lists.
    pub fn evaluate(&self, x: &[Complex64], p: &[Complex64]) -> Complex64 {
        let product = |list: &Exponents, values: &[Complex64]| {
            list.iter().map(|&(v, e)| values[v].powu(e)).product::<Complex64>()
        };
        self.terms().map(|(m, c)| c * product(&m.unknowns, x) * product(&m.parameters, p)).sum()
    }

    /// Every parameter p_j replaced by the j-th polynomial.
    pub(crate) fn with_parameters(&self, substitutes: &[Self]) -> Self {
        Self::sum(self.terms().map(|(m, c)| {
            let mut term = Self::default();
            term.add_term(Monomial { unknowns: m.unknowns.clone(), parameters: vec![] }, c);
            m.parameters.iter().fold(term, |t, &(p, e)| &t * &substitutes[p].pow(e))
        }))
    }
}

impl Add<&Polynomial> for &Polynomial {
    type Output = Polynomial;
    fn add(self, other: &Polynomial) -> Polynomial {
        let mut sum = self.clone();
        for (m, c) in other.terms() {
            sum.add_term(m.clone(), c);
        }
        sum
    }
}

impl Mul<&Polynomial> for &Polynomial {
    type Output = Polynomial;
    fn mul(self, other: &Polynomial) -> Polynomial {
        let mut product = Polynomial::default();
        for (a, ca) in self.terms() {
            for (b, cb) in other.terms() {
                let monomial = Monomial {
                    unknowns: merge(&a.unknowns, &b.unknowns),
                    parameters: merge(&a.parameters, &b.parameters),
                };
                product.add_term(monomial, ca * cb);
            }
        }
        product
    }
}

impl Neg for &Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        Polynomial { terms: self.terms.iter().map(|(m, c)| (m.clone(), -c)).collect() }
    }
}

impl Neg for Polynomial {
    type Output = Polynomial;
    fn neg(self) -> Polynomial {
        -&self
    }
}

impl Sub<&Polynomial> for &Polynomial {
    type Output = Polynomial;
    fn sub(self, other: &Polynomial) -> Polynomial {
        self + &-other
    }
}

/// The operator for owned operands, mixed ones and constants, all by way of references.
macro_rules! forward {
    ($trait:ident, $method:ident) => {
        impl $trait<Polynomial> for Polynomial {
            type Output = Polynomial;
            fn $method(self, other: Polynomial) -> Polynomial {
                (&self).$method(&other)
            }
        }
        impl $trait<&Polynomial> for Polynomial {
            type Output = Polynomial;
            fn $method(self, other: &Polynomial) -> Polynomial {
                (&self).$method(other)
            }
        }
        impl $trait<Polynomial> for &Polynomial {
            type Output = Polynomial;
            fn $method(self, other: Polynomial) -> Polynomial {
                self.$method(&other)
            }
        }
        forward!($trait, $method, f64);
        forward!($trait, $method, Complex64);
    };
    ($trait:ident, $method:ident, $number:ty) => {
        impl $trait<$number> for Polynomial {
            type Output = Polynomial;
            fn $method(self, other: $number) -> Polynomial {
                (&self).$method(&Polynomial::constant(other))
            }
        }
        impl $trait<$number> for &Polynomial {
            type Output = Polynomial;
            fn $method(self, other: $number) -> Polynomial {
                self.$method(&Polynomial::constant(other))
            }
        }
        impl $trait<Polynomial> for $number {
            type Output = Polynomial;
            fn $method(self, other: Polynomial) -> Polynomial {
                (&Polynomial::constant(self)).$method(&other)
            }
        }
        impl $trait<&Polynomial> for $number {
            type Output = Polynomial;
            fn $method(self, other: &Polynomial) -> Polynomial {
                (&Polynomial::constant(self)).$method(other)
            }
        }
    };
}

forward!(Add, add);
forward!(Sub, sub);
forward!(Mul, mul);
