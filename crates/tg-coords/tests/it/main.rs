//! Integration tests of tg-coords, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod bad_members;
mod common;
mod constraint;
mod coord_type;
mod fit;
mod mass_matrix;
mod mass_properties;
mod pose;
mod properties;
mod scales;
mod weights;
