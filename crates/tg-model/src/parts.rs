//! The parts of a structure as the builder collects them, and the handles by which they refer to each other.

use nalgebra::SVector;
use tg_coords::{CoordsError, Member, Pose};

use crate::error::BuildError;
use crate::law::CableLaw;
use crate::load::Load;
use crate::signal::Signal;

/// A rigid member of a structure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct MemberId(pub(crate) usize);

/// A point of the ground (or of a moving base).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct AnchorId(pub(crate) usize);

/// A cable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CableId(pub(crate) usize);

/// A load: a force or moments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct LoadId(pub(crate) usize);

/// A place of a structure to which things are attached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place<const D: usize> {
    /// Node `i` of a member in the order of its coordinate type: basic points, then base vectors.
    Node(MemberId, usize),
    /// A material point of a member, in its local frame \[m\].
    Material(MemberId, [f64; D]),
    /// The mass centre of a member.
    MassCentre(MemberId),
    /// An anchor.
    Anchor(AnchorId),
}

impl MemberId {
    /// Node `i`: basic points first, then base vectors, in the order of the coordinate type's name.
    pub fn node<const D: usize>(self, i: usize) -> Place<D> {
        Place::Node(self, i)
    }

    /// The material point with these coordinates in the member's local frame \[m\].
    pub fn at<const D: usize>(self, local: [f64; D]) -> Place<D> {
        Place::Material(self, local)
    }

    /// The mass centre.
    pub fn mass_centre<const D: usize>(self) -> Place<D> {
        Place::MassCentre(self)
    }
}

impl<const D: usize> From<AnchorId> for Place<D> {
    fn from(anchor: AnchorId) -> Self {
        Self::Anchor(anchor)
    }
}

/// How a joint is modelled (Sec. 3.1); the motion is the same to rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joining {
    /// The points become one node: fewer coordinates and no constraint. Basic points and anchors only.
    Share,
    /// Extrinsic constraints r_a - r_b = 0, eq. (19). Any points.
    Constrain,
}

/// What to do with redundant constraints.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Redundancies {
    /// `build()` fails and names them.
    #[default]
    Reject,
    /// `build()` leaves them out and names them in the report. Right where they are implied in every
    /// configuration, as in overconstrained linkages; [`crate::Model::dropped_violation`] tells during the motion.
    Drop,
}

/// Everything that a builder has collected.
#[derive(Clone, Debug)]
pub(crate) struct Parts<const D: usize> {
    pub(crate) members: Vec<MemberPart<D>>,
    pub(crate) anchors: Vec<AnchorPart<D>>,
    pub(crate) joints: Vec<JointPart<D>>,
    pub(crate) supports: Vec<SupportPart<D>>,
    pub(crate) cables: Vec<CablePart<D>>,
    pub(crate) loads: Vec<LoadPart<D>>,
    pub(crate) gravity: SVector<f64, D>,
    pub(crate) redundancies: Redundancies,
}

#[derive(Clone, Debug)]
pub(crate) struct MemberPart<const D: usize> {
    pub(crate) name: String,
    pub(crate) member: Member<D>,
    pub(crate) pose: Pose<D>,
}

#[derive(Clone, Debug)]
pub(crate) struct AnchorPart<const D: usize> {
    pub(crate) name: String,
    pub(crate) position: SVector<f64, D>,
}

#[derive(Clone, Debug)]
pub(crate) struct JointPart<const D: usize> {
    pub(crate) name: String,
    pub(crate) places: Vec<Place<D>>,
    pub(crate) joining: Joining,
}

#[derive(Clone, Debug)]
pub(crate) struct SupportPart<const D: usize> {
    pub(crate) name: String,
    pub(crate) place: Place<D>,
    pub(crate) axis: usize,
    pub(crate) offset: Signal,
}

#[derive(Clone, Debug)]
pub(crate) struct CablePart<const D: usize> {
    pub(crate) name: String,
    pub(crate) from: Place<D>,
    pub(crate) to: Place<D>,
    pub(crate) law: CableLaw,
    pub(crate) rest: Signal,
}

#[derive(Clone, Debug)]
pub(crate) struct LoadPart<const D: usize> {
    pub(crate) name: String,
    pub(crate) load: Load<D>,
    /// Components where the factor is one \[N or N m\].
    pub(crate) components: Vec<f64>,
    pub(crate) factor: Signal,
}

/// x, y, z.
pub(crate) fn axis_name(axis: usize) -> char {
    ['x', 'y', 'z'].get(axis).copied().unwrap_or('?')
}

pub(crate) fn coordinates(kind: &'static str, name: &str, source: CoordsError) -> BuildError {
    BuildError::Coordinates { kind, name: name.into(), source }
}
