//! A structure after `build()`: immutable, shared by threads, everything precomputed.

use std::ops::Range;
use std::sync::Arc;

use nalgebra::SVector;
use tg_coords::{CoordsError, Member, PoseFit, Twist};

use crate::cables::{CableState, Cables, cable_state};
use crate::constraints::{ConstraintSource, Constraints};
use crate::drive::Drive;
use crate::error::{BuildError, PlaceError};
use crate::form::{Form, node};
use crate::inertia::Inertia;
use crate::law::CableLaw;
use crate::mechanics::{Entry, HessianEntry, Mechanics};
use crate::moments::Moments;
use crate::parts::{AnchorId, CableId, LoadId, MemberId, Parts, Place};
use crate::placed::{Cable, PlacedMember};
use crate::report::BuildReport;

/// A checked structure in D-dimensional space; offers itself to the solvers as [`Mechanics`].
///
/// Handles are those of the builder that made the model, and slices have the lengths of its coordinates and inputs. A
/// handle of another builder or a slice of another length panics at the caller like an index out of range; only
/// [`Model::form`] checks its handle.
#[derive(Clone, Debug)]
pub struct Model<const D: usize> {
    pub(crate) members: Vec<PlacedMember<D>>,
    pub(crate) anchors: Vec<usize>,
    pub(crate) cables: Vec<Cable<D>>,
    pub(crate) in_equations: Cables,
    /// What the builder collected, for questions about single parts.
    pub(crate) parts: Arc<Parts<D>>,
    /// Point forces with their first input.
    pub(crate) forces: Vec<(Form<D>, usize)>,
    pub(crate) moments: Moments,
    /// First input of each load, and the end of all.
    pub(crate) load_starts: Vec<usize>,
    /// Generalised force of gravity, constant.
    pub(crate) weight: Vec<f64>,
    pub(crate) constraints: Constraints,
    /// Redundant constraints that were left out.
    pub(crate) dropped: Constraints,
    pub(crate) constraint_names: Vec<String>,
    pub(crate) constraint_sources: Vec<ConstraintSource>,
    pub(crate) node_names: Vec<String>,
    pub(crate) jacobian_pattern: Vec<(usize, usize)>,
    pub(crate) hessian: Vec<HessianEntry>,
    /// Entries of cables, then of moments.
    pub(crate) stiffness_pattern: Vec<(usize, usize)>,
    /// Number of the former.
    pub(crate) cable_entries: usize,
    pub(crate) damping_pattern: Vec<(usize, usize)>,
    pub(crate) mass: Vec<Entry>,
    pub(crate) inertia: Inertia,
    pub(crate) drive: Drive,
    pub(crate) free: Vec<usize>,
    /// Diagonal of the box around all points as built \[m\]; one where they are one point.
    pub(crate) size: f64,
    pub(crate) initial: Vec<f64>,
    pub(crate) report: BuildReport,
}

/// Energies \[J\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// ½ q̇ᵀ M q̇.
    pub kinetic: f64,
    /// Stored in cables.
    pub elastic: f64,
    /// -Σ m g·r_g, zero at the origin.
    pub gravity: f64,
    /// Potential of the loads as they are at that time: -Σ f·r of point forces, -M θ of moments in the plane, -(M_ε ε +
    /// M_β β) of universal joints. Moments on members of space have none and are left out.
    pub load: f64,
}

impl Energy {
    /// Mechanical energy E = T + V.
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential()
    }

    /// Potential energy V.
    pub fn potential(&self) -> f64 {
        self.elastic + self.gravity + self.load
    }
}

impl<const D: usize> Model<D> {
    /// What `build()` found: counts, and what was left out.
    pub fn report(&self) -> &BuildReport {
        &self.report
    }

    /// Full coordinates as built, prescribed components at t = 0.
    pub fn initial_coordinates(&self) -> Vec<f64> {
        self.initial.clone()
    }

    /// Full velocities with every free component at rest and prescribed ones at their rate at t = 0.
    pub fn velocities_at_rest(&self) -> Vec<f64> {
        let (mut q, mut v) = (self.initial.clone(), vec![0.0; self.initial.len()]);
        self.drive.prescribe(0.0, &mut q, &mut v);
        v
    }

    /// Inputs u at time `t` \[s\]: the rest lengths of all cables \[m\], then the components of each load in the order in
    /// which they were added (see [`Model::load_inputs`]).
    pub fn inputs_at(&self, t: f64) -> Vec<f64> {
        let mut u = vec![0.0; self.drive.input_count()];
        self.drive.inputs(t, &mut u);
        u
    }

    /// The linear form of a place: its position from q, its velocity from q̇.
    ///
    /// # Errors
    /// The place is not of this model, or the point not of its member.
    pub fn form(&self, place: impl Into<Place<D>>) -> Result<Form<D>, PlaceError> {
        let member = |MemberId(m)| self.members.get(m).ok_or(PlaceError::NoSuchMember(m));
        match place.into() {
            Place::Node(id, i) => {
                let placed = member(id)?;
                let node = placed.nodes.get(i).ok_or_else(|| PlaceError::NoSuchNode {
                    member: placed.name.clone(),
                    node: i,
                    nodes: placed.nodes.len(),
                })?;
                Ok(Form::new([(*node, 1.0)]))
            }
            Place::Material(id, local) => {
                let placed = member(id)?;
                match placed.member.point_weights(local.into()) {
                    Ok(weights) => Ok(placed.form(weights.as_slice())),
                    Err(source) => Err(PlaceError::NotOfMember { member: placed.name.clone(), source }),
                }
            }
            Place::MassCentre(id) => {
                let placed = member(id)?;
                Ok(placed.form(placed.member.mass_centre_weights().as_slice()))
            }
            Place::Anchor(AnchorId(a)) => {
                let node = self.anchors.get(a).ok_or(PlaceError::NoSuchAnchor(a))?;
                Ok(Form::new([(*node, 1.0)]))
            }
        }
    }

    /// Natural coordinates (or their rates) of a member out of full ones: one D-vector per node.
    #[track_caller]
    pub fn member_nodes(&self, member: MemberId, x: &[f64]) -> Vec<SVector<f64, D>> {
        self.members[member.0].nodes.iter().map(|&n| node(x, n)).collect()
    }

    /// Nodes that hold a member's natural coordinates, in the order of its coordinate type; see [`Model::node_name`].
    #[track_caller]
    pub fn member_node_ids(&self, member: MemberId) -> &[usize] {
        &self.members[member.0].nodes
    }

    /// Pose of a member's local frame, best fit.
    ///
    /// # Errors
    /// The coordinates are not finite or degenerate.
    #[track_caller]
    pub fn pose(&self, member: MemberId, q: &[f64]) -> Result<PoseFit<D>, CoordsError> {
        self.members[member.0].member.pose(&self.member_nodes(member, q))
    }

    /// Twist of a member's local frame.
    ///
    /// # Errors
    /// The coordinates are not finite or degenerate.
    #[track_caller]
    pub fn twist(&self, member: MemberId, q: &[f64], v: &[f64]) -> Result<Twist<D>, CoordsError> {
        self.members[member.0].member.twist(&self.member_nodes(member, q), &self.member_nodes(member, v))
    }

    /// Writes the velocities of a member that moves with `twist` into full velocities; the prescribed components
    /// and the members that share its nodes are the caller's to reconcile ([`crate::Projector::velocity`]).
    ///
    /// # Errors
    /// The coordinates are not finite or degenerate.
    #[track_caller]
    pub fn set_twist(
        &self,
        member: MemberId,
        twist: &Twist<D>,
        q: &[f64],
        v: &mut [f64],
    ) -> Result<(), CoordsError> {
        let placed = &self.members[member.0];
        let pose = self.pose(member, q)?.pose;
        for (&n, velocity) in placed.nodes.iter().zip(placed.member.place_velocity(&pose, twist)) {
            v[n * D..n * D + D].copy_from_slice(velocity.as_slice());
        }
        Ok(())
    }

    /// Length, rate, rest length, tension and slackness of one cable.
    #[track_caller]
    pub fn cable(&self, cable: CableId, q: &[f64], v: &[f64], u: &[f64]) -> CableState {
        let part = &self.cables[cable.0];
        cable_state(&part.form, &part.law, u[cable.0], q, v)
    }

    /// All cables in the order in which they were added.
    pub fn cables(&self) -> impl ExactSizeIterator<Item = CableId> + use<D> {
        (0..self.cables.len()).map(CableId)
    }

    /// All members in the order in which they were added.
    pub fn members(&self) -> impl ExactSizeIterator<Item = MemberId> + use<D> {
        (0..self.members.len()).map(MemberId)
    }

    /// Name of a cable.
    #[track_caller]
    pub fn cable_name(&self, cable: CableId) -> &str {
        &self.cables[cable.0].name
    }

    /// Name of a member.
    #[track_caller]
    pub fn member_name(&self, member: MemberId) -> &str {
        &self.members[member.0].name
    }

    /// Name of a load.
    #[track_caller]
    pub fn load_name(&self, load: LoadId) -> &str {
        &self.parts.loads[load.0].name
    }

    /// The inputs that are a load's components: D of a force \[N\], 1 or 3 of a moment in the plane or in space, M_ε and M_β
    /// of a universal joint \[N m\].
    #[track_caller]
    pub fn load_inputs(&self, load: LoadId) -> Range<usize> {
        self.load_starts[load.0]..self.load_starts[load.0 + 1]
    }

    /// What an input is, for messages: `rest length of "name"` or `component 1 of load "name"`.
    pub fn input_name(&self, input: usize) -> String {
        if let Some(cable) = self.cables().nth(input) {
            return format!("rest length of \"{}\"", self.cable_name(cable));
        }
        let load = self.loads().find(|&load| self.load_inputs(load).contains(&input));
        match load {
            Some(load) => {
                let component = input - self.load_inputs(load).start + 1;
                format!("component {component} of load \"{}\"", self.load_name(load))
            }
            None => format!("input {input}"),
        }
    }

    /// The vector l = J q of a cable (26), from its first place to its second.
    #[track_caller]
    pub fn cable_form(&self, cable: CableId) -> &Form<D> {
        &self.cables[cable.0].form
    }

    /// Name of a node: the D-vector of the full coordinates `node·D .. node·D + D`.
    #[track_caller]
    pub fn node_name(&self, node: usize) -> &str {
        &self.node_names[node]
    }

    /// What each constraint belongs to, in the order of Φ.
    pub fn constraint_sources(&self) -> &[ConstraintSource] {
        &self.constraint_sources
    }

    /// Force of a member's own rigidity on each of its nodes, the part of Aᵀλ that its intrinsic constraints make
    /// \[N\]; it balances what weight, cables and joints put on the member. `jacobian` holds the values of A in the order of
    /// [`Mechanics::jacobian_pattern`].
    #[track_caller]
    pub fn rigidity_forces(
        &self,
        member: MemberId,
        jacobian: &[f64],
        lambda: &[f64],
    ) -> Vec<SVector<f64, D>> {
        let nodes = &self.members[member.0].nodes;
        let mut forces = vec![SVector::zeros(); nodes.len()];
        for (&(row, i), a) in self.jacobian_pattern.iter().zip(jacobian) {
            if self.constraint_sources[row] == ConstraintSource::Rigidity(member)
                && let Some(k) = nodes.iter().position(|&n| n == i / D)
            {
                forces[k][i % D] += a * lambda[row];
            }
        }
        forces
    }

    /// A member's type of coordinates and mass.
    #[track_caller]
    pub fn member(&self, member: MemberId) -> &Member<D> {
        &self.members[member.0].member
    }

    /// The constitutive law of a cable.
    #[track_caller]
    pub fn cable_law(&self, cable: CableId) -> &CableLaw {
        &self.cables[cable.0].law
    }

    /// The same structure with another law for one cable; a parameter study in stiffness uses it.
    ///
    /// # Errors
    /// κ or η is negative or not finite.
    #[track_caller]
    pub fn with_law(&self, cable: CableId, law: CableLaw) -> Result<Self, BuildError> {
        law.check(&self.cables[cable.0].name)?;
        let mut changed = self.clone();
        changed.cables[cable.0].law = law;
        let mut free = vec![false; self.initial.len()];
        self.free.iter().for_each(|&i| free[i] = true);
        changed.in_equations = Cables::of(&changed.cables, |i| free[i]);
        changed.stiffness_pattern = changed.in_equations.stiffness_pattern::<D>();
        changed.cable_entries = changed.stiffness_pattern.len();
        changed.stiffness_pattern.extend(changed.moments.stiffness_pattern());
        changed.damping_pattern = changed.in_equations.damping_pattern::<D>();
        Ok(changed)
    }

    /// Energies at full coordinates, velocities and inputs.
    #[track_caller]
    pub fn energy(&self, q: &[f64], v: &[f64], u: &[f64]) -> Energy {
        let dot = |f: &[f64]| -f.iter().zip(q).map(|(f, q)| f * q).sum::<f64>();
        let load = |(form, input): &(Form<D>, usize)| {
            -form.eval(q).dot(&SVector::<f64, D>::from_column_slice(&u[*input..input + D]))
        };
        Energy {
            kinetic: self.inertia.kinetic_energy(v),
            elastic: self.in_equations.energy::<D>(q, u),
            gravity: dot(&self.weight),
            load: self.forces.iter().map(load).sum::<f64>() + self.moments.energy(q, u),
        }
    }

    /// Largest scaled violation of the redundant constraints that `build()` left out; it stays at the level of the
    /// others' as long as they are implied. NaN if a coordinate is.
    pub fn dropped_violation(&self, q: &[f64]) -> f64 {
        let mut phi = vec![0.0; self.dropped.len()];
        self.dropped.residual::<D>(q, &mut phi);
        let scaled = phi.iter().zip(self.dropped.scales()).map(|(phi, s)| phi.abs() / s);
        // NaN stays: it is no small violation.
        scaled.fold(0.0, |worst, x| if x <= worst || worst.is_nan() { worst } else { x })
    }

    /// This model as the solvers see it.
    pub fn mechanics(&self) -> &dyn Mechanics {
        self
    }
}
