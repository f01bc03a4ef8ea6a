//! Integration tests of tg-integrate, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod allocation;
mod bad_input;
mod checkpoint;
mod closed_forms;
mod composition;
mod conservation;
mod driver;
mod failure;
mod fallback;
mod generalized_alpha;
mod invariance;
mod leapfrog;
mod mast;
mod order;
mod projection;
mod reversal;
mod runge_kutta;
mod singular_poses;
mod slacking;
mod support;
mod supports;
mod switches;
mod unbounded;
