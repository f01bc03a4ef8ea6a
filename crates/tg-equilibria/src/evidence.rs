//! Evidence that a family's generic solutions are all there are, by methods that know nothing of the start system.

use tg_homotopy::{Complex64, MonodromyOptions, monodromy, trace_test};

use crate::error::EquilibriaError;
use crate::family::Family;

/// Curvature of the trace above which sections are taken to be incomplete: rounding leaves far less, a missing point far
/// more.
const LINEAR: f64 = 1e-8;

/// What monodromy and the trace test say about a family's generic solutions.
#[derive(Clone, Debug)]
pub struct Evidence {
    /// Generic solutions from the start system.
    pub solutions: usize,
    /// Number of solutions in each orbit of monodromy, descending: loops of the parameters exchange those of one orbit.
    /// Each is an irreducible component of the family, or part of one.
    pub orbits: Vec<usize>,
    /// Solutions that monodromy found and the start system did not.
    pub missing: usize,
    /// Bend of the sum of all solutions along a line: zero, up to rounding, if each orbit is a whole component.
    pub curvature: f64,
    /// Whether the section of the trace test yields these solutions and no other.
    pub section_agrees: bool,
}

impl Evidence {
    /// Whether nothing speaks against completeness. Components without any known solution stay unseen by both tests: that
    /// there is none is what the number of paths of the start system vouches for.
    pub fn supports_completeness(&self) -> bool {
        self.missing == 0 && self.section_agrees && self.curvature <= LINEAR
    }
}

impl<const D: usize> Family<'_, D> {
    /// Monodromy from one solution after another, then the trace test; `None` for a family without parameters.
    ///
    /// # Errors
    /// The polynomial solver refuses.
    pub fn evidence(&self) -> Result<Option<Evidence>, EquilibriaError> {
        let instance = self.instance();
        if instance.parameters.is_empty() {
            return Ok(None);
        }
        let options = MonodromyOptions { paths: self.paths().clone(), ..MonodromyOptions::default() };
        let mut left: Vec<&Vec<Complex64>> = instance.solutions.iter().collect();
        let (mut orbits, mut missing) = (Vec::new(), 0);
        while let Some(seed) = left.first() {
            let (filled, _) = monodromy(self.system(), &instance.parameters, &[seed.to_vec()], &options)?;
            let before = left.len();
            left.retain(|known| !filled.solutions.iter().any(|x| near(x, known)));
            if left.len() == before {
                break;
            }
            orbits.push(before - left.len());
            missing += filled.solutions.len().saturating_sub(before - left.len());
        }
        orbits.sort_unstable_by(|a, b| b.cmp(a));
        let trace = trace_test(self.system(), instance, &options)?;
        Ok(Some(Evidence {
            solutions: instance.solutions.len(),
            orbits,
            missing,
            curvature: trace.curvature,
            section_agrees: trace.missing.is_empty() && trace.unreached == 0 && trace.lost == 0,
        }))
    }
}

/// Generic solutions lie far apart.
fn near(a: &[Complex64], b: &[Complex64]) -> bool {
    let size = a.iter().fold(0.0_f64, |m, x| m.max(x.norm()));
    a.iter().zip(b).all(|(a, b)| (a - b).norm() <= 1e-8 * size)
}
