//! The program `tg` as a process, and what came of it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use crate::{TaskError, root};

/// Time \[s\] after which a process counts as endless, and is ended with the exit code 124.
const PATIENCE: &str = "300";

/// The program and a folder for its results, which vanishes with this.
pub(super) struct Program {
    path: PathBuf,
    /// An empty folder.
    pub(super) scratch: PathBuf,
}

/// What came of a process.
#[derive(Clone, Debug, Default)]
pub(super) struct Outcome {
    /// Exit code; none after a signal.
    pub(super) code: Option<i32>,
    /// What it said.
    pub(super) stderr: String,
}

impl Program {
    /// The program beside this one.
    pub(super) fn find() -> Result<Self, TaskError> {
        let here = std::env::current_exe()?;
        let folder = here.parent().unwrap_or(&here);
        let path = folder.join("tg");
        if !path.exists() {
            let path = path.display();
            return Err(format!("{path} is missing; build it: cargo build --release -p tg-cli").into());
        }
        let scratch = folder.join("faults");
        if scratch.exists() {
            std::fs::remove_dir_all(&scratch)?;
        }
        std::fs::create_dir_all(&scratch)?;
        Ok(Self { path, scratch })
    }

    /// A path in the scratch folder that is free.
    pub(super) fn free(&self, name: &str) -> Result<PathBuf, TaskError> {
        let path = self.scratch.join(name);
        if path.is_dir() {
            std::fs::remove_dir_all(&path)?;
        } else if path.exists() {
            std::fs::remove_file(&path)?;
        }
        Ok(path)
    }

    /// The program with arguments, seen from the repository.
    pub(super) fn tg(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(&self.path);
        command.args(arguments).current_dir(root());
        command
    }

    /// A shell that knows the program as `$TG` and the scratch folder as `$AT`.
    pub(super) fn shell(&self, script: &str) -> Result<Outcome, TaskError> {
        let mut command = Command::new("timeout");
        command.args([PATIENCE, "bash", "-c", script]).current_dir(root());
        command.env("TG", &self.path).env("AT", &self.scratch);
        outcome(command)
    }

    /// Runs to the end.
    pub(super) fn run(&self, arguments: &[&str]) -> Result<Outcome, TaskError> {
        let mut command = Command::new("timeout");
        command.arg(PATIENCE).arg(&self.path).args(arguments).current_dir(root());
        outcome(command)
    }

    /// Runs to success.
    pub(super) fn must(&self, arguments: &[&str]) -> Result<(), TaskError> {
        let outcome = self.run(arguments)?;
        if outcome.code == Some(0) {
            return Ok(());
        }
        Err(format!("tg {}: {}", arguments.join(" "), outcome.stderr).into())
    }

    /// Runs, and kills after a time; true if it was killed before it had ended.
    pub(super) fn kill_after(&self, arguments: &[&str], time: Duration) -> Result<bool, TaskError> {
        let mut command = self.tg(arguments);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
        sleep(time);
        // One that has ended is not there to be killed.
        let _ = child.kill();
        Ok(child.wait()?.code().is_none())
    }

    /// Paths without the folders of this machine.
    pub(super) fn plain(&self, text: &str) -> String {
        let short = |path: &Path| format!("{}/", path.display());
        let text = text.replace(&short(&self.scratch), "").replace(&short(root()), "");
        text.replace(&self.scratch.display().to_string(), "$AT")
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.scratch);
    }
}

fn outcome(mut command: Command) -> Result<Outcome, TaskError> {
    let output = command.stdin(Stdio::null()).output()?;
    Ok(Outcome { code: output.status.code(), stderr: String::from_utf8_lossy(&output.stderr).into_owned() })
}
