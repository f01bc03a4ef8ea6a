//! One rigid member: everything that is constant about it, computed once.

use nalgebra::{SMatrix, SVector};

use crate::basis::Basis;
use crate::coord_type::MAX_NODES;
use crate::fit::{Polar, shortest_arc};
use crate::mass_matrix::mass_matrix;
use crate::{
    CoordType, CoordsError, DotConstraint, MassMatrix, MassProperties, Pose, PoseFit, Twist, Weights,
};

/// A rigid body, bar or particle of D-dimensional space in natural coordinates, D = 2 or 3.
///
/// Its coordinates are a list of nodes, D-vectors: basic points first, then base vectors, in the
/// order of the type's name. A member is immutable.
#[derive(Clone, Debug)]
pub struct Member<const D: usize> {
    coord_type: CoordType,
    local_nodes: [SVector<f64, D>; MAX_NODES],
    mass: MassProperties<D>,
    basis: Basis<D>,
    mass_centre: Weights,
    mass_matrix: MassMatrix,
    constraints: Vec<DotConstraint>,
}

impl<const D: usize> Member<D> {
    /// Member with the given nodes in its own local frame \[m\]: basic points (positions) first, then
    /// base vectors. The mass properties are in the same frame, whose origin and axes are arbitrary.
    ///
    /// # Errors
    /// A type that does not fit the space, a wrong number of nodes, non-finite numbers, a degenerate
    /// basis (condition above [`CONDITION_LIMIT`](crate::CONDITION_LIMIT)), a mass centre off a bar's
    /// axis or off the particle; in space a bar whose J does not lie along its axis; a particle with J ≠ 0.
    pub fn new(
        coord_type: CoordType,
        local_nodes: &[SVector<f64, D>],
        mass: MassProperties<D>,
    ) -> Result<Self, CoordsError> {
        const { assert!(D == 2 || D == 3, "members live in the plane or in space") };
        if !coord_type.fits(D) {
            return Err(CoordsError::Dimension { coord_type, dimension: D });
        }
        coord_type.check_count(local_nodes.len())?;
        check_finite(local_nodes, "local node")?;
        let basis = Basis::new(coord_type, local_nodes)?;
        let mass_centre = basis.point(&mass.centre(), "mass centre")?;
        let mass_matrix = mass_matrix(coord_type, &basis, &mass)?;
        let constraints = DotConstraint::of(coord_type, &basis);
        if !constraints.iter().all(|c| c.scale().is_finite()) {
            return Err(CoordsError::NotFinite { what: "squared length of a base vector" });
        }
        let mut nodes = [SVector::zeros(); MAX_NODES];
        nodes[..local_nodes.len()].copy_from_slice(local_nodes);
        Ok(Self { coord_type, local_nodes: nodes, mass, basis, mass_centre, mass_matrix, constraints })
    }

    /// Bar of type RR between two local points \[m\], a uniform thin rod of the given mass \[kg\].
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn thin_rod(mass: f64, from: SVector<f64, D>, to: SVector<f64, D>) -> Result<Self, CoordsError> {
        let properties = MassProperties::thin_rod(mass, from, to)?;
        Self::new(CoordType::Rr, &[from, to], properties)
    }

    /// Particle of type R with the given mass \[kg\] at a local point \[m\].
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn particle(mass: f64, at: SVector<f64, D>) -> Result<Self, CoordsError> {
        Self::new(CoordType::R, &[at], MassProperties::point(mass, at)?)
    }

    /// Type of the natural coordinates.
    pub fn coord_type(&self) -> CoordType {
        self.coord_type
    }

    /// Nodes in the local frame \[m\].
    pub fn local_nodes(&self) -> &[SVector<f64, D>] {
        &self.local_nodes[..self.coord_type.nodes()]
    }

    /// Mass properties as given.
    pub fn mass_properties(&self) -> &MassProperties<D> {
        &self.mass
    }

    /// Condition number of X̄ (eq. A.1); 1 for a bar or a particle.
    pub fn condition(&self) -> f64 {
        self.basis.condition()
    }

    /// Form that picks one node.
    ///
    /// # Panics
    /// If the type has no such node.
    #[track_caller]
    pub fn node_weights(&self, node: usize) -> Weights {
        Weights::unit(node, self.coord_type.nodes())
    }

    /// Form of the material point at `local` \[m\] (eq. 16, A.2).
    ///
    /// # Errors
    /// [`CoordsError::OffAxis`] for a point off a bar's axis by more than
    /// [`ROUNDING_TOLERANCE`](crate::ROUNDING_TOLERANCE) of the bar's length,
    /// [`CoordsError::OffParticle`], [`CoordsError::NotFinite`].
    pub fn point_weights(&self, local: SVector<f64, D>) -> Result<Weights, CoordsError> {
        self.basis.point(&local, "point")
    }

    /// Form of the vector `local` fixed in the member \[m\] (eq. 16 without the point).
    ///
    /// # Errors
    /// As [`point_weights`](Self::point_weights).
    pub fn vector_weights(&self, local: SVector<f64, D>) -> Result<Weights, CoordsError> {
        self.basis.vector(&local, "vector")
    }

    /// Form of the mass centre.
    pub fn mass_centre_weights(&self) -> Weights {
        self.mass_centre
    }

    /// Constant scalar mass matrix, nodes × nodes (eq. 18).
    pub fn mass_matrix(&self) -> &MassMatrix {
        &self.mass_matrix
    }

    /// Kinetic energy ½ q̇ᵀ M q̇ \[J\] of node velocities \[m/s\] (eq. 17).
    ///
    /// # Panics
    /// If there is not one velocity per node.
    #[track_caller]
    pub fn kinetic_energy(&self, velocities: &[SVector<f64, D>]) -> f64 {
        0.5 * self.mass_matrix.form(velocities, velocities)
    }

    /// Intrinsic constraints in the order u·u, v·v, w·w, v·w, u·w, u·v, those that exist (eq. 5, 10, 13).
    pub fn constraints(&self) -> &[DotConstraint] {
        &self.constraints
    }

    /// Natural coordinates of the member in a pose \[m\].
    pub fn place(&self, pose: &Pose<D>) -> Vec<SVector<f64, D>> {
        let mut nodes = vec![SVector::zeros(); self.coord_type.nodes()];
        self.place_into(pose, &mut nodes);
        nodes
    }

    /// [`place`](Self::place) into a list.
    ///
    /// # Panics
    /// If the list has not one vector per node.
    #[track_caller]
    pub fn place_into(&self, pose: &Pose<D>, out: &mut [SVector<f64, D>]) {
        assert_eq!(out.len(), self.coord_type.nodes(), "list against nodes");
        for (a, (node, local)) in out.iter_mut().zip(self.local_nodes()).enumerate() {
            *node =
                if self.coord_type.is_point(a) { pose.apply_point(local) } else { pose.apply_vector(local) };
        }
    }

    /// Velocities of the natural coordinates in a pose \[m/s\].
    pub fn place_velocity(&self, pose: &Pose<D>, twist: &Twist<D>) -> Vec<SVector<f64, D>> {
        let mut velocities = vec![SVector::zeros(); self.coord_type.nodes()];
        self.place_velocity_into(pose, twist, &mut velocities);
        velocities
    }

    /// [`place_velocity`](Self::place_velocity) into a list.
    ///
    /// # Panics
    /// If the list has not one vector per node.
    #[track_caller]
    pub fn place_velocity_into(&self, pose: &Pose<D>, twist: &Twist<D>, out: &mut [SVector<f64, D>]) {
        assert_eq!(out.len(), self.coord_type.nodes(), "list against nodes");
        for (a, (velocity, local)) in out.iter_mut().zip(self.local_nodes()).enumerate() {
            *velocity = twist.spin * pose.apply_vector(local);
            if self.coord_type.is_point(a) {
                *velocity += twist.velocity;
            }
        }
    }

    /// Pose that fits the coordinates \[m\] best, and its misfit.
    ///
    /// For a body the rotation is the one nearest to F = \[u v w\] X̄⁻¹ (polar decomposition), which
    /// does not depend on the coordinate type. For a bar it is the shortest arc from its local
    /// direction, for a particle the identity. The mass centre of the pose is that of the coordinates.
    ///
    /// # Errors
    /// A wrong number of nodes, non-finite numbers, [`CoordsError::NoOrientation`] if the nodes have
    /// collapsed or are turned inside out so that no rotation is nearest.
    pub fn pose(&self, nodes: &[SVector<f64, D>]) -> Result<PoseFit<D>, CoordsError> {
        Ok(self.orientation(nodes)?.fit)
    }

    /// Velocity of the local frame that fits the node velocities \[m/s\]; exact on rigid motions.
    ///
    /// For a body it is the rate of [`pose`](Self::pose), whatever the coordinates. The spin of a bar
    /// about its own axis is zero by convention, as is that of a particle.
    ///
    /// # Errors
    /// As [`pose`](Self::pose).
    pub fn twist(
        &self,
        nodes: &[SVector<f64, D>],
        velocities: &[SVector<f64, D>],
    ) -> Result<Twist<D>, CoordsError> {
        let orientation = self.orientation(nodes)?;
        self.coord_type.check_count(velocities.len())?;
        check_finite(velocities, "velocity")?;
        let spin = match &orientation.kind {
            Kind::Body(polar) => polar.spin(&self.basis.deformation(velocities)),
            Kind::Bar { direction, length } => {
                // Ω = ḃ bᵀ - b ḃᵀ with b = u/|u|; the part of u̇ along b drops out.
                let rate = self.coord_type.base_vector(velocities, 0) / *length;
                let turn = rate * direction.transpose();
                turn - turn.transpose()
            }
            Kind::Particle => SMatrix::zeros(),
        };
        let arm = orientation.fit.pose.apply_vector(&self.mass.centre());
        Ok(Twist { velocity: self.mass_centre.apply(velocities) - spin * arm, spin })
    }

    /// The same member in another coordinate type of the same span; [`CoordType::convert`] converts
    /// its coordinates.
    ///
    /// # Errors
    /// [`CoordsError::Span`] if the types do not span the same number of directions.
    pub fn with_type(&self, coord_type: CoordType) -> Result<Self, CoordsError> {
        let nodes = self.coord_type.convert(coord_type, self.local_nodes())?;
        Self::new(coord_type, &nodes, self.mass)
    }

    fn orientation(&self, nodes: &[SVector<f64, D>]) -> Result<Orientation<D>, CoordsError> {
        self.coord_type.check_count(nodes.len())?;
        check_finite(nodes, "coordinate")?;
        let none = CoordsError::NoOrientation { coord_type: self.coord_type };
        let (rotation, misfit, kind) = match self.basis.vectors() {
            [] => (SMatrix::identity(), 0.0, Kind::Particle),
            [local] => {
                let u = self.coord_type.base_vector(nodes, 0);
                let length = u.norm();
                let natural = local.norm();
                // A bar shorter than its rounding has no direction.
                if length <= f64::EPSILON * natural {
                    return Err(none);
                }
                let direction = u / length;
                let rotation = shortest_arc(&(local / natural), &direction);
                let misfit = (length / natural - 1.0).abs();
                (rotation, misfit, Kind::Bar { direction, length })
            }
            _ => {
                let polar = Polar::new(&self.basis.deformation(nodes)).ok_or(none)?;
                (polar.rotation(), polar.misfit(), Kind::Body(polar))
            }
        };
        let position = self.mass_centre.apply(nodes) - rotation * self.mass.centre();
        Ok(Orientation { fit: PoseFit { pose: Pose { position, rotation }, misfit }, kind })
    }
}

/// A fit with what its rate needs.
struct Orientation<const D: usize> {
    fit: PoseFit<D>,
    kind: Kind<D>,
}

enum Kind<const D: usize> {
    Body(Polar<D>),
    Bar { direction: SVector<f64, D>, length: f64 },
    Particle,
}

fn check_finite<const D: usize>(vectors: &[SVector<f64, D>], what: &'static str) -> Result<(), CoordsError> {
    if vectors.iter().flat_map(|v| v.iter()).all(|x| x.is_finite()) {
        Ok(())
    } else {
        Err(CoordsError::NotFinite { what })
    }
}
