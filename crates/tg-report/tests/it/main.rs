//! Reports are read back by other means than they were written.

#![allow(clippy::unwrap_used, clippy::expect_used)]

mod damage;
mod folder;
mod gltf;
mod pictures;
mod sample;
mod tables;
mod view;
mod vtk;
