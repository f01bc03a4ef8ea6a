//! The reference page of scene files, made from the schema.

use std::fmt::Write;

use schemars::Schema;
use serde_json::{Map, Value, json};

use crate::schema;

/// The page in Markdown: every table of a scene with its keys, types, units and meanings.
pub fn reference() -> String {
    let schema = schema();
    let root = schema.as_value();
    let mut page = String::from(HEAD);
    section(&mut page, "The scene", root);
    if let Some(Value::Object(definitions)) = root.get("$defs") {
        for (name, definition) in definitions {
            section(&mut page, name, definition);
        }
    }
    page
}

const HEAD: &str = "# Scene files

Generated from the types by `tg schema --markdown`; `tg schema` prints the JSON Schema for editors.

A scene is a TOML (`.toml`) or JSON (`.json`) file. Units are SI: metres, kilograms, seconds, newtons; angles are in radians,
counterclockwise in the plane and right-handed in space. Tension is positive, a bar under compression has a negative axial
force. In the plane x points to the right and y up, in space z up. Unknown keys are errors.

Names are yours. Names of points, anchors and members (bars, bodies, particles) are all different; `\"member.point\"` names a point
of a member. In an array `{i}` in a name or reference stands for the copy's index, `{(i + 1) % 3}` for an expression of it.
";

fn section(page: &mut String, name: &str, schema: &Value) {
    // Writing to a string does not fail.
    let _ = write!(page, "\n## {name}\n\n{}\n", description(schema));
    if let Some(Value::Object(properties)) = schema.get("properties") {
        table(page, properties, schema);
    }
    if let Some(Value::Array(variants)) = schema.get("oneOf") {
        let _ = writeln!(page);
        for variant in variants {
            choice(page, variant);
        }
    }
}

fn table(page: &mut String, properties: &Map<String, Value>, schema: &Value) {
    let required = needed(schema);
    let _ = write!(page, "\n| key | value | meaning |\n|---|---|---|\n");
    for (key, property) in properties.iter().filter(|(_, property)| property.get(ALIAS_OF).is_none()) {
        let needed = if required.contains(&key.as_str()) { " (needed)" } else { "" };
        let others: Vec<String> = properties
            .iter()
            .filter(|(_, other)| other.get(ALIAS_OF).and_then(Value::as_str) == Some(key))
            .map(|(other, _)| format!("`{other}`"))
            .collect();
        let others = if others.is_empty() { String::new() } else { format!(" Also {}.", others.join(", ")) };
        let meaning = description(property).replace('\n', " ").replace('|', "\\|");
        let _ = writeln!(page, "| `{key}`{needed} | {} | {meaning}{others} |", kind(property));
    }
}

/// Needed keys, under their first names.
fn needed(schema: &Value) -> Vec<&str> {
    let plain = schema.get("required").and_then(Value::as_array).into_iter().flatten();
    let choices = schema.get("allOf").and_then(Value::as_array).into_iter().flatten();
    let first = choices.filter_map(|choice| choice.pointer("/anyOf/0/required/0"));
    plain.chain(first).filter_map(Value::as_str).collect()
}

/// One of several forms.
fn choice(page: &mut String, variant: &Value) {
    let meaning = description(variant).replace('\n', " ");
    if let Some(Value::Object(properties)) = variant.get("properties") {
        for (key, content) in properties {
            let _ = writeln!(page, "- `{{ {key} = ... }}`, {}: {meaning}", kind(content));
        }
    } else if let Some(word) = variant.get("const").and_then(Value::as_str) {
        let _ = writeln!(page, "- `\"{word}\"`: {meaning}");
    } else if let Some(Value::Array(words)) = variant.get("enum") {
        let words: Vec<String> =
            words.iter().filter_map(Value::as_str).map(|word| format!("`\"{word}\"`")).collect();
        let _ = writeln!(page, "- {} {meaning}", words.join(", "));
    }
}

fn description(schema: &Value) -> String {
    let text = schema.get("description").and_then(Value::as_str).unwrap_or_default();
    text.replace("\\[", "[").replace("\\]", "]")
}

/// What a value is, in a few words.
fn kind(schema: &Value) -> String {
    if let Some(target) = schema.get("$ref").and_then(Value::as_str) {
        return link(target);
    }
    if let Some(Value::Array(options)) = schema.get("anyOf") {
        let options: Vec<String> = options.iter().map(kind).filter(|kind| !kind.is_empty()).collect();
        return options.join(" or ");
    }
    let of = |key: &str| schema.get(key).map(kind);
    let words = match schema.get("type") {
        Some(Value::String(word)) => vec![word.as_str()],
        Some(Value::Array(words)) => words.iter().filter_map(Value::as_str).collect(),
        _ => return "value".into(),
    };
    let word = |word: &&str| match (*word, of("items"), of("additionalProperties")) {
        ("array", Some(part), _) => format!("list of {part}"),
        ("object", _, Some(part)) => format!("named: {part}"),
        (word, _, _) => plain(word).into(),
    };
    words.iter().filter(|word| **word != "null").map(word).collect::<Vec<_>>().join(" or ")
}

fn plain(word: &str) -> &str {
    match word {
        "string" => "text",
        "integer" => "whole number",
        "boolean" => "true or false",
        "array" => "list",
        "object" => "table",
        other => other,
    }
}

fn link(target: &str) -> String {
    let name = target.rsplit('/').next().unwrap_or(target);
    format!("[{name}](#{})", name.to_lowercase())
}

/// Key of a schema that marks a property as another name.
pub(crate) const ALIAS_OF: &str = "x-alias-of";

/// Adds the other names of keys, which serde takes but the schema does not know.
pub(crate) fn add_aliases(schema: &mut Schema) {
    fn visit(value: &mut Value) {
        if let Some(properties) = value.get_mut("properties").and_then(Value::as_object_mut) {
            let (mut more, mut names) = (Vec::new(), Vec::new());
            for (key, property) in properties.iter() {
                for alias in property.get(ALIASES).and_then(Value::as_array).into_iter().flatten() {
                    let mut copy = property.clone();
                    if let (Some(alias), Some(map)) = (alias.as_str(), copy.as_object_mut()) {
                        map.remove(ALIASES);
                        map.insert(ALIAS_OF.into(), Value::String(key.clone()));
                        more.push((alias.to_string(), copy));
                        names.push((key.clone(), alias.to_string()));
                    }
                }
            }
            for property in properties.values_mut().filter_map(Value::as_object_mut) {
                property.remove(ALIASES);
            }
            properties.extend(more);
            any_name_will_do(value, &names);
        }
        match value {
            Value::Object(map) => map.values_mut().for_each(visit),
            Value::Array(list) => list.iter_mut().for_each(visit),
            _ => {}
        }
    }
    let mut value = std::mem::take(schema).to_value();
    visit(&mut value);
    if let Ok(changed) = Schema::try_from(value) {
        *schema = changed;
    }
}

/// A needed key may be there under another name.
fn any_name_will_do(schema: &mut Value, names: &[(String, String)]) {
    let Some(required) = schema.get_mut("required").and_then(Value::as_array_mut) else { return };
    let mut choices = Vec::new();
    required.retain(|key| {
        let others = names.iter().filter(|(name, _)| Some(name.as_str()) == key.as_str());
        let mut any: Vec<Value> = others.map(|(_, alias)| json!({ "required": [alias] })).collect();
        let keep = any.is_empty();
        if !keep {
            any.insert(0, json!({ "required": [key] }));
            choices.push(json!({ "anyOf": any }));
        }
        keep
    });
    if let (Some(map), false) = (schema.as_object_mut(), choices.is_empty()) {
        map.insert("allOf".into(), Value::Array(choices));
    }
}

/// Key of a property that lists its other names.
const ALIASES: &str = "x-aliases";
