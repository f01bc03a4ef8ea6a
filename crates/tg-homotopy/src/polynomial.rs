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
