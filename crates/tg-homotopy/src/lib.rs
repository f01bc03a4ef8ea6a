//! All isolated solutions of a square polynomial system over the complex numbers, each certified.
//!
//! ```text
//! F(x; p) = 0,   n equations, n unknowns x, parameters p
//! H(X, t) = γ t G(X) + (1 - t) F(X; p)        from a start system G whose solutions are known, t: 1 → 0
//! H(X, t) = F(X; t p₁ + (1 - t) p₀)           from a generic instance p₁
//! ```
//!
//! A. J. Sommese, C. W. Wampler, *The Numerical Solution of Systems of Polynomials Arising in Engineering and Science*
//! (World Scientific, 2005).
//!
//! | step | item |
//! |---|---|
//! | write a system | [`SystemBuilder`], [`Polynomial`], [`PolynomialSystem`] |
//! | count paths, choose a start system | [`Grouping`], [`Start`] |
//! | solve from scratch | [`solve`], [`SolveReport`], [`PathResult`] |
//! | solve again for other parameters | [`GenericInstance`], [`ParameterSolver`] |
//! | fill an instance from seeds | [`monodromy`], [`find_seed`] |
//! | evidence that it is complete | [`trace_test`] |
//! | prove solutions, tell real from complex | [`certify`], [`Conjugation`] |

// `!(a <= b)` is meant: a NaN must count as a failed test.
#![allow(clippy::neg_cmp_op_on_partial_ord)]

mod batch;
mod certify;
mod complex_dd;
mod conjugation;
mod dd;
mod disc;
mod endgame;
mod error;
mod evaluate;
mod grouping;
mod homotopy;
mod krawczyk;
mod lane;
mod lu;
mod monodromy;
mod options;
mod parameter;
mod path;
mod polynomial;
mod random;
mod scalar;
mod solve;
mod start;
mod system;
mod trace;
mod tracker;

pub use batch::PathOptions;
pub use certify::{Certificate, CertificationReport, CertifyOptions, Realness, Rejection, certify};
pub use complex_dd::ComplexDd;
pub use conjugation::Conjugation;
pub use dd::Dd;
pub use disc::Disc;
pub use error::HomotopyError;
pub use evaluate::Evaluator;
pub use grouping::Grouping;
pub use monodromy::{MonodromyOptions, MonodromyReport, find_seed, monodromy};
pub use num_complex::Complex64;
pub use options::{EndgameOptions, TrackerOptions};
pub use parameter::{GenericInstance, ParameterSolver};
pub use path::{FailureReason, PathCounts, PathResult, ReturnCode};
pub use polynomial::Polynomial;
pub use random::Random;
pub use scalar::{Field, Scalar};
pub use solve::{SingularSolution, SolveOptions, SolveReport, Start, solve};
pub use system::{PolynomialSystem, SystemBuilder};
pub use trace::{TraceReport, trace_test};
