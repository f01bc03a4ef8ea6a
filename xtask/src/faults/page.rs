//! `docs/faults.md`, all of it generated.

use super::Found;
use super::trial::Trial;
use crate::bench::page::table;

const HEAD: &str = "# Faults

What the program `tg` does when it is killed, when the disk is full, when files vanish or are damaged. Every case is tried; what
is read afterwards is compared bit for bit with an undisturbed run.

```console
$ cargo build --release -p tg-cli
$ cargo run --release -p xtask -- faults     # --kills N, --seed N for other times, --write to renew this page
```

In the commands below `$TG` is the program and `$AT` an empty folder. The exit code is 1 if an analysis or a run failed, 2 if what
was given is wrong: a scene, an argument, a folder. A run that the disk stops has failed.
";

const KILLS: &str = "
## Killed

The run is killed by SIGKILL at random times from its first to its last millisecond, a quarter of them in the first twelfth, a
quarter around the end. Then the library and `tg view` read the folder: what they read is the first part of the undisturbed run. Some
resumed runs are killed again. In the end `--resume` gives the undisturbed rows, frames, checkpoint and manifest (but for the time of
day), bit for bit. A run that was killed before it had computed anything is begun anew.

```console
$ tg run scenes/seismic.toml -o out & sleep 1; kill -9 $!
$ tg view out
$ tg run scenes/seismic.toml -o out --resume
```

";

const SYSTEM: &str = "
## What the system refuses

";

const VANISHED: &str = "
## Files that vanish

`out` is a folder of results of `RUN`. What is missing is told; nothing is shown as if it were whole.

";

const DAMAGED: &str = "
## Files that are damaged

Each file of the folder of a killed run is cut off at a random byte, or has one wrong bit, so many times. *Refused*: the message
names the file. *Shorter*: rows or frames at the end are left out, as after a kill. *As before*: the byte tells nothing, a space say.

```console
$ truncate -s -100 out/trajectory/part-00000.parquet; tg view out
```

";

const END: &str = "
## What holds it together

- Rows go to a journal, each in one write with its checksum; frames are lines with theirs. What was cut off at the end is left out.
- A part of the table is complete, on the disk, and entered in the list of parts with its checksum before the journal is emptied.
- Checkpoint, manifest, pages, plots and exports grow beside their place and are renamed into it when they are complete; what cannot
  be completed is removed again.
- The checkpoint counts the rows and frames before it, which are on the disk before it is. Where one is missing the run is not
  resumed.

## What is not covered

- A power failure cannot be tried here. What is written is brought to the disk in the order above.
- The documents of analyses that take seconds (`answer.json`, `modes.json`, `shapes.json`, `plots.json`) have no checksum: a wrong bit
  that leaves them readable is not seen. They are written whole, and one that vanishes is missed.
- A CRC-32 lets one of four thousand million damages pass; it is no protection against who means harm.
- Two programs that write one folder at the same time are not kept apart.
- `--resume` compares the text of the scene, not of the tables that it names.
";

/// The page.
pub(super) fn page(found: &Found) -> String {
    let mut text = HEAD.to_string() + KILLS;
    let header = [
        "",
        "kills",
        "before any results",
        "amid the rows",
        "of these with a part closed",
        "at the end",
        "too late",
        "resumed runs killed again",
        "read as a first part",
        "resumed bit for bit",
    ]
    .map(String::from);
    let rows: Vec<Vec<String>> = found
        .kills
        .iter()
        .map(|k| {
            let numbers = [k.kills, k.nothing, k.amid, k.parted, k.finishing, k.late, k.again];
            let unread = k.wrong.iter().filter(|why| !why.contains("resumed")).count();
            let judged = [(k.kills + k.again, unread), (k.kills, k.wrong.len() - unread)];
            let judged = judged.map(|(all, wrong)| format!("{} of {all}", all.saturating_sub(wrong)));
            let name = format!("`tg {}` ({} rows)", k.command, k.rows);
            std::iter::once(name).chain(numbers.map(|n| n.to_string())).chain(judged).collect()
        })
        .collect();
    text += &table(&header, &rows);
    text += SYSTEM;
    text += &trials(&found.system);
    text += &VANISHED.replace("RUN", found.kills.first().map_or("", |kills| kills.command.as_str()));
    text += &trials(&found.vanished);
    text += DAMAGED;
    let header =
        ["file", "fault", "tried", "refused", "shorter", "as before", "taken for results"].map(String::from);
    let rows: Vec<Vec<String>> = found
        .damages
        .iter()
        .map(|d| {
            let numbers = [d.tried, d.refused, d.shorter, d.same, d.wrong.len()].map(|n| n.to_string());
            [format!("`{}`", d.file), d.how.to_string()].into_iter().chain(numbers).collect()
        })
        .collect();
    text += &table(&header, &rows);
    text += "\nSome of the messages:\n\n```text\n";
    for damage in found.damages.iter().filter(|damage| !damage.message.is_empty()) {
        text += &format!("error: {}\n", damage.message);
    }
    text + "```\n" + END
}

/// One after another: commands and messages are too long for a table.
fn trials(trials: &[Trial]) -> String {
    let mut text = String::new();
    let mut fault = "";
    for trial in trials {
        if trial.fault != fault {
            fault = trial.fault;
            text += &format!("### {}{}\n\n", fault[..1].to_uppercase(), &fault[1..]);
        }
        let code = trial.code.map_or_else(|| "a signal".to_string(), |code| code.to_string());
        let left = match &trial.left {
            Ok(left) => left.clone(),
            Err(why) => format!("DOES NOT HOLD: {why}"),
        };
        text += &format!("```console\n$ {}\n", trial.command);
        if !trial.message.is_empty() {
            text += &format!("{}\n", trial.message);
        }
        text += &format!("```\n\nExit code {code}; {left}.\n\n");
    }
    text
}
