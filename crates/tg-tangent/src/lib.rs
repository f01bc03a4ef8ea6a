//! The tangent of a structure at a configuration: what stability, natural frequencies and linear control share.
//!
//! ```text
//! K = -∂F/∂q - ∂(Aᵀλ)/∂q,   C = -∂F/∂q̇,   A = ∂Φ/∂q,   A N = 0                 free coordinates
//! 𝓜 = Nᵀ M N,   𝓒 = Nᵀ C N,   𝓚 = Nᵀ K N                                        (43)
//! K x - Aᵀ y = ν W x,   A x = 0                                                   (44) with W = M
//! ```
//!
//! Small structures are reduced to a dense basis N of the null space ([`Reduced`]). Large ones keep the saddle-point
//! matrix `[K - σW, -Aᵀ; A, 0]`: its factors give the lowest eigenpairs (shift-invert block Lanczos) and, by the signs of
//! its pivots, how many eigenvalues lie below σ. [`lowest`] chooses, and certifies the sparse answer by that count.
//!
//! | equation | meaning | item |
//! |---|---|---|
//! | (31), λ of a configuration | multipliers and forces out of balance | [`Configuration::at`] |
//! | (41) | tangent with the multiplier term | [`Tangent`] |
//! | N, (32), (41b) | null space of A and its rank | [`NullSpace`] |
//! | `Aᵀ P A` | regular leading block without pivoting | [`Augmentation`] |
//! | (42), (43) | reduced matrices | [`Reduced`] |
//! | `[K, -Aᵀ; A, 0]`, `[M, -Aᵀ; A, 0]` | linear response under the constraints | [`Constrained`] |
//! | (44) | lowest eigenpairs, inertia | [`lowest`], [`Spectrum`] |

mod augmentation;
mod certified;
mod configuration;
mod constrained;
pub mod dense;
mod eigen;
mod entries;
mod error;
mod lanczos;
mod null_space;
mod reduced;
mod shift_invert;
mod tangent;

pub use augmentation::Augmentation;
pub use configuration::{Configuration, balance};
pub use constrained::Constrained;
pub use eigen::{Counts, EigenOptions, EigenPair, Method, Metric, Sign, Spectrum, lowest};
pub use entries::Entries;
pub use error::TangentError;
pub use faer;
pub use null_space::NullSpace;
pub use reduced::Reduced;
pub use tangent::Tangent;
