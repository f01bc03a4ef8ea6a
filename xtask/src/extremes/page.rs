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
    let mut text = HEAD.to_string() + &summary(found);
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

/// How many answers of each axis were right, told, refused or none of these.
fn summary(found: &[Found]) -> String {
    let mut total = [0; 4];
    let rows = found.iter().map(|found| {
        let mut counts = [0; 4];
        for (_, verdict) in &found.verdicts {
            let column = match verdict {
                Verdict::Right { .. } => 0,
                Verdict::Told { .. } => 1,
                Verdict::Refused(_) => 2,
                Verdict::Wrong { .. } | Verdict::Panicked(_) | Verdict::Endless => 3,
            };
            counts[column] += 1;
            total[column] += 1;
        }
        let title = format!("[{}](#{})", found.axis.title, anchor(found.axis.title));
        [title].into_iter().chain(counts.map(|count| count.to_string())).collect()
    });
    let header = ["axis", "right", "told", "refused", "wrong, panic or endless"].map(String::from);
    let rows = table(&header, &rows.collect::<Vec<_>>());
    let [right, told, refused, wrong] = total;
    format!("\n{right} answers are right, {told} told, {refused} refused, {wrong} none of these.\n\n{rows}")
}

/// What a heading is linked by.
fn anchor(title: &str) -> String {
    let kept = title.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>().to_lowercase()
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
