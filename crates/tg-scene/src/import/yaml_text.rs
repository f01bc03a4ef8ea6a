//! YAML to the tree. Scalars stay text, as a node may be called `1` or `yes`. Aliases are refused: a few lines of them
//! can stand for more than fits the memory.

use saphyr_parser::{Event, Parser, Span as YamlSpan};

use crate::error::ReadError;
use crate::node::{Entry, Node, Span, Value};

/// Deeper files are no structure that somebody wrote.
const DEEPEST: usize = 32;

/// A list or table being read, with the key that waits for its value.
struct Open {
    span: Span,
    content: Content,
}

enum Content {
    List(Vec<Node>),
    Table(Vec<Entry>, Option<(String, Span)>),
}

/// Parses the one document of a file. An empty file is an empty table.
pub(super) fn parse(text: &str) -> Result<Node, ReadError> {
    let offsets: Vec<usize> = text.char_indices().map(|(at, _)| at).chain([text.len()]).collect();
    let byte = |index: usize| offsets.get(index).copied().unwrap_or(text.len());
    let bytes = |span: &YamlSpan| byte(span.start.index())..byte(span.end.index());
    let mut open: Vec<Open> = Vec::new();
    let mut root = None;
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| {
            let at = byte(error.marker().index());
            ReadError::new(format!("this is no YAML: {}", error.info())).at(&(at..at))
        })?;
        let span = bytes(&span);
        let done = match event {
            Event::Scalar(value, ..) => Some(Node { value: scalar(&value), span }),
            Event::SequenceStart(..) | Event::MappingStart(..) => {
                if open.len() >= DEEPEST {
                    let message = format!("lists and tables are nested deeper than {DEEPEST}");
                    return Err(ReadError::new(message).at(&span));
                }
                let list = matches!(event, Event::SequenceStart(..));
                let content = if list { Content::List(Vec::new()) } else { Content::Table(Vec::new(), None) };
                open.push(Open { span, content });
                None
            }
            Event::SequenceEnd | Event::MappingEnd => open.pop().map(|open| close(open, &span)),
            Event::Alias(_) => {
                let error = ReadError::new("an alias is not understood here").at(&span);
                return Err(error.help("write the value out"));
            }
            _ => None,
        };
        let Some(node) = done else { continue };
        match open.last_mut() {
            Some(parent) => put(parent, node)?,
            None if root.is_none() => root = Some(node),
            None => {
                let error = ReadError::new("the file has more than one document").at(&node.span);
                return Err(error.help("a structure is one document; put each into a file of its own"));
            }
        }
    }
    Ok(root.unwrap_or(Node { value: Value::Table(Vec::new()), span: 0..0 }))
}

fn scalar(text: &str) -> Value {
    match text {
        "" | "~" | "null" => Value::Null,
        _ => Value::Text(text.into()),
    }
}

fn close(open: Open, end: &Span) -> Node {
    let span = open.span.start..end.end.max(open.span.start);
    let value = match open.content {
        Content::List(list) => Value::List(list),
        Content::Table(entries, _) => Value::Table(entries),
    };
    Node { value, span }
}

fn put(parent: &mut Open, node: Node) -> Result<(), ReadError> {
    match &mut parent.content {
        Content::List(list) => list.push(node),
        Content::Table(entries, waiting) => match waiting.take() {
            Some((key, span)) => entries.push(Entry { key, span, node }),
            None => {
                let Value::Text(key) = node.value else {
                    return Err(ReadError::new("a name is expected before the colon").at(&node.span));
                };
                if entries.iter().any(|entry| entry.key == key) {
                    let error = ReadError::new(format!("the key `{key}` is given twice")).at(&node.span);
                    return Err(error.help("remove one of the two"));
                }
                *waiting = Some((key, node.span));
            }
        },
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_bytes_and_scalars_text() {
        let text = "# größe\nnodes:\n  a: [1, -2.5e1]\n";
        let root = parse(text).unwrap();
        let Value::Table(entries) = &root.value else { panic!() };
        assert_eq!(&text[entries[0].span.clone()], "nodes");
        let Value::Table(nodes) = &entries[0].node.value else { panic!() };
        let Value::List(list) = &nodes[0].node.value else { panic!() };
        assert!(matches!(&list[1].value, Value::Text(text) if text == "-2.5e1"));
        assert_eq!(&text[list[1].span.clone()], "-2.5e1");
    }

    #[test]
    fn nonsense_is_named() {
        for (text, part) in [
            ("a: [1, 2", "no YAML"),
            ("a: 1\na: 2", "`a` is given twice"),
            ("a: &x 1\nb: *x", "alias"),
            ("a: 1\n---\nb: 2", "more than one document"),
            ("[1, 2]: 3", "a name is expected"),
        ] {
            let error = parse(text).unwrap_err();
            assert!(error.message.contains(part), "{text}: {error}");
        }
        assert!(parse(&"[".repeat(10_000)).is_err());
        assert!(matches!(parse("").unwrap().value, Value::Table(list) if list.is_empty()));
    }
}
