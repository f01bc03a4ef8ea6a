//! `faults`: the program is killed, its disk fills, its files vanish and are damaged.
//!
//! Whatever happens, what was computed is read or computed again bit for bit, what is not right is refused with a message
//! that says where and what would mend it, and nothing half-written is taken for results.
//!
//! - `program`: `tg` as a process; `subject`: a run and its undisturbed results; `trial`: one fault and what came of it;
//! - `kills`, `system`, `vanish`, `damage`: the faults;
//! - `page`: `docs/faults.md`.

mod damage;
mod kills;
mod page;
mod program;
mod subject;
mod system;
mod trial;
mod vanish;

use clap::Args;

use crate::{TaskError, root};
use kills::Random;
use program::Program;
use subject::{PLANE, SPACE, Subject};

/// Arguments of `faults`.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// How many times runs are killed.
    #[arg(long, default_value_t = 100)]
    kills: usize,
    /// Decides when.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Write docs/faults.md.
    #[arg(long)]
    write: bool,
}

/// All that was found.
#[derive(Default)]
struct Found {
    kills: Vec<kills::Kills>,
    system: Vec<trial::Trial>,
    vanished: Vec<trial::Trial>,
    damages: Vec<damage::Damage>,
}

/// Tries all faults; true if the program stood all of them.
pub(crate) fn try_all(options: &Options) -> Result<bool, TaskError> {
    let program = Program::find()?;
    let mut random = Random(options.seed);
    eprintln!("undisturbed runs");
    let subjects = [Subject::new(&program, "plane", PLANE)?, Subject::new(&program, "space", SPACE)?];
    let [plane, _] = &subjects;
    let mut kills = Vec::new();
    for (subject, share) in subjects.iter().zip([options.kills.div_ceil(2), options.kills / 2]) {
        eprintln!("{share} kills of {}", subject.arguments.join(" "));
        kills.push(kills::kill(&program, subject, share, &mut random)?);
    }
    let mut found = Found { kills, ..Found::default() };
    found.tell();
    eprintln!("what the system refuses");
    found.system = system::trials(&program, &subjects)?;
    found.tell();
    eprintln!("what vanishes");
    found.vanished = vanish::trials(&program, plane)?;
    found.tell();
    eprintln!("what is damaged");
    let half = vanish::half(&program, plane)?;
    found.damages = damage::damages(&program, plane, &half, &mut random)?;
    found.tell();
    let text = page::page(&found);
    println!("{text}");
    if options.write {
        std::fs::write(root().join("docs/faults.md"), text)?;
    }
    Ok(found.wrong().is_empty())
}

impl Found {
    /// Says at once what does not hold.
    fn tell(&self) {
        self.wrong().iter().for_each(|line| eprintln!("does not hold: {line}"));
    }

    /// What does not hold.
    fn wrong(&self) -> Vec<String> {
        let kills = self.kills.iter().flat_map(|kills| kills.wrong.clone());
        let trials = self.system.iter().chain(&self.vanished);
        let trials = trials.filter_map(|t| {
            let why = t.left.as_ref().err()?;
            Some(format!("{}, {}: {why} ({})", t.fault, t.command, t.message))
        });
        let damages = self.damages.iter();
        let damages = damages.flat_map(|d| d.wrong.iter().map(|why| format!("{} {}: {why}", d.file, d.how)));
        kills.chain(trials).chain(damages).collect()
    }
}
