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

/// A part is closed, and a checkpoint and some rows are later.
fn amid_second_part(folder: &Path) -> bool {
    let modified = |name| fs::metadata(folder.join(name)).and_then(|about| about.modified()).ok();
    let (part, checkpoint) = (modified(FILES[2]), modified("checkpoint.json"));
    let journal = fs::metadata(folder.join("journal.bin")).map_or(0, |about| about.len());
    part.is_some() && checkpoint > part && journal > 10_000
}

fn copy(program: &Program, folder: &Path, name: &str) -> Result<std::path::PathBuf, TaskError> {
    let to = program.free(name)?;
    program.shell(&format!("cp -r '{}' '{}'", folder.display(), to.display()))?;
    Ok(to)
}

/// Every command either says what is missing or answers as if nothing were.
fn before_looking(program: &Program, whole: &Path, file: &str) -> Result<Option<Trial>, TaskError> {
    let missing = copy(program, whole, "missing")?;
    if !missing.join(file).exists() {
        return Ok(None);
    }
    fs::remove_file(missing.join(file))?;
    let looks = [
        "view RESULTS -o $AT/look.html",
        "plot RESULTS --what points -o $AT/look.svg",
        "export RESULTS csv -o $AT/look.csv",
        "export RESULTS gltf -o $AT/look.glb",
    ];
    let script = looks.map(|look| {
        let (at, of) = (look.replace("RESULTS", "$AT/missing"), look.replace("RESULTS", &whole.display().to_string()));
        let to = look.rsplit(' ').next().unwrap_or_default();
        format!("rm -f {to}; $TG {at} >/dev/null; c=$?; [ $c = 2 ] || {{ [ $c = 0 ] && mv {to} {to}-, && $TG {of} >/dev/null && cmp -s {to} {to}-,; }} || {{ echo wrong: {look} $c; bad=1; }}; [ $c = 0 ] || any=2")
    });
    let script = format!("bad=0; any=0; {}; exit $((bad + any))", script.join("; "));
    // Only the checkpoint is not looked at.
    let code = if file == "checkpoint.json" { 0 } else { 2 };
    let says: &[&str] = match file {
        "checkpoint.json" => &[],
        "run.json" => &["run.json"],
        _ => &["it has vanished; put it back, or begin anew"],
    };
    let expected = Expected { fault: "of finished results", script, code, says };
    let mut trial = expected
        .try_out(program, |_| Ok("what needs it is refused, everything else is as before".to_string()))?;
    trial.command = format!("rm out/{file}; tg view out; tg plot out; tg export out csv; tg export out gltf");
    Ok(Some(trial))
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
    trial.command = format!("tg run ... -o out & rm -r out/{file}");
    Ok(trial)
}
