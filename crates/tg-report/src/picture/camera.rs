//! From space to paper.

use crate::frame::Frame;
use crate::outline::Outline;
use crate::picture::Projection;
use crate::vector::{Vec3, add, bounds, cross, dot, scale, sub, unit};

/// A parallel projection.
pub(super) struct Camera {
    right: Vec3,
    up: Vec3,
    /// Towards the eye.
    pub(super) near: Vec3,
}

/// The part of the paper that is used \[m\].
pub(super) struct Extent {
    pub(super) least: [f64; 2],
    pub(super) greatest: [f64; 2],
}

impl Camera {
    pub(super) fn new(outline: &Outline, projection: Projection) -> Self {
        let up = unit(outline.up).unwrap_or([0.0, 0.0, 1.0]);
        // The first axis that is not upright, made level.
        let axis = if up[0].abs() < 0.9 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
        let right = unit(sub(axis, scale(dot(axis, up), up))).unwrap_or([0.0, 1.0, 0.0]);
        let near = cross(right, up);
        match projection {
            Projection::Front => Self { right, up, near },
            Projection::Side => Self { right: scale(-1.0, near), up, near: right },
            Projection::Top => Self { right, up: scale(-1.0, near), near: up },
            Projection::Isometric => {
                let eye = unit(add(add(right, near), up)).unwrap_or(near);
                let right = unit(cross(up, eye)).unwrap_or(right);
                Self { right, up: cross(eye, right), near: eye }
            }
        }
    }

    /// Right, up and towards the eye \[m\].
    pub(super) fn see(&self, p: Vec3) -> Vec3 {
        [dot(p, self.right), dot(p, self.up), dot(p, self.near)]
    }

    /// What some frames fill together; none without a finite point.
    pub(super) fn extent(&self, outline: &Outline, frames: &[Frame]) -> Option<Extent> {
        let points = || {
            frames.iter().flat_map(|frame| {
                let members = outline.members.iter().zip(&frame.poses);
                let vertices = members.flat_map(|(m, pose)| m.vertices.iter().map(|&v| pose.apply(v)));
                vertices.chain(frame.cables.iter().flat_map(|c| c.ends)).map(|p| self.see(p))
            })
        };
        points().find(|p| p.iter().all(|x| x.is_finite()))?;
        let [least, greatest] = bounds(points());
        Some(Extent { least: [least[0], least[1]], greatest: [greatest[0], greatest[1]] })
    }
}
