//! Queries: from a generic instance with all its solutions to any other parameters.
//!
//! For generic complex p₁ the segment t p₁ + (1 - t) p₀ meets no branch point, so the paths from all solutions at p₁ end at
//! all isolated solutions at p₀ (Morgan & Sommese, *Coefficient-parameter polynomial continuation*, 1989).

use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use crate::batch::{PathOptions, run};
use crate::error::{HomotopyError, check_finite, check_length};
use crate::grouping::Grouping;
use crate::homotopy::Homotopy;
use crate::solve::SolveReport;
use crate::system::PolynomialSystem;

/// Generic complex parameters and all regular solutions there; plain data to be stored beside a family of systems.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GenericInstance {
    /// p₁.
    pub parameters: Vec<Complex64>,
    /// Solutions at p₁.
    pub solutions: Vec<Vec<Complex64>>,
}

/// A family of systems with a generic instance, ready for queries; shared by threads.
#[derive(Clone, Debug)]
pub struct ParameterSolver<'a> {
    system: &'a PolynomialSystem,
    homotopy: Homotopy,
    instance: GenericInstance,
    starts: Vec<Vec<Complex64>>,
    grouping: Option<Grouping>,
    options: PathOptions,
}

impl GenericInstance {
    pub(crate) fn check(&self, system: &PolynomialSystem) -> Result<(), HomotopyError> {
        check_length("generic parameters", system.parameters(), self.parameters.len())?;
        check_finite("generic parameter", &self.parameters)?;
        for x in &self.solutions {
            check_length("generic solution", system.unknowns(), x.len())?;
            check_finite("a coordinate of a generic solution", x)?;
        }
        Ok(())
    }
}

impl<'a> ParameterSolver<'a> {
    /// Prepares queries. With a grouping paths live in projective spaces, which solutions at infinity of special targets
    /// need; without one they are affine, faster where all solutions stay finite.
    pub fn new(
        system: &'a PolynomialSystem,
        instance: GenericInstance,
        grouping: Option<Grouping>,
        options: PathOptions,
    ) -> Result<Self, HomotopyError> {
        instance.check(system)?;
        if let Some(grouping) = &grouping {
            grouping.check(system)?;
        }
        let p = &instance.parameters;
        let homotopy = Homotopy::between(system, p, p, grouping.as_ref())?;
        let starts = instance.solutions.iter().map(|x| homotopy.lift(x)).collect();
        Ok(Self { system, homotopy, instance, starts, grouping, options })
    }

    /// All isolated solutions at `target`.
    pub fn query(&self, target: &[Complex64]) -> Result<SolveReport, HomotopyError> {
        check_length("parameters", self.system.parameters(), target.len())?;
        check_finite("parameter", target)?;
        let mut homotopy = self.homotopy.clone();
        homotopy.set_ends(&self.instance.parameters, target);
        let paths = run(&homotopy, self.system, target, &self.starts, &self.options);
        Ok(SolveReport { paths, grouping: self.grouping.clone() })
    }
}
