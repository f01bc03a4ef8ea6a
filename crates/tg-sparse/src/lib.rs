//! Saddle-point systems of one fixed pattern, factored and solved again and again with new values, without allocation.
//!
//! ```text
//! [ H   −A₀ᵀ ] [x]   [f]     H: n × n, structurally symmetric, definite on null(A) in regular cases
//! [ A₁    0  ] [y] = [g]     A₀, A₁: m × n, one pattern, different values
//! ```
//!
//! Each Newton step of the time-stepping scheme of the unified framework solves such a system, eq. (55): `H` is the mass
//! matrix minus h²/2 times the tangent of the forces, `A₀ = A(q_k)`, `A₁ = A(q_{k+1})`; y scales the multipliers.
//!
//! The pattern is analysed once ([`SaddlePattern`]): a static elimination order in which every multiplier follows the
//! last unknown of its constraint, so that no pivoting is needed; dense fronts; the slot of every entry. A
//! [`SaddleSystem`] then only writes values, refactors and solves. Every pivot and every residual is checked. What the
//! static order cannot factor goes to faer's pivoting LU (feature `pivoting`), and the counts and reports say so; a
//! matrix that is singular is an error that names the constraint or the unknown.
//!
//! ```
//! use tg_sparse::{SaddlePattern, SaddleSystem};
//!
//! // A particle of 2 kg that slides along a line: 2 a − Aᵀ λ = f, A a = 0, A = (0.6, 0.8).
//! let mass = [Some((0, 0)), Some((1, 1))];
//! let jacobian = [Some((0, 0)), Some((0, 1))];
//! let mut system = SaddleSystem::new(SaddlePattern::new(2, 1, &[&mass], &jacobian)?);
//! system.add_leading(0, 1.0, &[2.0, 2.0]);
//! system.set_jacobian(&[0.6, 0.8], &[0.6, 0.8]);
//! system.factor()?;
//! let mut x = [0.0, -19.62, 0.0];
//! let report = system.solve(&mut x)?;
//! assert!((x[2] - 0.8 * 19.62).abs() < 1e-12 && (0.6 * x[0] + 0.8 * x[1]).abs() < 1e-12);
//! assert!(report.residual < 1e-13 && !report.fell_back);
//! # Ok::<(), tg_sparse::SparseError>(())
//! ```
//!
//! | what | item |
//! |---|---|
//! | eq. (55), pattern of `[M − h²/2 ∂F/∂q, −A(q_k)ᵀ; A(q_{k+1}), 0]` | [`SaddlePattern::new`] |
//! | its values | [`SaddleSystem::add_leading`], [`SaddleSystem::set_jacobian`] |
//! | Newton correction `−Jac⁻¹ Res`, Alg. 1 | [`SaddleSystem::factor`], [`SaddleSystem::solve`] |
//! | signs of the eigenvalues of the reduced Hessian | [`SaddleSystem::inertia`] |
//! | rank of A, redundant constraints | [`dependent_rows`] |
//!
//! # When something is wrong
//!
//! | sign | limit | consequence |
//! |---|---|---|
//! | a pivot is not finite, or below a share of the terms that it was summed from | 1e-13, all digits lost | fallback, or [`SparseError::Pivot`] |
//! | a pivot is below a larger share | 1e-8, half of the digits lost | it is probed by a solve and a correction: when that changes its component by more than a tenth, as above |
//! | the componentwise backward error | 1e-13 | iterative refinement |
//! | the same after refinement | 1e-10 | fallback, or [`SparseError::Residual`] |
//! | after the fallback: a probe that a correction changes by more than a tenth, or such a residual | | [`SparseError::Singular`] |
//!
//! A pivot that grows too large needs no limit of its own: it is harmless unless it destroys digits, and then the
//! residual shows it.

mod block_inverse;
mod elimination_tree;
mod error;
mod front;
mod inertia;
mod kernels;
mod ldlt;
mod order;
mod pattern;
mod pivot;
#[cfg(feature = "pivoting")]
mod pivoting;
mod rank;
mod refinement;
mod saddle;
mod slot_map;
mod span;
mod static_lu;
mod symbolic;
mod symmetric;

pub use error::{EntryList, Row, SparseError};
pub use inertia::Inertia;
pub use pattern::SaddlePattern;
pub use rank::{DependentRow, dependent_rows};
pub use saddle::{Counts, SaddleSystem, SolveReport};
pub use symmetric::SymmetricSystem;
