//! The builder: mutable, names things, used once.
//!
//! Parts are checked for themselves when they are added and against each other in [`ModelBuilder::build`]. Loads are
//! added in [`crate::load`].

use std::collections::HashSet;

use nalgebra::SVector;
use tg_coords::{Member, Pose};

use crate::assemble::assemble;
use crate::error::BuildError;
use crate::law::{CableLaw, not_negative};
use crate::model::Model;
use crate::parts::{
    AnchorId, AnchorPart, CableId, CablePart, Joining, JointPart, MemberId, MemberPart, Parts, Place,
    Redundancies, SupportPart, axis_name, coordinates,
};
use crate::signal::Signal;

/// Collects the parts of a structure in D-dimensional space.
#[derive(Clone, Debug)]
pub struct ModelBuilder<const D: usize> {
    pub(crate) parts: Parts<D>,
    names: HashSet<(&'static str, String)>,
}

impl<const D: usize> Default for ModelBuilder<D> {
    fn default() -> Self {
        Self::new()
    }
}

impl<const D: usize> ModelBuilder<D> {
    /// An empty structure without gravity.
    pub fn new() -> Self {
        let parts = Parts {
            members: Vec::new(),
            anchors: Vec::new(),
            joints: Vec::new(),
            supports: Vec::new(),
            cables: Vec::new(),
            loads: Vec::new(),
            gravity: SVector::zeros(),
            redundancies: Redundancies::Reject,
        };
        Self { parts, names: HashSet::new() }
    }

    /// Sets the acceleration of gravity \[m/s²\].
    ///
    /// # Errors
    /// Not finite.
    pub fn gravity(&mut self, g: [f64; D]) -> Result<(), BuildError> {
        self.parts.gravity = finite("gravity", "g", "acceleration", g)?;
        Ok(())
    }

    /// Says what `build()` does with redundant constraints; the default is to refuse them.
    pub fn redundancies(&mut self, redundancies: Redundancies) {
        self.parts.redundancies = redundancies;
    }

    /// Adds a rigid member, its local frame placed at `pose`.
    ///
    /// # Errors
    /// The name is taken, or the pose is not a finite rigid placement.
    pub fn member(&mut self, name: &str, member: Member<D>, pose: Pose<D>) -> Result<MemberId, BuildError> {
        pose.check().map_err(|source| coordinates("member", name, source))?;
        self.take_name("member", name)?;
        self.parts.members.push(MemberPart { name: name.into(), member, pose });
        Ok(MemberId(self.parts.members.len() - 1))
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
        self.parts.anchors.push(AnchorPart { name: name.into(), position });
        Ok(AnchorId(self.parts.anchors.len() - 1))
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
        self.parts.joints.push(JointPart { name: name.into(), places: places.to_vec(), joining });
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
        self.parts.supports.push(SupportPart { name: name.into(), place: place.into(), axis, offset });
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
        law.check(name)?;
        let rest = checked_signal("cable", name, rest.into())?;
        if let Some(value) = rest.constant() {
            not_negative(name, "rest length", value)?;
        }
        self.take_name("cable", name)?;
        self.parts.cables.push(CablePart { name: name.into(), from: from.into(), to: to.into(), law, rest });
        Ok(CableId(self.parts.cables.len() - 1))
    }

    /// Checks the structure as a whole and freezes it.
    ///
    /// # Errors
    /// See [`BuildError`]; each names the offending part.
    pub fn build(self) -> Result<Model<D>, BuildError> {
        assemble(self.parts)
    }

    pub(crate) fn take_name(&mut self, kind: &'static str, name: &str) -> Result<(), BuildError> {
        if self.names.insert((kind, name.into())) {
            Ok(())
        } else {
            Err(BuildError::DuplicateName { kind, name: name.into() })
        }
    }
}

pub(crate) fn finite<const D: usize>(
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

pub(crate) fn checked_signal(kind: &'static str, name: &str, signal: Signal) -> Result<Signal, BuildError> {
    signal.check().map_err(|source| BuildError::Signal { kind, name: name.into(), source })?;
    Ok(signal)
}
