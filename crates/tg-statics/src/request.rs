//! What is asked of inverse statics: the unknowns, what is given or tied, what to aim at.

use tg_model::Tensioned;

use crate::inverse_error::InverseError;

/// The unknowns of inverse statics, in which norms and ties are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unknown {
    /// Tensions f \[N\].
    Tension,
    /// Force densities γ = f/l \[N/m\], eq. (32).
    ForceDensity,
    /// Rest lengths μ \[m\], eq. (34); all cables must have linear laws.
    RestLength,
}

/// A value that is given for a cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given {
    /// Tension f \[N\].
    Tension(f64),
    /// Force density γ \[N/m\].
    ForceDensity(f64),
    /// Rest length μ \[m\].
    RestLength(f64),
}

impl Given {
    pub(crate) fn tension(self, structure: &dyn Tensioned, cable: usize, length: f64) -> f64 {
        match self {
            Self::Tension(f) => f,
            Self::ForceDensity(density) => density * length,
            // Taut, whatever the law would say: a rest length beyond the length is a push, and shows as one.
            Self::RestLength(rest) => match structure.linear_stiffness(cable) {
                Some(stiffness) => stiffness * (length - rest),
                None => structure.static_tension(cable, length, rest),
            },
        }
    }
}

/// Which solution to choose.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Goal {
    /// The least sum of squares of the unknowns.
    #[default]
    MinimumNorm,
    /// The least sum of squared distances from these values of the unknowns, one per cable.
    Closest(Vec<f64>),
    /// The least sum of tensions; it needs bounds.
    LeastTotalTension,
}

/// A request to inverse statics.
#[derive(Clone, Debug)]
pub struct Request {
    pub(crate) unknown: Unknown,
    pub(crate) given: Vec<(usize, Given)>,
    pub(crate) tied: Vec<Vec<usize>>,
    pub(crate) goal: Goal,
    pub(crate) bounds: Option<(f64, f64)>,
    pub(crate) cable_bounds: Vec<(usize, (f64, f64))>,
    pub(crate) tolerance: Option<f64>,
}

impl Request {
    /// The minimum-norm solution in these unknowns, nothing given.
    pub fn new(unknown: Unknown) -> Self {
        Self {
            unknown,
            given: Vec::new(),
            tied: Vec::new(),
            goal: Goal::MinimumNorm,
            bounds: None,
            cable_bounds: Vec::new(),
            tolerance: None,
        }
    }

    /// Gives a value for a cable (its index).
    #[must_use]
    pub fn give(mut self, cable: usize, value: Given) -> Self {
        self.given.push((cable, value));
        self
    }

    /// Ties cables (their indices): their unknowns are equal.
    #[must_use]
    pub fn tie(mut self, cables: &[usize]) -> Self {
        self.tied.push(cables.to_vec());
        self
    }

    /// Chooses the solution closest to these values of the unknowns, one per cable.
    #[must_use]
    pub fn closest_to(mut self, values: &[f64]) -> Self {
        self.goal = Goal::Closest(values.to_vec());
        self
    }

    /// Bounds every tension \[N\] from below and above; an infinite bound is none.
    #[must_use]
    pub fn tension_between(mut self, least: f64, most: f64) -> Self {
        self.bounds = Some((least, most));
        self
    }

    /// Bounds the tension \[N\] of one cable (its index) instead of the bounds of all.
    #[must_use]
    pub fn cable_tension_between(mut self, cable: usize, least: f64, most: f64) -> Self {
        self.cable_bounds.push((cable, (least, most)));
        self
    }

    /// Chooses the solution with the least sum of tensions.
    #[must_use]
    pub fn least_total_tension(mut self) -> Self {
        self.goal = Goal::LeastTotalTension;
        self
    }

    /// Part of the largest singular value below which others count as zero; 1e-9 unless set.
    #[must_use]
    pub fn rank_tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    pub(crate) fn check(&self, cables: usize) -> Result<(), InverseError> {
        let bounded = self.cable_bounds.iter().map(|b| b.0);
        let given = self.given.iter().map(|g| g.0);
        let mut named = given.chain(self.tied.iter().flatten().copied()).chain(bounded);
        if let Some(cable) = named.find(|&cable| cable >= cables) {
            return Err(InverseError::NoSuchCable { cable, cables });
        }
        match &self.goal {
            Goal::Closest(values) if values.len() != cables => {
                Err(InverseError::WrongLength { found: values.len(), cables })
            }
            _ => {
                let empty = |&(low, high): &(f64, f64)| low > high || low.is_nan() || high.is_nan();
                match self.bounds.iter().chain(self.cable_bounds.iter().map(|b| &b.1)).find(|b| empty(b)) {
                    Some(&(low, high)) => Err(InverseError::EmptyBounds { low, high }),
                    None => Ok(()),
                }
            }
        }
    }

    /// Bounds on the tension of a cable; infinite where there are none.
    pub(crate) fn bounds_of(&self, cable: usize) -> (f64, f64) {
        let own = self.cable_bounds.iter().rev().find(|b| b.0 == cable).map(|b| b.1);
        own.or(self.bounds).unwrap_or((f64::NEG_INFINITY, f64::INFINITY))
    }

    /// Whether a programme is needed to choose.
    pub(crate) fn is_bounded(&self) -> bool {
        self.bounds.is_some() || !self.cable_bounds.is_empty() || self.goal == Goal::LeastTotalTension
    }

    /// Groups of cables with one unknown each; cables with a given value are in none.
    pub(crate) fn groups(&self, given: &[Option<f64>]) -> Result<Vec<Vec<usize>>, InverseError> {
        let mut of = vec![None; given.len()];
        let mut groups: Vec<Vec<usize>> = Vec::new();
        for tied in &self.tied {
            for &cable in tied {
                if given[cable].is_some() || of[cable].is_some() {
                    return Err(InverseError::TwiceBound { cable });
                }
                of[cable] = Some(groups.len());
            }
            groups.push(tied.clone());
        }
        let single = (0..given.len()).filter(|&c| given[c].is_none() && of[c].is_none());
        groups.extend(single.map(|c| vec![c]));
        Ok(groups.into_iter().filter(|group| !group.is_empty()).collect())
    }
}

/// The rest length at which a cable of this length carries this tension; by bisection for a user's law, which is taken
/// to fall with the rest length.
pub(crate) fn rest_length(structure: &dyn Tensioned, cable: usize, length: f64, tension: f64) -> Option<f64> {
    if let Some(stiffness) = structure.linear_stiffness(cable) {
        return (stiffness > 0.0).then(|| length - tension / stiffness);
    }
    let excess = |rest: f64| structure.static_tension(cable, length, rest) - tension;
    let (mut low, mut high) = (length, length);
    while excess(low) < 0.0 {
        low *= 0.5;
        if low < 1e-12 * length {
            return None;
        }
    }
    while excess(high) > 0.0 {
        high *= 2.0;
        if high > 1e12 * length {
            return None;
        }
    }
    while high - low > 2.0 * f64::EPSILON * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if excess(middle) > 0.0 { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}
