//! Integration tests of tg-statics, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod continuation;
mod prism;
mod structures;
