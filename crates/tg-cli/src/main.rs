//! The program `tg`: from a scene file to an answer and a picture.
//!
//! One module for each command; [`answer`] decides what goes to stdout and with which exit code, [`loading`] reads scenes,
//! [`picture`] turns structures into what `tg-report` draws, [`results`] fills results folders.

mod answer;
mod args;
mod command;
mod loading;
mod picture;
mod progress;
mod results;

use std::process::ExitCode;

use clap::Parser;

use crate::answer::{Answer, Failure};
use crate::args::{Arguments, Command};

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let result = threads(arguments.threads).and_then(|()| dispatch(&arguments));
    answer::give(result, arguments.json)
}

fn dispatch(arguments: &Arguments) -> Result<Answer, Failure> {
    match &arguments.command {
        Command::Check(given) => command::check(given),
        Command::Statics(given) => command::statics(given),
        Command::Modes(given) => command::modes(given),
        Command::Run(given) => command::run(given),
        Command::Trade(given) => command::trade(given),
        Command::Equilibria(given) => command::equilibria(given),
        Command::Sweep(given) => command::sweep(given),
        Command::View(given) => command::view(given),
        Command::Plot(given) => command::plot(given),
        Command::Export(given) => command::export(given),
        Command::Import(given) => command::import(given),
        Command::Schema(given) => command::schema(given),
        Command::Completions(given) => Ok(command::completions(given)),
        Command::Man(given) => command::man(given),
    }
}

/// All parallel work shares one pool.
fn threads(number: Option<usize>) -> Result<(), Failure> {
    let Some(number) = number else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(number).build_global();
    pool.map_err(|error| Failure::Usage(format!("{number} threads cannot be had: {error}")))
}
