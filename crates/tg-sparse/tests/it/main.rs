//! Integration tests of tg-sparse, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod assembly;
mod dense;
mod inertia;
mod rank;
mod repeated;
mod singular;
mod support;
mod symmetric;
