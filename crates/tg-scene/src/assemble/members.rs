//! First pass: points, anchors and rigid members, in the order of the file.

use nalgebra::SVector;
use tg_coords::{Member, Pose, Twist};

use super::{Assembler, mistake};
use crate::dimension::{Dimension, Space};
use crate::error::ReadError;
use crate::expression::Variables;
use crate::member::{Bar, Body, Particle};
use crate::names::{Copy, NamedMember, Target};
use crate::parts::Parts;
use crate::place::PlaceRef;
use crate::quantity::Vector;
use crate::shape::{Outline, padded};
use crate::spanned::Spanned;
use crate::structure::{MemberPicture, PictureKind};
use crate::values::{positive, vector};

/// Radius of a bar in pictures, by its length.
pub(super) const SLENDER: f64 = 0.02;

/// A member of any kind in the file.
enum Part<'s> {
    Point(&'s PlaceRef),
    Anchor(&'s PlaceRef),
    Bar(&'s Bar),
    Body(&'s Body),
    Particle(&'s Particle),
}

/// A member ready to be added.
pub(super) struct Made<const D: usize> {
    pub(super) member: Member<D>,
    pub(super) pose: Pose<D>,
    pub(super) points: Vec<(String, SVector<f64, D>)>,
    pub(super) picture: MemberPicture,
}

/// Velocity of the mass centre and spin, as written.
type Motion<'s> = (Option<&'s Vector>, Option<&'s Vector>);

impl<'s, const D: usize> Assembler<'s, D>
where
    Space: Dimension<D>,
{
    /// Points, anchors and members of one copy.
    pub(super) fn place_members(&mut self, parts: Parts<'s>, copy: &Copy<D>) -> Result<(), ReadError> {
        let mut list: Vec<(&'s Spanned<String>, Part<'s>)> = Vec::new();
        list.extend(parts.points.iter().map(|(name, part)| (name, Part::Point(part))));
        list.extend(parts.anchors.iter().map(|(name, part)| (name, Part::Anchor(part))));
        list.extend(parts.bars.iter().map(|(name, part)| (name, Part::Bar(part))));
        list.extend(parts.bodies.iter().map(|(name, part)| (name, Part::Body(part))));
        list.extend(parts.particles.iter().map(|(name, part)| (name, Part::Particle(part))));
        // Points and anchors need no member but may be where members go; the rest is in the order of the file.
        list.sort_by_key(|(name, part)| (!matches!(part, Part::Point(_) | Part::Anchor(_)), name.span.start));
        for (name, part) in list {
            self.place_member(name, &part, copy).map_err(|error| error.at(&name.span))?;
        }
        Ok(())
    }

    fn place_member(
        &mut self,
        given: &Spanned<String>,
        part: &Part<'s>,
        copy: &Copy<D>,
    ) -> Result<(), ReadError> {
        let variables = &copy.variables;
        let (made, motion): (_, Motion<'s>) = match *part {
            Part::Point(at) => {
                let (name, position) =
                    (variables.fill(&given.value, &given.span)?, self.names.position(at, copy)?);
                return self.names.take(&name, &given.span, Target::Point(position));
            }
            Part::Anchor(at) => {
                let (name, position) = (self.name("anchor", given, copy)?, self.names.position(at, copy)?);
                self.names.check_free(&name, &given.span)?;
                let id = self.builder.anchor(&name, position.into()).map_err(|e| mistake(&e, &given.span))?;
                return self.names.take(&name, &given.span, Target::Anchor(id, position));
            }
            Part::Bar(bar) => (self.bar(bar, copy)?, (bar.velocity.as_ref(), bar.spin.as_ref())),
            Part::Body(body) => (self.body(body, copy)?, (body.velocity.as_ref(), body.spin.as_ref())),
            Part::Particle(particle) => (self.particle(particle, copy)?, (particle.velocity.as_ref(), None)),
        };
        let name = self.name("member", given, copy)?;
        self.names.check_free(&name, &given.span)?;
        let id = self
            .builder
            .member(&name, made.member.clone(), made.pose)
            .map_err(|e| mistake(&e, &given.span))?;
        if motion.0.is_some() || motion.1.is_some() {
            let twist = start(&made, motion, copy)?;
            self.motions.push((id, twist));
        }
        self.pictures.push(made.picture);
        let member = NamedMember { id, member: made.member, pose: made.pose, points: made.points };
        self.names.take(&name, &given.span, Target::Member(Box::new(member)))
    }

    fn bar(&self, bar: &Bar, copy: &Copy<D>) -> Result<Made<D>, ReadError> {
        let [from, to] = bar.ends.value.as_slice() else {
            let message = format!("a bar has two ends, not {}", bar.ends.value.len());
            return Err(ReadError::new(message).at(&bar.ends.span));
        };
        let (from, to) = (self.names.position(from, copy)?, self.names.position(to, copy)?);
        let length = (to - from).norm();
        if length == 0.0 {
            let error = ReadError::new("the bar has no length").at(&bar.ends.span);
            return Err(error.help("its two ends are one point; move one"));
        }
        let radius = bar.radius.as_ref().map(|r| positive(&copy.variables, r)).transpose()?;
        let mass = bar_mass(bar, length, radius, &copy.variables)?;
        let member = Member::thin_rod(mass, from, to)
            .map_err(|error| ReadError::from_below(&error).at(&bar.ends.span))?;
        let outline =
            Outline { vertices: vec![padded(&from), padded(&to)], edges: vec![[0, 1]], faces: Vec::new() };
        Ok(Made {
            member,
            pose: Pose::identity(),
            points: vec![("from".into(), from), ("to".into(), to)],
            picture: MemberPicture {
                kind: PictureKind::Bar,
                outline,
                radius: radius.unwrap_or(SLENDER * length),
            },
        })
    }

    fn particle(&self, particle: &Particle, copy: &Copy<D>) -> Result<Made<D>, ReadError> {
        let at = self.names.position(&particle.at, copy)?;
        let mass = positive(&copy.variables, &particle.mass)?;
        let member = Member::particle(mass, at)
            .map_err(|error| ReadError::from_below(&error).at(&particle.mass.span))?;
        let outline = Outline { vertices: vec![padded(&at)], ..Outline::default() };
        let picture = MemberPicture { kind: PictureKind::Particle, outline, radius: 0.0 };
        Ok(Made { member, pose: Pose::identity(), points: Vec::new(), picture })
    }
}

/// Twist of the local frame from the velocity of the mass centre and the spin, both turned with the copy.
fn start<const D: usize>(
    made: &Made<D>,
    (velocity, spin): Motion<'_>,
    copy: &Copy<D>,
) -> Result<Twist<D>, ReadError>
where
    Space: Dimension<D>,
{
    let mut twist = Space::twist(&copy.pose, spin, &copy.variables)?;
    if let Some(velocity) = velocity {
        twist.velocity = copy.pose.apply_vector(&vector::<D>(&copy.variables, velocity)?);
    }
    let centre = made.pose.apply_vector(&made.member.mass_properties().centre());
    twist.velocity -= twist.spin * centre;
    Ok(twist)
}

fn bar_mass(bar: &Bar, length: f64, radius: Option<f64>, variables: &Variables) -> Result<f64, ReadError> {
    match (&bar.mass, &bar.line_density, &bar.density, radius) {
        (Some(mass), None, None, _) => positive(variables, mass),
        (None, Some(density), None, _) => Ok(positive(variables, density)? * length),
        (None, None, Some(density), Some(r)) => {
            Ok(positive(variables, density)? * std::f64::consts::PI * r * r * length)
        }
        (None, None, Some(density), None) => {
            Err(ReadError::new("a density needs the bar's radius").at(&density.span).help("add radius = ..."))
        }
        (None, None, None, _) => {
            Err(ReadError::new("the bar has no mass").help("add mass, line_density, or density and radius"))
        }
        _ => Err(ReadError::new("the bar's mass is given twice")
            .help("keep one of mass, line_density and density")),
    }
}
