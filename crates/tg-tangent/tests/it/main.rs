//! Integration tests of tg-tangent, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod eigen;
mod tangent;
