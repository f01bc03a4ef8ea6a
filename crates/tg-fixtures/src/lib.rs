//! Structures with known properties that the tests and benchmarks of several crates share.

mod mast;
mod prism;
mod spine;

pub use mast::{Mast, MastCable, MastScene, mast};
pub use prism::{Prism, prism};
pub use spine::{Spine, spine};
