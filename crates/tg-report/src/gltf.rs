//! glTF 2.0 in one self-contained `.glb` file: what browsers, Blender and slides show.
//!
//! Each member is a node that moves; each cable is a node whose unit rod (along z) is placed, turned and stretched between
//! its ends, thin, because many programs do not show lines. y points up, as the format wants.

mod buffer;
mod mesh;
mod motion;

use std::path::Path;

use serde_json::{Map, Value, json};

use crate::colour::{Colour, SERIES};
use crate::error::ReportError;
use crate::folder::write_file;
use crate::frame::Frame;
use crate::outline::{MemberKind, Outline};
use crate::vector::{bounds, norm, shortest, sub, unit};
use buffer::Buffer;
use mesh::{Mesh, Sizes};
use motion::Track;

/// Writes a `.glb` file; one frame makes a still picture.
///
/// # Errors
/// There is no frame, one does not fit the outline, or the file cannot be written.
pub fn write_glb(path: &Path, outline: &Outline, frames: &[Frame]) -> Result<(), ReportError> {
    write_file(path, &glb(outline, frames)?)
}

/// The content of a `.glb` file. Frames with a number that is not finite, and those not later than the one before, are
/// left out; the motion starts at 0 s.
///
/// # Errors
/// There is no frame, or one does not fit the outline.
pub fn glb(outline: &Outline, frames: &[Frame]) -> Result<Vec<u8>, ReportError> {
    outline.check()?;
    frames.iter().try_for_each(|f| f.check(outline))?;
    let frames = motion::usable(frames);
    let Some(first) = frames.first() else {
        let reason = "there is no frame with finite numbers".into();
        return Err(ReportError::Empty { what: "the animation".into(), reason });
    };
    let mut scene = Scene::new(extent(outline, first));
    let times = motion::times(&frames);
    for (k, member) in outline.members.iter().enumerate() {
        let track = Track::of_member(&frames, k);
        let mesh = scene.mesh(&member.name, &Mesh::of_member(member, scene.sizes), material(member.kind));
        scene.node(&member.name, mesh, &track);
    }
    let groups = groups(outline);
    let rod = Mesh::unit_rod();
    let mut rods = vec![None; groups.len()];
    for (k, cable) in outline.cables.iter().enumerate() {
        let group = groups.iter().position(|g| *g == cable.group.as_deref()).unwrap_or(0);
        let track = Track::of_cable(&frames, k, scene.sizes.cable);
        if rods[group].is_none() {
            rods[group] = scene.mesh("cable", &rod, ("cable", SERIES[group % SERIES.len()]));
        }
        scene.node(&cable.name, rods[group], &track);
    }
    scene.write(outline, &times)
}

fn material(kind: MemberKind) -> (&'static str, Colour) {
    match kind {
        MemberKind::Bar => ("bar", [96, 104, 120]),
        MemberKind::Body => ("body", [222, 178, 120]),
        MemberKind::Particle => ("particle", [70, 70, 78]),
    }
}

/// Groups of cables in order of appearance.
fn groups(outline: &Outline) -> Vec<Option<&str>> {
    let mut groups = Vec::new();
    for cable in &outline.cables {
        if !groups.contains(&cable.group.as_deref()) {
            groups.push(cable.group.as_deref());
        }
    }
    groups
}

/// Size of the structure at one time \[m\].
fn extent(outline: &Outline, frame: &Frame) -> f64 {
    let members = outline.members.iter().zip(&frame.poses);
    let vertices = members.flat_map(|(m, pose)| m.vertices.iter().map(|&v| pose.apply(v)));
    let ends = frame.cables.iter().flat_map(|c| c.ends);
    let [least, greatest] = bounds(vertices.chain(ends));
    let size = norm(sub(greatest, least));
    if size > 0.0 { size } else { 1.0 }
}

/// A file that is being put together.
struct Scene {
    sizes: Sizes,
    buffer: Buffer,
    meshes: Vec<Value>,
    /// Names and sRGB colours.
    materials: Vec<(&'static str, Colour)>,
    nodes: Vec<Value>,
    samplers: Vec<Value>,
    channels: Vec<Value>,
}

impl Scene {
    fn new(extent: f64) -> Self {
        Self {
            sizes: Sizes::of(extent),
            buffer: Buffer::default(),
            meshes: Vec::new(),
            materials: Vec::new(),
            nodes: Vec::new(),
            samplers: Vec::new(),
            channels: Vec::new(),
        }
    }

    /// Adds a mesh; none where it has no triangle.
    fn mesh(&mut self, name: &str, mesh: &Mesh, material: (&'static str, Colour)) -> Option<usize> {
        if mesh.triangles.is_empty() {
            return None;
        }
        let known = self.materials.iter().position(|m| *m == material);
        let material = known.unwrap_or_else(|| {
            self.materials.push(material);
            self.materials.len() - 1
        });
        let attributes = json!({
            "POSITION": self.buffer.positions(&mesh.positions),
            "NORMAL": self.buffer.directions(&mesh.normals),
        });
        let indices = self.buffer.indices(&mesh.triangles);
        let primitive =
            json!({"attributes": attributes, "indices": indices, "material": material, "mode": 4});
        self.meshes.push(json!({"name": name, "primitives": [primitive]}));
        Some(self.meshes.len() - 1)
    }

    /// Adds a node, animated in what changes.
    fn node(&mut self, name: &str, mesh: Option<usize>, track: &Track) {
        let number = self.nodes.len() + 1; // 0 is the root
        let mut node = Map::new();
        node.insert("name".into(), name.into());
        node.insert("translation".into(), json!(track.translation[0]));
        node.insert("rotation".into(), json!(track.rotation[0]));
        node.insert("scale".into(), json!(track.scale[0]));
        if let Some(mesh) = mesh {
            node.insert("mesh".into(), mesh.into());
        }
        self.nodes.push(node.into());
        self.animate(number, "translation", &track.translation);
        self.animate(number, "rotation", &track.rotation);
        self.animate(number, "scale", &track.scale);
    }

    fn animate<const N: usize>(&mut self, node: usize, path: &str, keys: &[[f32; N]]) {
        if keys.iter().all(|key| *key == keys[0]) {
            return;
        }
        let output = self.buffer.keys(keys);
        let sampler = self.samplers.len();
        self.samplers.push(json!({"interpolation": "LINEAR", "output": output}));
        self.channels.push(json!({"sampler": sampler, "target": {"node": node, "path": path}}));
    }

    fn write(mut self, outline: &Outline, times: &[f32]) -> Result<Vec<u8>, ReportError> {
        if !self.samplers.is_empty() {
            let input = self.buffer.times(times);
            self.samplers.iter_mut().for_each(|s| s["input"] = input.into());
        }
        let up = unit(outline.up).unwrap_or([0.0, 1.0, 0.0]);
        let children: Vec<usize> = (1..=self.nodes.len()).collect();
        let mut root =
            json!({"name": "structure", "rotation": shortest(up, [0.0, 1.0, 0.0]).map(|x| x as f32)});
        if !children.is_empty() {
            root["children"] = children.into();
        }
        self.nodes.insert(0, root);
        let mut file = json!({
            "asset": {"version": "2.0", "generator": concat!("tg-report ", env!("CARGO_PKG_VERSION"))},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": self.nodes,
        });
        // Lists must not be empty.
        if !self.meshes.is_empty() {
            file["meshes"] = self.meshes.into();
            file["materials"] = self.materials.into_iter().map(material_json).collect();
        }
        if !self.channels.is_empty() {
            file["animations"] =
                json!([{"name": "motion", "channels": self.channels, "samplers": self.samplers}]);
        }
        self.buffer.write(file)
    }
}

fn material_json((name, colour): (&str, Colour)) -> Value {
    let [r, g, b] = colour.map(linear);
    json!({
        "name": name,
        "doubleSided": name == "body",
        "pbrMetallicRoughness": {"baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.7},
    })
}

/// The format wants linear light.
fn linear(s: u8) -> f64 {
    let s = f64::from(s) / 255.0;
    if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) }
}
