//! Integration tests, one module per feature.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod arithmetic;
mod certificates;
mod classics;
mod evaluation;
mod groupings;
mod infinity;
mod mechanism_cases;
mod monodromy_loops;
mod parameters;
mod refusals;
mod singular;
mod support;
mod univariate;
