//! Values of a tree of YAML or JSON, with errors that say what was expected.

use crate::error::ReadError;
use crate::node::{Entry, Node, Value};

pub(super) fn table<'n>(node: &'n Node, what: &str) -> Result<&'n [Entry], ReadError> {
    match &node.value {
        Value::Table(entries) => Ok(entries),
        _ => Err(expected(node, what)),
    }
}

pub(super) fn list<'n>(node: &'n Node, what: &str) -> Result<&'n [Node], ReadError> {
    match &node.value {
        Value::List(list) => Ok(list),
        _ => Err(expected(node, what)),
    }
}

pub(super) fn text<'n>(node: &'n Node, what: &str) -> Result<&'n str, ReadError> {
    match &node.value {
        Value::Text(text) => Ok(text),
        _ => Err(expected(node, what)),
    }
}

/// A finite number; YAML's are still text.
pub(super) fn number(node: &Node, what: &str) -> Result<f64, ReadError> {
    let value = match &node.value {
        Value::Integer(value) => Some(*value as f64),
        Value::Float(value) => Some(*value),
        Value::Text(text) => text.parse().ok(),
        _ => None,
    };
    let value = value.ok_or_else(|| expected(node, what))?;
    if value.is_finite() { Ok(value) } else { Err(expected(node, what)) }
}

pub(super) fn positive(node: &Node, what: &str) -> Result<f64, ReadError> {
    let value = number(node, what)?;
    if value > 0.0 {
        return Ok(value);
    }
    Err(ReadError::new(format!("{what} is {value}; it must be positive")).at(&node.span))
}

pub(super) fn not_negative(node: &Node, what: &str) -> Result<f64, ReadError> {
    let value = number(node, what)?;
    if value >= 0.0 {
        return Ok(value);
    }
    Err(ReadError::new(format!("{what} is {value}; it must not be negative")).at(&node.span))
}

/// N numbers.
pub(super) fn numbers<const N: usize>(node: &Node, what: &str) -> Result<[f64; N], ReadError> {
    let given = list(node, what)?;
    if given.len() != N {
        let message = format!("{what} is expected: {N} numbers, not {}", given.len());
        return Err(ReadError::new(message).at(&node.span));
    }
    let mut values = [0.0; N];
    for (value, node) in values.iter_mut().zip(given) {
        *value = number(node, "a number")?;
    }
    Ok(values)
}

/// The value of a key, if it is there and not null.
pub(super) fn get<'n>(entries: &'n [Entry], key: &str) -> Option<&'n Node> {
    let found = entries.iter().find(|entry| entry.key == key).map(|entry| &entry.node);
    found.filter(|node| !matches!(node.value, Value::Null))
}

/// The value of a key that must be there.
pub(super) fn require<'n>(entries: &'n [Entry], key: &str, of: &Node) -> Result<&'n Node, ReadError> {
    get(entries, key).ok_or_else(|| ReadError::new(format!("the key `{key}` is missing")).at(&of.span))
}

/// Refuses keys that are not known and keys given twice.
pub(super) fn only(entries: &[Entry], known: &[&str]) -> Result<(), ReadError> {
    match entries.iter().find(|entry| !known.contains(&entry.key.as_str())) {
        None => Ok(()),
        Some(entry) => {
            let error = ReadError::new(format!("unknown key `{}`", entry.key)).at(&entry.span);
            Err(error.suggest(&entry.key, known))
        }
    }
}

fn expected(node: &Node, what: &str) -> ReadError {
    let found = match &node.value {
        Value::Null => "nothing".into(),
        Value::Bool(value) => format!("`{value}`"),
        Value::Integer(value) => value.to_string(),
        Value::Float(value) => value.to_string(),
        Value::Text(text) => format!("`{text}`"),
        Value::List(_) => "a list".into(),
        Value::Table(_) => "a table".into(),
    };
    ReadError::new(format!("{what} is expected, found {found}")).at(&node.span)
}
