//! Files of a results folder that vanish: while the run goes on, before it is resumed, before it is looked at.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::thread::sleep;

use super::program::Program;
use super::subject::Subject;
use super::trial::{Expected, Trial};
use crate::TaskError;

const FILES: [&str; 6] = [
    "run.json",
    "parts.json",
    "trajectory/part-00000.parquet",
    "journal.bin",
    "frames.ndjson",
    "checkpoint.json",
];

/// All of them.
pub(super) fn trials(program: &Program, subject: &Subject) -> Result<Vec<Trial>, TaskError> {
    let mut trials = Vec::new();
    let killed = half(program, subject)?;
    for file in FILES {
        trials.extend(before_looking(program, &subject.folder, file)?);
    }
    for file in FILES {
        trials.push(before_resuming(program, subject, &killed, file)?);
    }
    for file in FILES.into_iter().chain(["."]) {
        trials.push(while_it_runs(program, subject, file)?);
    }
    Ok(trials)
}

/// A folder of a run that was killed after its first part was closed.
pub(super) fn half(program: &Program, subject: &Subject) -> Result<std::path::PathBuf, TaskError> {
    let folder = program.free("half")?;
    let line = subject.line(&folder, &[]);
    let mut child = program.tg(&line.iter().map(String::as_str).collect::<Vec<_>>());
    let mut child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn()?;
    while child.try_wait()?.is_none() && !amid_second_part(&folder) {
        sleep(subject.time / 1000);
    }
    child.kill()?;
    if child.wait()?.code().is_some() {
        return Err("the run ended before it was killed; take a longer one".into());
    }
    Ok(folder)
}

/// A part is closed, and a checkpoint is later, with rows that are in the journal.
fn amid_second_part(folder: &Path) -> bool {
    let Ok(list) = fs::read_to_string(folder.join("parts.json")) else { return false };
    let Ok(checkpoint) = fs::read_to_string(folder.join("checkpoint.json")) else { return false };
    let rows = |text: &str| -> Option<usize> {
        let (_, rest) = text.split_once("\"rows\":")?;
        rest.split(',').next()?.parse().ok()
    };
    rows(&list).is_some_and(|closed| rows(&checkpoint).is_some_and(|all| all > closed))
}

fn copy(program: &Program, folder: &Path, name: &str) -> Result<std::path::PathBuf, TaskError> {
    let to = program.free(name)?;
    program.shell(&format!("cp -r '{}' '{}'", folder.display(), to.display()))?;
    Ok(to)
}

/// What looks at results, and the file that it makes.
const LOOKS: [(&[&str], &str); 4] = [
    (&["view"], "look.html"),
    (&["plot", "--what", "points"], "look.svg"),
    (&["export", "--to", "csv"], "look.csv"),
    (&["export", "--to", "gltf"], "look.glb"),
];

/// Every command either says what is missing or makes what it made of the whole folder.
fn before_looking(program: &Program, whole: &Path, file: &str) -> Result<Option<Trial>, TaskError> {
    let missing = copy(program, whole, "missing")?;
    if !missing.join(file).exists() {
        return Ok(None);
    }
    fs::remove_file(missing.join(file))?;
    let (mut code, mut message, mut wrong) = (0, String::new(), Vec::new());
    let (mut refused, mut made) = (Vec::new(), Vec::new());
    for (look, name) in LOOKS {
        let file_of = |folder: &Path| {
            let (folder, file) = (folder.display().to_string(), program.free(name)?);
            let to = file.display().to_string();
            let outcome = program.run(&[look, &[&folder, "-o", &to]].concat())?;
            Ok::<_, TaskError>((outcome, fs::read(file).ok()))
        };
        let ((outcome, ours), (_, theirs)) = (file_of(&missing)?, file_of(whole)?);
        let said = outcome.stderr.contains(file) && !outcome.stderr.contains("panicked");
        match outcome.code {
            Some(0) if ours == theirs && ours.is_some() => made.push(look.join(" ")),
            Some(2) if said => {
                refused.push(look.join(" "));
                code = 2;
                message = program.plain(outcome.stderr.trim());
            }
            other => wrong.push(format!("{}: exit code {other:?}, {}", look.join(" "), outcome.stderr)),
        }
    }
    let told = |what: &[String], word: &str| match what {
        [] => format!("{word}: nothing"),
        what => format!("{word}: {}", what.join(", ")),
    };
    let left = format!("{}; {}", told(&refused, "refused"), told(&made, "as before"));
    Ok(Some(Trial {
        fault: "of finished results",
        command: format!(
            "rm out/{file}; tg view out; tg plot out --what points; tg export out --to csv; ..."
        ),
        code: Some(code),
        message,
        left: if wrong.is_empty() { Ok(left) } else { Err(wrong.join("; ")) },
    }))
}

fn before_resuming(
    program: &Program,
    subject: &Subject,
    killed: &Path,
    file: &str,
) -> Result<Trial, TaskError> {
    let missing = copy(program, killed, "missing")?;
    fs::remove_file(missing.join(file))?;
    let script = format!("$TG {} -o $AT/missing --resume", subject.arguments.join(" "));
    let says: &[&str] = match file {
        "run.json" => &["no results"],
        "journal.bin" => &["rows are left", "begin anew"],
        "checkpoint.json" => &["no checkpoint", "--force"],
        _ => &["it has vanished"],
    };
    let expected = Expected { fault: "of a killed run that is to be resumed", script, code: 2, says };
    let mut trial = expected.try_out(program, |_| Ok("refused; the rest stays as it was".to_string()))?;
    trial.command = format!("rm out/{file}; tg run ... -o out --resume");
    Ok(trial)
}

/// The run either writes what vanished again, or says at its end that it is missing.
fn while_it_runs(program: &Program, subject: &Subject, file: &str) -> Result<Trial, TaskError> {
    program.free("missing")?;
    let script = format!(
        "$TG {} -o $AT/missing & while [ ! -e $AT/missing/trajectory/part-00000.parquet ]; do sleep 0.002; done; rm -r \
         $AT/missing/{}; wait $!",
        subject.arguments.join(" "),
        if file == "." { "" } else { file },
    );
    let (code, says): (i32, &[&str]) = match file {
        "trajectory/part-00000.parquet" | "frames.ndjson" => (1, &["it has vanished"]),
        "." => (1, &["missing"]),
        _ => (0, &[]),
    };
    let expected = Expected { fault: "while the run goes on", script, code, says };
    let folder = program.scratch.join("missing");
    let mut trial = expected.try_out(program, |_| match code {
        0 => subject.same(&folder).map(|()| "written again; the results are complete".to_string()),
        _ => Ok("the message tells what is missing".to_string()),
    })?;
    trial.command = format!(
        "tg run ... -o out & rm -r {}",
        if file == "." { "out".into() } else { format!("out/{file}") }
    );
    Ok(trial)
}
