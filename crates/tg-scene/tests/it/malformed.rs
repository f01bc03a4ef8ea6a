//! Mistakes in scenes: where the error points, what it says and what it advises. Each case is a good scene with one thing
//! wrong. Children: `text`, `values`, `structure`.

mod structure;
mod text;
mod values;

use std::path::Path;

use tg_scene::{Language, Mistake, SceneError, SceneFile};

const TOML: &str = include_str!("data/good.toml");
const JSON: &str = include_str!("data/good.json");
const SPACE: &str = include_str!("data/space.toml");

/// What is wrong with a text that is read, built and asked for its run.
fn result(text: &str, language: Language) -> Result<(), SceneError> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/data");
    let file = SceneFile::parse(text, language, "scene", folder)?;
    file.build(&[])?;
    file.run(&[]).map(|_| ())
}

fn mistake(text: &str, language: Language) -> Mistake {
    match result(text, language) {
        Err(SceneError::Mistake(mistake)) => *mistake,
        other => panic!("{other:?}"),
    }
}

/// Asserts place and beginnings of message and help; an empty help means that there is none.
#[track_caller]
fn assert_mistake(text: &str, language: Language, at: (usize, usize), message: &str, help: &str) {
    let found = mistake(text, language);
    assert_eq!((found.line, found.column), at, "{found}");
    assert!(found.message.starts_with(message), "{}", found.message);
    let advice = found.help.clone().unwrap_or_default();
    assert!(advice.starts_with(help) && advice.is_empty() == help.is_empty(), "{advice}");
    // The picture for terminals shows the line too.
    let line = text.lines().nth(at.0 - 1).unwrap_or_default().trim();
    let picture = found.render(false);
    assert!(picture.contains(&format!("scene:{}:{}", at.0, at.1)) || line.is_empty(), "{picture}");
}

#[track_caller]
fn replaced(good: &str, from: &str, to: &str) -> String {
    assert_eq!(good.matches(from).count(), 1, "{from}");
    good.replace(from, to)
}

/// `wrong!(name, language, from => to, line:column, message, help)` or `wrong!(name, language, whole text, ...)`.
macro_rules! wrong {
    ($name:ident, Toml, $from:literal => $to:literal, $($rest:tt)*) => {
        wrong!(@ $name, Toml, &super::replaced(super::TOML, $from, $to), $($rest)*);
    };
    ($name:ident, Json, $from:literal => $to:literal, $($rest:tt)*) => {
        wrong!(@ $name, Json, &super::replaced(super::JSON, $from, $to), $($rest)*);
    };
    ($name:ident, Space, $from:literal => $to:literal, $($rest:tt)*) => {
        wrong!(@ $name, Toml, &super::replaced(super::SPACE, $from, $to), $($rest)*);
    };
    ($name:ident, $language:ident, whole $text:literal, $($rest:tt)*) => {
        wrong!(@ $name, $language, $text, $($rest)*);
    };
    (@ $name:ident, $language:ident, $text:expr, $line:literal : $column:literal, $message:literal, $help:literal) => {
        #[test]
        fn $name() {
            super::assert_mistake($text, tg_scene::Language::$language, ($line, $column), $message, $help);
        }
    };
}
use wrong;

#[test]
fn the_good_scenes_are_good() {
    result(TOML, Language::Toml).unwrap();
    result(JSON, Language::Json).unwrap();
    result(SPACE, Language::Toml).unwrap();
}

#[test]
fn overrides_name_a_parameter() {
    let file = SceneFile::parse(TOML, Language::Toml, "scene", ".".into()).unwrap();
    let error = file.build(&[("hh".into(), 1.0)]).unwrap_err().to_string();
    assert!(error.contains("no parameter `hh`") && error.contains("did you mean `h`?"), "{error}");
}
