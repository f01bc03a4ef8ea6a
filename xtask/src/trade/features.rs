//! Instructions of a step with and without each feature, as the gate counts and guards them.

use crate::TaskError;
use crate::bench::page::{digits, table};
use crate::instructions::{features, iterations, stored};

pub(super) fn section() -> Result<String, TaskError> {
    let counts = stored(features::GROUP)?;
    let count = |name: &str| counts.get(name).map_or(f64::NAN, |&count| count as f64);
    let mut rows = Vec::new();
    for variant in features::variants()? {
        let (own, without) = (count(variant.name), count(variant.without));
        let share = if variant.name == variant.without { "–".into() } else { digits(own / without) };
        rows.push(vec![variant.name.to_string(), digits(iterations(&variant)?), digits(1e-3 * own), share]);
    }
    let header =
        ["symplectic, steps of 1 ms", "iterations", "thousand instructions per step", "times those without"];
    Ok(format!(
        "Counted by valgrind (`xtask instructions`, profile `quick`) and stored in `xtask/instructions.json`; the gate fails if \
         one of them grows by 2 %, so that a feature which is added cannot cost those that have no use for it. All are in motion from the start.\n\n{}",
        table(&header.map(String::from), &rows)
    ))
}
