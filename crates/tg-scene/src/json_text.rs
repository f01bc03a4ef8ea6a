//! JSON to the tree. Comments are allowed, nothing else that JSON has not.

use std::collections::HashSet;

use jsonc_parser::ast;
use jsonc_parser::common::Ranged;
use jsonc_parser::{CollectOptions, ParseOptions, parse_to_ast};

use crate::error::ReadError;
use crate::node::{Entry, Node, Span, Value};

/// Parses JSON.
pub(crate) fn parse(text: &str) -> Result<Node, ReadError> {
    let options = ParseOptions {
        allow_comments: true,
        allow_loose_object_property_names: false,
        allow_trailing_commas: false,
        allow_missing_commas: false,
        allow_single_quoted_strings: false,
        allow_hexadecimal_numbers: false,
        allow_unary_plus_numbers: false,
        allow_bare_decimal_point_numbers: false,
        allow_non_finite_numbers: false,
        allow_extended_string_escapes: false,
    };
    let parsed = parse_to_ast(text, &CollectOptions::default(), &options).map_err(|error| {
        let range = error.range();
        ReadError::new(error.kind().to_string()).at(&(range.start..range.end))
    })?;
    match parsed.value {
        Some(value) => convert(&value),
        None => Err(ReadError::new("the file is empty").at(&(0..0))),
    }
}

fn span(value: &impl Ranged) -> Span {
    value.start()..value.end()
}

fn convert(value: &ast::Value<'_>) -> Result<Node, ReadError> {
    let span = span(value);
    let value = match value {
        ast::Value::NullKeyword(_) => Value::Null,
        ast::Value::BooleanLit(literal) => Value::Bool(literal.value),
        ast::Value::StringLit(literal) => Value::Text(literal.value.to_string()),
        ast::Value::NumberLit(literal) => number(literal.value, &span)?,
        ast::Value::Array(list) => Value::List(list.elements.iter().map(convert).collect::<Result<_, _>>()?),
        ast::Value::Object(object) => table(object)?,
    };
    Ok(Node { value, span })
}

fn table(object: &ast::Object<'_>) -> Result<Value, ReadError> {
    let mut entries: Vec<Entry> = Vec::with_capacity(object.properties.len());
    let mut known = HashSet::new();
    for property in &object.properties {
        let (key, span) = (property.name.as_str().to_string(), span(&property.name));
        if !known.insert(property.name.as_str()) {
            return Err(ReadError::new(format!("the key `{key}` stands here a second time"))
                .at(&span)
                .help("remove one of the two"));
        }
        entries.push(Entry { key, span, node: convert(&property.value)? });
    }
    Ok(Value::Table(entries))
}

fn number(text: &str, span: &Span) -> Result<Value, ReadError> {
    if let Ok(integer) = text.parse() {
        return Ok(Value::Integer(integer));
    }
    let number = text.parse().map_err(|_| ReadError::new(format!("{text} is no number")).at(span))?;
    Ok(Value::Float(number))
}
