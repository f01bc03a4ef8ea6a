//! `docs/limits.md`, all of it generated.

use std::fmt::Write as _;

use super::axis::Found;
use super::verdict::Verdict;
use crate::bench::page::{digits, table};

const HEAD: &str = "# Limits

Where the library was taken to its extremes, what holds there, what is refused and with which message. Every answer is
compared with something that does not share its code; *right* means within the limit given. What is not right must be
refused by a typed error, or *told* by a number of its report: nothing here is wrong in silence, panics, or does not end.

```console
$ cargo xtask extremes            # --axis WORD for some of it, --quick without what takes long, --write to renew this page
```
";

/// The page.
pub(super) fn page(found: &[Found]) -> String {
    let mut text = HEAD.to_string();
    for found in found {
        let axis = &found.axis;
        // A string takes every write.
        let _ = write!(text, "\n## {}\n\n{}\n\n", axis.title, axis.setup.trim());
        let header = ["at", "verdict", "error", "limit"].map(String::from);
        let mut refusals = Vec::<&str>::new();
        let rows = found.verdicts.iter().map(|(at, verdict)| row(at, verdict, &mut refusals));
        let rows: Vec<_> = rows.collect();
        text += &table(&header, &rows);
        for (k, words) in refusals.iter().enumerate() {
            let _ = write!(text, "\n({}) {words}\n", k + 1);
        }
        if !axis.cause.is_empty() {
            let _ = write!(text, "\n{}\n", axis.cause.trim());
        }
    }
    text
}

/// A row; equal refusals share a note.
fn row<'v>(at: &str, verdict: &'v Verdict, refusals: &mut Vec<&'v str>) -> Vec<String> {
    let mut note = |words: &'v str| {
        let known = refusals.iter().position(|known| *known == words);
        known.unwrap_or_else(|| {
            refusals.push(words);
            refusals.len() - 1
        }) + 1
    };
    let (word, error, limit) = match verdict {
        Verdict::Right { error, limit } => ("right".to_string(), *error, *limit),
        Verdict::Wrong { error, limit } => ("WRONG".to_string(), *error, *limit),
        Verdict::Told { error, limit, words } => (format!("told ({})", note(words)), *error, *limit),
        Verdict::Refused(words) => (format!("refused ({})", note(words)), f64::NAN, f64::NAN),
        Verdict::Panicked(words) => (format!("PANIC ({})", note(words)), f64::NAN, f64::NAN),
        Verdict::Endless => ("ENDLESS".to_string(), f64::NAN, f64::NAN),
    };
    vec![at.to_string(), word, digits(error), digits(limit)]
}
