//! What is generated from the types is what is in the repository, and every command teaches.

use std::path::Path;

use crate::{run, text};

fn same_as_file(arguments: &[&str], file: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(file);
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    let expected = text(&run(arguments).stdout);
    assert!(found == expected, "{file} is not up to date: tg {} > {file}", arguments.join(" "));
}

#[test]
fn the_reference_page_is_up_to_date() {
    same_as_file(&["schema", "--markdown"], "docs/scenes.md");
}

#[test]
fn the_schema_is_up_to_date() {
    same_as_file(&["schema"], "docs/scene.schema.json");
}

#[test]
fn every_command_has_help_and_a_manual_page() {
    let folder = tempfile::tempdir().unwrap();
    assert!(run(&["man", "-o", folder.path().to_str().unwrap()]).status.success());
    for command in [
        "check",
        "statics",
        "modes",
        "run",
        "equilibria",
        "sweep",
        "view",
        "plot",
        "export",
        "import",
        "schema",
        "completions",
        "man",
    ] {
        let help = text(&run(&[command, "--help"]).stdout);
        assert!(help.contains("Usage: tg") && help.len() > 200, "{command}: {help}");
        assert!(folder.path().join(format!("tg-{command}.1")).exists(), "{command}");
    }
    assert!(text(&run(&["man"]).stdout).contains(".TH"));
}

#[test]
fn completions_are_there_for_every_shell() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        assert!(text(&run(&["completions", shell]).stdout).contains("equilibria"), "{shell}");
    }
}
