//! Free bodies: every member alone with all forces on it, and the reactions that Newton's laws alone leave for its joints
//! and supports.
//!
//! ```text
//! Σ (f_i, r_i × f_i + m_i) = 0        for each member: cables, weight, loads, reactions
//! reactions of a joint on its members add up to zero, unless it is joined to the ground
//! ```
//! Nothing here uses the assembled residual, the constraints or their multipliers: tensions are those of
//! [`Model::cable`], and reactions are the least-squares solution of the balances of all members. In equilibrium the
//! balances hold to rounding; [`EquilibriumReport`](crate::EquilibriumReport) has the same reactions from multipliers.
//! Children: `wrench` (forces with moments, Plücker coordinates of lines), `balance` (the least-squares problem).

mod balance;
mod given;
mod wrench;

use nalgebra::{SVector, Vector3};
use tg_model::{MemberId, Model, PlaceError};
use tg_tangent::TangentError;
use thiserror::Error;

pub use wrench::{Line, Wrench};

use balance::Balance;

/// Why there are no free bodies.
#[derive(Debug, Error)]
pub enum FreeBodyError {
    /// A force or position is NaN or infinite.
    #[error("member \"{member}\": {what} is not finite; check the coordinates and inputs")]
    NotFinite {
        /// Name of the member.
        member: String,
        /// What is not finite.
        what: &'static str,
    },
    /// A place is not one of the model, or a body has no orientation that its moment could follow.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// The least-squares problem cannot be solved.
    #[error(transparent)]
    Decomposition(#[from] TangentError),
}

/// Where a force on a member comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum Source<const D: usize> {
    /// A cable, with its tension \[N\] and the unit line from its end on this member to the other.
    Cable {
        /// Name of the cable.
        name: String,
        /// Tension \[N\], positive when it pulls.
        tension: f64,
        /// Plücker coordinates of its line, in space's frame.
        line: Line<D>,
    },
    /// The member's weight.
    Weight,
    /// A load.
    Load {
        /// Name of the load.
        name: String,
    },
    /// A joint: a reaction.
    Joint {
        /// Name of the joint.
        name: String,
    },
    /// A support: a reaction along one axis, or its moment where it holds a base vector.
    Support {
        /// Name of the support.
        name: String,
    },
    /// The universal joint that a load's moments act about: its reaction moment, about the normal of both axes.
    UniversalJoint {
        /// Name of the load.
        load: String,
    },
}

/// A force or moment on a member.
#[derive(Clone, Debug, PartialEq)]
pub struct Action<const D: usize> {
    /// Where it comes from.
    pub source: Source<D>,
    /// Where it acts \[m\].
    pub point: SVector<f64, D>,
    /// Force \[N\] and moment about [`Action::point`] \[N m\].
    pub wrench: Wrench<D>,
    /// For a reaction, whether the balances determine it; if not, it is the smallest of those that balance. Given actions
    /// are always determinate.
    pub determinate: bool,
}

impl<const D: usize> Action<D> {
    /// Force, and moment about a point.
    pub fn about(&self, point: &SVector<f64, D>) -> Wrench<D> {
        self.wrench.moved(&self.point, point)
    }
}

/// One member alone.
#[derive(Clone, Debug)]
pub struct FreeBody<const D: usize> {
    /// The member.
    pub member: MemberId,
    /// Its name.
    pub name: String,
    /// Cables, weight and loads.
    pub given: Vec<Action<D>>,
    /// Joints and supports, found from the balances.
    pub reactions: Vec<Action<D>>,
    /// Its mass centre \[m\].
    pub centre: SVector<f64, D>,
}

impl<const D: usize> FreeBody<D> {
    /// Sum of what is given about a point.
    pub fn given_about(&self, point: &SVector<f64, D>) -> Wrench<D> {
        self.given.iter().map(|action| action.about(point)).sum()
    }

    /// Sum of everything about a point: zero in equilibrium.
    pub fn unbalance_about(&self, point: &SVector<f64, D>) -> Wrench<D> {
        self.given.iter().chain(&self.reactions).map(|action| action.about(point)).sum()
    }
}

/// All members alone.
#[derive(Clone, Debug)]
pub struct FreeBodyReport<const D: usize> {
    /// One for each member, in the user's order.
    pub bodies: Vec<FreeBody<D>>,
    /// Number of independent sets of reactions that balance themselves: zero where all are determinate.
    pub indeterminate: usize,
    /// Largest force of a given action, or moment per [`FreeBodyReport::length`] \[N\].
    pub force_scale: f64,
    /// Size of the structure by which moments are compared with forces \[m\].
    pub length: f64,
    /// Largest unbalanced force, or moment about the member's mass centre per length, of a member per
    /// [`FreeBodyReport::force_scale`]; zero where nothing acts.
    pub unbalance: f64,
    /// The member with it.
    pub worst: Option<MemberId>,
}

impl<const D: usize> FreeBodyReport<D> {
    /// Isolates all members of a model at full coordinates `q` at rest with inputs `u`, in equilibrium or not.
    ///
    /// # Errors
    /// A force or position is not finite, or the decomposition fails.
    pub fn new(model: &Model<D>, q: &[f64], u: &[f64]) -> Result<Self, FreeBodyError> {
        let mut bodies = given::bodies(model, q, u)?;
        let length = size(&bodies);
        let balance = Balance::new(model, q, &bodies, length)?;
        let indeterminate = balance.indeterminate;
        for (reaction, action) in balance.reactions {
            bodies[reaction].reactions.push(action);
        }
        let measure = |w: &Wrench<D>| w.force.amax().max(w.moment.amax() / length);
        let actions = bodies.iter().flat_map(|body| &body.given);
        let force_scale = actions.map(|action| measure(&action.wrench)).fold(0.0, f64::max);
        let (mut largest, mut worst) = (0.0, None);
        for body in &bodies {
            let unbalance = measure(&body.unbalance_about(&body.centre));
            if unbalance > largest {
                (largest, worst) = (unbalance, Some(body.member));
            }
        }
        let unbalance = if largest == 0.0 { 0.0 } else { largest / force_scale };
        Ok(Self { bodies, indeterminate, force_scale, length, unbalance, worst })
    }

    /// The member alone.
    pub fn body(&self, member: MemberId) -> Option<&FreeBody<D>> {
        self.bodies.iter().find(|body| body.member == member)
    }
}

/// Diagonal of the box of all points at which something acts; one where there is a single point.
fn size<const D: usize>(bodies: &[FreeBody<D>]) -> f64 {
    let points = || bodies.iter().flat_map(|b| b.given.iter().map(|a| a.point).chain([b.centre]));
    let low = points().fold(SVector::<f64, D>::repeat(f64::INFINITY), |low, p| low.inf(&p));
    let high = points().fold(SVector::<f64, D>::repeat(f64::NEG_INFINITY), |high, p| high.sup(&p));
    let size = (high - low).norm();
    if size.is_finite() && size > 0.0 { size } else { 1.0 }
}

/// A vector of the plane in space.
fn in_space<const D: usize>(x: &SVector<f64, D>) -> Vector3<f64> {
    Vector3::from_fn(|i, _| x.get(i).copied().unwrap_or(0.0))
}
