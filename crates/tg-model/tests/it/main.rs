//! Integration tests of tg-model, one module per subject in one program.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod assemble;
mod build_errors;
mod build_errors_joints;
mod cables;
mod drive;
mod messages;
mod model;
mod moments;
mod operators;
mod parts;
mod projector;
mod projector_position;
mod reactions;
mod redundancy;
mod resultant;
mod signal;
mod singular_poses;
mod sizes;
mod support;
mod tangents;
mod tensioned;
mod zero_length;
