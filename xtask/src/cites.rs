//! `cites`: the headings of `docs/accuracy-and-speed.md` that the code cites beside its default settings are there.

use std::fs;
use std::path::Path;

use crate::trade::PAGE;
use crate::{TaskError, root};

/// Looks through the crates' sources; true if every heading is found.
pub(crate) fn check() -> Result<bool, TaskError> {
    let page = fs::read_to_string(root().join(PAGE))?;
    let headings: Vec<&str> = page
        .lines()
        .filter(|line| line.starts_with('#'))
        .map(|line| line.trim_start_matches(['#', ' ']))
        .collect();
    let (mut cites, mut holds) = (0, true);
    let mut look = |path: &Path, text: &str| {
        for heading in cited(text) {
            cites += 1;
            if !headings.contains(&heading.as_str()) {
                println!("{}: {PAGE} has no heading {heading:?}", path.display());
                holds = false;
            }
        }
    };
    for krate in fs::read_dir(root().join("crates"))? {
        sources(&krate?.path().join("src"), &mut look)?;
    }
    if cites == 0 {
        return Err("no source cites the page".into());
    }
    if holds {
        println!("{cites} cited headings are there");
    }
    Ok(holds)
}

/// Every Rust file of a folder and its folders.
fn sources(folder: &Path, look: &mut impl FnMut(&Path, &str)) -> Result<(), TaskError> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            sources(&path, look)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            look(&path, &fs::read_to_string(&path)?);
        }
    }
    Ok(())
}

/// Headings in quotation marks behind the page's name, which comments may break over lines.
fn cited(text: &str) -> Vec<String> {
    let lines = text.lines().map(|line| line.trim_start().trim_start_matches(['/', '!']));
    let words = lines.flat_map(str::split_whitespace).collect::<Vec<_>>().join(" ");
    let mark = format!("{PAGE}, \"");
    words.split(&mark).skip(1).filter_map(|rest| Some(rest.split_once('"')?.0.to_string())).collect()
}
