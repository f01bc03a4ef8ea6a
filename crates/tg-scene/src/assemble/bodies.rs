//! Bodies: mass properties, natural coordinates and looks from what is written.

use nalgebra::SVector;
use tg_coords::{CoordType, MassProperties, Member, Pose};

use super::Assembler;
use super::members::{Made, SLENDER};
use crate::dimension::{Dimension, Space};
use crate::error::ReadError;
use crate::expression::Variables;
use crate::member::{Body, CoordTypeName};
use crate::names::Copy;
use crate::node::Span;
use crate::place::{PlaceName, PlaceRef};
use crate::quantity::Quantity;
use crate::shape::{Outline, Solid, padded};
use crate::structure::{MemberPicture, PictureKind};
use crate::values::{components, positive, vector};

impl<const D: usize> Assembler<'_, D>
where
    Space: Dimension<D>,
{
    pub(super) fn body(&self, body: &Body, copy: &Copy<D>) -> Result<Made<D>, ReadError> {
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
