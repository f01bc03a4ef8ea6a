//! Texts that would take memory or time without measure end with an error instead.

use tg_scene::{Language, SceneFile};

#[track_caller]
fn assert_refused(text: &str, language: Language, part: &str) {
    let file = SceneFile::parse(text, language, "scene", ".".into());
    let error = file.and_then(|file| file.build(&[])).unwrap_err().to_string();
    assert!(error.contains(part), "{}", error.chars().take(300).collect::<String>());
}

#[test]
fn deep_nesting() {
    let deep = |opening: &str| opening.repeat(50_000);
    for text in [
        format!("a = {}", deep("[")),
        format!("a = {}", deep("{a=")),
        format!("[{}]", vec!["a"; 20_000].join(".")),
        format!("{} = 1", vec!["a"; 20_000].join(".")),
    ] {
        assert_refused(&text, Language::Toml, "recurs");
    }
    assert_refused(&deep("["), Language::Json, "nesting depth");
    assert_refused(&deep("{\"a\":"), Language::Json, "nesting depth");
}

/// Each signal is the one above it twice: 2^60 terms.
#[test]
fn sums_of_sums_of_signals() {
    let mut text = String::from("version = 1\ndimension = 2\n[signals]\ns0 = { sum = [1, 2] }\n");
    for k in 0..60 {
        text += &format!("s{} = {{ sum = [{{ signal = \"s{k}\" }}, {{ signal = \"s{k}\" }}] }}\n", k + 1);
    }
    assert_refused(&text, Language::Toml, "more than 1000000 terms");
}

#[test]
fn arrays_of_arrays_of_arrays() {
    let text = "version = 1\ndimension = 2\n[arrays.a]\ncount = 1000\n[arrays.a.arrays.b]\ncount = 1000\n[arrays.a.arrays.b.arrays.c]\ncount = 1000";
    assert_refused(text, Language::Toml, "more than 100000 copies");
}

/// Ten thousand parameters, each waiting for the next: no more than a moment, and the right value.
#[test]
fn long_chains_of_parameters() {
    let n = 10_000;
    let chain: String = (0..n).map(|k| format!("p{k} = \"p{} + 1\"\n", k + 1)).collect();
    let text = format!("version = 1\ndimension = 2\n[parameters]\n{chain}p{n} = 1\n");
    let file = SceneFile::parse(&text, Language::Toml, "scene", ".".into()).unwrap();
    let values = file.parameters(&[]).unwrap();
    assert_eq!(values[0], ("p0".to_string(), f64::from(n) + 1.0));
    assert_eq!(values.len(), n as usize + 1);
}

#[cfg(unix)]
#[test]
fn files_without_end() {
    let text = "version = 1\ndimension = 2\nsignals.a = { file = { file = '/dev/zero', value = 'a' } }";
    assert_refused(text, Language::Toml, "not a file of at most 256 MiB");
}
