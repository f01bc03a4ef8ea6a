//! Tests of the tangent against closed forms, finite differences, and of each method against the other.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod eigen;
