//! What `build()` found.

use std::fmt;

/// Counts of a structure and everything that `build()` left out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BuildReport {
    /// Coordinates n, free and prescribed.
    pub coordinates: usize,
    /// Free coordinates ň.
    pub free: usize,
    /// Intrinsic constraints kept (dot products of members).
    pub intrinsic: usize,
    /// Extrinsic constraints kept (components of joints and of supports at material points).
    pub extrinsic: usize,
    /// Constraints dropped because supports hold all of their coordinates.
    pub dropped_constraints: usize,
    /// Cables left out of the equations because both ends are prescribed.
    pub idle_cables: Vec<String>,
    /// Constraints dropped because others imply them (only with [`Redundancies::Drop`]).
    ///
    /// [`Redundancies::Drop`]: crate::Redundancies::Drop
    pub redundant: Vec<Redundancy>,
    /// Tolerance of the redundancy test: sine of the angle between a constraint's gradient and the span of the others.
    pub redundancy_tolerance: f64,
}

impl BuildReport {
    /// Degrees of freedom: free coordinates less independent constraints.
    pub fn degrees_of_freedom(&self) -> usize {
        self.free - self.intrinsic - self.extrinsic
    }
}

impl fmt::Display for BuildReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} coordinates ({} free), {} intrinsic and {} extrinsic constraints, {} degrees of freedom",
            self.coordinates,
            self.free,
            self.intrinsic,
            self.extrinsic,
            self.degrees_of_freedom()
        )?;
        if self.dropped_constraints > 0 {
            write!(f, "; {} constraints held by supports", self.dropped_constraints)?;
        }
        if !self.idle_cables.is_empty() {
            write!(f, "; idle cables: {}", self.idle_cables.join(", "))?;
        }
        for redundancy in &self.redundant {
            write!(f, "; dropped {redundancy}")?;
        }
        Ok(())
    }
}

/// A constraint whose gradient is a combination of others' in the initial configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Redundancy {
    /// The dependent constraint.
    pub constraint: String,
    /// The constraints that imply it; none if its gradient over the free coordinates vanishes.
    pub implied_by: Vec<String>,
    /// Sine of the angle between its gradient and their span.
    pub sine: f64,
}

impl fmt::Display for Redundancy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        const SHOWN: usize = 6;
        if self.implied_by.is_empty() {
            return write!(
                f,
                "{} is implied by the supports (no free coordinate changes it here)",
                self.constraint
            );
        }
        let shown = self.implied_by.iter().take(SHOWN).map(String::as_str).collect::<Vec<_>>().join(", ");
        write!(f, "{} is implied by {shown}", self.constraint)?;
        match self.implied_by.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => write!(f, " and {more} more"),
        }
    }
}
