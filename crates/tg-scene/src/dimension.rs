//! What differs between the plane and space: rotations, spins, inertias, moments.

use nalgebra::{Matrix3, Rotation3, SVector, Unit, UnitQuaternion, Vector2, Vector3};
use tg_coords::{CoordType, MassProperties, Pose, Twist};
use tg_model::{MemberId, ModelBuilder, MomentAxes, Signal};

use crate::error::ReadError;
use crate::expression::Variables;
use crate::load::{Load, MomentAxesName};
use crate::member::{AxisAngle, Body, Inertia, Rotation};
use crate::node::Span;
use crate::parts::Array;
use crate::quantity::Vector;
use crate::shape::{Shape, Solid};
use crate::values::{matrix, vector};

/// The space of a scene.
pub(crate) trait Dimension<const D: usize> {
    /// Type of a body's coordinates that are not chosen.
    const BODY: CoordType;
    /// Rotation of a body's local frame.
    fn rotation(body: &Body, variables: &Variables) -> Result<Pose<D>, ReadError>;
    /// From one copy of an array to the copy `times` later, without the shift.
    fn turn(array: &Array, times: f64, variables: &Variables) -> Result<Pose<D>, ReadError>;
    /// Twist of a frame at rest in its origin, with a spin.
    fn twist(pose: &Pose<D>, spin: Option<&Vector>, variables: &Variables) -> Result<Twist<D>, ReadError>;
    /// Mass properties from an inertia.
    fn inertia(
        mass: f64,
        centre: SVector<f64, D>,
        given: &Inertia,
        variables: &Variables,
    ) -> Result<MassProperties<D>, ReadError>;
    /// The solid of a shape.
    fn solid(shape: &Shape, variables: &Variables) -> Result<Solid<D>, ReadError>;
    /// Adds a moment on a member.
    fn moment(
        builder: &mut ModelBuilder<D>,
        name: &str,
        load: &MomentOn<'_, D>,
        factor: Signal,
    ) -> Result<(), ReadError>;
}

/// A moment to be added.
pub(crate) struct MomentOn<'a, const D: usize> {
    pub(crate) member: MemberId,
    pub(crate) load: &'a Load,
    /// Place of the copy that it belongs to.
    pub(crate) pose: &'a Pose<D>,
    pub(crate) variables: &'a Variables,
    pub(crate) span: &'a Span,
}

/// The plane or space.
pub(crate) struct Space;

fn only(what: &str, place: &Span, instead: &str) -> ReadError {
    ReadError::new(what).at(place).help(instead)
}

impl Dimension<2> for Space {
    const BODY: CoordType = CoordType::Ruv;

    fn rotation(body: &Body, variables: &Variables) -> Result<Pose<2>, ReadError> {
        if body.rotation.is_some() {
            return Err(
                ReadError::new("a rotation in space does not fit the plane").help("write angle = ... [rad]")
            );
        }
        let angle = body.angle.as_ref().map_or(Ok(0.0), |angle| variables.number(angle))?;
        Ok(Pose::planar(0.0, 0.0, angle))
    }

    fn turn(array: &Array, times: f64, variables: &Variables) -> Result<Pose<2>, ReadError> {
        if let Some(axis) = &array.axis {
            return Err(only("the plane has one axis of rotation", &axis.span, "remove the key"));
        }
        let angle = array.rotate.as_ref().map_or(Ok(0.0), |angle| variables.number(angle))?;
        Ok(Pose::planar(0.0, 0.0, times * angle))
    }

    fn twist(_: &Pose<2>, spin: Option<&Vector>, variables: &Variables) -> Result<Twist<2>, ReadError> {
        let spin = spin.map_or(Ok(0.0), |spin| vector::<1>(variables, spin).map(|spin| spin[0]))?;
        Ok(Twist::planar(Vector2::zeros(), spin))
    }

    fn inertia(
        mass: f64,
        centre: Vector2<f64>,
        given: &Inertia,
        variables: &Variables,
    ) -> Result<MassProperties<2>, ReadError> {
        let (properties, span) = match given {
            Inertia::Polar(moment) => {
                (MassProperties::from_polar_moment(mass, centre, variables.number(moment)?), &moment.span)
            }
            Inertia::SecondMoment(rows) => {
                (MassProperties::from_second_moment(mass, centre, matrix(variables, rows)?), &rows.span)
            }
            Inertia::Principal(Vector { span, .. }) => {
                return Err(only("a body in the plane has one moment of inertia", span, "polar = I_z"));
            }
            Inertia::Matrix(rows) => {
                return Err(only("a body in the plane has one moment of inertia", &rows.span, "polar = I_z"));
            }
        };
        properties.map_err(|error| ReadError::from_below(&error).at(span))
    }

    fn solid(shape: &Shape, variables: &Variables) -> Result<Solid<2>, ReadError> {
        shape.in_plane(variables)
    }

    fn moment(
        builder: &mut ModelBuilder<2>,
        name: &str,
        on: &MomentOn<'_, 2>,
        factor: Signal,
    ) -> Result<(), ReadError> {
        let Some(moment) = &on.load.moment else {
            return Err(only(
                "this moment needs three dimensions",
                on.span,
                "in the plane: moment = [value]",
            ));
        };
        let moment = vector::<1>(on.variables, moment)?[0];
        let added = builder.moment(name, on.member, moment, factor);
        added.map(|_| ()).map_err(|error| ReadError::from_below(&error).at(on.span))
    }
}

impl Dimension<3> for Space {
    const BODY: CoordType = CoordType::Ruvw;

    fn rotation(body: &Body, variables: &Variables) -> Result<Pose<3>, ReadError> {
        if let Some(angle) = &body.angle {
            let help = "write rotation = { about = { axis = [0, 0, 1], angle = ... } }";
            return Err(only("in space an angle needs an axis", &angle.span, help));
        }
        let rotation =
            body.rotation.as_ref().map_or(Ok(Rotation3::identity()), |r| rotation(r, variables))?;
        Ok(Pose { position: Vector3::zeros(), rotation: rotation.into_inner() })
    }

    fn turn(array: &Array, times: f64, variables: &Variables) -> Result<Pose<3>, ReadError> {
        let angle = array.rotate.as_ref().map_or(Ok(0.0), |angle| variables.number(angle))?;
        let axis = array.axis.as_ref().map_or(Ok(Vector3::z_axis()), |axis| direction(axis, variables))?;
        let rotation = Rotation3::from_axis_angle(&axis, times * angle).into_inner();
        Ok(Pose { position: Vector3::zeros(), rotation })
    }

    fn twist(pose: &Pose<3>, spin: Option<&Vector>, variables: &Variables) -> Result<Twist<3>, ReadError> {
        let spin = spin.map_or(Ok(Vector3::zeros()), |spin| vector::<3>(variables, spin))?;
        Ok(Twist::spatial(Vector3::zeros(), pose.apply_vector(&spin)))
    }

    fn inertia(
        mass: f64,
        centre: Vector3<f64>,
        given: &Inertia,
        variables: &Variables,
    ) -> Result<MassProperties<3>, ReadError> {
        let (properties, span) = match given {
            Inertia::Principal(moments) => {
                let values = vector::<3>(variables, moments)?.into();
                (MassProperties::from_principal_moments(mass, centre, values), &moments.span)
            }
            Inertia::Matrix(rows) => {
                (MassProperties::from_inertia_matrix(mass, centre, matrix(variables, rows)?), &rows.span)
            }
            Inertia::SecondMoment(rows) => {
                (MassProperties::from_second_moment(mass, centre, matrix(variables, rows)?), &rows.span)
            }
            Inertia::Polar(moment) => {
                let help = "principal = [I_x, I_y, I_z] or matrix = [[...], ...]";
                return Err(only("a body in space has three moments of inertia", &moment.span, help));
            }
        };
        properties.map_err(|error| ReadError::from_below(&error).at(span))
    }

    fn solid(shape: &Shape, variables: &Variables) -> Result<Solid<3>, ReadError> {
        shape.in_space(variables)
    }

    fn moment(
        builder: &mut ModelBuilder<3>,
        name: &str,
        on: &MomentOn<'_, 3>,
        factor: Signal,
    ) -> Result<(), ReadError> {
        let added = match (&on.load.moment, &on.load.joint_moments) {
            (Some(moment), _) => {
                let moment = vector::<3>(on.variables, moment)?;
                let (axes, moment) = match on.load.axes.unwrap_or(MomentAxesName::Space) {
                    MomentAxesName::Space => (MomentAxes::Space, on.pose.apply_vector(&moment)),
                    MomentAxesName::Body => (MomentAxes::Body, moment),
                };
                builder.moment(name, on.member, axes, moment.into(), factor)
            }
            (None, Some(moments)) => {
                let moments = vector::<2>(on.variables, moments)?;
                builder.joint_moments(name, on.member, moments.into(), factor)
            }
            (None, None) => return Err(ReadError::new("a load without a moment").at(on.span)),
        };
        added.map(|_| ()).map_err(|error| ReadError::from_below(&error).at(on.span))
    }
}

fn direction(axis: &Vector, variables: &Variables) -> Result<Unit<Vector3<f64>>, ReadError> {
    let given = vector::<3>(variables, axis)?;
    let unit = Unit::try_new(given, 0.0).filter(|unit| unit.iter().all(|x| x.is_finite()));
    unit.ok_or_else(|| ReadError::new("the axis has no direction").at(&axis.span))
}

fn rotation(given: &Rotation, variables: &Variables) -> Result<Rotation3<f64>, ReadError> {
    match given {
        Rotation::About(AxisAngle { axis, angle }) => {
            Ok(Rotation3::from_axis_angle(&direction(axis, variables)?, variables.number(angle)?))
        }
        Rotation::Matrix(rows) => {
            let matrix: Matrix3<f64> = matrix(variables, rows)?;
            let pose = Pose::new(Vector3::zeros(), matrix);
            pose.map(|pose| Rotation3::from_matrix_unchecked(pose.rotation))
                .map_err(|error| ReadError::from_below(&error).at(&rows.span))
        }
        Rotation::Quaternion(parts) => {
            let [x, y, z, w] = vector::<4>(variables, parts)?.into();
            let quaternion = nalgebra::Quaternion::new(w, x, y, z);
            let unit = UnitQuaternion::try_new(quaternion, 0.0)
                .ok_or_else(|| ReadError::new("the quaternion is zero").at(&parts.span))?;
            Ok(unit.to_rotation_matrix())
        }
        Rotation::Sequence(list) => list
            .iter()
            .try_fold(Rotation3::identity(), |before, next| Ok(rotation(next, variables)? * before)),
    }
}
