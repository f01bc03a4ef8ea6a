//! First pass: points, anchors and rigid members, in the order of the file.

use nalgebra::SVector;
use tg_coords::{CoordType, MassProperties, Member, Pose, Twist};

use super::{Assembler, mistake};
use crate::dimension::{Dimension, Space};
use crate::error::ReadError;
use crate::expression::Variables;
use crate::member::{Bar, Body, CoordTypeName, Particle};
use crate::names::{Copy, NamedMember, Target};
use crate::node::Span;
use crate::parts::Parts;
use crate::place::{PlaceName, PlaceRef};
use crate::quantity::{Quantity, Vector};
use crate::shape::{Outline, Solid};
use crate::spanned::Spanned;
use crate::structure::{MemberPicture, PictureKind};
use crate::values::{components, positive, vector};

/// Radius of a bar in pictures, by its length.
const SLENDER: f64 = 0.02;

/// A member of any kind in the file.
enum Part<'s> {
    Point(&'s PlaceRef),
    Anchor(&'s PlaceRef),
    Bar(&'s Bar),
    Body(&'s Body),
    Particle(&'s Particle),
}

/// A member ready to be added.
struct Made<const D: usize> {
    member: Member<D>,
    pose: Pose<D>,
    points: Vec<(String, SVector<f64, D>)>,
    picture: MemberPicture,
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
        if let (Some(_), _) | (_, Some(_)) = motion {
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

    fn body(&self, body: &Body, copy: &Copy<D>) -> Result<Made<D>, ReadError> {
        let variables = &copy.variables;
        let position = match &body.position {
            Some(at) => self.names.position(at, copy)?,
            None => copy.pose.apply_point(&SVector::zeros()),
        };
        let rotation = copy.pose.rotation * Space::rotation(body, variables)?.rotation;
        let solid: Option<Solid<D>> =
            body.shape.as_ref().map(|shape| Space::solid(shape, variables)).transpose()?;
        let mass = body_mass(body, solid.as_ref(), variables)?;
        let mut points = vec![("origin".to_string(), SVector::zeros())];
        for (name, point) in &body.points.0 {
            points.push((variables.fill(&name.value, &name.span)?, vector::<D>(variables, point)?));
        }
        for (name, point) in solid.iter().flat_map(|solid| &solid.points) {
            if points.iter().all(|(taken, _)| taken != name) {
                points.push((name.clone(), *point));
            }
        }
        let coord_type = body.coord_type.as_ref().map_or(Space::BODY, |name| coord_type(name.value));
        let nodes = basis(body, coord_type, &points, variables)?;
        let span = body.basis.as_ref().map(|b| &b.span).or(body.coord_type.as_ref().map(|t| &t.span));
        let member = Member::new(coord_type, &nodes, mass)
            .map_err(|error| ReadError::from_below(&error).at_opt(span.cloned()))?;
        let outline = body_outline(body, solid.as_ref(), &points, &member)?;
        let radius =
            outline.vertices.iter().map(|v| SVector::<f64, 3>::from(*v).norm()).fold(0.0, f64::max) * SLENDER;
        let picture = MemberPicture { kind: PictureKind::Body, outline, radius };
        Ok(Made { member, pose: Pose { position, rotation }, points, picture })
    }
}

fn padded<const D: usize>(point: &SVector<f64, D>) -> [f64; 3] {
    std::array::from_fn(|k| if k < D { point[k] } else { 0.0 })
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

fn body_mass<const D: usize>(
    body: &Body,
    solid: Option<&Solid<D>>,
    variables: &Variables,
) -> Result<MassProperties<D>, ReadError>
where
    Space: Dimension<D>,
{
    let mass = match (&body.mass, &body.density, solid) {
        (Some(mass), None, _) => positive(variables, mass)?,
        (None, Some(density), Some(solid)) => positive(variables, density)? * solid.measure,
        (None, Some(density), None) => {
            return Err(ReadError::new("a density needs a shape")
                .at(&density.span)
                .help("add shape = ... or give mass"));
        }
        (Some(_), Some(density), _) => {
            return Err(ReadError::new("mass and density are both given").at(&density.span).help("keep one"));
        }
        (None, None, _) => {
            return Err(ReadError::new("the body has no mass").help("add mass, or density with a shape"));
        }
    };
    let centre = match (&body.centre, solid) {
        (Some(centre), _) => vector::<D>(variables, centre)?,
        (None, Some(solid)) => solid.centre,
        (None, None) => SVector::zeros(),
    };
    match (&body.inertia, solid) {
        (Some(inertia), _) => Space::inertia(mass, centre, inertia, variables),
        (None, Some(solid)) => MassProperties::from_second_moment(mass, centre, solid.second_moment * mass)
            .map_err(|error| ReadError::from_below(&error)),
        (None, None) => {
            Err(ReadError::new("the body has no inertia").help("add inertia = { ... }, or a shape"))
        }
    }
}

/// Basic points and base vectors in the local frame.
fn basis<const D: usize>(
    body: &Body,
    coord_type: CoordType,
    points: &[(String, SVector<f64, D>)],
    variables: &Variables,
) -> Result<Vec<SVector<f64, D>>, ReadError> {
    let Some(given) = &body.basis else {
        if coord_type.points() == 1 {
            let axis = |k: usize| SVector::from_fn(|i, _| if i + 1 == k { 1.0 } else { 0.0 });
            return Ok((0..coord_type.nodes()).map(axis).collect());
        }
        let message = format!("a body of type {coord_type} needs to know its basic points");
        let span = body.coord_type.as_ref().map(|name| name.span.clone());
        return Err(ReadError::new(message)
            .at_opt(span)
            .help("basis = [\"p1\", \"p2\", ...], then vectors [x, y, ...]"));
    };
    given.value.iter().map(|node| basis_node(node, points, variables)).collect()
}

fn basis_node<const D: usize>(
    node: &PlaceRef,
    points: &[(String, SVector<f64, D>)],
    variables: &Variables,
) -> Result<SVector<f64, D>, ReadError> {
    match &node.value {
        PlaceName::Position(list) => node_components(list, &node.span, variables),
        PlaceName::Name(name) => named(name, &node.span, points).map(|k| points[k].1),
        PlaceName::On(on) => Err(ReadError::new("a point of this body is expected").at(&on.on.span)),
    }
}

fn node_components<const D: usize>(
    list: &[Quantity],
    span: &Span,
    variables: &Variables,
) -> Result<SVector<f64, D>, ReadError> {
    let values = components::<D>(variables, list)?;
    values.map(Into::into).ok_or_else(|| ReadError::new(format!("expected {D} components")).at(span))
}

/// Position of a point in the list.
fn named<const D: usize>(
    name: &str,
    span: &Span,
    points: &[(String, SVector<f64, D>)],
) -> Result<usize, ReadError> {
    let known: Vec<&str> = points.iter().map(|(name, _)| name.as_str()).collect();
    let found = known.iter().position(|known| *known == name);
    found.ok_or_else(|| {
        ReadError::new(format!("the body has no point \"{name}\"")).at(span).suggest(name, &known)
    })
}

/// Faces as given; else the shape; else the flat or solid figure of up to four points; else lines from the mass centre.
fn body_outline<const D: usize>(
    body: &Body,
    solid: Option<&Solid<D>>,
    points: &[(String, SVector<f64, D>)],
    member: &Member<D>,
) -> Result<Outline, ReadError> {
    let mut outline =
        Outline { vertices: points.iter().map(|(_, p)| padded(p)).collect(), ..Outline::default() };
    if let Some(faces) = &body.faces {
        for face in faces {
            let corners = face.iter().map(|name| named(&name.value, &name.span, points));
            let corners = corners.collect::<Result<Vec<_>, _>>()?;
            if corners.len() > 1 {
                outline.add_polygon(&corners);
            }
        }
        return Ok(outline);
    }
    if let Some(solid) = solid {
        return Ok(solid.outline.clone());
    }
    // The origin helps to draw a figure where there are few other points.
    let own: Vec<usize> =
        if points.len() > 3 { (1..points.len()).collect() } else { (0..points.len()).collect() };
    match own.as_slice() {
        [_, _] | [_, _, _] => outline.add_polygon(&own),
        &[a, b, c, d] if D == 3 => {
            [[a, b, c], [a, b, d], [a, c, d], [b, c, d]].iter().for_each(|face| outline.add_polygon(face));
        }
        _ => {
            let centre = outline.vertices.len();
            outline.vertices.push(padded(&member.mass_properties().centre()));
            outline.edges.extend(own.iter().map(|&point| [centre, point]));
        }
    }
    Ok(outline)
}

fn coord_type(name: CoordTypeName) -> CoordType {
    match name {
        CoordTypeName::Ruvw => CoordType::Ruvw,
        CoordTypeName::Rrvw => CoordType::Rrvw,
        CoordTypeName::Rrrw => CoordType::Rrrw,
        CoordTypeName::Rrrr => CoordType::Rrrr,
        CoordTypeName::Ruv => CoordType::Ruv,
        CoordTypeName::Rrv => CoordType::Rrv,
        CoordTypeName::Rrr => CoordType::Rrr,
    }
}
