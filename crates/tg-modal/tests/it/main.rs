//! Tests of linearised dynamics against closed forms, finite differences and simulations of the nonlinear structure.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod damped;
mod ground;
mod large;
mod modes;
mod refusals;
mod shapes;
mod simulated;
mod state_space;
mod support;
mod sweep;
