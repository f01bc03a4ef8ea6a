//! The names of a structure while it is being built, and the places that they stand for.

use std::collections::HashMap;

use nalgebra::SVector;
use tg_coords::{Member, Pose};
use tg_model::{AnchorId, MemberId, Place};

use crate::error::ReadError;
use crate::expression::Variables;
use crate::node::Span;
use crate::place::{OnMember, PlaceName, PlaceRef};
use crate::spanned::Spanned;
use crate::values::{COMPONENTS, components, vector};

/// One copy of an array's parts: the values of its indices, and where it stands.
#[derive(Clone, Debug)]
pub(crate) struct Copy<const D: usize> {
    pub(crate) variables: Variables,
    pub(crate) pose: Pose<D>,
}

/// A place and where it is as built.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Located<const D: usize> {
    pub(crate) place: Place<D>,
    pub(crate) position: SVector<f64, D>,
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub(crate) enum Target<const D: usize> {
    /// A point of space.
    Point(SVector<f64, D>),
    Anchor(AnchorId, SVector<f64, D>),
    Member(Box<NamedMember<D>>),
}

/// A member with its named points in the local frame.
#[derive(Clone, Debug)]
pub(crate) struct NamedMember<const D: usize> {
    pub(crate) id: MemberId,
    pub(crate) member: Member<D>,
    pub(crate) pose: Pose<D>,
    pub(crate) points: Vec<(String, SVector<f64, D>)>,
}

impl<const D: usize> NamedMember<D> {
    /// A local point, as a basic point where it is one.
    pub(crate) fn locate(&self, local: SVector<f64, D>) -> Located<D> {
        let coord_type = self.member.coord_type();
        let nodes = self.member.local_nodes();
        let basic = (0..nodes.len()).find(|&k| coord_type.is_point(k) && nodes[k] == local);
        let place = basic.map_or(self.id.at(local.into()), |k| self.id.node(k));
        Located { place, position: self.pose.apply_point(&local) }
    }

    fn is_particle(&self) -> bool {
        self.member.coord_type().nodes() == 1
    }

    fn is_bar(&self) -> bool {
        self.member.coord_type().nodes() == 2
    }
}

/// All names given so far.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names<const D: usize>(HashMap<String, Target<D>>);

impl<const D: usize> Names<D> {
    /// Refuses a name that is taken.
    pub(crate) fn check_free(&self, name: &str, span: &Span) -> Result<(), ReadError> {
        if !self.0.contains_key(name) {
            return Ok(());
        }
        let help =
            "points, anchors and members have different names; in an array use its index: \"name {i}\"";
        Err(ReadError::new(format!("the name \"{name}\" is taken")).at(span).help(help))
    }

    /// Takes a name, which must be free.
    pub(crate) fn take(&mut self, name: &str, span: &Span, target: Target<D>) -> Result<(), ReadError> {
        self.check_free(name, span)?;
        self.0.insert(name.into(), target);
        Ok(())
    }

    /// A member by its name.
    pub(crate) fn member(
        &self,
        name: &Spanned<String>,
        copy: &Copy<D>,
    ) -> Result<&NamedMember<D>, ReadError> {
        let filled = copy.variables.fill(&name.value, &name.span)?;
        match self.0.get(&filled) {
            Some(Target::Member(member)) => Ok(member),
            _ => Err(self.unknown(&filled, "member", &name.span, |t| matches!(t, Target::Member(_)))),
        }
    }

    /// A place to which something is attached.
    pub(crate) fn place(&self, given: &PlaceRef, copy: &Copy<D>) -> Result<Located<D>, ReadError> {
        match &given.value {
            PlaceName::Position(_) => Err(ReadError::new("a place is expected here, not coordinates")
                .at(&given.span)
                .help("name an anchor or a point of a member; anchors are points of the ground")),
            PlaceName::On(on) => self.on_member(on, copy),
            PlaceName::Name(name) => {
                let name = copy.variables.fill(name, &given.span)?;
                match self.0.get(&name) {
                    Some(&Target::Anchor(id, position)) => Ok(Located { place: id.into(), position }),
                    Some(Target::Member(member)) if member.is_particle() => {
                        Ok(member.locate(member.member.local_nodes()[0]))
                    }
                    Some(Target::Member(member)) => Err(self.which_point(&name, member, &given.span)),
                    Some(Target::Point(_)) => {
                        let message =
                            format!("\"{name}\" is a point of space, to which nothing can be attached");
                        Err(ReadError::new(message)
                            .at(&given.span)
                            .help("make it an anchor, or name a point of a member"))
                    }
                    None => self.point_of_member(&name, &given.span),
                }
            }
        }
    }

    /// A position in space.
    pub(crate) fn position(&self, given: &PlaceRef, copy: &Copy<D>) -> Result<SVector<f64, D>, ReadError> {
        match &given.value {
            PlaceName::Position(list) => {
                let values = components::<D>(&copy.variables, list)?.ok_or_else(|| {
                    let message = format!("expected {D} coordinates, found {}", list.len());
                    ReadError::new(message).at(&given.span).help(COMPONENTS)
                })?;
                Ok(copy.pose.apply_point(&values.into()))
            }
            PlaceName::Name(name) => {
                let name = copy.variables.fill(name, &given.span)?;
                match self.0.get(&name) {
                    Some(Target::Point(position)) => Ok(*position),
                    _ => Ok(self.place(given, copy)?.position),
                }
            }
            PlaceName::On(_) => Ok(self.place(given, copy)?.position),
        }
    }

    /// `member.point`
    fn point_of_member(&self, name: &str, span: &Span) -> Result<Located<D>, ReadError> {
        let Some((member_name, point)) = name.rsplit_once('.') else {
            return Err(self.unknown(name, "anchor or member", span, |t| !matches!(t, Target::Point(_))));
        };
        let Some(Target::Member(member)) = self.0.get(member_name) else {
            return Err(self.unknown(member_name, "member", span, |t| matches!(t, Target::Member(_))));
        };
        if let Some((_, local)) = member.points.iter().find(|(name, _)| name == point) {
            return Ok(member.locate(*local));
        }
        if point == "centre" || point == "center" {
            let centre = member.member.mass_properties().centre();
            return Ok(Located {
                place: member.id.mass_centre(),
                position: member.pose.apply_point(&centre),
            });
        }
        let mut known: Vec<&str> = member.points.iter().map(|(name, _)| name.as_str()).collect();
        known.push("centre");
        Err(ReadError::new(format!("\"{member_name}\" has no point \"{point}\""))
            .at(span)
            .suggest(point, &known))
    }

    fn which_point(&self, name: &str, member: &NamedMember<D>, span: &Span) -> ReadError {
        let points: Vec<_> = member.points.iter().map(|(point, _)| format!("\"{name}.{point}\"")).collect();
        let help = format!("write {} or \"{name}.centre\"", points.join(", "));
        ReadError::new(format!("\"{name}\" is a member; which of its points?")).at(span).help(help)
    }

    fn on_member(&self, on: &OnMember, copy: &Copy<D>) -> Result<Located<D>, ReadError> {
        let member = self.member(&on.on, copy)?;
        let variables = &copy.variables;
        if member.is_bar() {
            let at = Spanned { value: on.at.clone(), span: on.on.span.clone() };
            let part = vector::<1>(variables, &at)
                .map_err(|e| e.help("on a bar: the part of its length, [0.5]"))?[0];
            let nodes = member.member.local_nodes();
            return Ok(member.locate(nodes[0] + (nodes[1] - nodes[0]) * part));
        }
        let at = Spanned { value: on.at.clone(), span: on.on.span.clone() };
        Ok(member.locate(vector::<D>(variables, &at)?))
    }

    fn unknown(&self, name: &str, what: &str, span: &Span, fits: impl Fn(&Target<D>) -> bool) -> ReadError {
        let mut known: Vec<&str> =
            self.0.iter().filter(|(_, target)| fits(target)).map(|(name, _)| name.as_str()).collect();
        known.sort_unstable();
        ReadError::new(format!("there is no {what} \"{name}\"")).at(span).suggest(name, &known)
    }
}
