//! Tests of tg-equilibria.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod mechanism;
mod refusals;
mod space;
mod support;
mod sweep;
