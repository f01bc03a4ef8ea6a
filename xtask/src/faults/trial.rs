//! One fault, what the program did, and whether that is as it must be.

use super::program::{Outcome, Program};
use crate::TaskError;

/// A fault and what came of it.
pub(super) struct Trial {
    /// What happens.
    pub(super) fault: &'static str,
    /// How a user repeats it.
    pub(super) command: String,
    /// Exit code; none after a signal.
    pub(super) code: Option<i32>,
    /// The first line that the program said.
    pub(super) message: String,
    /// What survived, or what does not hold.
    pub(super) left: Result<String, String>,
}

/// What must come of a script.
pub(super) struct Expected {
    pub(super) fault: &'static str,
    /// A script for bash; `$TG` is the program, `$AT` an empty folder.
    pub(super) script: String,
    pub(super) code: i32,
    /// What the message names.
    pub(super) says: &'static [&'static str],
}

impl Expected {
    /// Runs the script; `survived` looks at what is left.
    pub(super) fn try_out(
        &self,
        program: &Program,
        survived: impl FnOnce(&Outcome) -> Result<String, String>,
    ) -> Result<Trial, TaskError> {
        let outcome = program.shell(&self.script)?;
        let silent = self.says.iter().find(|word| !outcome.stderr.contains(**word));
        let left = if outcome.code != Some(self.code) {
            Err(format!("exit code {:?} instead of {}", outcome.code, self.code))
        } else if let Some(word) = silent {
            Err(format!("the message does not say {word:?}"))
        } else if outcome.stderr.contains("panicked") {
            Err("a panic".into())
        } else {
            survived(&outcome)
        };
        let line = outcome.stderr.lines().find(|line| line.starts_with("error")).unwrap_or("");
        Ok(Trial {
            fault: self.fault,
            command: self.script.clone(),
            code: outcome.code,
            message: program.plain(line),
            left,
        })
    }
}
