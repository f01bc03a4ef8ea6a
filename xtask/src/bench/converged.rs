//! Where the mast's nodes really go: the symplectic scheme at three and more steps, extrapolated.
//!
//! The scheme is symmetric, so its error has even powers of h only, and each halving removes one more (Romberg):
//! ```text
//! r_{i,0} = q at h/2^i,   r_{i,j} = r_{i,j-1} + (r_{i,j-1} - r_{i-1,j-1}) / (4^j - 1)
//! ```
//! It is kept in a file, since it takes longer than what is measured with it, and held against the reference positions.

use std::fs;
use std::path::Path;

use tg_cases::published::mast;
use tg_integrate::{NewtonOptions, Stepper, Symplectic};

use super::curve::SAMPLES;
use super::scene::{MastRun, Trajectory, error};
use super::scheme::SAMPLE;
use crate::TaskError;

/// Halvings of the paper's step.
const LEVELS: u32 = 4;
/// What the reference positions and the extrapolation may differ by \[m\].
const AGREEMENT: f64 = 1e-9;

/// The converged trajectory from `folder`, or computed and put there.
pub(crate) fn converged(run: &MastRun, folder: &Path) -> Result<Trajectory, TaskError> {
    let path = folder.join(format!("mast-{}-converged.json", run.stages));
    let trajectory = match fs::read(&path) {
        Ok(bytes) => serde_json::from_slice(&bytes)?,
        Err(_) => {
            let (trajectory, left) = extrapolate(run)?;
            eprintln!("mast, N = {}: converged trajectory, last correction {left:.1e} m", run.stages);
            fs::create_dir_all(folder)?;
            fs::write(&path, serde_json::to_vec(&trajectory)?)?;
            trajectory
        }
    };
    let off = off_reference(run.stages, &trajectory);
    if off.is_some_and(|off| off.is_nan() || off > AGREEMENT) {
        return Err(format!(
            "the mast of {} stages: converged and reference positions are {off:?} m apart; delete {} to try again",
            run.stages,
            path.display()
        )
        .into());
    }
    Ok(trajectory)
}

/// Largest distance from the reference positions \[m\], for the sizes that have them.
fn off_reference(stages: usize, trajectory: &Trajectory) -> Option<f64> {
    let reference = mast();
    let known = reference.positions(stages)?;
    let ours: Trajectory =
        reference.t.iter().filter_map(|t| trajectory.get((t / SAMPLE).round() as usize).cloned()).collect();
    let free: Trajectory = known.iter().map(|nodes| nodes[3..].to_vec()).collect();
    Some(error(&ours, &free))
}

/// The trajectory, and what the last extrapolation changed \[m\].
fn extrapolate(run: &MastRun) -> Result<(Trajectory, f64), TaskError> {
    let mut row: Vec<Trajectory> = Vec::new();
    let mut left = f64::NAN;
    for level in 0..LEVELS {
        let mut next = vec![trajectory(run, 10 << level)?];
        for (j, coarser) in row.iter().enumerate() {
            let factor = f64::from(4_u32.pow(j as u32 + 1));
            let refined = combine(factor, coarser, &next[j]);
            next.push(refined);
        }
        if let [.., before, last] = next.as_slice() {
            left = error(before, last);
        }
        row = next;
    }
    row.pop().map(|best| (best, left)).ok_or_else(|| "no trajectory".into())
}

/// The trajectory without the error that is `factor` times smaller in `fine` than in `coarse`.
fn combine(factor: f64, coarse: &Trajectory, fine: &Trajectory) -> Trajectory {
    let value = |c: f64, f: f64| f + (f - c) / (factor - 1.0);
    let point = |(c, f): (&[f64; 3], &[f64; 3])| std::array::from_fn(|d| value(c[d], f[d]));
    let sample = |(c, f): (&Vec<[f64; 3]>, &Vec<[f64; 3]>)| c.iter().zip(f).map(point).collect();
    coarse.iter().zip(fine).map(sample).collect()
}

/// With `steps` steps a sample.
fn trajectory(run: &MastRun, steps: u32) -> Result<Trajectory, TaskError> {
    let scene = &run.scene;
    let options = NewtonOptions { tolerance: 1e-13, ..NewtonOptions::default() };
    let mut stepper = Symplectic::new(scene.mechanics.as_ref(), options)?;
    let mut state = stepper.start(0.0, &scene.q, &scene.v)?;
    let mut samples = vec![run.positions(&state.q)];
    for _ in 1..SAMPLES {
        for _ in 0..steps {
            stepper.step(&mut state, SAMPLE / f64::from(steps))?;
        }
        samples.push(run.positions(&state.q));
    }
    Ok(samples)
}
