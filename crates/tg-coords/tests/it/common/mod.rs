//! Members of every type with facts that do not come from the crate, and random motions.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, SVector, Vector2, Vector3};
use tg_coords::{CoordType, MassProperties, Member, Pose, Twist};

/// splitmix64: the same numbers on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in (-1, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub(crate) fn vector<const D: usize>(&mut self) -> SVector<f64, D> {
        SVector::from_fn(|_, _| self.unit())
    }

    pub(crate) fn nodes<const D: usize>(&mut self, n: usize) -> Vec<SVector<f64, D>> {
        (0..n).map(|_| self.vector()).collect()
    }

    /// Rotation from a random unit quaternion, written out.
    pub(crate) fn rotation3(&mut self) -> Matrix3<f64> {
        let q = [self.unit(), self.unit(), self.unit(), self.unit()];
        let n = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        quaternion_matrix(q.map(|x| x / n))
    }

    pub(crate) fn pose3(&mut self) -> Pose<3> {
        Pose::new(self.vector(), self.rotation3()).unwrap()
    }

    pub(crate) fn pose2(&mut self) -> Pose<2> {
        Pose::planar(self.unit(), self.unit(), 3.0 * self.unit())
    }
}

/// Rotation matrix of a unit quaternion (w, x, y, z).
pub(crate) fn quaternion_matrix([w, x, y, z]: [f64; 4]) -> Matrix3<f64> {
    Matrix3::new(
        1.0 - 2.0 * (y * y + z * z),
        2.0 * (x * y - w * z),
        2.0 * (x * z + w * y),
        2.0 * (x * y + w * z),
        1.0 - 2.0 * (x * x + z * z),
        2.0 * (y * z - w * x),
        2.0 * (x * z - w * y),
        2.0 * (y * z + w * x),
        1.0 - 2.0 * (x * x + y * y),
    )
}

/// A member made of point masses, and its conventional inertia by direct sums.
pub(crate) struct Sample<const D: usize, I> {
    pub(crate) member: Member<D>,
    pub(crate) mass: f64,
    pub(crate) centre: SVector<f64, D>,
    /// About the mass centre, local axes: matrix in space, polar moment in the plane.
    pub(crate) inertia: I,
}

pub(crate) const SPACE_TYPES: [CoordType; 7] = [
    CoordType::Ruvw,
    CoordType::Rrvw,
    CoordType::Rrrw,
    CoordType::Rrrr,
    CoordType::Ru,
    CoordType::Rr,
    CoordType::R,
];
pub(crate) const PLANE_TYPES: [CoordType; 6] =
    [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr, CoordType::Ru, CoordType::Rr, CoordType::R];

type PointMass<const D: usize> = (f64, SVector<f64, D>);

/// Point masses on the member and its nodes, in a local frame neither central nor principal.
fn masses_and_nodes<const D: usize>(
    coord_type: CoordType,
    random: &mut Random,
) -> (Vec<PointMass<D>>, Vec<SVector<f64, D>>) {
    let origin: SVector<f64, D> = random.vector();
    let mut base: Vec<SVector<f64, D>> = (0..coord_type.span()).map(|_| random.vector()).collect();
    for (k, vector) in base.iter_mut().enumerate() {
        // A dominant component each keeps the basis far from degenerate.
        *vector *= 0.3;
        vector[k] += 1.2;
    }
    let masses = (0..6)
        .map(|_| {
            let offset = base.iter().fold(SVector::zeros(), |sum, b| sum + b * random.unit());
            (1.2 + random.unit(), origin + offset)
        })
        .collect();
    let mut nodes = vec![origin];
    for (k, vector) in base.iter().enumerate() {
        nodes.push(if coord_type.is_point(k + 1) { origin + vector } else { *vector });
    }
    (masses, nodes)
}

fn centre_of<const D: usize>(masses: &[PointMass<D>]) -> (f64, SVector<f64, D>) {
    let mass = masses.iter().map(|(m, _)| m).sum();
    let moment = masses.iter().fold(SVector::zeros(), |sum: SVector<f64, D>, (m, r)| sum + r * *m);
    (mass, moment / mass)
}

/// A member of space.
pub(crate) fn space(coord_type: CoordType, random: &mut Random) -> Sample<3, Matrix3<f64>> {
    let (masses, nodes) = masses_and_nodes::<3>(coord_type, random);
    let (mass, centre) = centre_of(&masses);
    let mut inertia = Matrix3::zeros();
    for (m, r) in &masses {
        let d = r - centre;
        inertia += (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * *m;
    }
    let properties = match coord_type.span() {
        0 => MassProperties::point(mass, nodes[0]),
        1 => {
            let axis = masses[0].1 - nodes[0];
            let transverse = masses.iter().map(|(m, r)| m * (r - centre).norm_squared()).sum();
            MassProperties::rod(mass, centre, axis, transverse)
        }
        _ => MassProperties::from_inertia_matrix(mass, centre, inertia),
    };
    let member = Member::new(coord_type, &nodes, properties.unwrap()).unwrap();
    Sample { member, mass, centre, inertia }
}

/// A member of the plane.
pub(crate) fn plane(coord_type: CoordType, random: &mut Random) -> Sample<2, f64> {
    let (masses, nodes) = masses_and_nodes::<2>(coord_type, random);
    let (mass, centre) = centre_of(&masses);
    let inertia = masses.iter().map(|(m, r)| m * (r - centre).norm_squared()).sum();
    let properties = match coord_type.span() {
        0 => MassProperties::point(mass, nodes[0]),
        _ => MassProperties::from_polar_moment(mass, centre, inertia),
    };
    let member = Member::new(coord_type, &nodes, properties.unwrap()).unwrap();
    Sample { member, mass, centre, inertia }
}

/// One sample of every type of space, with a pose and a twist.
pub(crate) fn space_cases(seed: u64) -> Vec<(Sample<3, Matrix3<f64>>, Pose<3>, Twist<3>)> {
    let random = &mut Random(seed);
    SPACE_TYPES
        .map(|t| {
            let sample = space(t, random);
            let twist = Twist::spatial(random.vector(), random.vector::<3>() * 2.0);
            (sample, random.pose3(), twist)
        })
        .into()
}

/// One sample of every type of the plane, with a pose and a twist.
pub(crate) fn plane_cases(seed: u64) -> Vec<(Sample<2, f64>, Pose<2>, Twist<2>)> {
    let random = &mut Random(seed);
    PLANE_TYPES
        .map(|t| {
            let sample = plane(t, random);
            let twist = Twist::planar(random.vector(), 2.0 * random.unit());
            (sample, random.pose2(), twist)
        })
        .into()
}

/// Velocity of the global point r on a body in space: v + ω × (r - x).
pub(crate) fn velocity3(pose: &Pose<3>, twist: &Twist<3>, r: &Vector3<f64>) -> Vector3<f64> {
    twist.velocity + twist.angular_velocity().cross(&(r - pose.position))
}

/// The same in the plane.
pub(crate) fn velocity2(pose: &Pose<2>, twist: &Twist<2>, r: &Vector2<f64>) -> Vector2<f64> {
    let arm = r - pose.position;
    twist.velocity + Vector2::new(-arm.y, arm.x) * twist.angular_velocity()
}

/// Short for literals.
pub(crate) fn v<const D: usize>(components: [f64; D]) -> SVector<f64, D> {
    SVector::from(components)
}

pub(crate) fn rotation2(angle: f64) -> Matrix2<f64> {
    Matrix2::new(angle.cos(), -angle.sin(), angle.sin(), angle.cos())
}

pub(crate) fn flat<const D: usize>(nodes: &[SVector<f64, D>]) -> DVector<f64> {
    DVector::from_iterator(nodes.len() * D, nodes.iter().flat_map(|v| v.iter().copied()))
}

pub(crate) fn unflat<const D: usize>(q: &DVector<f64>) -> Vec<SVector<f64, D>> {
    q.as_slice().chunks(D).map(SVector::from_column_slice).collect()
}

/// Distance of two lists of vectors, the largest component.
pub(crate) fn distance<const D: usize>(a: &[SVector<f64, D>], b: &[SVector<f64, D>]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).amax()).fold(0.0, f64::max)
}

/// Gradient of all constraints, one row each.
pub(crate) fn jacobian<const D: usize>(member: &Member<D>, q: &[SVector<f64, D>]) -> DMatrix<f64> {
    let rows = member.constraints();
    let mut a = DMatrix::zeros(rows.len(), q.len() * D);
    for (i, phi) in rows.iter().enumerate() {
        a.row_mut(i).tr_copy_from(&flat(&phi.gradient(q)));
    }
    a
}
