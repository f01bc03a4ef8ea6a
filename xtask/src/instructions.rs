//! `instructions`: how many instructions a step takes, against a stored baseline.
//!
//! Times on a shared machine scatter by tens of percent; instructions under callgrind repeat to some 1e-6, so that a
//! loss of two percent is seen. They say nothing about memory or pipelines: `bench` does.
//!
//! The baseline is of the profile `quick`, which the gate has built already. Callgrind sees the machine's instruction sets
//! (but no AVX-512) and the compiler chooses the code, so a count is compared only with one of the same compiler and
//! instruction sets; elsewhere counts are printed and not compared.

pub(crate) mod features;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::{Deserialize, Serialize};
use tg_integrate::{State, StepError, Stepper};

use crate::bench::rustc;
use crate::bench::scene::Scene;
use crate::bench::scheme::{Dial, SCHEMES};
use crate::{TaskError, root};
use features::{Variant, Watched};

/// Where counts are stored.
const BASELINE: &str = "xtask/instructions.json";
/// The task that runs under callgrind.
const TASK: &str = "counted-steps";
/// The function whose instructions are counted; callgrind knows it by this name.
const COUNTED: &str = "xtask::instructions::counted_steps";
/// Instruction sets that code may choose by.
const SETS: [&str; 3] = ["avx2", "fma", "bmi2"];
/// Part by which a count may exceed the baseline.
const TOLERANCE: f64 = 0.02;
/// Steps before the counted ones: past the start a step has its usual iterations.
const BEFORE: u32 = 3;

/// Counted steps of each variant.
const FEATURE_STEPS: u32 = 50;

/// Instructions per step, by structure and scheme, and what they depend on.
#[derive(Deserialize, Serialize)]
struct Baseline {
    profile: String,
    rustc: String,
    instruction_sets: Vec<String>,
    per_step: BTreeMap<String, BTreeMap<String, u64>>,
}

/// Structures and counted steps.
fn scenes() -> Result<[(Scene, u32); 3], TaskError> {
    Ok([(Scene::mast(8)?, 20), (Scene::mast(32)?, 8), (Scene::example3()?, 20)])
}

/// The stored counts of a structure, or of the group of features.
pub(crate) fn stored(group: &str) -> Result<BTreeMap<String, u64>, TaskError> {
    let mut baseline: Baseline = serde_json::from_slice(&fs::read(root().join(BASELINE))?)?;
    Ok(baseline.per_step.remove(group).ok_or("no counts of that name are stored")?)
}

/// Counts and compares, or stores the counts; true if none has grown.
pub(crate) fn check(bless: bool) -> Result<bool, TaskError> {
    let path = root().join(BASELINE);
    let now = count()?;
    if bless {
        fs::write(&path, serde_json::to_string_pretty(&now)? + "\n")?;
        println!("{} written", path.display());
        return Ok(true);
    }
    let before: Baseline = serde_json::from_slice(&fs::read(&path)?)?;
    let reason = difference(&before, &now);
    let mut holds = true;
    for (scene, schemes) in &now.per_step {
        for (scheme, &count) in schemes {
            let stored = before.per_step.get(scene).and_then(|schemes| schemes.get(scheme));
            let share = stored.map_or(f64::NAN, |&stored| count as f64 / stored as f64 - 1.0);
            let grown = reason.is_none() && (share.is_nan() || share > TOLERANCE);
            holds &= !grown;
            let sign = if grown { "  TOO MANY" } else { "" };
            println!("{scene}, {scheme}: {count} instructions a step, {:+.2} %{sign}", 100.0 * share);
        }
    }
    match reason {
        Some(reason) => println!("not compared: {reason}"),
        None if !holds => println!("if that is meant: {} --bless, and say why in the commit", command_line()),
        None => {}
    }
    Ok(holds)
}

/// Why two counts cannot be compared.
fn difference(before: &Baseline, now: &Baseline) -> Option<String> {
    if before.profile != now.profile {
        Some(format!("the baseline is of the profile {}: run {}", before.profile, command_line()))
    } else if before.rustc != now.rustc {
        Some(format!("the baseline was made with {}, this is {}", before.rustc, now.rustc))
    } else if before.instruction_sets != now.instruction_sets {
        Some(format!("the baseline was made with the instruction sets {:?}", before.instruction_sets))
    } else {
        None
    }
}

fn command_line() -> &'static str {
    "cargo build --profile quick -p xtask && target/quick/xtask instructions"
}

/// Runs this program under callgrind: one dump at the end of each counted call.
fn count() -> Result<Baseline, TaskError> {
    let program = std::env::current_exe()?;
    let folder = program.parent().ok_or("no folder")?;
    let profile = folder.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let dumps = folder.join("callgrind");
    if dumps.exists() {
        fs::remove_dir_all(&dumps)?;
    }
    fs::create_dir_all(&dumps)?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--collect-atstart=no"])
        .arg(format!("--toggle-collect={COUNTED}"))
        .arg(format!("--dump-after={COUNTED}"))
        .arg(format!("--callgrind-out-file={}", dumps.join("steps").display()))
        .arg(&program)
        .arg(TASK)
        .output()
        .map_err(|error| format!("valgrind: {error}; apt-get install valgrind"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into());
    }
    let mut per_step = BTreeMap::<String, BTreeMap<String, u64>>::new();
    // Dumps are numbered in the order of the calls.
    for (dump, line) in (1..).zip(String::from_utf8(output.stdout)?.lines()) {
        let (steps, rest) = line.split_once('\t').ok_or("steps and names expected")?;
        let (scene, scheme) = rest.split_once('\t').ok_or("two names expected")?;
        let total = total(&dumps.join(format!("steps.{dump}")))?;
        per_step.entry(scene.into()).or_default().insert(scheme.into(), total / steps.parse::<u64>()?);
    }
    Ok(Baseline { profile, rustc: rustc()?, instruction_sets: instruction_sets()?, per_step })
}

/// Instructions of a dump.
fn total(dump: &PathBuf) -> Result<u64, TaskError> {
    let text = fs::read_to_string(dump).map_err(|error| format!("{}: {error}", dump.display()))?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals: "));
    Ok(total.ok_or("a dump without totals")?.trim().parse()?)
}

fn instruction_sets() -> Result<Vec<String>, TaskError> {
    let cpu = fs::read_to_string(Path::new("/proc/cpuinfo"))?;
    let flags = cpu.lines().find(|line| line.starts_with("flags")).unwrap_or_default();
    let has = |set: &&str| flags.split_whitespace().any(|flag| flag == *set);
    Ok(SETS.into_iter().filter(has).map(String::from).collect())
}

/// Under callgrind: steps every structure with every scheme and prints what was stepped.
pub(crate) fn in_child() -> Result<bool, TaskError> {
    for (scene, steps) in scenes()? {
        for scheme in &SCHEMES {
            let (mut stepper, mut state) = scheme.start(&scene, Dial::PAPER)?;
            for _ in 0..BEFORE {
                stepper.step(&mut state, Dial::PAPER.step())?;
            }
            counted_steps(stepper.as_mut(), &mut state, steps)?;
            println!("{steps}\t{}\t{}", scene.name, scheme.name);
        }
    }
    for variant in features::variants()? {
        let stepper = step_variant(&variant)?;
        // What was seen must be used.
        assert!(stepper.seen.is_finite());
        println!("{FEATURE_STEPS}\t{}\t{}", features::GROUP, variant.name);
    }
    Ok(true)
}

/// The counted steps of a variant, after some others.
fn step_variant(variant: &Variant) -> Result<Watched<'_>, TaskError> {
    let mut stepper = Watched::new(variant)?;
    let mut state = stepper.begin()?;
    for _ in 0..BEFORE {
        stepper.step(&mut state, Dial::PAPER.step())?;
    }
    stepper.iterations = 0;
    counted_steps(&mut stepper, &mut state, FEATURE_STEPS)?;
    Ok(stepper)
}

/// Newton iterations in a counted step of a variant.
pub(crate) fn iterations(variant: &Variant) -> Result<f64, TaskError> {
    Ok(f64::from(step_variant(variant)?.iterations) / f64::from(FEATURE_STEPS))
}

/// What callgrind counts: found by its name, so it must stay a function.
#[inline(never)]
fn counted_steps(stepper: &mut dyn Stepper, state: &mut State, steps: u32) -> Result<(), StepError> {
    (0..steps).try_for_each(|_| stepper.step(state, Dial::PAPER.step()).map(drop))
}
