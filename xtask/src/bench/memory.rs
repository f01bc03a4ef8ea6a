//! Peak memory of a process that steps a large mast, asked of a child so that nothing else is counted.

use std::process::Command;

use super::scene::Scene;
use super::scheme::{Dial, SCHEMES};
use crate::TaskError;

/// The task that the child runs.
pub(crate) const TASK: &str = "peak-memory";

/// Peak memory of `steps` steps of the mast with a scheme \[MB\], building included.
pub(crate) fn peak(stages: usize, scheme: usize) -> Result<f64, TaskError> {
    let child = Command::new(std::env::current_exe()?)
        .args([TASK, &stages.to_string(), &scheme.to_string()])
        .output()?;
    if !child.status.success() {
        return Err(String::from_utf8_lossy(&child.stderr).into());
    }
    Ok(String::from_utf8(child.stdout)?.trim().parse()?)
}

/// In the child: a few steps, then the high-water mark that the kernel kept.
pub(crate) fn in_child(stages: usize, scheme: usize) -> Result<bool, TaskError> {
    let scene = Scene::mast(stages)?;
    let scheme = SCHEMES.get(scheme).ok_or("no such scheme")?;
    let (mut stepper, mut state) = scheme.start(&scene, Dial::PAPER)?;
    for _ in 0..3 {
        stepper.step(&mut state, Dial::PAPER.step())?;
    }
    let status = std::fs::read_to_string("/proc/self/status")?;
    let kilobytes = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes: f64 =
        kilobytes.and_then(|rest| rest.split_whitespace().next()).ok_or("no VmHWM")?.parse()?;
    println!("{}", kilobytes / 1e3);
    Ok(true)
}
