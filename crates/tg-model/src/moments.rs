//! Moments as generalised forces on the natural coordinates of members, one set of loads per kind.
//!
//! ```text
//! plane        Q = M ∂θ/∂q                          θ the member's angle                      child `plane`
//! bar          Q_u = M × u / |u|²,  ∂(M_ε ε + M_β β)/∂u                                      child `bar`
//! body         Q_a = ½ M × Σ_b (w_a·w_b) q_b        from δW = ½ Σ_k M·(e_k × δe_k)            child `body`
//! ```
//! The kinds differ in the dimension of their structure; sets of the other dimension stay empty. Tangents are blocks over
//! pairs of the member's nodes, after those of the cables in the entry order.

mod bar;
mod body;
mod plane;

use tg_coords::CoordType;

use crate::error::BuildError;
use crate::load::{Load, MomentAxes};
use crate::mechanics::At;
use crate::nodes::Nodes;
use crate::parts::{MemberId, Parts};
use bar::{BarMoments, SpatialMoment, UniversalJoint};
use body::BodyMoments;
use plane::PlaneMoments;

/// All moments of a structure.
#[derive(Clone, Debug, Default)]
pub(crate) struct Moments {
    plane: PlaneMoments,
    joint: BarMoments<UniversalJoint>,
    bar: BarMoments<SpatialMoment>,
    body: BodyMoments<false>,
    following: BodyMoments<true>,
}

/// Calls a method on each set in turn, in the one order that fixes all entry orders.
macro_rules! each_set {
    ($moments:expr, |$set:ident| $body:expr) => {{
        let $set = &$moments.plane;
        $body;
        let $set = &$moments.joint;
        $body;
        let $set = &$moments.bar;
        $body;
        let $set = &$moments.body;
        $body;
        let $set = &$moments.following;
        $body;
    }};
}

impl Moments {
    /// The moments among the loads; `input` is the first input of each load. Tangents reach pairs of free nodes.
    pub(crate) fn of<const D: usize>(
        parts: &Parts<D>,
        nodes: &Nodes<D>,
        input: impl Fn(usize) -> usize,
        is_free: impl Fn(usize) -> bool,
    ) -> Result<Self, BuildError> {
        let moves = |node: usize| (node * D..node * D + D).any(&is_free);
        let q = nodes.initial();
        let mut sets = Self::default();
        for (k, part) in parts.loads.iter().enumerate() {
            let (MemberId(m), refused) = match part.load {
                Load::Force(_) => continue,
                Load::Moment(member, axes) => (member, refusal::<D>(axes)),
                Load::JointMoments(member) => (member, ONLY_BARS),
            };
            let Some(member) = parts.members.get(m) else {
                return Err(BuildError::Dangling {
                    kind: "load",
                    name: part.name.clone(),
                    place: format!("member number {m}"),
                    mend: "add that member to this builder first",
                });
            };
            if let Some(what) = refused(member.member.coord_type()) {
                let member = member.name.clone();
                return Err(BuildError::MeaninglessMoment { name: part.name.clone(), member, what });
            }
            let axes = Axes::new(&member.member, nodes, m);
            let bar = || axes.bar();
            match part.load {
                Load::JointMoments(_) => sets.joint.push(input(k), bar(), moves),
                Load::Moment(..) if D == 2 => sets.plane.push(input(k), &axes, &q, moves),
                Load::Moment(..) if axes.is_bar => sets.bar.push(input(k), bar(), moves),
                Load::Moment(_, MomentAxes::Space) => sets.body.push(input(k), axes.nodes, moves),
                Load::Moment(..) => sets.following.push(input(k), axes.nodes, moves),
                Load::Force(_) => {}
            }
        }
        Ok(sets)
    }

    pub(crate) fn force(&self, at: At<'_>, f: &mut [f64]) {
        each_set!(self, |set| set.force(at, f));
    }

    pub(crate) fn stiffness(&self, at: At<'_>, values: &mut [f64]) {
        if values.is_empty() {
            return;
        }
        let mut values = values.iter_mut();
        each_set!(self, |set| set.stiffness(at, &mut values));
    }

    pub(crate) fn stiffness_pattern(&self) -> Vec<(usize, usize)> {
        let mut pattern = Vec::new();
        each_set!(self, |set| set.pattern(&mut pattern));
        pattern
    }

    /// Potential of the conservative moments \[J\].
    pub(crate) fn energy(&self, q: &[f64], u: &[f64]) -> f64 {
        self.plane.energy(q, u) + self.joint.energy(q, u)
    }

    /// Largest component of the force of one moment on one node \[N\].
    pub(crate) fn largest_force(&self, at: At<'_>) -> f64 {
        let mut largest = 0.0_f64;
        each_set!(self, |set| largest = largest.max(set.largest_force(at)));
        largest
    }
}

type Refusal = fn(CoordType) -> Option<&'static str>;

const ONLY_BARS: Refusal = |kind| {
    (kind.span() != 1).then_some("the universal joint of this load holds a bar; use a moment for a body")
};

fn refusal<const D: usize>(axes: MomentAxes) -> Refusal {
    const PARTICLE: &str = "a particle has no orientation; put a force on it, or a moment on a body or bar";
    if D == 3 && axes == MomentAxes::Body {
        |kind| match kind.span() {
            0 => Some(PARTICLE),
            1 => Some(
                "a bar has no axes of its own beside its direction; give the moment along the axes of space",
            ),
            _ => None,
        }
    } else {
        |kind| (kind.span() == 0).then_some(PARTICLE)
    }
}

/// Weights of the unit vectors along a member's local axes at its nodes: e_k = Σ_a w_a\[k\] q_a. A bar has one, along
/// itself.
struct Axes {
    nodes: Vec<(usize, [f64; 3])>,
    is_bar: bool,
}

impl Axes {
    fn new<const D: usize>(member: &tg_coords::Member<D>, nodes: &Nodes<D>, m: usize) -> Self {
        let kind = member.coord_type();
        let is_bar = kind.span() == 1;
        let vectors: Vec<nalgebra::SVector<f64, D>> = if is_bar {
            let nodes = member.local_nodes();
            let along = if kind.is_point(1) { nodes[1] - nodes[0] } else { nodes[1] };
            vec![along.normalize()]
        } else {
            (0..D).map(|d| nalgebra::SVector::from_fn(|i, _| f64::from(u8::from(i == d)))).collect()
        };
        let mut found: Vec<(usize, [f64; 3])> = Vec::new();
        for (k, vector) in vectors.into_iter().enumerate() {
            // A member has every vector that its own span contains; a bar's is along itself.
            let Ok(weights) = member.vector_weights(vector) else { continue };
            for &(node, weight) in nodes.member_form(m, &weights).terms() {
                let place = found.iter().position(|&(n, _)| n == node).unwrap_or_else(|| {
                    found.push((node, [0.0; 3]));
                    found.len() - 1
                });
                found[place].1[k] = weight;
            }
        }
        found.sort_unstable_by_key(|&(node, _)| node);
        Self { nodes: found, is_bar }
    }

    /// Weights of a bar's direction.
    fn bar(&self) -> Vec<(usize, f64)> {
        self.nodes.iter().map(|&(node, w)| (node, w[0])).collect()
    }
}

/// The pairs of a load's nodes that have a tangent, as places in its list of nodes.
fn pairs<T>(nodes: &[(usize, T)], moves: impl Fn(usize) -> bool) -> Vec<(usize, usize)> {
    let moving: Vec<usize> = (0..nodes.len()).filter(|&a| moves(nodes[a].0)).collect();
    moving.iter().flat_map(|&a| moving.iter().map(move |&b| (a, b))).collect()
}

/// Entries of the blocks of node pairs, rows before columns.
fn block_pattern<const D: usize>(
    pairs: impl Iterator<Item = (usize, usize)>,
    pattern: &mut Vec<(usize, usize)>,
) {
    for (a, b) in pairs {
        pattern.extend((0..D).flat_map(|r| (0..D).map(move |c| (a * D + r, b * D + c))));
    }
}

/// Writes one block in that order.
fn write_block<const D: usize>(
    block: &nalgebra::SMatrix<f64, D, D>,
    values: &mut std::slice::IterMut<'_, f64>,
) {
    for r in 0..D {
        for (c, value) in (0..D).zip(&mut *values) {
            *value = block[(r, c)];
        }
    }
}
