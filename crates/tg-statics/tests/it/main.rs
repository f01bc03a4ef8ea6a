//! Integration tests of tg-statics, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod continuation;
mod equilibrium;
mod forward;
mod free_body;
mod inverse;
mod large;
mod prism;
mod structures;
