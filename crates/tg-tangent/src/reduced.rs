//! The reduced matrices 𝓜, 𝓒, 𝓚 (43), dense.

use faer::Mat;

use crate::entries::Entries;
use crate::error::TangentError;
use crate::null_space::NullSpace;
use crate::tangent::Tangent;

/// A tangent reduced to independent variables ξ, δq = N ξ (42).
#[derive(Clone, Debug)]
pub struct Reduced {
    /// N, its rank and singular values.
    pub null_space: NullSpace,
    /// 𝓚 \[N/m\].
    pub stiffness: Mat<f64>,
    /// 𝓒 \[N s/m\].
    pub damping: Mat<f64>,
    /// 𝓜 \[kg\].
    pub mass: Mat<f64>,
}

impl Reduced {
    /// Reduces a tangent.
    ///
    /// # Errors
    /// The null space's decomposition does not converge.
    pub fn new(tangent: &Tangent<'_>) -> Result<Self, TangentError> {
        let null_space = NullSpace::new(tangent)?;
        let reduce = |x: &Entries| null_space.basis.transpose() * x.times(&null_space.basis);
        Ok(Self {
            stiffness: reduce(&tangent.stiffness),
            damping: reduce(&tangent.damping),
            mass: reduce(&tangent.mass),
            null_space,
        })
    }

    /// Number of degrees of freedom.
    pub fn degrees_of_freedom(&self) -> usize {
        self.null_space.basis.ncols()
    }
}
