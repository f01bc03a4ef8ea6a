//! Rigid members: bars, bodies, particles.

use schemars::JsonSchema;
use serde::Deserialize;

use crate::place::PlaceRef;
use crate::quantity::{Quantity, Vector};
use crate::shape::Shape;
use crate::spanned::{Named, Spanned};

/// A thin rigid bar (strut, rod). Its points: `from`, `to`, `centre`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Bar {
    /// Its two ends in space.
    #[serde(alias = "nodes", alias = "between")]
    #[schemars(extend("x-aliases" = ["nodes", "between"]))]
    pub ends: Spanned<Vec<PlaceRef>>,
    /// Mass \[kg\], uniform along the bar.
    pub mass: Option<Quantity>,
    /// Mass by length \[kg/m\] instead.
    pub line_density: Option<Quantity>,
    /// Density \[kg/m³\] instead, with the radius.
    pub density: Option<Quantity>,
    /// Radius \[m\], for density and pictures; it does not enter the mechanics otherwise.
    pub radius: Option<Quantity>,
    /// Velocity of its mass centre at t = 0 \[m/s\].
    pub velocity: Option<Vector>,
    /// Angular velocity at t = 0 \[rad/s\]: one number in the plane, a vector in space.
    pub spin: Option<Vector>,
}

/// A rigid body. Its points: those that it names, `origin` and `centre`.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Origin of its local frame in space \[m\], zero if not given.
    pub position: Option<PlaceRef>,
    /// In the plane, the angle of its local frame \[rad\], counterclockwise.
    pub angle: Option<Quantity>,
    /// In space, the rotation of its local frame.
    pub rotation: Option<Rotation>,
    /// A shape, which gives mass, mass centre, inertia and points; what stands beside it takes precedence.
    pub shape: Option<Shape>,
    /// Mass \[kg\].
    pub mass: Option<Quantity>,
    /// Density \[kg/m³\], with a shape, instead of the mass; with a plate without thickness \[kg/m²\].
    pub density: Option<Quantity>,
    /// Mass centre in the local frame \[m\].
    #[serde(alias = "center", alias = "mass_centre", alias = "com")]
    #[schemars(extend("x-aliases" = ["center", "mass_centre", "com"]))]
    pub centre: Option<Vector>,
    /// Inertia about the mass centre, along the local axes.
    pub inertia: Option<Inertia>,
    /// Named points in the local frame \[m\].
    #[serde(default)]
    pub points: Named<Vector>,
    /// Type of its natural coordinates; RUV in the plane and RUVW in space if not given. A joint at a basic point costs no
    /// constraint.
    #[serde(rename = "type", alias = "coordinates")]
    #[schemars(extend("x-aliases" = ["coordinates"]))]
    pub coord_type: Option<Spanned<CoordTypeName>>,
    /// Its basic points, then its base vectors, as the type has them: names of points or local coordinates \[m\]. The origin and unit
    /// axes if not given and the type has one basic point.
    #[serde(alias = "nodes")]
    #[schemars(extend("x-aliases" = ["nodes"]))]
    pub basis: Option<Spanned<Vec<PlaceRef>>>,
    /// For pictures: faces by names of points. Without them, the shape is drawn, or lines between the points.
    pub faces: Option<Vec<Vec<Spanned<String>>>>,
    /// Velocity of its mass centre at t = 0 \[m/s\].
    pub velocity: Option<Vector>,
    /// Angular velocity at t = 0 \[rad/s\]: one number in the plane, a vector in space.
    pub spin: Option<Vector>,
}

/// A mass at a point, where cables meet. Its name is its place.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Particle {
    /// Position in space \[m\].
    #[serde(alias = "position")]
    #[schemars(extend("x-aliases" = ["position"]))]
    pub at: PlaceRef,
    /// Mass \[kg\].
    pub mass: Quantity,
    /// Velocity at t = 0 \[m/s\].
    pub velocity: Option<Vector>,
}

/// A rotation in space.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Rotation {
    /// By an angle about an axis.
    About(AxisAngle),
    /// The matrix R, row by row: its columns are the local axes in space.
    Matrix(Spanned<Vec<Vector>>),
    /// A quaternion (x, y, z, w), of any length but zero.
    Quaternion(Vector),
    /// One rotation after another, the first in the list first.
    Sequence(Vec<Rotation>),
}

/// An axis and an angle.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisAngle {
    /// Direction of the axis, of any length.
    pub axis: Vector,
    /// Angle \[rad\], right-handed.
    pub angle: Quantity,
}

/// Inertia about the mass centre, along the local axes.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Inertia {
    /// In the plane, I_z \[kg m²\].
    Polar(Quantity),
    /// In space, the principal moments I_x, I_y, I_z \[kg m²\], the local axes being principal.
    Principal(Vector),
    /// In space, the inertia matrix \[kg m²\], row by row, with minus signs on the products of inertia.
    Matrix(Spanned<Vec<Vector>>),
    /// The second moment of mass J = ∫ρ r rᵀ \[kg m²\], row by row.
    SecondMoment(Spanned<Vec<Vector>>),
}

/// Types of natural coordinates of a body (Table 1 of the framework paper): basic points, then base vectors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "UPPERCASE")]
pub enum CoordTypeName {
    /// In space, one point and three vectors.
    Ruvw,
    /// In space, two points and two vectors.
    Rrvw,
    /// In space, three points and one vector.
    Rrrw,
    /// In space, four points.
    Rrrr,
    /// In the plane, one point and two vectors.
    Ruv,
    /// In the plane, two points and one vector.
    Rrv,
    /// In the plane, three points.
    Rrr,
}
