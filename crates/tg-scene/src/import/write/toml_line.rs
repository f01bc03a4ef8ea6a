//! Keys, values and inline tables of TOML.

/// A number that TOML reads back as the same bits.
pub(super) fn number(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e15 {
        return format!("{}", value as i64);
    }
    format!("{value:?}")
}

pub(super) fn numbers(values: &[f64]) -> String {
    let list: Vec<_> = values.iter().copied().map(number).collect();
    format!("[{}]", list.join(", "))
}

/// A string without control characters in quotes.
pub(super) fn text(value: &str) -> String {
    format!("\"{}\"", value.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A key, bare where TOML allows it.
pub(super) fn key(name: &str) -> String {
    let bare = !name.is_empty() && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-');
    if bare { name.into() } else { text(name) }
}

/// An inline table being written.
#[derive(Debug, Default)]
pub(super) struct Line(Vec<String>);

impl Line {
    pub(super) fn add(&mut self, key: &str, value: &str) {
        self.0.push(format!("{key} = {value}"));
    }

    pub(super) fn add_number(&mut self, key: &str, value: f64) {
        self.add(key, &number(value));
    }

    /// `name = { ... }`
    pub(super) fn of(&self, name: &str) -> String {
        if self.0.is_empty() {
            return format!("{} = {{}}", key(name));
        }
        format!("{} = {{ {} }}", key(name), self.0.join(", "))
    }
}
