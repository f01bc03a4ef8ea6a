//! Members and cables, the farthest first.

use super::camera::{Camera, Extent};
use super::legend::{SLACK, Tensions};
use crate::canvas::{Canvas, Point, Stroke};
use crate::colour::{Colour, shade};
use crate::frame::{CableFrame, Frame, Placement};
use crate::outline::{MemberKind, MemberOutline, Outline};
use crate::vector::{Vec3, cross, dot, sub, unit};

const BAR: Colour = [108, 118, 134];
const BODY: Colour = [228, 196, 150];
const PARTICLE: Colour = [70, 70, 78];
/// Cables of a picture without a range of tensions.
const CABLE: Colour = [0, 114, 178];

/// A place on the paper for one frame.
pub(super) struct Sheet<'a> {
    pub(super) camera: &'a Camera,
    pub(super) extent: &'a Extent,
    pub(super) centre: Point,
    /// Pixels per metre.
    pub(super) scale: f64,
}

/// Something drawn, and how near it is to the eye \[m\].
struct Item {
    near: f64,
    shape: Shape,
}

enum Shape {
    Rod { ends: [Point; 2], width: f64, note: String },
    Edge([Point; 2]),
    Face([Point; 3], Colour),
    Ball { centre: Point, radius: f64 },
    Cable { ends: [Point; 2], stroke: Stroke<'static>, note: String },
}

impl Sheet<'_> {
    pub(super) fn structure(
        &self,
        canvas: &mut dyn Canvas,
        outline: &Outline,
        frame: &Frame,
        tensions: Option<&Tensions>,
    ) {
        let mut items = Vec::new();
        for (member, pose) in outline.members.iter().zip(&frame.poses) {
            self.member(&mut items, member, pose);
        }
        for (cable, state) in outline.cables.iter().zip(&frame.cables) {
            items.extend(self.cable(&cable.name, state, tensions));
        }
        items.sort_by(|a, b| a.near.total_cmp(&b.near));
        items.into_iter().for_each(|item| item.shape.draw(canvas));
    }

    /// The place on the paper, and how near; none of a point that is not finite.
    fn at(&self, p: Vec3) -> Option<(Point, f64)> {
        let [x, y, near] = self.camera.see(p);
        let middle = self.extent.centre();
        let at =
            [self.centre[0] + self.scale * (x - middle[0]), self.centre[1] - self.scale * (y - middle[1])];
        (at[0].is_finite() && at[1].is_finite()).then_some((at, near))
    }

    fn ends(&self, ends: [Vec3; 2]) -> Option<([Point; 2], f64)> {
        let [(a, near), (b, also)] = [self.at(ends[0])?, self.at(ends[1])?];
        Some(([a, b], 0.5 * (near + also)))
    }

    fn member(&self, items: &mut Vec<Item>, member: &MemberOutline, pose: &Placement) {
        let points: Vec<Vec3> = member.vertices.iter().map(|&v| pose.apply(v)).collect();
        items.extend(member.faces.iter().filter_map(|corners| self.face(corners.map(|i| points[i]))));
        let given = 2.0 * member.radius * self.scale;
        for edge in &member.edges {
            let Some((ends, near)) = self.ends(edge.map(|i| points[i])) else { continue };
            items.push(match member.kind {
                MemberKind::Bar => {
                    let width = if given > 0.0 { given.clamp(3.0, 16.0) } else { 6.0 };
                    Item { near, shape: Shape::Rod { ends, width, note: member.name.clone() } }
                }
                // In front of the faces that it bounds.
                _ => Item { near: near + 1e-9 * near.abs().max(1.0), shape: Shape::Edge(ends) },
            });
        }
        if member.kind == MemberKind::Particle {
            let radius = if given > 0.0 { (0.5 * given).clamp(3.0, 24.0) } else { 5.0 };
            let places = points.iter().filter_map(|&p| self.at(p));
            items.extend(places.map(|(centre, near)| Item { near, shape: Shape::Ball { centre, radius } }));
        }
    }

    /// A triangle, lighter where it faces the eye.
    fn face(&self, corners: [Vec3; 3]) -> Option<Item> {
        let [a, b, c] = corners;
        let places = [self.at(a)?, self.at(b)?, self.at(c)?];
        let facing = unit(cross(sub(b, a), sub(c, a))).map_or(0.0, |n| dot(n, self.camera.near).abs());
        let shape = Shape::Face(places.map(|(at, _)| at), shade(BODY, 0.4 * facing - 0.25));
        Some(Item { near: places.iter().map(|(_, near)| near).sum::<f64>() / 3.0, shape })
    }

    fn cable(&self, name: &str, state: &CableFrame, tensions: Option<&Tensions>) -> Option<Item> {
        let (ends, near) = self.ends(state.ends)?;
        let (stroke, note) = if state.slack {
            (SLACK, format!("{name}: slack"))
        } else {
            let colour = tensions.map_or(CABLE, |t| t.colour(state.tension));
            (Stroke::plain(2.0, colour), format!("{name}: {:.4} N", state.tension))
        };
        Some(Item { near, shape: Shape::Cable { ends, stroke, note } })
    }
}

impl Shape {
    fn draw(self, canvas: &mut dyn Canvas) {
        match self {
            Self::Rod { ends, width, note } => {
                canvas.line(&ends, Stroke::plain(width + 2.0, shade(BAR, -0.5)), "");
                canvas.line(&ends, Stroke::plain(width, BAR), &note);
            }
            Self::Edge(ends) => canvas.line(&ends, Stroke::plain(1.4, shade(BODY, -0.55)), ""),
            Self::Face(corners, colour) => canvas.polygon(&corners, colour, 0.85),
            Self::Ball { centre, radius } => {
                canvas.disc(centre, radius + 1.0, shade(PARTICLE, -0.5));
                canvas.disc(centre, radius, PARTICLE);
            }
            Self::Cable { ends, stroke, note } => canvas.line(&ends, stroke, &note),
        }
    }
}
