//! Members and cables, the farthest first.

use std::fmt::Write;

use crate::colour::{Colour, hex, shade};
use crate::frame::{CableFrame, Frame, Placement};
use crate::outline::{MemberKind, MemberOutline, Outline};
use crate::svg::bar::Tensions;
use crate::svg::camera::{Camera, Extent};
use crate::vector::{Vec3, cross, dot, sub, unit};

const BAR: Colour = [108, 118, 134];
const BODY: Colour = [228, 196, 150];
const PARTICLE: Colour = [70, 70, 78];
/// Cables of a frame without colours.
const PLAIN: Colour = [0, 114, 178];

/// A place on the paper for one frame.
pub(super) struct Sheet<'a> {
    pub(super) camera: &'a Camera,
    pub(super) extent: &'a Extent,
    pub(super) centre: [f64; 2],
    /// Pixels per metre.
    pub(super) scale: f64,
}

/// Something drawn, with how near it is.
struct Item {
    near: f64,
    svg: String,
}

impl Sheet<'_> {
    pub(super) fn structure(
        &self,
        out: &mut String,
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
        out.push_str("<g stroke-linecap=\"round\" stroke-linejoin=\"round\">\n");
        items.iter().for_each(|item| out.push_str(&item.svg));
        out.push_str("</g>\n");
    }

    /// Pixels, and how near \[m\]; none of a point that is not finite.
    fn at(&self, p: Vec3) -> Option<(String, f64)> {
        let [x, y, near] = self.camera.see(p);
        let middle = self.extent.centre();
        let x = self.centre[0] + self.scale * (x - middle[0]);
        let y = self.centre[1] - self.scale * (y - middle[1]);
        (x.is_finite() && y.is_finite()).then(|| (format!("{x:.2} {y:.2}"), near))
    }

    fn member(&self, items: &mut Vec<Item>, member: &MemberOutline, pose: &Placement) {
        let points: Vec<Vec3> = member.vertices.iter().map(|&v| pose.apply(v)).collect();
        for corners in &member.faces {
            items.extend(self.face(corners.map(|i| points[i])));
        }
        let given = 2.0 * member.radius * self.scale;
        for edge in &member.edges {
            let ends = edge.map(|i| points[i]);
            match member.kind {
                MemberKind::Bar => {
                    let width = if given > 0.0 { given.clamp(3.0, 16.0) } else { 6.0 };
                    let under = self.line(ends, width + 2.0, shade(BAR, -0.5), "");
                    let over = self.line(ends, width, BAR, "");
                    items.extend(
                        under
                            .zip(over)
                            .map(|(under, over)| Item { near: over.near, svg: under.svg + &over.svg }),
                    );
                }
                _ => items.extend(self.line(ends, 1.5, shade(BODY, -0.55), "").map(nearer)),
            }
        }
        if member.kind == MemberKind::Particle {
            let radius = if given > 0.0 { (0.5 * given).clamp(3.0, 24.0) } else { 5.0 };
            items.extend(points.iter().filter_map(|&p| self.ball(p, radius)));
        }
    }

    /// A triangle, lighter where it faces the eye.
    fn face(&self, corners: [Vec3; 3]) -> Option<Item> {
        let [a, b, c] = corners;
        let [p, q, r] = [self.at(a)?, self.at(b)?, self.at(c)?];
        let facing = unit(cross(sub(b, a), sub(c, a))).map_or(0.0, |n| dot(n, self.camera.near).abs());
        let fill = hex(shade(BODY, 0.35 * facing - 0.25));
        let svg = format!(
            "<path d=\"M{} L{} L{} Z\" fill=\"{fill}\" fill-opacity=\"0.85\" stroke=\"{fill}\" \
             stroke-width=\"0.5\"/>\n",
            p.0, q.0, r.0
        );
        Some(Item { near: (p.1 + q.1 + r.1) / 3.0, svg })
    }

    fn line(&self, ends: [Vec3; 2], width: f64, colour: Colour, more: &str) -> Option<Item> {
        let [(from, a), (to, b)] = [self.at(ends[0])?, self.at(ends[1])?];
        let colour = hex(colour);
        let svg = format!(
            "<path d=\"M{from} L{to}\" stroke=\"{colour}\" stroke-width=\"{width:.2}\" fill=\"none\"{more}/>\n"
        );
        Some(Item { near: 0.5 * (a + b), svg })
    }

    fn ball(&self, p: Vec3, radius: f64) -> Option<Item> {
        let (at, near) = self.at(p)?;
        let (x, y) = at.split_once(' ')?;
        let fill = hex(PARTICLE);
        let svg = format!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius:.2}\" fill=\"{fill}\"/>\n");
        Some(Item { near, svg })
    }

    fn cable(&self, name: &str, state: &CableFrame, tensions: Option<&Tensions>) -> Option<Item> {
        let (colour, dashes) = if state.slack {
            (super::bar::SLACK, " stroke-dasharray=\"5 5\"")
        } else {
            (tensions.map_or(PLAIN, |t| t.colour(state.tension)), "")
        };
        let mut item = self.line(state.ends, 2.0, colour, dashes)?;
        let mut title = String::new();
        let _ = write!(title, "><title>{}: ", crate::view::escaped(name));
        if state.slack {
            title.push_str("slack");
        } else {
            let _ = write!(title, "{:.4} N", state.tension);
        }
        title.push_str("</title></path>\n");
        item.svg.truncate(item.svg.trim_end_matches("/>\n").len());
        item.svg.push_str(&title);
        Some(item)
    }
}

/// Edges of a body belong in front of its faces.
fn nearer(item: Item) -> Item {
    Item { near: item.near + 1e-9 * item.near.abs().max(1.0), ..item }
}
