//! The floor program: C++ written for the mast alone, to see how near a general code comes. It is not part of this
//! repository; where it or its compiler is missing the comparison is left out.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use super::curve::{Point, SAMPLES};
use super::export;
use super::scene::{MastRun, Trajectory, error};
use super::scheme::SAMPLE;
use crate::TaskError;

/// A way to run the floor program.
pub(crate) struct Variant {
    pub(crate) name: &'static str,
    /// MODE of its command line.
    mode: &'static str,
    /// What follows the step and the damping factor.
    rest: &'static [&'static str],
    /// Evaluations of the accelerations in a step, where steps consist of them.
    pub(crate) evaluations: f64,
}

/// What is compared with.
pub(crate) const VARIANTS: [Variant; 4] = [
    Variant { name: "imp 10 kept, 1e-12", mode: "imp", rest: &["10", "1e-12"], evaluations: 1.0 },
    Variant { name: "imp 10 kept, 1e-10", mode: "imp", rest: &["10", "1e-10"], evaluations: 1.0 },
    Variant { name: "shake, 2 iterations", mode: "shake", rest: &["2"], evaluations: 1.0 },
    Variant { name: "exp, RK4", mode: "exp", rest: &[], evaluations: 4.0 },
];

/// The compiled program.
pub(crate) struct Floor {
    program: PathBuf,
    folder: PathBuf,
}

#[derive(Deserialize)]
struct Answer {
    us_step: f64,
}

impl Floor {
    /// Compiles `source`; the reason in words if that cannot be done.
    pub(crate) fn compile(source: &Path, folder: &Path) -> Result<Self, String> {
        if !source.exists() {
            return Err(format!("{} does not exist", source.display()));
        }
        std::fs::create_dir_all(folder).map_err(|error| error.to_string())?;
        let program = folder.join("floor");
        let changed = |path: &Path| path.metadata().and_then(|file| file.modified()).ok();
        // Compiling takes longer than many a run.
        if changed(&program).is_some_and(|compiled| Some(compiled) > changed(source)) {
            return Ok(Self { program, folder: folder.into() });
        }
        let output = Command::new("g++")
            .args(["-O3", "-march=native", "-I/usr/include/eigen3", "-o"])
            .arg(&program)
            .arg(source)
            .output()
            .map_err(|error| format!("g++: {error}"))?;
        if output.status.success() {
            Ok(Self { program, folder: folder.into() })
        } else {
            Err("it does not compile: apt-get install g++ libeigen3-dev nlohmann-json3-dev".into())
        }
    }

    /// µs per step in a run of 2 s with `steps` steps a sample.
    pub(crate) fn micros(&self, run: &MastRun, variant: &Variant, steps: u32) -> Result<f64, TaskError> {
        let scene = export::scene(&run.numbers(), &self.folder)?;
        let output = Command::new(&self.program)
            .args([&scene, &self.positions()])
            .args([variant.mode, &format!("{:e}", SAMPLE / f64::from(steps)), "1"])
            .args(variant.rest)
            .output()?;
        if !output.status.success() {
            return Err(format!("floor program: {}", String::from_utf8_lossy(&output.stderr)).into());
        }
        Ok(serde_json::from_slice::<Answer>(&output.stdout)?.us_step)
    }

    /// The same as a point of a curve.
    fn point(
        &self,
        run: &MastRun,
        variant: &Variant,
        steps: u32,
        converged: &Trajectory,
    ) -> Result<Point, TaskError> {
        let micros = self.micros(run, variant, steps)?;
        let trajectory = samples(&std::fs::read(self.positions())?, 3 * (run.stages + 1));
        Ok(Point {
            tool: "floor".into(),
            variant: variant.name.into(),
            dial: format!("{:.3e} s", SAMPLE / f64::from(steps)),
            seconds: 1e-6 * micros * f64::from(steps) * (SAMPLES - 1) as f64,
            error: error(&trajectory, converged),
        })
    }

    /// Where the program writes its trajectory.
    fn positions(&self) -> PathBuf {
        self.folder.join("floor.bin")
    }

    /// Points of all variants, as far as a run stays below `limit` seconds.
    pub(crate) fn curves(
        &self,
        run: &MastRun,
        converged: &Trajectory,
        limit: f64,
    ) -> Result<Vec<Point>, TaskError> {
        let mut points = Vec::new();
        for variant in &VARIANTS {
            for steps in [1, 2, 5, 10, 20, 40, 80] {
                let point = self.point(run, variant, steps, converged)?;
                let seconds = point.seconds;
                // Too large a step of an explicit scheme.
                if point.error.is_finite() {
                    points.push(point);
                }
                if 2.0 * seconds > limit {
                    break;
                }
            }
        }
        Ok(points)
    }
}

/// The program writes the levels' nodes, the feet included, sample by sample.
fn samples(bytes: &[u8], nodes: usize) -> Trajectory {
    let numbers: Vec<f64> =
        bytes.chunks_exact(8).map(|chunk| f64::from_le_bytes(std::array::from_fn(|k| chunk[k]))).collect();
    numbers
        .chunks_exact(3 * nodes)
        .map(|sample| sample.chunks_exact(3).skip(3).map(|x| [x[0], x[1], x[2]]).collect())
        .collect()
}
