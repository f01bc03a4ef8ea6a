//! `bench`: what a step and the analyses cost, and how exact they are for it.
//!
//! Everything is processor time of one thread; a run is measured in pieces of 10 ms of motion, of which the median counts,
//! and passes of all tools alternate, of which the fastest counts.
//!
//! - `clock`: processor time; `scene`, `scheme`: what is measured; `machine`: on what; `page`: where it is written;
//! - `stepping`, `growth`, `parts`, `memory`: cost of steps, also by size, of their parts and of analyses, peak memory;
//! - `converged`, `curve`: error against time; `floor`: the program written for the mast alone;
//! - `sizes`, `papers`, `accuracy`: the tables; `export`: the mast for other tools.

mod accuracy;
pub(crate) mod clock;
mod converged;
mod curve;
mod export;
mod floor;
mod growth;
pub(crate) mod machine;
mod memory;
pub(crate) mod page;
mod papers;
mod parts;
pub(crate) mod scene;
pub(crate) mod scheme;
mod sizes;
mod stepping;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::{TaskError, root};
use floor::Floor;
use scene::MastRun;

pub(crate) use machine::rustc;
pub(crate) use memory::in_child as peak_memory;

/// The page that is written.
const PAGE: &str = "docs/performance.md";

/// Arguments of `bench`.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// A short check: small masts, one pass.
    #[arg(long)]
    quick: bool,
    /// Write the tables into docs/performance.md.
    #[arg(long)]
    write: bool,
    /// Source of the floor program.
    #[arg(long)]
    floor: Option<PathBuf>,
}

impl Options {
    /// Seconds for one measurement.
    const BUDGET: f64 = 0.5;

    /// Times that everything is measured.
    fn passes(&self) -> usize {
        if self.quick { 1 } else { 3 }
    }

    /// Seconds for one measurement, a tenth for a short check.
    fn budget(&self) -> f64 {
        if self.quick { Self::BUDGET / 10.0 } else { Self::BUDGET }
    }
}

/// Arguments of `curves`.
#[derive(Debug, Args)]
pub(crate) struct CurveOptions {
    /// Stages of the mast.
    stages: usize,
    /// Seconds after which a curve ends.
    #[arg(long, default_value_t = 4.0)]
    limit: f64,
    /// Source of the floor program.
    #[arg(long)]
    floor: Option<PathBuf>,
}

/// Prints all tables; always true.
pub(crate) fn bench(options: &Options) -> Result<bool, TaskError> {
    let floor = compile(options.floor.as_deref());
    let mut text = format!("Measured on: {}.\n\n", machine::machine()?);
    if options.quick {
        text += "A short check: one pass of short runs.\n\n";
    }
    if let Err(reason) = &floor {
        text += &format!("The floor program is left out: {reason}.\n\n");
    }
    let floor = floor.ok();
    for section in [
        sizes::section(options, floor.as_ref())?,
        papers::section(options)?,
        accuracy::section(options, floor.as_ref())?,
    ] {
        text += &section;
    }
    println!("{text}");
    if options.write {
        page::insert(PAGE, "bench", &text)?;
    }
    Ok(true)
}

/// Prints the points of all curves of one mast as JSON, for the peers' scripts.
pub(crate) fn curves(options: &CurveOptions) -> Result<bool, TaskError> {
    let run = MastRun::new(options.stages)?;
    let converged = converged::converged(&run, &folder()?)?;
    let mut points = curve::curves(&run, &converged, options.limit)?;
    if let Ok(floor) = compile(options.floor.as_deref()) {
        points.extend(floor.curves(&run, &converged, options.limit)?);
    }
    println!("{}", serde_json::to_string(&points)?);
    Ok(true)
}

/// Prints ten lowest modes of one mast and what they cost as JSON, for the peers' scripts.
pub(crate) fn modes(stages: usize) -> Result<bool, TaskError> {
    println!("{}", serde_json::to_string(&parts::modal(stages, Options::BUDGET)?)?);
    Ok(true)
}

/// Writes the mast and its converged trajectory where the peers' scripts look.
pub(crate) fn mast(stages: usize) -> Result<bool, TaskError> {
    export::export(stages, &folder()?)
}

/// Where things are kept from run to run: `bench` in the target folder.
fn folder() -> Result<PathBuf, TaskError> {
    let program = std::env::current_exe()?;
    let target = program.parent().and_then(Path::parent).ok_or("the program is not in a target folder")?;
    Ok(target.join("bench"))
}

/// The floor program from where it is said to be, or from `shared` beside the repository.
fn compile(source: Option<&Path>) -> Result<Floor, String> {
    let beside = root().join("../shared/benchmarks/floor.cpp");
    let folder = folder().map_err(|error| error.to_string())?;
    Floor::compile(source.unwrap_or(&beside), &folder)
}
