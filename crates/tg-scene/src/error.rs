//! What is wrong with a scene, and where.

use std::fmt;

use annotate_snippets::{AnnotationKind, Level, Renderer, Snippet};
use serde::de;
use thiserror::Error;

use crate::deserialize::list;
use crate::node::Span;

/// A mistake in a scene's text: what, where in the text, and what would mend it.
#[derive(Clone, Debug)]
pub(crate) struct ReadError {
    pub(crate) message: String,
    pub(crate) span: Option<Span>,
    pub(crate) help: Option<String>,
}

impl ReadError {
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self { message: message.into(), span: None, help: None }
    }

    /// From an error of the layers below, whose last clause says what would mend it.
    pub(crate) fn from_below(error: &dyn fmt::Display) -> Self {
        let text = error.to_string();
        match text.rsplit_once("; ") {
            Some((message, mend)) => Self::new(message).help(mend),
            None => Self::new(text),
        }
    }

    /// Says where, unless something more precise has been said.
    pub(crate) fn at(self, span: &Span) -> Self {
        self.at_opt(Some(span.clone()))
    }

    pub(crate) fn at_opt(mut self, span: Option<Span>) -> Self {
        self.span = self.span.or(span);
        self
    }

    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Names the nearest of some words, or all of them.
    pub(crate) fn suggest(self, word: &str, words: &[&str]) -> Self {
        match nearest(word, words) {
            Some(found) => self.help(format!("did you mean `{found}`?")),
            None if words.is_empty() => self,
            None if words.len() <= 24 => self.help(format!("known here: {}", list(words))),
            None => self.help(format!("known here: {} and {} more", list(&words[..24]), words.len() - 24)),
        }
    }
}

/// The word most like another, if any is.
fn nearest<'a>(word: &str, words: &[&'a str]) -> Option<&'a str> {
    let likeness = |other: &str| strsim::jaro_winkler(&word.to_lowercase(), &other.to_lowercase());
    let (likeness, found) =
        words.iter().map(|other| (likeness(other), *other)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    (likeness > 0.8).then_some(found)
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ReadError {}

impl de::Error for ReadError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(message.to_string())
    }

    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        Self::new(format!("unknown key `{field}`")).suggest(field, expected)
    }

    fn unknown_variant(variant: &str, expected: &'static [&'static str]) -> Self {
        Self::new(format!("`{variant}` is not known here")).suggest(variant, expected)
    }

    fn missing_field(field: &'static str) -> Self {
        let error = Self::new(format!("the key `{field}` is missing"));
        if matches!(field, "version" | "dimension") {
            return error.help("a scene begins with version = 1 and dimension = 2 or 3");
        }
        error
    }

    fn duplicate_field(field: &'static str) -> Self {
        Self::new(format!("`{field}` is given twice (a key and its alias count as one)"))
            .help("remove one of the two")
    }

    fn invalid_type(unexpected: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::new(format!("expected {}, found {}", plain(&expected.to_string()), found(&unexpected)))
    }

    fn invalid_value(unexpected: de::Unexpected<'_>, expected: &dyn de::Expected) -> Self {
        Self::new(format!("expected {}, found {}", plain(&expected.to_string()), found(&unexpected)))
    }

    fn invalid_length(len: usize, expected: &dyn de::Expected) -> Self {
        Self::new(format!("expected {expected}, found {len} entries"))
    }
}

/// What serde expects, in the words of scene files.
fn plain(expected: &str) -> &str {
    match expected {
        "a sequence" => "a list",
        "a map" => "a table",
        "a string" => "text in quotes",
        "u32" => "a whole number",
        other => other,
    }
}

/// What was found, in the words of scene files.
pub(crate) fn found(unexpected: &de::Unexpected<'_>) -> String {
    match unexpected {
        de::Unexpected::Map => "a table".into(),
        de::Unexpected::Seq => "a list".into(),
        de::Unexpected::Unit => "null".into(),
        de::Unexpected::Bool(value) => format!("`{value}`"),
        de::Unexpected::Signed(value) => format!("the number {value}"),
        de::Unexpected::Unsigned(value) => format!("the number {value}"),
        de::Unexpected::Float(value) => format!("the number {value}"),
        de::Unexpected::Str(text) => format!("the text \"{text}\""),
        other => other.to_string(),
    }
}

/// Why a scene cannot be read or built.
#[derive(Debug, Error)]
pub enum SceneError {
    /// The file cannot be read at all.
    #[error("{path}: {source}; check the path and its permissions")]
    Unreadable {
        /// The file.
        path: String,
        /// The reason.
        source: std::io::Error,
    },
    /// The name says neither TOML nor JSON.
    #[error("{path}: a scene is a .toml or a .json file; other formats: tg import")]
    UnknownFormat {
        /// The file.
        path: String,
    },
    /// Something in the scene is wrong.
    #[error("{0}")]
    Mistake(Box<Mistake>),
}

/// A mistake at a place of a scene file.
#[derive(Clone, Debug)]
pub struct Mistake {
    /// The file, as it was named.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1, in characters.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// What would mend it.
    pub help: Option<String>,
    source: String,
    span: Span,
}

impl Mistake {
    pub(crate) fn new(error: ReadError, file: &str, source: &str) -> Self {
        let span = on_one_line(error.span.unwrap_or(0..0), source);
        let before = &source[..span.start];
        let begin = before.rfind('\n').map_or(0, |at| at + 1);
        Self {
            file: file.into(),
            line: before.matches('\n').count() + 1,
            column: before[begin..].chars().count() + 1,
            message: error.message,
            help: error.help,
            source: source.into(),
            span,
        }
    }

    /// The mistake with the line that it stands in, underlined, and the help beneath.
    pub fn render(&self, colour: bool) -> String {
        let mark = AnnotationKind::Primary.span(self.span.clone());
        let snippet = Snippet::source(self.source.as_str()).path(self.file.as_str()).annotation(mark);
        let mut group = Level::ERROR.primary_title(self.message.as_str()).element(snippet);
        if let Some(help) = &self.help {
            group = group.element(Level::HELP.message(help.as_str()));
        }
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group]).to_string()
    }
}

impl fmt::Display for Mistake {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}:{}: {}", self.file, self.line, self.column, self.message)?;
        self.help.iter().try_for_each(|help| write!(f, "; {help}"))
    }
}

/// A span within the text, cut at the end of its first line: a whole table underlined says nothing.
fn on_one_line(span: Span, source: &str) -> Span {
    let boundary = |mut at: usize| {
        at = at.min(source.len());
        while !source.is_char_boundary(at) {
            at -= 1;
        }
        at
    };
    let start = boundary(span.start);
    let end = boundary(span.end.max(start));
    start..source[start..end].find('\n').map_or(end, |line| start + line)
}
