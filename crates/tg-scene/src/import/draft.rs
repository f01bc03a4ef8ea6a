//! What every format becomes before it is written: nodes, and what holds and joins them.

use nalgebra::{Matrix3, Vector3};

use super::ImportOptions;
use super::names::clean;
use super::sources::{At, Fault};

/// A structure of nodes. In the plane z is zero.
#[derive(Debug, Default)]
pub(super) struct Draft {
    pub(super) title: Option<String>,
    pub(super) dimension: usize,
    /// What the file is and what the importer made of it, as comments.
    pub(super) notes: Vec<String>,
    pub(super) warnings: Vec<String>,
    /// Gravity as the format's users have it, as a comment.
    pub(super) gravity: String,
    pub(super) nodes: Vec<DraftNode>,
    pub(super) bars: Vec<DraftBar>,
    pub(super) bodies: Vec<DraftBody>,
    pub(super) cables: Vec<DraftCable>,
    pub(super) drop_redundancies: bool,
}

#[derive(Debug)]
pub(super) struct DraftNode {
    pub(super) name: String,
    pub(super) position: Vector3<f64>,
    pub(super) fixed: [bool; 3],
    pub(super) mass: Option<f64>,
    pub(super) at: At,
}

#[derive(Debug)]
pub(super) struct DraftBar {
    pub(super) name: String,
    pub(super) ends: [usize; 2],
    pub(super) mass: BarMass,
    pub(super) radius: Option<f64>,
    pub(super) at: At,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum BarMass {
    Mass(f64),
    LineDensity(f64),
    /// With the radius.
    Density(f64),
}

#[derive(Debug)]
pub(super) struct DraftBody {
    pub(super) name: String,
    pub(super) nodes: Vec<usize>,
    /// Pairs of nodes to draw.
    pub(super) edges: Vec<[usize; 2]>,
    pub(super) mass: f64,
    pub(super) centre: Vector3<f64>,
    /// About the mass centre, along the axes of space; in the plane its last entry.
    pub(super) inertia: Matrix3<f64>,
}

#[derive(Debug)]
pub(super) struct DraftCable {
    pub(super) name: String,
    pub(super) ends: [usize; 2],
    pub(super) group: Option<String>,
    pub(super) stiffness: Stiffness,
    pub(super) damping: f64,
    pub(super) rest: Rest,
    pub(super) linear: bool,
    pub(super) at: At,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Stiffness {
    Spring(f64),
    Axial(f64),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rest {
    Length(f64),
    Ratio(f64),
    Tension(f64),
    ForceDensity(f64),
}

impl Draft {
    /// Whether all components of a node are held.
    pub(super) fn is_anchor(&self, node: usize) -> bool {
        self.nodes[node].fixed[..self.dimension].iter().all(|held| *held)
    }

    /// Faults that the file's author can mend: no length, nothing that holds a cable.
    pub(super) fn check(&self) -> Result<(), Fault> {
        let mut held: Vec<bool> =
            (0..self.nodes.len()).map(|k| self.is_anchor(k) || self.nodes[k].mass.is_some()).collect();
        let bars = self.bars.iter().flat_map(|bar| bar.ends);
        let bodies = self.bodies.iter().flat_map(|body| body.nodes.iter().copied());
        bars.chain(bodies).for_each(|node| held[node] = true);
        for bar in &self.bars {
            self.has_length("bar", &bar.name, bar.ends, &bar.at)?;
        }
        for cable in &self.cables {
            self.has_length("cable", &cable.name, cable.ends, &cable.at)?;
            if let Some(node) = cable.ends.into_iter().find(|node| !held[*node]) {
                let name = &self.nodes[node].name;
                let message =
                    format!("cable \"{}\" ends in node \"{name}\", which only cables hold", cable.name);
                return Err(cable.at.fault(message, "give the node a mass, fix it, or let a bar end there"));
            }
        }
        let loose = |k: usize| self.nodes[k].fixed.contains(&true) && !held[k];
        if let Some(node) = (0..self.nodes.len()).find(|k| loose(*k)) {
            let DraftNode { name, at, .. } = &self.nodes[node];
            let message = format!("node \"{name}\" is held in part, and nothing is there to be held");
            return Err(at.fault(message, "fix all its components, give it a mass, or let a bar end there"));
        }
        if self.bars.is_empty() && self.bodies.is_empty() && self.nodes.iter().all(|n| n.mass.is_none()) {
            let at = self.nodes.first().map_or_else(At::default, |node| node.at.clone());
            return Err(at.fault("nothing here has a mass", "a structure needs bars, bodies or particles"));
        }
        Ok(())
    }

    /// Says that bars came without mass.
    pub(super) fn warn_of_assumed_mass(&mut self, bars: usize) {
        if bars > 0 {
            let message = format!(
                "{bars} bars have no mass; a line density of 1 kg/m (in units of the file) is assumed for them"
            );
            self.warnings.push(message);
        }
    }

    /// Makes names of groups usable and says which nodes nothing uses.
    pub(super) fn tidy(&mut self) {
        for cable in &mut self.cables {
            cable.group = cable.group.take().map(|name| clean(&name)).filter(|name| !name.is_empty());
        }
        let mut used: Vec<bool> =
            (0..self.nodes.len()).map(|k| self.is_anchor(k) || self.nodes[k].mass.is_some()).collect();
        let ends = self.bars.iter().map(|bar| bar.ends).chain(self.cables.iter().map(|cable| cable.ends));
        let bodies = self.bodies.iter().flat_map(|body| body.nodes.iter().copied());
        ends.flatten().chain(bodies).for_each(|node| used[node] = true);
        let unused: Vec<&str> = self
            .nodes
            .iter()
            .zip(&used)
            .filter(|(_, used)| !**used)
            .map(|(node, _)| node.name.as_str())
            .collect();
        if !unused.is_empty() {
            let more = if unused.len() > 8 { ", ..." } else { "" };
            let named = unused[..unused.len().min(8)].join(", ");
            self.warnings
                .push(format!("{} nodes are left out, as nothing uses them: {named}{more}", unused.len()));
        }
    }

    fn has_length(&self, kind: &str, name: &str, [from, to]: [usize; 2], at: &At) -> Result<(), Fault> {
        let length = (self.nodes[to].position - self.nodes[from].position).norm();
        if length > 0.0 && length.is_finite() {
            return Ok(());
        }
        let [from, to] = [from, to].map(|node| &self.nodes[node].name);
        let message = format!("{kind} \"{name}\" from \"{from}\" to \"{to}\" has the length {length}");
        Err(at.fault(message, "its two nodes must be apart"))
    }

    /// To SI units.
    pub(super) fn scale(&mut self, options: &ImportOptions) {
        let ImportOptions { length_scale: l, force_scale: f, mass_scale: m } = *options;
        for node in &mut self.nodes {
            node.position *= l;
            node.mass = node.mass.map(|mass| mass * m);
        }
        for bar in &mut self.bars {
            bar.radius = bar.radius.map(|radius| radius * l);
            bar.mass = match bar.mass {
                BarMass::Mass(mass) => BarMass::Mass(mass * m),
                BarMass::LineDensity(density) => BarMass::LineDensity(density * m / l),
                BarMass::Density(density) => BarMass::Density(density * m / (l * l * l)),
            };
        }
        for body in &mut self.bodies {
            body.mass *= m;
            body.centre *= l;
            body.inertia *= m * l * l;
        }
        for cable in &mut self.cables {
            cable.damping *= f / l;
            cable.stiffness = match cable.stiffness {
                Stiffness::Spring(k) => Stiffness::Spring(k * f / l),
                Stiffness::Axial(ea) => Stiffness::Axial(ea * f),
            };
            cable.rest = match cable.rest {
                Rest::Length(rest) => Rest::Length(rest * l),
                Rest::Ratio(ratio) => Rest::Ratio(ratio),
                Rest::Tension(tension) => Rest::Tension(tension * f),
                Rest::ForceDensity(density) => Rest::ForceDensity(density * f / l),
            };
        }
    }
}
