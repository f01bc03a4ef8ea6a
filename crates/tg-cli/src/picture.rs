//! Structures as `tg-report` draws them.

use nalgebra::{Matrix3, Rotation3, SVector, UnitQuaternion};
use tg_coords::Pose;
use tg_integrate::State;
use tg_model::{Form, PlaceError};
use tg_report::{CableFrame, CableOutline, Frame, MemberKind, MemberOutline, ModeShape, Outline, Placement};
use tg_scene::{PictureKind, Structure};

use crate::answer::Failure;

/// Draws one structure.
pub(crate) struct Painter<'s, const D: usize> {
    structure: &'s Structure<D>,
    /// Ends of each cable.
    ends: Vec<[Form<D>; 2]>,
    /// Vertices of all members, in order.
    vertices: Vec<Form<D>>,
}

impl<'s, const D: usize> Painter<'s, D> {
    /// A painter of a structure.
    pub(crate) fn new(structure: &'s Structure<D>) -> Result<Self, Failure> {
        let model = &structure.model;
        let ends = model.cables().map(|cable| {
            let [from, to] = model.cable_places(cable);
            Ok([model.form(from)?, model.form(to)?])
        });
        let vertices = model.members().zip(&structure.pictures).flat_map(|(member, picture)| {
            let place = move |vertex: &[f64; 3]| member.at(std::array::from_fn(|k| vertex[k]));
            picture.outline.vertices.iter().map(place).map(|place| model.form(place))
        });
        let vertices =
            vertices.collect::<Result<_, _>>().map_err(|error: PlaceError| Failure::analysis(error))?;
        let ends = ends.collect::<Result<_, _>>().map_err(|error: PlaceError| Failure::analysis(error))?;
        Ok(Self { structure, ends, vertices })
    }

    /// What does not change: outlines and names.
    pub(crate) fn outline(&self) -> Outline {
        let model = &self.structure.model;
        let mut outline = Outline::new(D);
        let against = padded(&SVector::<f64, D>::from(model.gravity())).map(|g| -g);
        let norm = against.iter().map(|g| g * g).sum::<f64>().sqrt();
        if norm > 0.0 {
            outline.up = against.map(|g| g / norm);
        }
        let members = model.members().zip(&self.structure.pictures);
        outline.members = members
            .map(|(member, picture)| MemberOutline {
                name: model.member_name(member).into(),
                kind: match picture.kind {
                    PictureKind::Bar => MemberKind::Bar,
                    PictureKind::Body => MemberKind::Body,
                    PictureKind::Particle => MemberKind::Particle,
                },
                vertices: picture.outline.vertices.clone(),
                edges: picture.outline.edges.clone(),
                faces: picture.outline.faces.clone(),
                radius: picture.radius,
            })
            .collect();
        let cables = model.cables().zip(&self.structure.groups);
        outline.cables = cables
            .map(|(cable, group)| CableOutline { name: model.cable_name(cable).into(), group: group.clone() })
            .collect();
        outline
    }

    /// Where everything is at full coordinates `q` and inputs `u`.
    pub(crate) fn frame(&self, time: f64, q: &[f64], u: &[f64]) -> Result<Frame, Failure> {
        let model = &self.structure.model;
        let poses = model.members().map(|member| {
            let pose = model.pose(member, q).map_err(Failure::analysis)?.pose;
            Ok(Placement { position: padded(&pose.position), rotation: quaternion(&pose) })
        });
        let rest = vec![0.0; q.len()];
        let cables = model.cables().zip(&self.ends).map(|(cable, ends)| {
            let state = model.cable(cable, q, &rest, u);
            CableFrame {
                ends: [&ends[0], &ends[1]].map(|end| padded(&end.eval(q))),
                tension: state.tension,
                length: state.length,
                rest: state.rest,
                slack: state.slack,
            }
        });
        let cables = cables.collect();
        Ok(Frame { time, poses: poses.collect::<Result<_, Failure>>()?, cables })
    }

    /// Where everything is in a state of a motion.
    pub(crate) fn frame_at(&self, state: &State) -> Result<Frame, Failure> {
        self.frame(state.t, &state.q, &self.structure.model.inputs_at(state.t))
    }

    /// A shape over the full coordinates, its largest displacement scaled to one.
    pub(crate) fn mode(
        &self,
        label: &str,
        frequency: Option<f64>,
        damping: Option<f64>,
        shape: &[f64],
    ) -> ModeShape {
        let mut vertices: Vec<[f64; 3]> =
            self.vertices.iter().map(|form| padded(&form.eval(shape))).collect();
        let mut ends: Vec<[[f64; 3]; 2]> =
            self.ends.iter().map(|ends| [&ends[0], &ends[1]].map(|end| padded(&end.eval(shape)))).collect();
        let largest =
            vertices.iter().map(|d| d.iter().map(|x| x * x).sum::<f64>().sqrt()).fold(0.0, f64::max);
        if largest > 0.0 {
            vertices.iter_mut().chain(ends.iter_mut().flatten()).flatten().for_each(|x| *x /= largest);
        }
        ModeShape { label: label.into(), frequency, damping, vertices, ends }
    }
}

/// Unit quaternion x, y, z, w of a rotation, about z in the plane.
pub(crate) fn quaternion<const D: usize>(pose: &Pose<D>) -> [f64; 4] {
    let rotation = Matrix3::from_fn(|i, j| match (i < D, j < D) {
        (true, true) => pose.rotation[(i, j)],
        _ => f64::from(u8::from(i == j)),
    });
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation)).coords.into()
}

fn padded<const D: usize>(vector: &SVector<f64, D>) -> [f64; 3] {
    std::array::from_fn(|k| if k < D { vector[k] } else { 0.0 })
}
