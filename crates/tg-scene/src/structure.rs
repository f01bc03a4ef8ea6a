//! What a scene becomes: the model, and what pictures and results need besides.

use tg_model::{Model, Place};

pub use crate::shape::Outline;

/// The structure of a scene in D-dimensional space.
#[derive(Clone, Debug)]
pub struct Structure<const D: usize> {
    /// The model.
    pub model: Model<D>,
    /// How each member looks, in the order of [`Model::members`].
    pub pictures: Vec<MemberPicture>,
    /// The group of each cable, in the order of [`Model::cables`].
    pub groups: Vec<Option<String>>,
    /// Points whose motion is asked for.
    pub watched: Vec<(String, Place<D>)>,
    /// Full velocities at t = 0 \[m/s\], members' as written, not yet reconciled with joints and supports.
    pub velocities: Vec<f64>,
}

/// How a member looks.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberPicture {
    /// What it is.
    pub kind: PictureKind,
    /// Its lines and faces in its local frame \[m\].
    pub outline: Outline,
    /// Radius of its lines \[m\]; of a particle 0: as pictures like.
    pub radius: f64,
}

/// What a member is, for pictures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureKind {
    /// A thin bar.
    Bar,
    /// A body.
    Body,
    /// A particle.
    Particle,
}

/// The structure of a scene, in the plane or in space.
#[derive(Clone, Debug)]
pub enum Built {
    /// In the plane.
    Plane(Box<Structure<2>>),
    /// In space.
    Space(Box<Structure<3>>),
}
