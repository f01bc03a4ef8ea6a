//! Integration tests of tg-equilibria, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod mechanism;
