//! Shapes of bodies: what is written, and the measure, mass centre, second moment and outline that follow.
//!
//! ```text
//! J / m about the mass centre, w_i vertices from there:
//! box diag(s²)/12,  cylinder diag(r²/4, r²/4, h²/12),  sphere r²/5 I,  tetrahedron Σ w wᵀ / 20,  triangle Σ w wᵀ / 12
//! ```

use nalgebra::{SMatrix, SVector, Vector2, Vector3};
use schemars::JsonSchema;
use serde::Deserialize;

use crate::error::ReadError;
use crate::expression::Variables;
use crate::quantity::{Quantity, Vector};
use crate::spanned::Spanned;
use crate::values::{positive, vector};

/// The shape of a uniform body.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// A box about the origin, its edges \[m\] along the local axes; a rectangle in the plane. Its points `p1`, `p2`, ... are its corners,
    /// x changing fastest.
    #[serde(alias = "rectangle")]
    Box(Vector),
    /// A cylinder about the origin, its axis along z. Its points: `bottom`, `top`.
    Cylinder(Cylinder),
    /// A ball about the origin, by its radius \[m\].
    #[serde(alias = "ball")]
    Sphere(Quantity),
    /// A tetrahedron by its four vertices \[m\], its points `p1` to `p4`.
    Tetrahedron(Spanned<Vec<Vector>>),
    /// A polygon in the local x-y plane. Its points `p1`, `p2`, ... are its corners.
    #[serde(alias = "polygon")]
    Plate(Plate),
}

/// A cylinder.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Radius \[m\].
    pub radius: Quantity,
    /// Height \[m\].
    pub height: Quantity,
}

/// A plate.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plate {
    /// Corners (x, y) \[m\] in order, without crossings.
    pub corners: Spanned<Vec<Vector>>,
    /// Thickness \[m\], half of it to each side.
    pub thickness: Option<Quantity>,
}

/// A uniform solid of D-dimensional space.
#[derive(Clone, Debug)]
pub(crate) struct Solid<const D: usize> {
    /// Volume \[m³\], or area \[m²\] without thickness.
    pub(crate) measure: f64,
    /// Mass centre \[m\].
    pub(crate) centre: SVector<f64, D>,
    /// J / m about the mass centre \[m²\].
    pub(crate) second_moment: SMatrix<f64, D, D>,
    /// Vertices \[m\] and their names.
    pub(crate) points: Vec<(String, SVector<f64, D>)>,
    /// What is drawn.
    pub(crate) outline: Outline,
}

/// Lines and triangles over vertices of a member's local frame; z = 0 in the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Outline {
    /// Vertices \[m\].
    pub vertices: Vec<[f64; 3]>,
    /// Pairs of vertices.
    pub edges: Vec<[usize; 2]>,
    /// Triples of vertices.
    pub faces: Vec<[usize; 3]>,
}

impl Outline {
    /// A polygon of some of its vertices: its sides, and a fan of triangles.
    pub(crate) fn add_polygon(&mut self, corners: &[usize]) {
        for (k, &corner) in corners.iter().enumerate() {
            let side = [corner, corners[(k + 1) % corners.len()]];
            if !self.edges.contains(&side) && !self.edges.contains(&[side[1], side[0]]) {
                self.edges.push(side);
            }
        }
        self.faces.extend(corners.windows(2).skip(1).map(|pair| [corners[0], pair[0], pair[1]]));
    }
}

impl Shape {
    /// The solid in the plane.
    pub(crate) fn in_plane(&self, variables: &Variables) -> Result<Solid<2>, ReadError> {
        match self {
            Self::Box(size) => block(&vector::<2>(variables, size)?, size),
            Self::Plate(plate) => polygon(variables, plate),
            Self::Cylinder(Cylinder { radius: place, .. }) | Self::Sphere(place) => Err(only_in_space(place)),
            Self::Tetrahedron(vertices) => Err(only_in_space(vertices)),
        }
    }

    /// The solid in space.
    pub(crate) fn in_space(&self, variables: &Variables) -> Result<Solid<3>, ReadError> {
        match self {
            Self::Box(size) => block(&vector::<3>(variables, size)?, size),
            Self::Cylinder(cylinder) => self::cylinder(variables, cylinder),
            Self::Sphere(radius) => sphere(positive(variables, radius)?),
            Self::Tetrahedron(vertices) => tetrahedron(variables, vertices),
            Self::Plate(plate) => thick(&polygon(variables, plate)?, plate, variables),
        }
    }
}

fn only_in_space<T>(place: &Spanned<T>) -> ReadError {
    ReadError::new("this shape needs three dimensions").at(&place.span).help("in the plane: box or plate")
}

/// With z = 0 in the plane.
pub(crate) fn padded<const D: usize>(point: &SVector<f64, D>) -> [f64; 3] {
    std::array::from_fn(|k| if k < D { point[k] } else { 0.0 })
}

fn numbered<const D: usize>(vertices: &[SVector<f64, D>]) -> Vec<(String, SVector<f64, D>)> {
    (1..).zip(vertices).map(|(k, &vertex)| (format!("p{k}"), vertex)).collect()
}

fn block<const D: usize>(size: &SVector<f64, D>, place: &Vector) -> Result<Solid<D>, ReadError> {
    if !size.iter().all(|edge| *edge > 0.0) {
        return Err(ReadError::new("a box needs positive edges").at(&place.span));
    }
    let corner = |k: usize| {
        SVector::<f64, D>::from_fn(
            |axis, _| if k >> axis & 1 == 1 { size[axis] / 2.0 } else { -size[axis] / 2.0 },
        )
    };
    let corners: Vec<_> = (0..1 << D).map(corner).collect();
    let mut outline = Outline { vertices: corners.iter().map(padded).collect(), ..Outline::default() };
    let sides: &[[usize; 4]] =
        &[[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    sides.iter().take(if D == 2 { 1 } else { 6 }).for_each(|side| outline.add_polygon(side));
    Ok(Solid {
        measure: size.product(),
        centre: SVector::zeros(),
        second_moment: SMatrix::from_diagonal(&size.map(|edge| edge * edge / 12.0)),
        points: numbered(&corners),
        outline,
    })
}

fn cylinder(variables: &Variables, shape: &Cylinder) -> Result<Solid<3>, ReadError> {
    const SIDES: usize = 24;
    let (r, h) = (positive(variables, &shape.radius)?, positive(variables, &shape.height)?);
    let ring = |z: f64| {
        (0..SIDES).map(move |k| {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / SIDES as f64).sin_cos();
            [r * cos, r * sin, z]
        })
    };
    let mut outline =
        Outline { vertices: ring(-h / 2.0).chain(ring(h / 2.0)).collect(), ..Outline::default() };
    outline.add_polygon(&(0..SIDES).collect::<Vec<_>>());
    outline.add_polygon(&(SIDES..2 * SIDES).collect::<Vec<_>>());
    for k in 0..SIDES {
        let next = (k + 1) % SIDES;
        outline.faces.extend([[k, next, SIDES + k], [next, SIDES + next, SIDES + k]]);
    }
    let end = |name: &str, z| (name.to_string(), Vector3::new(0.0, 0.0, z));
    Ok(Solid {
        measure: std::f64::consts::PI * r * r * h,
        centre: SVector::zeros(),
        second_moment: SMatrix::from_diagonal(&Vector3::new(r * r / 4.0, r * r / 4.0, h * h / 12.0)),
        points: vec![end("bottom", -h / 2.0), end("top", h / 2.0)],
        outline,
    })
}

fn sphere(r: f64) -> Result<Solid<3>, ReadError> {
    const SIDES: usize = 24;
    let mut outline = Outline::default();
    // Three great circles.
    for axis in 0..3 {
        let first = outline.vertices.len();
        for k in 0..SIDES {
            let (sin, cos) = (std::f64::consts::TAU * k as f64 / SIDES as f64).sin_cos();
            let mut vertex = [0.0; 3];
            (vertex[(axis + 1) % 3], vertex[(axis + 2) % 3]) = (r * cos, r * sin);
            outline.vertices.push(vertex);
            outline.edges.push([first + k, first + (k + 1) % SIDES]);
        }
    }
    Ok(Solid {
        measure: 4.0 / 3.0 * std::f64::consts::PI * r.powi(3),
        centre: SVector::zeros(),
        second_moment: SMatrix::identity() * (r * r / 5.0),
        points: Vec::new(),
        outline,
    })
}

fn tetrahedron(variables: &Variables, vertices: &Spanned<Vec<Vector>>) -> Result<Solid<3>, ReadError> {
    let corners = vertices.value.iter().map(|v| vector::<3>(variables, v)).collect::<Result<Vec<_>, _>>()?;
    let &[a, b, c, d] = corners.as_slice() else {
        let message = format!("a tetrahedron has 4 vertices, not {}", corners.len());
        return Err(ReadError::new(message).at(&vertices.span));
    };
    let volume = (b - a).cross(&(c - a)).dot(&(d - a)).abs() / 6.0;
    if volume == 0.0 {
        return Err(ReadError::new("the four vertices lie in one plane").at(&vertices.span));
    }
    let centre = (a + b + c + d) / 4.0;
    let spread = |v: &Vector3<f64>| (v - centre) * (v - centre).transpose();
    let mut outline = Outline { vertices: corners.iter().map(padded).collect(), ..Outline::default() };
    [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]].iter().for_each(|face| outline.add_polygon(face));
    Ok(Solid {
        measure: volume,
        centre,
        second_moment: corners.iter().map(spread).sum::<SMatrix<f64, 3, 3>>() / 20.0,
        points: numbered(&corners),
        outline,
    })
}

/// A polygon as triangles from its first corner, with signs.
fn polygon(variables: &Variables, plate: &Plate) -> Result<Solid<2>, ReadError> {
    let corners =
        plate.corners.value.iter().map(|v| vector::<2>(variables, v)).collect::<Result<Vec<_>, _>>()?;
    if corners.len() < 3 {
        return Err(ReadError::new("a plate has at least three corners").at(&plate.corners.span));
    }
    let origin = corners[0];
    let (mut area, mut first, mut second) = (0.0, Vector2::zeros(), SMatrix::<f64, 2, 2>::zeros());
    for pair in corners[1..].windows(2) {
        let (a, b) = (pair[0] - origin, pair[1] - origin);
        let (part, sum) = (a.perp(&b) / 2.0, a + b);
        area += part;
        first += sum * (part / 3.0);
        second += (a * a.transpose() + b * b.transpose() + sum * sum.transpose()) * (part / 12.0);
    }
    if area == 0.0 {
        return Err(ReadError::new("the plate has no area").at(&plate.corners.span));
    }
    let from_origin = first / area;
    let mut outline = Outline { vertices: corners.iter().map(padded).collect(), ..Outline::default() };
    outline.add_polygon(&(0..corners.len()).collect::<Vec<_>>());
    let thickness = plate.thickness.as_ref().map(|t| positive(variables, t)).transpose()?;
    Ok(Solid {
        measure: area.abs() * thickness.unwrap_or(1.0),
        centre: origin + from_origin,
        second_moment: second / area - from_origin * from_origin.transpose(),
        points: numbered(&corners),
        outline,
    })
}

/// A plate in space.
fn thick(flat: &Solid<2>, plate: &Plate, variables: &Variables) -> Result<Solid<3>, ReadError> {
    let thickness = plate.thickness.as_ref().map(|t| positive(variables, t)).transpose()?.unwrap_or(0.0);
    let mut second_moment = SMatrix::<f64, 3, 3>::zeros();
    second_moment.fixed_view_mut::<2, 2>(0, 0).copy_from(&flat.second_moment);
    second_moment[(2, 2)] = thickness * thickness / 12.0;
    let lift = |v: &Vector2<f64>| Vector3::new(v.x, v.y, 0.0);
    Ok(Solid {
        measure: flat.measure,
        centre: lift(&flat.centre),
        second_moment,
        points: flat.points.iter().map(|(name, point)| (name.clone(), lift(point))).collect(),
        outline: flat.outline.clone(),
    })
}
