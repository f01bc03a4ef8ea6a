//! What the operating system refuses: room, permission, a reader that has gone away.

use std::fs;
use std::path::Path;

use super::program::Program;
use super::subject::Subject;
use super::trial::{Expected, Trial};
use crate::TaskError;

/// All of them.
pub(super) fn trials(program: &Program, [plane, space]: &[Subject; 2]) -> Result<Vec<Trial>, TaskError> {
    let mut trials =
        vec![disk_full(program, plane)?, disk_full(program, space)?, file_limit(program, space)?];
    trials.extend(streams(program, space)?);
    trials.extend(folders(program)?);
    Ok(trials)
}

fn arguments(subject: &Subject) -> String {
    subject.arguments.join(" ")
}

/// File systems from one that takes nothing to one that takes all but the page: then room is made.
fn disk_full(program: &Program, subject: &Subject) -> Result<Trial, TaskError> {
    let run = arguments(subject);
    // Twice what is left in the end: a part and the journal that it is made of are there at the same time.
    let parts = [0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.97, 1.0, 1.1, 1.3, 1.5, 2.0];
    let kibibytes = size(&subject.folder)? as f64 / 1024.0;
    let sizes = parts.map(|part| format!("{:.0}", (part * kibibytes).max(16.0)));
    let (sizes, half) = (sizes.join(" "), &sizes[6]);
    let script = format!(
        "rm -rf $AT/small $AT/full-* $AT/after-*; mkdir $AT/small; unshare -rm bash -c '
for size in {sizes}; do
  mount -t tmpfs -o size=${{size}}k tmpfs $AT/small
  $TG {run} -o $AT/small/out 2>$AT/said-$size; echo $? >$AT/code-$size
  cp -r $AT/small/out $AT/full-$size
  mount -o remount,size=128m $AT/small
  $TG {run} -o $AT/small/out --resume 2>>$AT/said-$size; echo $? >>$AT/code-$size
  cp -r $AT/small/out $AT/after-$size
  umount $AT/small
done'; cat $AT/said-{half} >&2; exit $(head -1 $AT/code-{half})"
    );
    let says = &["No space left on device", "make room", "--resume goes on"];
    let expected = Expected { fault: "the disk is full in the middle of a run", script, code: 1, says };
    expected.try_out(program, |_| {
        let (mut failed, mut whole) = (0, 0);
        for size in sizes.split(' ') {
            let at = |name: &str| program.scratch.join(format!("{name}-{size}"));
            let read = |name| fs::read_to_string(at(name)).unwrap_or_default();
            let (codes, said) = (read("code"), read("said"));
            let wrong = |why: String| Err(format!("{size} KiB: {why}; {}", said.trim()));
            match codes.split_whitespace().collect::<Vec<_>>()[..] {
                ["0", "0"] => whole += 1,
                ["1" | "2", "0"] => failed += 1,
                _ => return wrong(format!("exit codes {codes:?}")),
            }
            if codes.starts_with(['1', '2']) && !said.contains("No space left on device") {
                return wrong("the message does not say why".into());
            }
            if at("full").join("run.json").exists()
                && let Err(why) = subject.prefix(&at("full"))
            {
                return wrong(format!("what was written: {why}"));
            }
            if let Err(why) = subject.same(&at("after")) {
                return wrong(format!("resumed with room: {why}"));
            }
        }
        Ok(format!(
            "{} sizes of the disk: {failed} too small at some place, {whole} large enough; each time the rows that were \
             written are read, and with room `--resume` gives the undisturbed run bit for bit",
            failed + whole
        ))
    })
}

/// Bytes of the files of a folder.
fn size(folder: &Path) -> Result<u64, TaskError> {
    let mut bytes = 0;
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let about = entry.metadata()?;
        bytes += if about.is_dir() { size(&entry.path())? } else { about.len() };
    }
    Ok(bytes)
}

/// A limit of file sizes: the system ends the program by a signal, unless that is ignored.
fn file_limit(program: &Program, subject: &Subject) -> Result<Trial, TaskError> {
    let run = arguments(subject);
    let script = format!("trap '' XFSZ; ulimit -f 100; $TG {run} -o $AT/limited");
    let says = &["File too large", "raise the limit", "--resume goes on"];
    let expected = Expected { fault: "a limit of file sizes", script, code: 1, says };
    let folder = program.scratch.join("limited");
    expected.try_out(program, |_| {
        let rows = subject.prefix(&folder)?;
        resumed(program, subject, &folder)?;
        Ok(format!(
            "{rows} rows are read, `--resume` without the limit gives the undisturbed run bit for bit"
        ))
    })
}

fn resumed(program: &Program, subject: &Subject, folder: &Path) -> Result<(), String> {
    let line = subject.line(folder, &["--resume"]);
    program.must(&line.iter().map(String::as_str).collect::<Vec<_>>()).map_err(|error| error.to_string())?;
    subject.same(folder)
}

/// Standard output and messages that nobody takes.
fn streams(program: &Program, subject: &Subject) -> Result<Vec<Trial>, TaskError> {
    let run = arguments(subject);
    let plain = |fault, script: String, code, says| Expected { fault, script, code, says };
    let full: &[&str] = &["cannot be printed", "No space left on device", "send it elsewhere"];
    let mut trials = Vec::new();
    let folder = program.scratch.join("printed");
    let of_run = plain("stdout is full", format!("$TG {run} -o $AT/printed >/dev/full"), 1, full);
    trials.push(
        of_run
            .try_out(program, |_| subject.same(&folder).map(|()| "the results are complete".to_string()))?,
    );
    let nothing = |_: &_| Ok("nothing is lost: the answer is computed again".to_string());
    let json = plain("stdout is full", "$TG modes scenes/tower.toml --json >/dev/full".into(), 1, full);
    trials.push(json.try_out(program, nothing)?);
    let piped = |line: &str| format!("$TG {line} | head -c 1 >/dev/null; exit ${{PIPESTATUS[0]}}");
    let quiet = |outcome: &super::program::Outcome| match outcome.stderr.is_empty() {
        true => Ok("no message: the reader has what it wanted".to_string()),
        false => Err(format!("says {:?}", outcome.stderr)),
    };
    for line in ["schema", "schema --json", "modes scenes/prism_mast.toml --json", "man", "--help"] {
        trials.push(plain("a broken pipe", piped(line), 0, &[]).try_out(program, quiet)?);
    }
    let folder = program.scratch.join("piped");
    let run_piped = format!("$TG {run} -o $AT/piped | true; exit ${{PIPESTATUS[0]}}");
    trials.push(
        plain("a broken pipe", run_piped, 0, &[])
            .try_out(program, |_| subject.same(&folder).map(|()| "the results are complete".to_string()))?,
    );
    for (fault, end) in [("stderr is closed", "2>&-"), ("stderr is full", "2>/dev/full")] {
        let line = format!("$TG check nosuch.toml {end}");
        trials.push(plain(fault, line, 2, &[]).try_out(program, |_| Ok("the exit code tells".into()))?);
    }
    let folder = program.scratch.join("closed");
    let closed = plain("stdout and stderr are closed", format!("$TG {run} -o $AT/closed >&- 2>&-"), 0, &[]);
    trials.push(
        closed
            .try_out(program, |_| subject.same(&folder).map(|()| "the results are complete".to_string()))?,
    );
    Ok(trials)
}

/// Places that take no results.
fn folders(program: &Program) -> Result<Vec<Trial>, TaskError> {
    let run = "run scenes/tower.toml --duration 0.1";
    let precious = program.scratch.join("notes.txt");
    fs::write(&precious, "precious")?;
    let above = Expected {
        fault: "no folder above the folder",
        script: format!("$TG {run} -o $AT/no/such/folder"),
        code: 0,
        says: &[],
    };
    let above = above.try_out(program, |_| Ok("the folders are made".to_string()))?;
    let trial = |fault, script: String, code, says| {
        let expected = Expected { fault, script, code, says };
        expected.try_out(program, |_| match fs::read(&precious) {
            Ok(text) if text == b"precious" => Ok("nothing was computed, nothing is lost".to_string()),
            _ => Err("a file of the user is lost".into()),
        })
    };
    let read_only = |rest: &str| {
        format!(
            "mkdir -p $AT/fixed && unshare -rm bash -c 'mount -t tmpfs tmpfs $AT/fixed; $TG {run} -o $AT/fixed/there; mount -o \
             remount,ro $AT/fixed; {rest}'"
        )
    };
    let elsewhere: &[&str] = &["Read-only file system", "choose another place"];
    Ok(vec![
        above,
        trial("a file where the folder should be", format!("$TG {run} -o $AT/notes.txt"), 2, &["notes.txt"])?,
        trial("a file above the folder", format!("$TG {run} -o $AT/notes.txt/out"), 2, &["notes.txt/out"])?,
        trial("files of someone else in the folder", format!("$TG {run} -o $AT --force"), 2, &[
            "no results",
            "choose another folder",
        ])?,
        trial("a read-only file system", read_only(&format!("$TG {run} -o $AT/fixed/out")), 2, elsewhere)?,
        trial("results on it are to be replaced", read_only(&format!("$TG {run} -o $AT/fixed/there --force")), 2, elsewhere)?,
        trial("results on it are resumed", read_only(&format!("$TG {run} -o $AT/fixed/there --resume")), 2, elsewhere)?,
        trial("a page for it", read_only("$TG view $AT/fixed/there"), 2, elsewhere)?,
        trial("no folder for a page", "$TG view scenes/tower.toml -o $AT/none/such.html".into(), 2, &["none/such.html", "missing"])?,
        trial("no folder for a scene", "$TG import $AT/nosuch.yaml".into(), 2, &["nosuch.yaml", "check the path"])?,
        trial(
            "the table beside a scene has vanished",
            "sed 's/ground_motion/vanished/' scenes/seismic.toml >$AT/s.toml; $TG run $AT/s.toml -o $AT/never".into(),
            2,
            &["s.toml:", "vanished.csv", "the path counts from the scene's folder"],
        )?,
    ])
}
