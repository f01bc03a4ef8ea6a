//! What maintainers run: `cargo xtask verify`, `cargo xtask paths`, `cargo xtask layers`, `cargo xtask cites`, `cargo xtask trade`,
//! `cargo xtask extremes`, `cargo xtask faults`, `cargo xtask mutants`, `cargo xtask bench`, `cargo xtask instructions`.

mod bench;
mod cites;
mod defaults;
mod extremes;
mod faults;
mod instructions;
mod layers;
mod mutants;
mod paths;
mod trade;
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
        /// Run only the case of this name (example1, example2, example3, antiprism, mechanism, mast).
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
    /// Check that the headings of docs/accuracy-and-speed.md that the code cites are there.
    Cites,
    /// Measure what accuracy costs: schemes, estimated errors, choices of modelling, features, default settings.
    ///
    /// Exit code 1 if less than 95 % of the estimated errors are within a factor of 5 of the true ones.
    Trade(trade::Options),
    /// Take the library to its extremes, axis by axis: right answers, refusals, failures.
    ///
    /// Exit code 1 if an answer is wrong in silence, panics or does not end.
    Extremes(extremes::Options),
    /// Kill the program, fill its disk, take its files away and damage them: what was computed survives.
    ///
    /// Of the program `tg` beside this one: `cargo build --release -p tg-cli`. Exit code 1 if something does not hold.
    Faults(faults::Options),
    /// Judge the results of cargo-mutants: which changes of the code no test sees, and why.
    ///
    /// Exit code 1 if tests catch less than 90 % of a crate's viable mutants or a survivor has no reason.
    Mutants(mutants::Options),
    /// Measure steps, analyses, memory, and error against time; compare with the floor program where there is one.
    Bench(bench::Options),
    /// Write the mast of N stages and its converged trajectory into target/bench, for the peers' scripts.
    Mast {
        /// Number of stages N.
        stages: usize,
    },
    /// Print error against time of all schemes on one mast as JSON, for the peers' scripts.
    Curves(bench::CurveOptions),
    /// Print ten lowest modes of the mast of N stages and their cost as JSON, for the peers' scripts.
    Modes {
        /// Number of stages N.
        stages: usize,
    },
    /// Count the instructions of a step under valgrind and compare them with the stored ones.
    ///
    /// Of the profile `quick`: `cargo build --profile quick -p xtask && target/quick/xtask instructions`. Exit code 1 if a
    /// count has grown by more than 2 %.
    Instructions {
        /// Store the counts instead.
        #[arg(long)]
        bless: bool,
    },
    /// The child of `instructions` whose steps are counted.
    #[command(hide = true)]
    CountedSteps,
    /// The child of `bench` whose memory is measured.
    #[command(hide = true)]
    PeakMemory {
        /// Number of stages of the mast.
        stages: usize,
        /// Which scheme.
        scheme: usize,
    },
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().task {
        Task::Verify { case, json } => verify::verify(case.as_deref(), json),
        Task::Paths { json } => paths::print(json),
        Task::Layers => layers::check(),
        Task::Cites => cites::check(),
        Task::Trade(options) => trade::trade(&options),
        Task::Extremes(options) => extremes::follow(&options),
        Task::Faults(options) => faults::try_all(&options),
        Task::Mutants(options) => mutants::judge(&options),
        Task::Bench(options) => bench::bench(&options),
        Task::Mast { stages } => bench::mast(stages),
        Task::Curves(options) => bench::curves(&options),
        Task::Modes { stages } => bench::modes(stages),
        Task::Instructions { bless } => instructions::check(bless),
        Task::CountedSteps => instructions::in_child(),
        Task::PeakMemory { stages, scheme } => bench::peak_memory(stages, scheme),
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

/// The repository's folder.
fn root() -> &'static std::path::Path {
    let here = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().unwrap_or(here)
}
