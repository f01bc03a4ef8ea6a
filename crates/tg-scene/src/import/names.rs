//! Names that a scene can use: without braces, which would be expressions, and without repetition.

use std::collections::HashSet;

/// Names that are taken.
#[derive(Debug, Default)]
pub(super) struct Names(HashSet<String>);

impl Names {
    /// The name itself if it is free, else with its kind before it, else with a number after it.
    pub(super) fn take(&mut self, kind: &str, wanted: &str) -> String {
        let clean = clean(wanted);
        let first = if clean.is_empty() { kind.to_string() } else { clean };
        let second = format!("{kind} {first}");
        let numbered = (2..).map(|k: usize| format!("{first} ({k})"));
        let free = [first.clone(), second].into_iter().chain(numbered).find(|name| !self.0.contains(name));
        let name = free.unwrap_or(first);
        self.0.insert(name.clone());
        name
    }

    /// Marks a name as taken.
    pub(super) fn reserve(&mut self, name: &str) {
        self.0.insert(name.into());
    }
}

/// One line without braces; full stops would part a body from its points.
pub(super) fn clean(name: &str) -> String {
    let plain = |c: char| match c {
        '{' => '(',
        '}' => ')',
        '.' => '/',
        c if c.is_control() => ' ',
        c => c,
    };
    name.trim().chars().map(plain).collect()
}
