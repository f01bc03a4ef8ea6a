//! What can be wrong with a structure; every message names the culprit and the mend.

use tg_coords::CoordsError;
use tg_sparse::SparseError;
use thiserror::Error;

use crate::report::Redundancy;
use crate::signal::SignalError;

/// Why a builder refuses a part, or `build()` the whole.
#[derive(Clone, Debug, Error)]
pub enum BuildError {
    /// Two parts of one kind have the same name.
    #[error("two {kind}s are named \"{name}\"; rename one of them")]
    DuplicateName {
        /// Kind of part: member, anchor, cable, joint, support or load.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// A number is NaN or infinite.
    #[error("{kind} \"{name}\": the {what} is not finite; give finite numbers")]
    NotFinite {
        /// Kind of part.
        kind: &'static str,
        /// Its name.
        name: String,
        /// Which quantity.
        what: &'static str,
    },
    /// A number is out of its range.
    #[error("{kind} \"{name}\": the {what} is {value}; it must {must}")]
    OutOfRange {
        /// Kind of part.
        kind: &'static str,
        /// Its name.
        name: String,
        /// Which quantity.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The rule.
        must: &'static str,
    },
    /// A rigid member cannot be made or does not have the point that is asked of it.
    #[error("{kind} \"{name}\": {source}")]
    Coordinates {
        /// Kind of part.
        kind: &'static str,
        /// Its name.
        name: String,
        /// The reason.
        source: CoordsError,
    },
    /// A signal's parameters are wrong.
    #[error("{kind} \"{name}\": {source}")]
    Signal {
        /// Kind of part.
        kind: &'static str,
        /// Its name.
        name: String,
        /// The reason.
        source: SignalError,
    },
    /// A part is attached to something that does not exist in this builder.
    #[error("{kind} \"{name}\" is attached to {place}, which does not exist; {mend}")]
    Dangling {
        /// Kind of part.
        kind: &'static str,
        /// Its name.
        name: String,
        /// Where it points.
        place: String,
        /// What would mend it.
        mend: &'static str,
    },
    /// A base vector is used where a point is needed.
    #[error(
        "{kind} \"{name}\" is attached to {place}, which is a base vector, not a point; use a basic point or a material point"
    )]
    NotAPoint {
        /// Kind of part.
        kind: &'static str,
        /// Its name.
        name: String,
        /// Where it points.
        place: String,
    },
    /// A cable has no length in the initial configuration.
    #[error(
        "cable \"{name}\" has zero length between {from} and {to}; its direction is undefined: move an end"
    )]
    ZeroLengthCable {
        /// Name of the cable.
        name: String,
        /// One end.
        from: String,
        /// Other end.
        to: String,
    },
    /// A joint joins fewer than two points, or a member with itself.
    #[error("joint \"{name}\" {what}; name the points of two or more different members")]
    MeaninglessJoint {
        /// Name of the joint.
        name: String,
        /// What is meaningless.
        what: &'static str,
    },
    /// A moment on a member that cannot carry it.
    #[error("load \"{name}\" on \"{member}\": {what}")]
    MeaninglessMoment {
        /// Name of the load.
        name: String,
        /// Name of the member.
        member: String,
        /// Why, and what to do.
        what: &'static str,
    },
    /// Joints by sharing make two points of one member the same.
    #[error(
        "joints by sharing make two basic points of \"{member}\" one; a rigid member cannot meet itself: check which points they name"
    )]
    SelfJoined {
        /// Name of the member.
        member: String,
    },
    /// Only basic points and anchors can be shared.
    #[error(
        "joint \"{name}\" cannot share {place}: it is not a basic point; choose a coordinate type with a basic point there, or join by constraints"
    )]
    CannotShare {
        /// Name of the joint.
        name: String,
        /// The place.
        place: String,
    },
    /// Points of a joint are apart in the initial configuration.
    #[error(
        "joint \"{name}\": {first} and {second} are {distance:.3e} m apart (allowed {allowed:.1e} m); place the members so that they meet"
    )]
    InconsistentJoint {
        /// Name of the joint.
        name: String,
        /// First point.
        first: String,
        /// The other point.
        second: String,
        /// Distance \[m\].
        distance: f64,
        /// Allowed distance \[m\].
        allowed: f64,
    },
    /// Two supports prescribe one component differently.
    #[error(
        "supports \"{first}\" and \"{second}\" both prescribe the {axis} component of {place}, differently; remove one"
    )]
    ContradictorySupports {
        /// First support.
        first: String,
        /// Second support.
        second: String,
        /// Component x, y or z.
        axis: char,
        /// The node.
        place: String,
    },
    /// Supports hold every coordinate of a constraint, but do not satisfy it.
    #[error(
        "the supports hold every coordinate of {constraint}, but violate it by {violation:.3e} (scaled); move them together or free one"
    )]
    UnsatisfiableConstraint {
        /// Name of the constraint.
        constraint: String,
        /// Scaled violation of the constraint or of its rate.
        violation: f64,
    },
    /// An axis beyond the space dimension.
    #[error(
        "support \"{name}\" prescribes component {axis} of a {dimension}-dimensional vector; components count from 0"
    )]
    NoSuchAxis {
        /// Name of the support.
        name: String,
        /// The axis.
        axis: usize,
        /// Dimension D.
        dimension: usize,
    },
    /// Some constraints are combinations of others.
    #[error("{} at tolerance {tolerance:.0e}: {}; remove the joint or support that repeats another, or let the builder drop them (Redundancies::Drop)",
        count(list.len()), names(list))]
    Redundant {
        /// Each dependent constraint with those that imply it.
        list: Vec<Redundancy>,
        /// Sine of the angle below which a gradient counts as dependent.
        tolerance: f64,
    },
    /// A redundant constraint demands something else than those that imply its gradient; dropping it would hide that.
    #[error(
        "{redundancy} in its gradient, but contradicts that by {violation:.3e} (scaled); make the supports and joints agree or remove one"
    )]
    ContradictoryConstraint {
        /// The constraint and those that it contradicts.
        redundancy: Redundancy,
        /// Scaled difference of the residuals or relative difference of the rates at t = 0.
        violation: f64,
    },
    /// Coordinates so far from the origin that rounding takes the structure's digits.
    #[error(
        "the structure is {size:.1e} m large and {distance:.1e} m from the origin, where coordinates are rounded by {:.1e} m: fewer than six digits of its shape are left; place the origin nearer",
        f64::EPSILON * distance
    )]
    FarFromOrigin {
        /// Size of the structure \[m\].
        size: f64,
        /// Largest coordinate \[m\].
        distance: f64,
    },
    /// The structure has nothing to solve for.
    #[error("the structure has no free coordinate; add a member or free a support")]
    NothingFree,
    /// The sparse solver cannot analyse the structure.
    #[error("analysis of the constraints failed at {culprit}: {source}")]
    Sparse {
        /// Name of the constraint or coordinate.
        culprit: String,
        /// The solver's reason.
        source: SparseError,
    },
}

/// Why a place is not one of a model.
#[derive(Clone, Debug, Error)]
pub enum PlaceError {
    /// The member's handle comes from another builder.
    #[error("the structure has no member number {0}; use the handles of the builder that it was built with")]
    NoSuchMember(usize),
    /// The anchor's handle comes from another builder.
    #[error("the structure has no anchor number {0}; use the handles of the builder that it was built with")]
    NoSuchAnchor(usize),
    /// The member has fewer nodes.
    #[error("\"{member}\" has no node {node}; its {nodes} nodes count from 0")]
    NoSuchNode {
        /// Name of the member.
        member: String,
        /// Node asked for.
        node: usize,
        /// Number of nodes.
        nodes: usize,
    },
    /// The point is not on the member.
    #[error("\"{member}\": {source}")]
    NotOfMember {
        /// Name of the member.
        member: String,
        /// The reason.
        source: CoordsError,
    },
}

fn count(n: usize) -> String {
    if n == 1 { "1 redundant constraint".into() } else { format!("{n} redundant constraints") }
}

fn names(list: &[Redundancy]) -> String {
    list.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
}
