//! The cases as tests: every verified number holds, and key numbers do not change unseen.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod antiprism;
mod mechanism;
mod outside;
mod rows;
mod scale;
mod scenes;
mod snapshots;
