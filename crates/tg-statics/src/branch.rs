//! A branch of equilibria: its points and what happens on the way.

use tg_tangent::Configuration;

/// An equilibrium on a branch.
#[derive(Clone, Debug)]
pub struct BranchPoint {
    /// Value of the parameter.
    pub parameter: f64,
    /// The equilibrium.
    pub configuration: Configuration,
    /// Negative eigenvalues of the reduced Hessian: zero where stable.
    pub negative: usize,
    /// Direction of the parameter along the branch, per unit of arclength: changes sign at a limit point.
    pub direction: f64,
    /// The active set: one flag per slacking cable, true where taut.
    pub taut: Vec<bool>,
}

/// What happens at a point of a branch.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// The parameter turns back (a fold): no equilibrium nearby beyond it.
    LimitPoint,
    /// The number of negative eigenvalues changes while the parameter goes on: another branch crosses.
    Bifurcation,
    /// A cable goes slack.
    Slack {
        /// Name of the cable.
        cable: String,
    },
    /// A cable becomes taut.
    Taut {
        /// Name of the cable.
        cable: String,
    },
}

/// An event, located by bisection along the branch.
#[derive(Clone, Debug)]
pub struct Event {
    /// What happens.
    pub kind: EventKind,
    /// Value of the parameter.
    pub parameter: f64,
    /// The equilibrium there.
    pub configuration: Configuration,
    /// Negative eigenvalues before and behind: `(0, 1..)` is a loss of stability.
    pub negative: (usize, usize),
}

impl Event {
    /// Whether a stable branch becomes unstable here.
    pub fn loses_stability(&self) -> bool {
        self.negative.0 == 0 && self.negative.1 > 0
    }
}

/// Why a branch ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BranchEnd {
    /// The parameter reached the far end of its range.
    Reached,
    /// The branch turned and left the range where it had entered.
    Returned,
    /// The number of steps was used up.
    Steps,
    /// No smaller step finds a next equilibrium: the branch ends, or forces jump.
    Lost,
}

/// A branch of equilibria.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Equilibria in the order in which they were found.
    pub points: Vec<BranchPoint>,
    /// Events in the same order.
    pub events: Vec<Event>,
    /// Why it ended.
    pub end: BranchEnd,
}
