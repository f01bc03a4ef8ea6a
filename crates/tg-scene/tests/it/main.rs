//! Tests of scene files and of imports.
#![allow(clippy::unwrap_used, clippy::expect_used)]

mod import;
