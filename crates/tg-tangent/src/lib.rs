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
//! ```
//! use tg_model::{CableLaw, ModelBuilder};
//! use tg_tangent::{Configuration, EigenOptions, Metric, lowest};
//!
//! // A bead of 2 kg between two cables of tension 10 N: 2 κ along them, 2 f/l across them.
//! let mut b = ModelBuilder::<2>::new();
//! let bead = b.particle("bead", 2.0, [0.0, 0.0])?;
//! for (name, x) in [("left", -1.0), ("right", 1.0)] {
//!     let peg = b.anchor(name, [x, 0.0])?;
//!     b.cable(name, peg, bead.node(0), CableLaw::slacking(100.0), 0.9)?;
//! }
//! let model = b.build()?;
//! let at = Configuration::at(&model, &model.initial_coordinates(), &model.inputs_at(0.0))?;
//! assert!(at.imbalance().0 < 1e-14);
//! let stiffness = lowest(&model, &at, &EigenOptions::new(2, Metric::Coordinates))?;
//! assert!((stiffness.pairs[0].value - 20.0).abs() < 1e-10 && (stiffness.pairs[1].value - 200.0).abs() < 1e-10);
//! let squares = lowest(&model, &at, &EigenOptions::new(2, Metric::Mass))?;
//! assert!((squares.pairs[0].value - 10.0).abs() < 1e-10, "ω² = 2 f / (l m)");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
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

mod all_motions;
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
mod shift;
mod shift_invert;
mod spectrum;
mod tangent;

pub use augmentation::Augmentation;
pub use configuration::{Configuration, balance};
pub use constrained::Constrained;
pub use eigen::lowest;
pub use entries::Entries;
pub use error::TangentError;
pub use faer;
pub use null_space::NullSpace;
pub use reduced::Reduced;
pub use spectrum::{Counts, EigenOptions, EigenPair, Method, Metric, Sign, Spectrum};
pub use tangent::Tangent;
