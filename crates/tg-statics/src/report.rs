//! The equilibrium check: who carries what at a given configuration, and what is left over.
//!
//! ```text
//! r = F + Aᵀ λ                     residual force, zero in equilibrium (31a)
//! bars: N = -û·(Aᵀλ)_j             the pull of a bar on its end j, turned into tension
//! ```

use nalgebra::SVector;
use tg_model::{At, CableState, ConstraintSource, Mechanics, Model};
use tg_tangent::{Configuration, TangentError};

/// What a structure's parts carry at a configuration; forces in N.
#[derive(Clone, Debug)]
pub struct EquilibriumReport<const D: usize> {
    /// Multipliers, residual and scale.
    pub configuration: Configuration,
    /// Largest residual force per largest force.
    pub imbalance: f64,
    /// Largest violation of a constraint, per its size.
    pub constraint_violation: f64,
    /// Residual force on each node with free components, zero in equilibrium.
    pub residuals: Vec<NodeForce<D>>,
    /// What each member carries.
    pub members: Vec<MemberForces<D>>,
    /// Joints by constraints.
    pub joints: Vec<JointReaction<D>>,
    /// What the ground exerts on each held place: prescribed nodes and supports at material points.
    pub supports: Vec<NodeForce<D>>,
    /// State of each cable, in the user's order.
    pub cables: Vec<(String, CableState)>,
}

/// A force at a named place.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeForce<const D: usize> {
    /// Name of the node or support.
    pub name: String,
    /// The force \[N\]; on a base vector, the generalised force.
    pub force: SVector<f64, D>,
}

/// What a member carries.
#[derive(Clone, Debug, PartialEq)]
pub struct MemberForces<const D: usize> {
    /// Name of the member.
    pub name: String,
    /// Axial force N of a bar \[N\], tension positive; its mean along the bar where the bar has weight. `None` for bodies
    /// and particles.
    pub axial: Option<f64>,
    /// What the member's rigidity puts on each of its nodes \[N\]: points, then base vectors.
    pub nodes: Vec<SVector<f64, D>>,
}

/// What a joint by constraints carries.
#[derive(Clone, Debug, PartialEq)]
pub struct JointReaction<const D: usize> {
    /// Name of the joint.
    pub name: String,
    /// The place on which the force acts; the opposite one acts on the joint's first place.
    pub at: String,
    /// The force \[N\].
    pub force: SVector<f64, D>,
}

impl<const D: usize> EquilibriumReport<D> {
    /// Looks at full coordinates `q` and inputs `u`, in equilibrium or not.
    ///
    /// # Errors
    /// A force is not finite, or the constraints are dependent.
    pub fn new(model: &Model<D>, q: &[f64], u: &[f64]) -> Result<Self, TangentError> {
        let configuration = Configuration::at(model, q, u)?;
        let lambda = &configuration.lambda;
        let mut jacobian = vec![0.0; model.jacobian_pattern().len()];
        model.jacobian(q, &mut jacobian);
        let mut phi = vec![0.0; lambda.len()];
        model.constraints(q, &mut phi);
        let violations = phi.iter().zip(model.constraint_scales()).map(|(phi, s)| phi.abs() / s);
        let rest = vec![0.0; q.len()];
        let mut held = rest.clone();
        model.force(At { q, v: &rest, u, taut: None }, &mut held);
        for (&(row, i), a) in model.jacobian_pattern().iter().zip(&jacobian) {
            held[i] += a * lambda[row];
        }
        held.iter_mut().for_each(|f| *f = -*f);
        let mut free = rest.clone();
        for (&i, r) in model.free().iter().zip(&configuration.residual) {
            free[i] = *r;
            held[i] = 0.0;
        }
        let mut is_free = vec![false; q.len()];
        model.free().iter().for_each(|&i| is_free[i] = true);
        let by_node = |force: &[f64], wanted: bool| {
            let nodes = (0..q.len() / D).filter(|&n| (n * D..n * D + D).any(|i| is_free[i] == wanted));
            let force = |n: usize| SVector::from_column_slice(&force[n * D..n * D + D]);
            nodes.map(|n| NodeForce { name: model.node_name(n).into(), force: force(n) }).collect()
        };
        let members = model.members().map(|member| {
            let nodes = model.rigidity_forces(member, &jacobian, lambda);
            let axis = &model.member_nodes(member, q);
            let axial = match (nodes.as_slice(), axis.as_slice()) {
                // The second node of a bar is its end, or the vector along it.
                ([_, pull], [start, end]) => {
                    let is_vector = model.member(member).coord_type().points() == 1;
                    let along = if is_vector { *end } else { end - start };
                    Some(-pull.dot(&along) / along.norm())
                }
                _ => None,
            };
            MemberForces { name: model.member_name(member).into(), axial, nodes }
        });
        let state = |cable| (model.cable_name(cable).into(), model.cable(cable, q, &rest, u));
        Ok(Self {
            imbalance: configuration.imbalance().0,
            constraint_violation: violations.fold(0.0, |worst, x| if x <= worst { worst } else { x }),
            residuals: by_node(&free, true),
            supports: by_node(&held, false),
            joints: joints(model, lambda),
            members: members.collect(),
            cables: model.cables().map(state).collect(),
            configuration,
        })
    }
}

/// λ of extrinsic constraints are forces already: Φ = r_at - r_first.
fn joints<const D: usize>(model: &Model<D>, lambda: &[f64]) -> Vec<JointReaction<D>> {
    let mut joints: Vec<JointReaction<D>> = Vec::new();
    for (source, &force) in model.constraint_sources().iter().zip(lambda) {
        if let ConstraintSource::Joint { name, at, axis } = source {
            let found = joints.iter().position(|j| j.name == *name && j.at == *at);
            let k = found.unwrap_or_else(|| {
                joints.push(JointReaction { name: name.clone(), at: at.clone(), force: SVector::zeros() });
                joints.len() - 1
            });
            joints[k].force[*axis] += force;
        }
    }
    joints
}
