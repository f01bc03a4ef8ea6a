//! What maintainers run: `cargo xtask verify`, `cargo xtask paths`, `cargo xtask layers`, `cargo xtask defaults`.

mod defaults;
mod layers;
mod paths;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Tasks of this workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", version)]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Rerun the papers' examples and compare every number with its reference.
    ///
    /// Exit code 0 if all hold, 1 if one does not, 2 if a case cannot be run.
    Verify {
        /// Run only the case of this name (example1, example2, example3, antiprism, mechanism).
        #[arg(long)]
        case: Option<String>,
        /// Print one JSON document with the rows instead of tables.
        #[arg(long)]
        json: bool,
    },
    /// Print the antiprisms' load paths and the mechanism's solution curves with their events.
    Paths {
        /// Print one JSON document with every point instead of tables.
        #[arg(long)]
        json: bool,
    },
    /// Compare the crates' dependencies with the allowed ones.
    Layers,
    /// Measure what the solvers' default settings cost and give.
    Defaults,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Verify { case, json } => verify::verify(case.as_deref(), json),
        Task::Paths { json } => paths::print(json),
        Task::Layers => layers::check(),
        Task::Defaults => defaults::measure(),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Any failure of a task, for its message.
type TaskError = Box<dyn std::error::Error>;
