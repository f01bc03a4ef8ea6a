//! Files of a results folder that are cut off or have a wrong bit.

use std::fs;
use std::path::Path;

use tg_report::Results;

use super::kills::Random;
use super::program::Program;
use super::subject::Subject;
use crate::TaskError;

/// Files, and how many times each is damaged in each way: Parquet parts are large.
const FILES: [(&str, usize); 6] = [
    ("run.json", 150),
    ("parts.json", 150),
    ("checkpoint.json", 150),
    ("frames.ndjson", 100),
    ("journal.bin", 40),
    ("trajectory/part-00000.parquet", 40),
];

/// What came of damaging one file.
pub(super) struct Damage {
    pub(super) file: &'static str,
    /// "cut off" or "a wrong bit".
    pub(super) how: &'static str,
    pub(super) tried: usize,
    /// Refused by a message that names the file.
    pub(super) refused: usize,
    /// Taken for what was written before the damage: rows or frames at the end are left out.
    pub(super) shorter: usize,
    /// As before: nothing was read from that place.
    pub(super) same: usize,
    /// What does not hold.
    pub(super) wrong: Vec<String>,
    /// One message.
    pub(super) message: String,
}

/// Damages each file of a killed run's folder again and again; the library reads it all.
pub(super) fn damages(
    program: &Program,
    subject: &Subject,
    folder: &Path,
    random: &mut Random,
) -> Result<Vec<Damage>, TaskError> {
    let mut found = Vec::new();
    for (file, times) in FILES {
        for how in ["cut off", "a wrong bit"] {
            let path = folder.join(file);
            let whole = fs::read(&path)?;
            let before = read(subject, folder).map_err(|why| format!("{file}: {why}"))?;
            let (tried, wrong, message) = (times, Vec::new(), String::new());
            let mut damage = Damage { file, how, tried, refused: 0, shorter: 0, same: 0, wrong, message };
            for _ in 0..times {
                let mut bytes = whole.clone();
                let at = (random.next() % bytes.len() as u64) as usize;
                match how {
                    "cut off" => bytes.truncate(at),
                    _ => bytes[at] ^= 1 << (random.next() % 8),
                }
                fs::write(&path, &bytes)?;
                damage.add(read(subject, folder), &before, at, program);
            }
            fs::write(&path, &whole)?;
            found.push(damage);
        }
    }
    Ok(found)
}

impl Damage {
    fn add(&mut self, read: Result<Seen, String>, before: &Seen, at: usize, program: &Program) {
        match read {
            Err(why) if why.contains(self.file) || why.contains("not a results folder") => {
                self.refused += 1;
                self.message = program.plain(&why);
            }
            Err(why) => self.wrong.push(format!("byte {at}: {why}")),
            Ok(seen) if seen == *before => self.same += 1,
            Ok(seen) if seen.0 <= before.0 && seen.1 <= before.1 && seen.2 == before.2 => self.shorter += 1,
            Ok(_) => self.wrong.push(format!("byte {at}: something else is read")),
        }
    }
}

/// Rows, frames, and texts of manifest and checkpoint.
type Seen = (usize, usize, [String; 2]);

/// All that a folder holds; rows and frames must be a first part of the undisturbed run's.
fn read(subject: &Subject, folder: &Path) -> Result<Seen, String> {
    let results = Results::open(folder).map_err(|error| error.to_string())?;
    let checkpoint: Option<serde_json::Value> = results.checkpoint().map_err(|error| error.to_string())?;
    let rows = subject.prefix(folder)?;
    let frames = results.frames().map_err(|error| error.to_string())?.len();
    let manifest = serde_json::to_string(&results.manifest).map_err(|error| error.to_string())?;
    Ok((rows, frames, [manifest, checkpoint.map_or_else(String::new, |value| value.to_string())]))
}
