//! Structures with known properties that the tests and benchmarks of several crates share.

mod prism;
mod spine;

pub use prism::{Prism, prism};
pub use spine::{Spine, spine};
