//! Numbering of nodes: members' nodes and anchors, merged where joints share them.

use nalgebra::SVector;
use tg_coords::Weights;

use crate::error::BuildError;
use crate::form::Form;
use crate::parts::{AnchorId, MemberId, Parts, Place, coordinates};
use crate::placed::PlacedMember;

/// Points that are to meet may be apart by this part of the structure's size: rounding of hand-written coordinates
/// passes, a misplaced member does not.
pub(crate) const MEETING: f64 = 1e-9;

/// Rounding of coordinates, per size of the structure, that leaves too little of its shape.
const RESOLVED: f64 = 1e-6;

/// Nodes before and after numbering. A *slot* is a node of one member or anchor before merging; a *node* is a
/// D-vector of the coordinates.
pub(crate) struct Nodes<const D: usize> {
    /// First slot of each member; anchors follow the members.
    first: Vec<usize>,
    first_anchor: usize,
    anchors: usize,
    /// Slot that stands for each slot (union by pointing to the earliest).
    parent: Vec<usize>,
    positions: Vec<SVector<f64, D>>,
    slot_names: Vec<String>,
    /// Slots that stay where they are unless a support moves them.
    hidden: Vec<usize>,
    /// Node of each slot, after `number`.
    node_of: Vec<usize>,
    /// Slot of each node.
    slot_of: Vec<usize>,
    size: f64,
}

impl<const D: usize> Nodes<D> {
    pub(crate) fn new(parts: &Parts<D>) -> Self {
        let (mut first, mut positions, mut slot_names) = (Vec::new(), Vec::new(), Vec::new());
        let mut points: Vec<SVector<f64, D>> = parts.anchors.iter().map(|a| a.position).collect();
        for part in &parts.members {
            first.push(positions.len());
            let kind = part.member.coord_type();
            for (i, x) in part.member.place(&part.pose).into_iter().enumerate() {
                slot_names.push(node_name(&part.name, i, kind.is_point(i)));
                if kind.is_point(i) {
                    points.push(x);
                } else {
                    points.push(positions[positions.len() - i] + x);
                }
                positions.push(x);
            }
        }
        let first_anchor = positions.len();
        positions.extend(parts.anchors.iter().map(|a| a.position));
        slot_names.extend(parts.anchors.iter().map(|a| format!("anchor \"{}\"", a.name)));
        let parent = (0..positions.len()).collect();
        Self {
            first,
            first_anchor,
            anchors: parts.anchors.len(),
            parent,
            positions,
            slot_names,
            hidden: Vec::new(),
            node_of: Vec::new(),
            slot_of: Vec::new(),
            size: extent(&points),
        }
    }

    /// Diagonal of the bounding box of all points \[m\].
    pub(crate) fn size(&self) -> f64 {
        self.size
    }

    /// Refuses a structure whose shape is rounded where it stands.
    pub(crate) fn check_resolved(&self) -> Result<(), BuildError> {
        let distance = self.positions.iter().fold(0.0_f64, |a, x| a.max(x.amax()));
        if f64::EPSILON * distance <= RESOLVED * self.size {
            return Ok(());
        }
        Err(BuildError::FarFromOrigin { size: self.size, distance })
    }

    pub(crate) fn position(&self, slot: usize) -> SVector<f64, D> {
        self.positions[slot]
    }

    fn root(&self, mut slot: usize) -> usize {
        while self.parent[slot] != slot {
            slot = self.parent[slot];
        }
        slot
    }

    pub(crate) fn merge(&mut self, a: usize, b: usize) {
        let (a, b) = (self.root(a), self.root(b));
        let (keep, drop) = (a.min(b), a.max(b));
        self.parent[drop] = keep;
    }

    /// A member two of whose points became one.
    pub(crate) fn self_joined(&self) -> Option<usize> {
        let ends = self.first.iter().skip(1).copied().chain([self.first_anchor]);
        self.first.iter().zip(ends).position(|(&from, to)| {
            let roots: Vec<usize> = (from..to).map(|slot| self.root(slot)).collect();
            roots.iter().enumerate().any(|(i, root)| roots[..i].contains(root))
        })
    }

    /// Numbers the nodes in the order of their slots.
    pub(crate) fn number(&mut self) {
        self.node_of = vec![0; self.positions.len()];
        for slot in 0..self.positions.len() {
            let root = self.root(slot);
            if root == slot {
                self.node_of[slot] = self.slot_of.len();
                self.slot_of.push(slot);
            } else {
                self.node_of[slot] = self.node_of[root];
            }
        }
    }

    /// A prescribed node at a form's initial position, for a support at a material point.
    pub(crate) fn add_hidden(&mut self, form: &Form<D>, support: &str) -> usize {
        let (slot, node) = (self.positions.len(), self.slot_of.len());
        self.positions.push(form.eval(&self.initial()));
        self.slot_names.push(format!("base of support \"{support}\""));
        self.parent.push(slot);
        self.hidden.push(slot);
        self.node_of.push(node);
        self.slot_of.push(slot);
        node
    }

    pub(crate) fn count(&self) -> usize {
        self.slot_of.len()
    }

    /// Nodes of anchors and hidden bases.
    pub(crate) fn fixed(&self) -> impl Iterator<Item = usize> {
        let anchors = self.first_anchor..self.first_anchor + self.anchors;
        anchors.chain(self.hidden.iter().copied()).map(|slot| self.node_of[slot])
    }

    pub(crate) fn anchors(&self) -> Vec<usize> {
        (self.first_anchor..self.first_anchor + self.anchors).map(|slot| self.node_of[slot]).collect()
    }

    pub(crate) fn names(&self) -> Vec<String> {
        self.slot_of.iter().map(|&slot| self.slot_names[slot].clone()).collect()
    }

    pub(crate) fn initial(&self) -> Vec<f64> {
        self.slot_of.iter().flat_map(|&slot| self.positions[slot].iter().copied()).collect()
    }

    pub(crate) fn place_members(&self, parts: &Parts<D>) -> Vec<PlacedMember<D>> {
        let pairs = parts.members.iter().zip(&self.first);
        pairs
            .map(|(part, &first)| PlacedMember {
                name: part.name.clone(),
                nodes: (first..first + part.member.coord_type().nodes())
                    .map(|slot| self.node_of[slot])
                    .collect(),
                member: part.member.clone(),
            })
            .collect()
    }

    /// A member's weights as a form over the structure's nodes (the selection of eq. 22).
    pub(crate) fn member_form(&self, member: usize, weights: &Weights) -> Form<D> {
        let nodes = self.node_of[self.first[member]..].iter().copied();
        Form::new(nodes.zip(weights.as_slice().iter().copied()))
    }

    /// The form of a node, basic point or base vector.
    pub(crate) fn node_form(
        &self,
        parts: &Parts<D>,
        kind: &'static str,
        name: &str,
        place: Place<D>,
    ) -> Result<Form<D>, BuildError> {
        let slot = self.slot(parts, kind, name, place)?;
        Ok(Form::new(slot.map(|slot| (self.node_of[slot], 1.0))))
    }

    /// The form of a point; base vectors are refused.
    pub(crate) fn point(
        &self,
        parts: &Parts<D>,
        kind: &'static str,
        name: &str,
        place: Place<D>,
    ) -> Result<Form<D>, BuildError> {
        if let Some(slot) = self.slot(parts, kind, name, place)? {
            if self.is_vector(parts, place) {
                let place = self.describe(parts, place);
                return Err(BuildError::NotAPoint { kind, name: name.into(), place });
            }
            return Ok(Form::new([(self.node_of[slot], 1.0)]));
        }
        match place {
            Place::Material(MemberId(m), local) => parts.members[m]
                .member
                .point_weights(local.into())
                .map(|weights| self.member_form(m, &weights))
                .map_err(|source| coordinates(kind, name, source)),
            Place::MassCentre(MemberId(m)) => {
                Ok(self.member_form(m, &parts.members[m].member.mass_centre_weights()))
            }
            Place::Node(..) | Place::Anchor(_) => Ok(Form::new([])),
        }
    }

    /// The slot of a basic point or anchor that a joint may share.
    pub(crate) fn shareable(
        &self,
        parts: &Parts<D>,
        joint: &str,
        place: Place<D>,
    ) -> Result<usize, BuildError> {
        match self.slot(parts, "joint", joint, place)? {
            Some(slot) if !self.is_vector(parts, place) => Ok(slot),
            _ => Err(BuildError::CannotShare { name: joint.into(), place: self.describe(parts, place) }),
        }
    }

    fn is_vector(&self, parts: &Parts<D>, place: Place<D>) -> bool {
        matches!(place, Place::Node(MemberId(m), i) if !parts.members[m].member.coord_type().is_point(i))
    }

    /// The slot of a place, if it is one; checks that the place exists.
    fn slot(
        &self,
        parts: &Parts<D>,
        kind: &'static str,
        name: &str,
        place: Place<D>,
    ) -> Result<Option<usize>, BuildError> {
        let dangling = |mend| {
            Err(BuildError::Dangling { kind, name: name.into(), place: self.describe(parts, place), mend })
        };
        match place {
            Place::Node(MemberId(m), _)
            | Place::Material(MemberId(m), _)
            | Place::MassCentre(MemberId(m))
                if m >= parts.members.len() =>
            {
                dangling("add that member to this builder first")
            }
            Place::Anchor(AnchorId(a)) if a >= self.anchors => {
                dangling("add that anchor to this builder first")
            }
            Place::Node(MemberId(m), i) => {
                if i < parts.members[m].member.coord_type().nodes() {
                    Ok(Some(self.first[m] + i))
                } else {
                    dangling("nodes count from 0 in the order of the coordinate type")
                }
            }
            Place::Anchor(AnchorId(a)) => Ok(Some(self.first_anchor + a)),
            Place::Material(..) | Place::MassCentre(_) => Ok(None),
        }
    }

    /// Length by which a joint's residual is scaled: the largest base vector of its members, else the structure.
    pub(crate) fn scale(&self, parts: &Parts<D>, places: &[Place<D>]) -> f64 {
        let of = |place: &Place<D>| match *place {
            Place::Node(MemberId(m), _)
            | Place::Material(MemberId(m), _)
            | Place::MassCentre(MemberId(m)) => {
                let dots = parts.members[m].member.constraints().iter();
                dots.map(|dot| dot.scale().sqrt()).fold(0.0, f64::max)
            }
            Place::Anchor(_) => 0.0,
        };
        let largest = places.iter().map(of).fold(0.0, f64::max);
        if largest > 0.0 { largest } else { self.size }
    }

    /// Words for a place.
    pub(crate) fn describe(&self, parts: &Parts<D>, place: Place<D>) -> String {
        let member = |m: usize| parts.members.get(m).map_or("?", |part| part.name.as_str());
        match place {
            Place::Node(MemberId(m), i) => {
                let is_point = parts.members.get(m).is_none_or(|part| part.member.coord_type().is_point(i));
                node_name(member(m), i, is_point)
            }
            Place::Material(MemberId(m), local) => format!("point {local:?} of \"{}\"", member(m)),
            Place::MassCentre(MemberId(m)) => format!("mass centre of \"{}\"", member(m)),
            Place::Anchor(AnchorId(a)) => {
                format!("anchor \"{}\"", parts.anchors.get(a).map_or("?", |part| part.name.as_str()))
            }
        }
    }
}

fn node_name(member: &str, node: usize, is_point: bool) -> String {
    let what = if is_point { "basic point" } else { "base vector" };
    format!("{what} {node} of \"{member}\"")
}

fn extent<const D: usize>(points: &[SVector<f64, D>]) -> f64 {
    let mut low = SVector::<f64, D>::repeat(f64::INFINITY);
    let mut high = SVector::<f64, D>::repeat(f64::NEG_INFINITY);
    for p in points {
        low = low.inf(p);
        high = high.sup(p);
    }
    let size = (high - low).norm();
    if size.is_finite() && size > 0.0 { size } else { 1.0 }
}
