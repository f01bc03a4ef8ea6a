//! How the time of a step grows with the size: N = 8 and a large mast over the same motion.
//!
//! A mast's first steps cost other than its later ones, and no one waits for the whole motion of a large one: both ends
//! run the same first part, in turn and many times, since a processor's clock changes within seconds, and the middle one of
//! the ratios counts.

use super::Options;
use super::clock::median;
use super::scene::Scene;
use super::scheme::SCHEMES;
use super::stepping::first;
use crate::TaskError;

/// Stages of the small end.
const SMALL: usize = 8;
/// Samples of 10 ms that both ends run.
const SAMPLES: usize = 5;
/// Ratios for each pass of the rest of the bench.
const PAIRS: usize = 5;

/// Exponent of the size from N = 8 to `largest`, for each scheme; none if there is nothing between.
pub(super) fn exponents(options: &Options, largest: usize) -> Result<Option<Vec<f64>>, TaskError> {
    if largest <= SMALL {
        return Ok(None);
    }
    let (small, large) = (Scene::mast(SMALL)?, Scene::mast(largest)?);
    let exponents = SCHEMES.iter().map(|scheme| {
        let ratio = |_| -> Result<f64, TaskError> {
            let [small, large] =
                [&small, &large].map(|scene| first(scene, scheme, SAMPLES, options.budget() / 2.0));
            Ok(large? / small?)
        };
        let ratios = (0..PAIRS * options.passes()).map(ratio).collect::<Result<_, _>>()?;
        Ok(median(ratios).ln() / (largest as f64 / SMALL as f64).ln())
    });
    exponents.collect::<Result<_, _>>().map(Some)
}
