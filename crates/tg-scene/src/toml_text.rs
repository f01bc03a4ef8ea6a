//! TOML to the tree.

use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use crate::error::ReadError;
use crate::node::{Entry, Node, Value};

/// Parses TOML.
pub(crate) fn parse(text: &str) -> Result<Node, ReadError> {
    let table = DeTable::parse(text).map_err(|error| grammar(&error, text))?;
    let span = table.span();
    Ok(Node { value: convert_table(table.get_ref())?, span })
}

fn grammar(error: &toml::de::Error, text: &str) -> ReadError {
    let span = error.span();
    let key = span.clone().and_then(|span| text.get(span)).unwrap_or_default();
    if error.message() == "duplicate key" && !key.is_empty() {
        let error = ReadError::new(format!("the key `{key}` stands here a second time"));
        return error.at_opt(span).help("remove one of the two");
    }
    ReadError::new(error.message().replace('\n', "; ")).at_opt(span)
}

fn convert_table(table: &DeTable<'_>) -> Result<Value, ReadError> {
    let mut entries = Vec::with_capacity(table.len());
    for (key, value) in table {
        entries.push(Entry { key: key.get_ref().to_string(), span: key.span(), node: convert(value)? });
    }
    entries.sort_by_key(|entry| entry.span.start);
    Ok(Value::Table(entries))
}

fn convert(value: &Spanned<DeValue<'_>>) -> Result<Node, ReadError> {
    let span = value.span();
    let value = match value.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Boolean(value) => Value::Bool(*value),
        DeValue::Integer(number) => Value::Integer(integer(number).ok_or_else(|| {
            ReadError::new("the integer does not fit 64 bits").at(&span).help("write it as 1.0e30")
        })?),
        // Only what the grammar has passed arrives here.
        DeValue::Float(number) => Value::Float(number.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Array(list) => Value::List(list.iter().map(convert).collect::<Result<_, _>>()?),
        DeValue::Table(table) => convert_table(table)?,
        DeValue::Datetime(_) => {
            let help = "a scene has no dates; put text in quotes";
            return Err(ReadError::new("a date is not expected here").at(&span).help(help));
        }
    };
    Ok(Node { value, span })
}

fn integer(number: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(number.as_str(), number.radix()).ok()
}
