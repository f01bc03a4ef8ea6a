//! `layers`: the allowed dependency edges between crates, compared with what cargo says.

use std::process::Command;

use serde::Deserialize;

use crate::TaskError;

/// Each crate and the workspace crates that it may use, lowest layer first.
const ALLOWED: [(&str, &[&str]); 16] = [
    ("tg-coords", &[]),
    ("tg-sparse", &[]),
    ("tg-model", &["tg-coords", "tg-sparse"]),
    ("tg-tangent", &["tg-model", "tg-sparse"]),
    ("tg-statics", &["tg-model", "tg-sparse", "tg-tangent"]),
    ("tg-modal", &["tg-coords", "tg-model", "tg-tangent"]),
    ("tg-homotopy", &[]),
    ("tg-equilibria", &["tg-homotopy", "tg-model", "tg-statics", "tg-tangent"]),
    ("tg-integrate", &["tg-model", "tg-sparse"]),
    ("tg-fixtures", &["tg-coords", "tg-model"]),
    ("tg-scene", &["tg-coords", "tg-model"]),
    ("tg-trade", &["tg-integrate", "tg-model", "tg-scene"]),
    ("tg-report", &[]),
    (
        "tg-cli",
        &[
            "tg-coords",
            "tg-equilibria",
            "tg-integrate",
            "tg-modal",
            "tg-model",
            "tg-report",
            "tg-scene",
            "tg-statics",
            "tg-trade",
        ],
    ),
    (
        "tg-cases",
        &[
            "tg-coords",
            "tg-model",
            "tg-tangent",
            "tg-statics",
            "tg-modal",
            "tg-equilibria",
            "tg-integrate",
            "tg-fixtures",
        ],
    ),
    (
        "xtask",
        &[
            "tg-cases",
            "tg-coords",
            "tg-equilibria",
            "tg-fixtures",
            "tg-homotopy",
            "tg-integrate",
            "tg-modal",
            "tg-model",
            "tg-report",
            "tg-scene",
            "tg-sparse",
            "tg-statics",
            "tg-tangent",
            "tg-trade",
        ],
    ),
];

/// Crates whose ordinary dependencies must not lead to a crate of this name: faer is most of the build time.
const WITHOUT_FAER: [&str; 4] = ["tg-coords", "tg-sparse", "tg-model", "tg-scene"];

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

#[derive(Deserialize)]
struct Package {
    name: String,
    dependencies: Vec<Dependency>,
}

#[derive(Deserialize)]
struct Dependency {
    name: String,
    /// `dev`, `build`, or none for ordinary dependencies.
    kind: Option<String>,
}

/// True if every edge between workspace crates is allowed and every allowed crate exists.
pub(crate) fn check() -> Result<bool, TaskError> {
    let output = cargo(&["metadata", "--format-version", "1", "--no-deps"])?;
    let metadata: Metadata = serde_json::from_str(&output)?;
    let ours: Vec<&str> = metadata.packages.iter().map(|package| package.name.as_str()).collect();
    let mut wrong = Vec::new();
    for package in &metadata.packages {
        let Some((_, allowed)) = ALLOWED.iter().find(|(name, _)| *name == package.name) else {
            wrong.push(format!(
                "{} is not in the list of layers; add it with the crates it may use",
                package.name
            ));
            continue;
        };
        let edges =
            package.dependencies.iter().filter(|d| d.kind.is_none() && ours.contains(&d.name.as_str()));
        for edge in edges.filter(|edge| !allowed.contains(&edge.name.as_str())) {
            wrong.push(format!("{} uses {}, which its layer does not allow", package.name, edge.name));
        }
    }
    for name in WITHOUT_FAER {
        let tree = cargo(&["tree", "--package", name, "--edges", "normal", "--prefix", "none"])?;
        if tree.lines().any(|line| line.starts_with("faer ")) {
            wrong.push(format!(
                "{name} leads to faer; keep it behind the feature that solver crates switch on"
            ));
        }
    }
    for line in &wrong {
        println!("{line}");
    }
    if wrong.is_empty() {
        println!("the layers hold: {}", ALLOWED.map(|(name, _)| name).join(", "));
    }
    Ok(wrong.is_empty())
}

fn cargo(arguments: &[&str]) -> Result<String, TaskError> {
    let program = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
    let output = Command::new(program).args(arguments).output()?;
    if output.status.success() {
        Ok(String::from_utf8(output.stdout)?)
    } else {
        Err(format!("cargo {}: {}", arguments.join(" "), String::from_utf8_lossy(&output.stderr)).into())
    }
}
