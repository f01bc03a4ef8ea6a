//! Triangles of members and of the rod that cables are.

use std::f64::consts::TAU;

use crate::outline::{MemberKind, MemberOutline};
use crate::vector::{Vec3, across, add, cross, norm, scale, sub, unit};

/// Corners of a rod's section.
const SIDES: usize = 12;

/// Triangles with a normal at each corner.
#[derive(Clone, Debug, Default)]
pub(super) struct Mesh {
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// Radii where the outline gives none \[m\].
#[derive(Clone, Copy, Debug)]
pub(super) struct Sizes {
    bar: f64,
    edge: f64,
    particle: f64,
    pub(super) cable: f64,
}

impl Sizes {
    /// Sizes for a structure of this extent.
    pub(super) fn of(extent: f64) -> Self {
        Self { bar: 0.008 * extent, edge: 0.003 * extent, particle: 0.018 * extent, cable: 0.0022 * extent }
    }
}

impl Mesh {
    pub(super) fn of_member(member: &MemberOutline, sizes: Sizes) -> Self {
        let mut mesh = Self::default();
        let given = |default: f64| if member.radius > 0.0 { member.radius } else { default };
        for corners in &member.faces {
            mesh.face(corners.map(|i| member.vertices[i]));
        }
        let radius = match member.kind {
            MemberKind::Bar => given(sizes.bar),
            _ => sizes.edge,
        };
        for edge in &member.edges {
            mesh.rod(edge.map(|i| member.vertices[i]), radius);
        }
        if member.kind == MemberKind::Particle {
            member.vertices.iter().for_each(|&v| mesh.ball(v, given(sizes.particle)));
        }
        mesh
    }

    /// A rod from 0 to 1 along z, of radius 1.
    pub(super) fn unit_rod() -> Self {
        let mut mesh = Self::default();
        mesh.rod([[0.0; 3], [0.0, 0.0, 1.0]], 1.0);
        mesh
    }

    fn corner(&mut self, position: Vec3, normal: Vec3) -> u32 {
        self.positions.push(position.map(|x| x as f32));
        self.normals.push(normal.map(|x| x as f32));
        self.positions.len() as u32 - 1
    }

    /// A flat triangle; one without area is left out.
    fn face(&mut self, corners: [Vec3; 3]) {
        let [a, b, c] = corners;
        if let Some(normal) = unit(cross(sub(b, a), sub(c, a))) {
            let triangle = corners.map(|p| self.corner(p, normal));
            self.triangles.push(triangle);
        }
    }

    /// A closed cylinder; one without length is left out.
    fn rod(&mut self, [a, b]: [Vec3; 2], radius: f64) {
        let Some(axis) = unit(sub(b, a)).filter(|_| norm(sub(b, a)) > 0.0) else { return };
        let u = across(axis);
        let v = cross(axis, u);
        let direction = |k: usize| {
            let (sin, cos) = (TAU * k as f64 / SIDES as f64).sin_cos();
            add(scale(cos, u), scale(sin, v))
        };
        let side: Vec<[u32; 2]> = (0..SIDES)
            .map(|k| [a, b].map(|end| self.corner(add(end, scale(radius, direction(k))), direction(k))))
            .collect();
        for k in 0..SIDES {
            let ([p, q], [r, s]) = (side[k], side[(k + 1) % SIDES]);
            self.triangles.extend([[p, r, s], [p, s, q]]);
        }
        for (end, normal) in [(a, scale(-1.0, axis)), (b, axis)] {
            let rim: Vec<u32> =
                (0..SIDES).map(|k| self.corner(add(end, scale(radius, direction(k))), normal)).collect();
            for k in 1..SIDES - 1 {
                let (second, third) = if end == a { (rim[k + 1], rim[k]) } else { (rim[k], rim[k + 1]) };
                self.triangles.push([rim[0], second, third]);
            }
        }
    }

    /// A ball of rings.
    fn ball(&mut self, centre: Vec3, radius: f64) {
        let rings = SIDES / 2;
        let start = self.positions.len() as u32;
        for i in 0..=rings {
            let (height, across) = (TAU / 2.0 * i as f64 / rings as f64).sin_cos();
            for k in 0..SIDES {
                let (sin, cos) = (TAU * k as f64 / SIDES as f64).sin_cos();
                let normal = [height * cos, height * sin, across];
                self.corner(add(centre, scale(radius, normal)), normal);
            }
        }
        let at = |i: usize, k: usize| start + (i * SIDES + k % SIDES) as u32;
        for i in 0..rings {
            for k in 0..SIDES {
                if i > 0 {
                    self.triangles.push([at(i, k), at(i + 1, k), at(i, k + 1)]);
                }
                if i + 1 < rings {
                    self.triangles.push([at(i, k + 1), at(i + 1, k), at(i + 1, k + 1)]);
                }
            }
        }
    }
}
