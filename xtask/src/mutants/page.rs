//! `docs/mutants.md`, all of it generated.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use super::{Tally, WANTED};
use crate::bench::page::table;

const HEAD: &str = "# Mutants

Do the tests see what the code does? `cargo mutants` changes the code of the two crates at the bottom in one place after
the other and runs the tests of the crate: a value returned outright, an operator replaced, a branch left out. A mutant
is caught if a test fails or does not end; unviable ones do not compile and do not count.

```console
$ cargo install cargo-mutants --locked
$ cargo mutants            # some hours; settings in .cargo/mutants.toml, --shard 0/8 for an eighth
$ cargo xtask mutants mutants.out          # several folders for several shards, --write to renew this page
```
";

const UNSAFE: &str = "
## Unsafe code

There is none, so Miri and sanitizers have nothing of ours to look at. `unsafe_code = \"forbid\"` holds in the workspace,
and each of its crates takes it over: ";

/// The page: tallies of crates and files, survivors by reason, crates that forbid unsafe code.
pub(super) fn page(
    crates: &BTreeMap<&str, Tally>,
    files: &BTreeMap<&str, Tally>,
    survive: &[(&str, Vec<String>)],
    forbidding: &[String],
) -> String {
    let mut text = HEAD.to_string();
    // A string takes every write.
    let _ = write!(text, "\nWanted are {:.0} % of the viable mutants of each crate.\n\n", 100.0 * WANTED);
    let rows = |tallies: &BTreeMap<&str, Tally>| -> Vec<_> {
        tallies.iter().map(|(name, tally)| row(name, tally)).collect()
    };
    let columns = ["mutants", "unviable", "caught", "without end", "survived", "share caught"];
    let header = |first: &str| [first].into_iter().chain(columns).map(String::from).collect::<Vec<_>>();
    text += &table(&header("crate"), &rows(crates));
    text += "\n## Survivors\n";
    for (reason, mutants) in survive.iter().filter(|(_, mutants)| !mutants.is_empty()) {
        let _ = write!(text, "\n{reason}\n\n");
        for mutant in mutants {
            let _ = writeln!(text, "- `{}`", mutant.replacen("crates/", "", 1).replacen("src/", "", 1));
        }
    }
    text += "\n## By file\n\n";
    text += &table(&header("file"), &rows(files));
    let _ = writeln!(text, "{UNSAFE}{}. `fuzz` and `examples` contain none either.", forbidding.join(", "));
    text
}

fn row(name: &str, tally: &Tally) -> Vec<String> {
    let Tally { unviable, caught, endless, survived } = *tally;
    let counts =
        [unviable + tally.viable(), unviable, caught, endless, survived].map(|count| count.to_string());
    let share = format!("{:.1} %", 100.0 * tally.share());
    let name = name.replacen("crates/", "", 1).replacen("src/", "", 1);
    [name].into_iter().chain(counts).chain([share]).collect()
}
