//! Tests of scene files and of imports.

mod import;
