//! Scene files as their authors see them: the scenes of this repository, mistakes with their messages, features, imports.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod features;
mod folder;
mod import;
mod limits;
mod malformed;
mod mutations;
mod schemes;
