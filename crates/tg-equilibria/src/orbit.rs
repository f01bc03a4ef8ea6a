//! Solutions up to the signs of quaternions: e and -e are one rotation.

use tg_homotopy::Complex64;

/// Solutions closer than this (relative to the largest modulus) are one.
const SAME: f64 = 1e-8;

/// One solution of each orbit.
pub(crate) struct Orbits {
    pub(crate) representatives: Vec<Vec<Complex64>>,
    /// Orbits of which not every member was found: a path must have been lost.
    pub(crate) incomplete: usize,
}

impl Orbits {
    pub(crate) fn new(solutions: Vec<Vec<Complex64>>, quaternions: &[[usize; 4]]) -> Self {
        let whole = 1 << quaternions.len();
        let mut orbits: Vec<(Vec<Complex64>, usize)> = Vec::new();
        for solution in solutions {
            match orbits.iter_mut().find(|(first, _)| is_same_rotation(first, &solution, quaternions)) {
                Some((_, found)) => *found += 1,
                None => orbits.push((solution, 1)),
            }
        }
        let incomplete = orbits.iter().filter(|(_, found)| *found != whole).count();
        Self { representatives: orbits.into_iter().map(|(first, _)| first).collect(), incomplete }
    }
}

/// Whether b is a with the signs of some quaternions changed, at least one unless there is none to change.
fn is_same_rotation(a: &[Complex64], b: &[Complex64], quaternions: &[[usize; 4]]) -> bool {
    if quaternions.is_empty() {
        return false;
    }
    let near = SAME * a.iter().fold(0.0_f64, |m, x| m.max(x.norm()));
    let in_quaternion = |k: usize| quaternions.iter().any(|e| e.contains(&k));
    (0..a.len()).filter(|&k| !in_quaternion(k)).all(|k| (a[k] - b[k]).norm() <= near)
        && quaternions.iter().all(|e| {
            e.iter().all(|&k| (a[k] - b[k]).norm() <= near) || e.iter().all(|&k| (a[k] + b[k]).norm() <= near)
        })
}
