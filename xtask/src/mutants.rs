//! `mutants`: what the tests of the crates at the bottom see of small changes in their code, from the results of
//! cargo-mutants.
//!
//! A mutant is the code with one change: a value returned outright, an operator replaced, a branch left out. It is caught
//! if a test of its own crate fails or does not end. Each survivor needs a reason in `xtask/mutants.json`.
//!
//! - `page`: `docs/mutants.md`.

mod page;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use serde::Deserialize;

use crate::{TaskError, root};

/// Share of viable mutants that a crate's tests must catch.
const WANTED: f64 = 0.9;

/// Arguments of `mutants`.
#[derive(Debug, Args)]
pub(crate) struct Options {
    /// Folders that cargo-mutants wrote; of a mutant that is in several the last counts.
    #[arg(default_value = "mutants.out")]
    folders: Vec<PathBuf>,
    /// Write docs/mutants.md.
    #[arg(long)]
    write: bool,
}

#[derive(Deserialize)]
struct Outcomes {
    outcomes: Vec<Outcome>,
}

#[derive(Deserialize)]
struct Outcome {
    scenario: Scenario,
    summary: String,
}

#[derive(Deserialize)]
enum Scenario {
    /// The code as it is.
    Baseline,
    Mutant(Mutant),
}

#[derive(Clone, Deserialize, PartialEq, Eq, PartialOrd, Ord)]
struct Mutant {
    package: String,
    file: String,
    /// `file:line:column: change`.
    name: String,
}

/// What came of a mutant.
#[derive(Clone, Copy, PartialEq)]
enum Fate {
    /// Does not compile.
    Unviable,
    Caught,
    /// Tests that do not end, caught too.
    Endless,
    Survived,
}

/// Why some survivors may live.
#[derive(Deserialize)]
struct Reason {
    reason: String,
    /// `file: change`, once for each place where the same change survives in one function.
    mutants: Vec<String>,
}

impl Mutant {
    /// `file: change`: what a line more or less elsewhere leaves alone.
    fn change(&self) -> String {
        let change = self.name.splitn(4, ':').nth(3).unwrap_or_default();
        format!("{}:{change}", self.file)
    }
}

/// How many mutants of a file or crate came to what.
#[derive(Clone, Copy, Default)]
struct Tally {
    unviable: usize,
    caught: usize,
    endless: usize,
    survived: usize,
}

impl Tally {
    fn add(&mut self, fate: Fate) {
        *match fate {
            Fate::Unviable => &mut self.unviable,
            Fate::Caught => &mut self.caught,
            Fate::Endless => &mut self.endless,
            Fate::Survived => &mut self.survived,
        } += 1;
    }

    fn viable(&self) -> usize {
        self.caught + self.endless + self.survived
    }

    /// Share of viable mutants that tests caught; all of none.
    fn share(&self) -> f64 {
        match self.viable() {
            0 => 1.0,
            viable => 1.0 - self.survived as f64 / viable as f64,
        }
    }
}

/// Reads the results; true if each crate's share is as wanted and every survivor has its reason.
pub(crate) fn judge(options: &Options) -> Result<bool, TaskError> {
    let found = read(&options.folders)?;
    let reasons: Vec<Reason> = json(&root().join("xtask/mutants.json"))?;
    let (mut files, mut crates) = (BTreeMap::<&str, Tally>::new(), BTreeMap::<&str, Tally>::new());
    for (mutant, &fate) in &found {
        files.entry(&mutant.file).or_default().add(fate);
        crates.entry(&mutant.package).or_default().add(fate);
    }
    let survivors = found.iter().filter(|(_, fate)| **fate == Fate::Survived);
    let mut unexplained: Vec<String> = survivors.map(|(mutant, _)| mutant.change()).collect();
    let mut survive = Vec::new();
    for Reason { reason, mutants } in &reasons {
        let mut of_this = Vec::new();
        for mutant in mutants {
            match unexplained.iter().position(|other| other == mutant) {
                Some(at) => of_this.push(unexplained.remove(at)),
                None => eprintln!("a reason without a survivor: {mutant}"),
            }
        }
        survive.push((reason.as_str(), of_this));
    }
    let text = page::page(&crates, &files, &survive, &unsafe_forbidden()?);
    println!("{text}");
    unexplained.iter().for_each(|mutant| println!("survives without a reason: {mutant}"));
    if options.write {
        fs::write(root().join("docs/mutants.md"), text)?;
    }
    Ok(unexplained.is_empty() && crates.values().all(|tally| tally.share() >= WANTED))
}

/// The fate of each mutant.
fn read(folders: &[PathBuf]) -> Result<BTreeMap<Mutant, Fate>, TaskError> {
    let mut found = BTreeMap::new();
    for folder in folders {
        let Outcomes { outcomes } = json(&folder.join("outcomes.json"))?;
        for Outcome { scenario, summary } in outcomes {
            let Scenario::Mutant(mutant) = scenario else { continue };
            let fate = match summary.as_str() {
                "Unviable" => Fate::Unviable,
                "CaughtMutant" => Fate::Caught,
                "Timeout" => Fate::Endless,
                "MissedMutant" => Fate::Survived,
                other => return Err(format!("{} was not tested: {other}", mutant.name).into()),
            };
            found.insert(mutant, fate);
        }
    }
    Ok(found)
}

/// The workspace's crates, of which each manifest forbids unsafe code.
fn unsafe_forbidden() -> Result<Vec<String>, TaskError> {
    let mut folders = vec![root().join("xtask")];
    for entry in fs::read_dir(root().join("crates"))? {
        folders.push(entry?.path());
    }
    folders.sort();
    let has = |manifest: &Path, line: &str| -> Result<(), TaskError> {
        let text = fs::read_to_string(manifest)?;
        let missing = || format!("{} has no `{}`", manifest.display(), line.replace('\n', ", ")).into();
        text.contains(line).then_some(()).ok_or_else(missing)
    };
    has(&root().join("Cargo.toml"), "unsafe_code = \"forbid\"")?;
    folders.iter().try_for_each(|folder| has(&folder.join("Cargo.toml"), "[lints]\nworkspace = true"))?;
    Ok(folders.iter().filter_map(|folder| Some(folder.file_name()?.to_string_lossy().into())).collect())
}

fn json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, TaskError> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    serde_json::from_str(&text).map_err(|error| format!("{}: {error}", path.display()).into())
}
