//! `extremes`: one axis after the other is followed until something fails.
//!
//! At each value the library must give the right answer, compared with something that does not share its code, or refuse with
//! a typed error. What is wrong in silence, panics or does not end is a failure of ours: the exit code says so.
//!
//! - `axis`: what is followed, and the values on it; `verdict`: what came of one, under guard;
//! - `page`: `docs/limits.md`;
//! - `chain`: a chain of masses, and `scheme`: the time stepping schemes, asked by several axes;
//! - one file per group of axes.

mod axis;
mod bases;
mod bifurcation;
mod chain;
mod jumps;
mod lengths;
mod long_runs;
mod many;
mod numbers;
mod page;
mod prestress;
mod ratios;
mod redundant;
mod scheme;
mod singular_poses;
mod spin;
mod step;
mod stiffness;
mod switching;
mod verdict;
mod zero_length;

use std::path::Path;

use clap::Args;

use crate::{TaskError, root};
use axis::{Axis, Found};

/// Arguments of `extremes`.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Only the axes whose title contains this.
    #[arg(long)]
    axis: Option<String>,
    /// Leave out what takes more than some seconds.
    #[arg(long)]
    quick: bool,
    /// Write docs/limits.md.
    #[arg(long, conflicts_with_all = ["axis", "quick"])]
    write: bool,
}

/// All axes in the order of the page.
fn axes() -> Vec<Axis> {
    let groups = [
        stiffness::axes(),
        ratios::stiffness(),
        ratios::masses(),
        lengths::axes(),
        step::axes(),
        long_runs::axes(),
        spin::axes(),
        bases::axes(),
        zero_length::axes(),
        singular_poses::axes(),
        redundant::axes(),
        switching::axes(),
        prestress::axes(),
        bifurcation::axes(),
        jumps::axes(),
        many::axes(),
        numbers::axes(),
    ];
    groups.into_iter().flatten().collect()
}

/// Follows the axes; true if every answer was right or refused.
pub(crate) fn follow(options: &Options) -> Result<bool, TaskError> {
    let wanted = |axis: &Axis| options.axis.as_ref().is_none_or(|part| axis.title.contains(part.as_str()));
    let mut found = Vec::<Found>::new();
    for axis in axes().into_iter().filter(wanted) {
        eprintln!("{}", axis.title);
        found.push(axis.follow(options.quick));
    }
    let text = page::page(&found);
    println!("{text}");
    if options.write {
        std::fs::write(root().join(Path::new("docs/limits.md")), text)?;
    }
    Ok(found.iter().all(Found::holds))
}
