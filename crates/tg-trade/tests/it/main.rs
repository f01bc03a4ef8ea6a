//! Errors and choices against a pendulum in one angle, which shares no code with the steppers.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod choices;
mod curves;
mod pendulum;
mod references;
