//! The builder: mutable, names things, used once.
//!
//! Parts are checked for themselves when they are added and against each other in [`ModelBuilder::build`].

use std::collections::HashSet;

use nalgebra::SVector;
use tg_coords::{CoordsError, Member, Pose};

use crate::error::BuildError;
use crate::law::CableLaw;
use crate::model::Model;
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

/// A point force.
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
    /// configuration, as in overconstrained linkages; [`Model::dropped_violation`] tells during the motion.
    Drop,
}

/// Collects the parts of a structure in D-dimensional space.
#[derive(Clone, Debug)]
pub struct ModelBuilder<const D: usize> {
    pub(crate) members: Vec<MemberPart<D>>,
    pub(crate) anchors: Vec<AnchorPart<D>>,
    pub(crate) joints: Vec<JointPart<D>>,
    pub(crate) supports: Vec<SupportPart<D>>,
    pub(crate) cables: Vec<CablePart<D>>,
    pub(crate) loads: Vec<LoadPart<D>>,
    pub(crate) gravity: SVector<f64, D>,
    pub(crate) redundancies: Redundancies,
    names: HashSet<(&'static str, String)>,
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
    pub(crate) place: Place<D>,
    pub(crate) force: SVector<f64, D>,
    pub(crate) factor: Signal,
}

impl<const D: usize> Default for ModelBuilder<D> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const D: usize> ModelBuilder<D> {
    /// An empty structure without gravity.
    pub fn new() -> Self {
        Self {
            members: Vec::new(),
            anchors: Vec::new(),
            joints: Vec::new(),
            supports: Vec::new(),
            cables: Vec::new(),
            loads: Vec::new(),
            gravity: SVector::zeros(),
            redundancies: Redundancies::Reject,
            names: HashSet::new(),
        }
    }

    /// Sets the acceleration of gravity \[m/s²\].
    ///
    /// # Errors
    /// Not finite.
    pub fn gravity(&mut self, g: [f64; D]) -> Result<(), BuildError> {
        self.gravity = finite("gravity", "g", "acceleration", g)?;
        Ok(())
    }

    /// Says what `build()` does with redundant constraints; the default is to refuse them.
    pub fn redundancies(&mut self, redundancies: Redundancies) {
        self.redundancies = redundancies;
    }

    /// Adds a rigid member, its local frame placed at `pose`.
    ///
    /// # Errors
    /// The name is taken, or the pose is not a finite rigid placement.
    pub fn member(&mut self, name: &str, member: Member<D>, pose: Pose<D>) -> Result<MemberId, BuildError> {
        pose.check().map_err(|source| coordinates("member", name, source))?;
        self.take_name("member", name)?;
        self.members.push(MemberPart { name: name.into(), member, pose });
        Ok(MemberId(self.members.len() - 1))
    }

    /// Adds a bar: a uniform thin rod of type RR between two points of space \[m\].
    ///
    /// # Errors
    /// The name is taken, the mass is not positive, or the points coincide.
    pub fn bar(
        &mut self,
        name: &str,
        mass: f64,
        from: [f64; D],
        to: [f64; D],
    ) -> Result<MemberId, BuildError> {
        let rod = Member::thin_rod(mass, from.into(), to.into())
            .map_err(|source| coordinates("member", name, source))?;
        self.member(name, rod, Pose::identity())
    }

    /// Adds a particle (one point with mass) at a point of space \[m\].
    ///
    /// # Errors
    /// The name is taken, the mass is not positive, or the position is not finite.
    pub fn particle(&mut self, name: &str, mass: f64, at: [f64; D]) -> Result<MemberId, BuildError> {
        let particle =
            Member::particle(mass, at.into()).map_err(|source| coordinates("member", name, source))?;
        self.member(name, particle, Pose::identity())
    }

    /// Adds an anchor: a prescribed point (21), at rest unless a support moves it.
    ///
    /// # Errors
    /// The name is taken or the position is not finite.
    pub fn anchor(&mut self, name: &str, position: [f64; D]) -> Result<AnchorId, BuildError> {
        let position = finite("anchor", name, "position", position)?;
        self.take_name("anchor", name)?;
        self.anchors.push(AnchorPart { name: name.into(), position });
        Ok(AnchorId(self.anchors.len() - 1))
    }

    /// Joins two or more points by a torqueless joint: a pin in the plane, a ball joint in space (Sec. 3.1).
    ///
    /// # Errors
    /// The name is taken, or there are fewer than two points.
    pub fn joint(&mut self, name: &str, places: &[Place<D>], joining: Joining) -> Result<(), BuildError> {
        if places.len() < 2 {
            return Err(BuildError::MeaninglessJoint {
                name: name.into(),
                what: "joins fewer than two points",
            });
        }
        self.take_name("joint", name)?;
        self.joints.push(JointPart { name: name.into(), places: places.to_vec(), joining });
        Ok(())
    }

    /// Prescribes one component of a place: its initial value plus `offset(t)` \[m\].
    ///
    /// The place may be an anchor, a node (a basic point or a base vector), or any material point (then the
    /// prescription is an extrinsic constraint to a hidden anchor).
    ///
    /// # Errors
    /// The name is taken, or the signal is wrong.
    pub fn support(
        &mut self,
        name: &str,
        place: impl Into<Place<D>>,
        axis: usize,
        offset: impl Into<Signal>,
    ) -> Result<(), BuildError> {
        let offset = checked_signal("support", name, offset.into())?;
        if axis >= D {
            return Err(BuildError::NoSuchAxis { name: name.into(), axis, dimension: D });
        }
        self.take_name("support", name)?;
        self.supports.push(SupportPart { name: name.into(), place: place.into(), axis, offset });
        Ok(())
    }

    /// Fixes every component of a place; the supports are named `name.x`, `name.y`, `name.z`.
    ///
    /// # Errors
    /// As [`ModelBuilder::support`].
    pub fn fix(&mut self, name: &str, place: impl Into<Place<D>>) -> Result<(), BuildError> {
        let place = place.into();
        (0..D).try_for_each(|axis| self.support(&format!("{name}.{}", axis_name(axis)), place, axis, 0.0))
    }

    /// Moves a place along the first axis by `offset(t)` and fixes its other components: shaken ground.
    ///
    /// # Errors
    /// As [`ModelBuilder::support`].
    pub fn shake(
        &mut self,
        name: &str,
        place: impl Into<Place<D>>,
        offset: impl Into<Signal>,
    ) -> Result<(), BuildError> {
        let (place, offset) = (place.into(), offset.into());
        (0..D).try_for_each(|axis| {
            let offset = if axis == 0 { offset.clone() } else { Signal::Constant(0.0) };
            self.support(&format!("{name}.{}", axis_name(axis)), place, axis, offset)
        })
    }

    /// Adds a massless cable between two places with its rest length μ \[m\], constant or driven.
    ///
    /// # Errors
    /// The name is taken, κ or η is negative or not finite, or a constant rest length is negative or its signal wrong.
    pub fn cable(
        &mut self,
        name: &str,
        from: impl Into<Place<D>>,
        to: impl Into<Place<D>>,
        law: CableLaw,
        rest: impl Into<Signal>,
    ) -> Result<CableId, BuildError> {
        if let CableLaw::Linear { stiffness, damping } | CableLaw::Slacking { stiffness, damping } = law {
            not_negative(name, "stiffness", stiffness)?;
            not_negative(name, "damping", damping)?;
        }
        let rest = checked_signal("cable", name, rest.into())?;
        if let Some(value) = rest.constant() {
            not_negative(name, "rest length", value)?;
        }
        self.take_name("cable", name)?;
        self.cables.push(CablePart { name: name.into(), from: from.into(), to: to.into(), law, rest });
        Ok(CableId(self.cables.len() - 1))
    }

    /// Adds a force at a place, fixed in space: `factor(t) · force` \[N\], eq. (25).
    ///
    /// # Errors
    /// The name is taken, the force is not finite or the signal wrong.
    pub fn load(
        &mut self,
        name: &str,
        place: impl Into<Place<D>>,
        force: [f64; D],
        factor: impl Into<Signal>,
    ) -> Result<LoadId, BuildError> {
        let force = finite("load", name, "force", force)?;
        let factor = checked_signal("load", name, factor.into())?;
        self.take_name("load", name)?;
        self.loads.push(LoadPart { name: name.into(), place: place.into(), force, factor });
        Ok(LoadId(self.loads.len() - 1))
    }

    /// Checks the structure as a whole and freezes it.
    ///
    /// # Errors
    /// See [`BuildError`]; each names the offending part.
    pub fn build(self) -> Result<Model<D>, BuildError> {
        crate::assemble::assemble(self)
    }

    fn take_name(&mut self, kind: &'static str, name: &str) -> Result<(), BuildError> {
        if self.names.insert((kind, name.into())) {
            Ok(())
        } else {
            Err(BuildError::DuplicateName { kind, name: name.into() })
        }
    }
}

/// x, y, z.
pub(crate) fn axis_name(axis: usize) -> char {
    ['x', 'y', 'z'].get(axis).copied().unwrap_or('?')
}

pub(crate) fn coordinates(kind: &'static str, name: &str, source: CoordsError) -> BuildError {
    BuildError::Coordinates { kind, name: name.into(), source }
}

fn finite<const D: usize>(
    kind: &'static str,
    name: &str,
    what: &'static str,
    x: [f64; D],
) -> Result<SVector<f64, D>, BuildError> {
    if x.iter().all(|x| x.is_finite()) {
        Ok(x.into())
    } else {
        Err(BuildError::NotFinite { kind, name: name.into(), what })
    }
}

fn not_negative(name: &str, what: &'static str, value: f64) -> Result<(), BuildError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else if value.is_finite() {
        Err(BuildError::OutOfRange { kind: "cable", name: name.into(), what, value, must: "not be negative" })
    } else {
        Err(BuildError::NotFinite { kind: "cable", name: name.into(), what })
    }
}

fn checked_signal(kind: &'static str, name: &str, signal: Signal) -> Result<Signal, BuildError> {
    signal.check().map_err(|source| BuildError::Signal { kind, name: name.into(), source })?;
    Ok(signal)
}
