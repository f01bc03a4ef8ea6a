//! SIGKILL at random times, and `--resume`.

use std::path::Path;
use std::time::Duration;

use tg_report::Results;

use super::program::Program;
use super::subject::Subject;
use crate::TaskError;

/// What came of the kills of one run.
#[derive(Default)]
pub(super) struct Kills {
    /// The command.
    pub(super) command: String,
    /// Rows of the undisturbed run.
    pub(super) rows: usize,
    pub(super) kills: usize,
    /// The program had ended before.
    pub(super) late: usize,
    /// There was no folder of results yet.
    pub(super) nothing: usize,
    /// Rows were there, but not all.
    pub(super) amid: usize,
    /// A part was closed, and not all rows were there.
    pub(super) parted: usize,
    /// All rows were there: what was killed was the end.
    pub(super) finishing: usize,
    /// Resumed runs that were killed again.
    pub(super) again: usize,
    /// What did not hold.
    pub(super) wrong: Vec<String>,
}

/// Random numbers (splitmix64): the same kills for the same seed.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between 0 and 1.
    pub(super) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Kills a run so many times, each time in a new folder.
pub(super) fn kill(
    program: &Program,
    subject: &Subject,
    kills: usize,
    random: &mut Random,
) -> Result<Kills, TaskError> {
    let folder = program.scratch.join("killed");
    let line = subject.line(Path::new("out"), &[]);
    let mut found = Kills { command: line.join(" "), rows: subject.table.rows(), kills, ..Kills::default() };
    for kill in 0..kills {
        program.free("killed")?;
        // A part of them at the start and at the end, where files come and go.
        let part = random.unit();
        let at = match kill % 4 {
            0 => 0.08 * part,
            1 => 0.85 + 0.2 * part,
            _ => part,
        };
        let mut at = subject.time.mul_f64(at);
        let mut more: &[&str] = &[];
        loop {
            let line = subject.line(&folder, more);
            let killed = program.kill_after(&line.iter().map(String::as_str).collect::<Vec<_>>(), at)?;
            if let Err(why) = look(program, subject, &folder, killed, &mut found)? {
                found.wrong.push(format!("kill {kill} after {} ms: {why}", at.as_millis()));
            }
            more = &["--resume"];
            if random.unit() > 0.3 {
                break;
            }
            found.again += 1;
            at = Duration::from_secs_f64(random.unit() * subject.time.as_secs_f64());
        }
        let line = subject.line(&folder, &["--resume"]);
        let outcome = program.run(&line.iter().map(String::as_str).collect::<Vec<_>>())?;
        let same = match outcome.code {
            Some(0) => subject.same(&folder),
            code => Err(format!("exit code {code:?}: {}", outcome.stderr.trim())),
        };
        if let Err(why) = same {
            found.wrong.push(format!("kill {kill} after {} ms, resumed: {why}", at.as_millis()));
        }
    }
    Ok(found)
}

/// What is left can be read, by the library and by the program, and is a first part of the undisturbed run.
fn look(
    program: &Program,
    subject: &Subject,
    folder: &Path,
    killed: bool,
    found: &mut Kills,
) -> Result<Result<(), String>, TaskError> {
    let page = program.free("page.html")?;
    let view = program.run(&["view", &folder.display().to_string(), "-o", &page.display().to_string()])?;
    let is = if folder.join("run.json").exists() { 0 } else { 2 };
    if view.code != Some(is) {
        return Ok(Err(format!("tg view: exit code {:?}: {}", view.code, view.stderr.trim())));
    }
    if is == 2 {
        found.nothing += 1;
        return Ok(match Results::open(folder) {
            Ok(_) => Err("the library reads what the program refuses".into()),
            Err(_) => Ok(()),
        });
    }
    let rows = match subject.prefix(folder) {
        Ok(rows) => rows,
        Err(why) => return Ok(Err(why)),
    };
    let parts = std::fs::read_dir(folder.join("trajectory")).map_or(0, Iterator::count);
    let all = rows == subject.table.rows();
    found.late += usize::from(!killed);
    found.amid += usize::from(killed && !all);
    found.parted += usize::from(killed && !all && parts > 0);
    found.finishing += usize::from(killed && all);
    if !killed && !all {
        return Ok(Err(format!("ended with {rows} rows")));
    }
    Ok(Ok(()))
}
