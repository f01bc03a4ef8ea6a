//! What the numbers were measured on.

use std::fs;
use std::process::Command;

use crate::TaskError;

/// One line: processor, cores, compiler, date.
pub(crate) fn machine() -> Result<String, TaskError> {
    let cpu = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = cpu.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    let cores = std::thread::available_parallelism()?;
    let today = command("date", &["-u", "+%Y-%m-%d"])?;
    let model = model.unwrap_or("unknown processor");
    Ok(format!("{model}, {cores} cores; {}; {today}", rustc()?))
}

/// Version of the compiler.
pub(crate) fn rustc() -> Result<String, TaskError> {
    command("rustc", &["--version"])
}

/// First line of what a program prints.
fn command(program: &str, arguments: &[&str]) -> Result<String, TaskError> {
    let output =
        Command::new(program).args(arguments).output().map_err(|error| format!("{program}: {error}"))?;
    let text = String::from_utf8(output.stdout)?;
    Ok(text.lines().next().unwrap_or_default().to_string())
}
