//! What a command says, and how the program ends: 0 success, 1 the analysis failed, 2 bad input.

use std::error::Error;
use std::fmt;
use std::io::{ErrorKind, IsTerminal, Write};
use std::process::ExitCode;

use serde_json::{Value, json};
use tg_report::ReportError;
use tg_scene::SceneError;

/// What a command found.
pub(crate) struct Answer {
    /// For machines: one document.
    pub(crate) document: Value,
    /// For people.
    pub(crate) text: String,
    /// What the reader should know besides; to stderr.
    pub(crate) warnings: Vec<String>,
    /// Why the analysis counts as failed although it says something.
    pub(crate) failed: Option<String>,
}

impl Answer {
    /// A complete answer.
    pub(crate) fn new(document: Value, text: String) -> Self {
        Self { document, text, warnings: Vec::new(), failed: None }
    }

    /// The same with remarks.
    pub(crate) fn warn(mut self, warnings: Vec<String>) -> Self {
        self.warnings.extend(warnings);
        self
    }
}

/// Why a command has no answer.
pub(crate) enum Failure {
    /// The scene is wrong.
    Scene(SceneError),
    /// An argument is wrong.
    Usage(String),
    /// A results folder cannot be read or written.
    Results(ReportError),
    /// The analysis did not succeed.
    Analysis(Box<dyn Error + Send + Sync>),
}

impl Failure {
    /// An analysis that did not succeed.
    pub(crate) fn analysis(error: impl Into<Box<dyn Error + Send + Sync>>) -> Self {
        Self::Analysis(error.into())
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Scene(error) => error.fmt(f),
            Self::Usage(message) => f.write_str(message),
            Self::Results(error) => error.fmt(f),
            Self::Analysis(error) => error.fmt(f),
        }
    }
}

impl From<SceneError> for Failure {
    fn from(error: SceneError) -> Self {
        Self::Scene(error)
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        Self::Results(error)
    }
}

/// Prints an answer or a failure; the exit code of the program.
pub(crate) fn give(result: Result<Answer, Failure>, as_json: bool) -> ExitCode {
    match result {
        Ok(answer) => {
            for warning in &answer.warnings {
                message(&format!("warning: {warning}"));
            }
            let mut document = answer.document;
            if let (Value::Object(map), false) = (&mut document, answer.warnings.is_empty()) {
                map.insert("warnings".into(), json!(answer.warnings));
            }
            let printed = print(&if as_json { pretty(&document) } else { answer.text });
            if let Some(why) = &answer.failed {
                message(&format!("error: {why}"));
            }
            if printed && answer.failed.is_none() { ExitCode::SUCCESS } else { ExitCode::from(1) }
        }
        Err(failure) => {
            let (kind, text, mut document, code) = describe(&failure);
            message(&text);
            if as_json {
                document["kind"] = json!(kind);
                print(&pretty(&json!({ "error": document })));
            }
            ExitCode::from(code)
        }
    }
}

fn describe(failure: &Failure) -> (&'static str, String, Value, u8) {
    let (kind, code) = match failure {
        Failure::Scene(SceneError::Mistake(mistake)) => {
            let document = json!({
                "file": mistake.file,
                "line": mistake.line,
                "column": mistake.column,
                "message": mistake.message,
                "help": mistake.help,
            });
            return ("scene", mistake.render(std::io::stderr().is_terminal()), document, 2);
        }
        Failure::Scene(_) => ("scene", 2),
        Failure::Usage(_) => ("usage", 2),
        Failure::Results(_) => ("results", 2),
        Failure::Analysis(_) => ("analysis", 1),
    };
    (kind, format!("error: {failure}"), json!({ "message": failure.to_string() }), code)
}

/// JSON for people and machines.
pub(crate) fn pretty(document: &Value) -> String {
    // A document is made of numbers, texts and lists: it has a text.
    serde_json::to_string_pretty(document).unwrap_or_default()
}

/// Prints to stdout; false if that cannot take it, for want of room. A reader that has gone away is no error of ours.
fn print(text: &str) -> bool {
    let mut out = std::io::stdout().lock();
    let end = if text.is_empty() || text.ends_with('\n') { "" } else { "\n" };
    let printed = out
        .write_all(text.as_bytes())
        .and_then(|()| out.write_all(end.as_bytes()))
        .and_then(|()| out.flush());
    match printed {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            message(&format!("error: the answer cannot be printed: {error}; send it elsewhere"));
            false
        }
        _ => true,
    }
}

fn message(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}
