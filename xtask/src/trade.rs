//! `trade`: what accuracy costs, and what the choices of modelling and of settings cost and give; written into
//! `docs/accuracy-and-speed.md`.
//!
//! - `scenes`: what is measured; `schemes`: error against processor time by scheme; `estimate`: how honest the estimated errors
//!   are;
//! - `choices`: one choice against the other on one structure, by topic in files beneath; `features`: instructions of a step with
//!   and without each feature.

mod choices;
mod estimate;
mod features;
mod scenes;
mod schemes;

use clap::Args;

use crate::bench::{machine, page};
use crate::{TaskError, defaults};

/// The page that is written.
pub(crate) const PAGE: &str = "docs/accuracy-and-speed.md";

/// Arguments of `trade`.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Only this part: schemes, estimate, choices, features or defaults.
    #[arg(long)]
    part: Option<String>,
    /// Only scenes whose name contains this.
    #[arg(long)]
    scene: Option<String>,
    /// Processor time of one run \[s\].
    #[arg(long, default_value_t = 1.0)]
    budget: f64,
    /// Write what was measured into docs/accuracy-and-speed.md.
    #[arg(long, conflicts_with = "scene")]
    write: bool,
}

/// Measures and prints the parts; true if the estimates are as honest as they must be.
pub(crate) fn trade(options: &Options) -> Result<bool, TaskError> {
    let mut honest = true;
    let machine = machine::machine()?;
    let wanted = |part: &str| options.part.as_ref().is_none_or(|wanted| wanted == part);
    let scenes = if wanted("schemes") || wanted("estimate") {
        scenes::scenes(options.scene.as_deref(), options.budget)?
    } else {
        Vec::new()
    };
    for part in ["schemes", "estimate", "choices", "features", "defaults"] {
        if !wanted(part) {
            continue;
        }
        let (text, holds) = match part {
            "schemes" => (schemes::section(&scenes, options)?, true),
            "estimate" => estimate::section(&scenes, options)?,
            "choices" => (choices::section()?, true),
            "features" => (features::section()?, true),
            _ => (defaults::section()?, true),
        };
        honest &= holds;
        println!("{text}");
        if options.write {
            page::insert(PAGE, part, &format!("Measured on: {machine}.\n\n{text}"))?;
        }
    }
    Ok(honest)
}
