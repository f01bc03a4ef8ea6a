//! Mass matrices against published-example values, quadrature and conventional kinetic energy.

use crate::common::{Random, distance, plane_cases, space_cases, v, velocity2, velocity3};
use nalgebra::{DMatrix, DVector, Matrix2, SMatrix, SVector, Vector2, Vector3};
use tg_coords::{CoordType, MassMatrix, MassProperties, Member};

fn compare<const N: usize>(matrix: &MassMatrix, expected: [[f64; N]; N]) {
    assert_eq!(matrix.len(), N);
    let size = expected.iter().flatten().fold(0.0_f64, |m, x| m.max(x.abs()));
    for (i, row) in expected.iter().enumerate() {
        for (j, &value) in row.iter().enumerate() {
            let error = (matrix.get(i, j) - value).abs();
            assert!(error < 1e-13 * size, "({i}, {j}): {} {value}", matrix.get(i, j));
        }
    }
}

// Framework reference values, minimal-coordinate/high-precision model: examples 1 and 3.

#[test]
fn reference_values_of_example_1() {
    let bar = Member::thin_rod(2.6934977798e-2, v([0.0, 0.0]), v([0.05, -0.05])).unwrap();
    compare(
        bar.mass_matrix(),
        [[0.00897832593266667, 0.00448916296633333], [0.00448916296633333, 0.00897832593266667]],
    );
    let m = 0.1271425597;
    let j = Matrix2::from_diagonal(&v([m * 0.01 / 24.0, m * 0.0025 / 18.0]));
    let mass = MassProperties::from_second_moment(m, v([0.05, 0.05 / 3.0]), j).unwrap();
    assert!((mass.polar_moment() - 7.063475538888889e-5).abs() < 1e-19);
    let (p1, p2, p3) = (v([0.0, 0.0]), v([0.1, 0.0]), v([0.05, 0.05]));
    let ruv = [p1, v([1.0, 0.0]), v([0.0, 1.0])];
    compare(
        Member::new(CoordType::Ruv, &ruv, mass).unwrap().mass_matrix(),
        [
            [0.1271425597, 0.006357127985, 0.00211904266166667],
            [0.006357127985, 0.000370832465791667, 0.000105952133083333],
            [0.00211904266166667, 0.000105952133083333, 5.29760665416667e-05],
        ],
    );
    let rrv = [p1, p2, v([0.0, 0.1])];
    compare(
        Member::new(CoordType::Rrv, &rrv, mass).unwrap().mass_matrix(),
        [
            [0.0370832465791667, 0.0264880332708333, 0.0105952133083333],
            [0.0264880332708333, 0.0370832465791667, 0.0105952133083333],
            [0.0105952133083333, 0.0105952133083333, 0.00529760665416667],
        ],
    );
    compare(
        Member::new(CoordType::Rrr, &[p1, p2, p3], mass).unwrap().mass_matrix(),
        [
            [0.0211904266166667, 0.0105952133083333, 0.0105952133083333],
            [0.0105952133083333, 0.0211904266166667, 0.0105952133083333],
            [0.0105952133083333, 0.0105952133083333, 0.0211904266166667],
        ],
    );
}

#[test]
fn reference_values_of_example_3() {
    let root2 = 2.0_f64.sqrt();
    let height = root2 / 20.0;
    let vertex = |azimuth: f64| {
        let a = azimuth.to_radians();
        v([0.1 * a.cos(), 0.1 * a.sin(), 0.0])
    };
    let points = [v([0.0, 0.0, height]), vertex(0.0), vertex(120.0), vertex(-120.0)];
    let mass = MassProperties::from_principal_moments(
        0.2999233976,
        v([0.0, 0.0, 0.1562442983 - 0.1 * root2]),
        [7.6639282053e-4, 7.6638139752e-4, 1.2464720496e-3],
    )
    .unwrap();
    let tet7 = Member::new(CoordType::Rrrr, &points, mass).unwrap();
    compare(
        tet7.mass_matrix(),
        [
            [0.0418100273187208, 0.00702077725566289, 0.0070207772556629, 0.00702077725566288],
            [0.00702077725566289, 0.051697870229478, 0.010149182676478, 0.010149182676478],
            [0.0070207772556629, 0.010149182676478, 0.051698250996478, 0.010148801909478],
            [0.00702077725566288, 0.010149182676478, 0.010148801909478, 0.051698250996478],
        ],
    );
    let unit_axes = [points[0], Vector3::x(), Vector3::y(), Vector3::z()];
    let tet10 = Member::new(CoordType::Ruvw, &unit_axes, mass).unwrap();
    compare(
        tet10.mass_matrix(),
        [
            [0.2999233976, 0.0, 0.0, -0.0167620396820768],
            [0.0, 0.000623230313295, 0.0, 0.0],
            [0.0, 0.0, 0.000623241736305, 0.0],
            [-0.0167620396820768, 0.0, 0.0, 0.00107994353373651],
        ],
    );
    let bar = Member::thin_rod(0.08, Vector3::zeros(), v([0.0, 0.22, 0.0])).unwrap();
    compare(
        bar.mass_matrix(),
        [[0.0266666666666667, 0.0133333333333333], [0.0133333333333333, 0.0266666666666667]],
    );
}

// Quadrature: M = Σ_g m_g C_gᵀ C_g over Gauss points, exact because CᵀC is quadratic. The weights
// at a Gauss point come from a dense solve of the affine map, not from the crate.

/// Weights by solving `[1 or 0 per node; node] w = [1; r]` for a full-span member or a bar.
fn dense_weights<const D: usize>(member: &Member<D>, r: &SVector<f64, D>) -> DVector<f64> {
    let nodes = member.local_nodes();
    let t = member.coord_type();
    let lhs = DMatrix::from_fn(D + 1, nodes.len(), |i, j| match i {
        0 => f64::from(u8::from(t.is_point(j))),
        _ => nodes[j][i - 1],
    });
    let mut rhs = DVector::zeros(D + 1);
    rhs[0] = 1.0;
    rhs.rows_mut(1, D).copy_from(r);
    lhs.svd(true, true).solve(&rhs, 1e-12).unwrap()
}

fn by_quadrature<const D: usize>(member: &Member<D>, gauss: &[(f64, SVector<f64, D>)]) {
    let n = member.coord_type().nodes();
    let mut expected = DMatrix::<f64>::zeros(n, n);
    for (m, r) in gauss {
        let c = dense_weights(member, r);
        expected += &c * c.transpose() * *m;
    }
    for i in 0..n {
        for j in 0..n {
            let error = (member.mass_matrix().get(i, j) - expected[(i, j)]).abs();
            assert!(error < 1e-12 * expected.amax(), "{}", member.coord_type());
        }
    }
}

/// Every type of the span, on nodes through the given points.
fn types_of<const D: usize>(points: &[SVector<f64, D>], mass: MassProperties<D>) -> Vec<Member<D>> {
    let span = points.len() - 1;
    let all = CoordType::ALL.into_iter().find(|t| t.span() == span && t.vectors() == 0).unwrap();
    let member = Member::new(all, points, mass).unwrap();
    CoordType::ALL.into_iter().filter(|t| t.span() == span).map(|t| member.with_type(t).unwrap()).collect()
}

const GAUSS: f64 = 0.577_350_269_189_625_8;

#[test]
fn quadrature_over_a_tetrahedron() {
    let p: Vec<Vector3<f64>> = Random(10).nodes(4);
    let m = 1.7;
    let centre = (p[0] + p[1] + p[2] + p[3]) / 4.0;
    let j =
        p.iter().map(|p| (p - centre) * (p - centre).transpose()).sum::<SMatrix<f64, 3, 3>>() * (m / 20.0);
    let mass = MassProperties::from_second_moment(m, centre, j).unwrap();
    // Four points at barycentric (a, b, b, b), degree 2.
    let (a, b) = ((5.0 + 3.0 * 5.0_f64.sqrt()) / 20.0, (5.0 - 5.0_f64.sqrt()) / 20.0);
    let gauss: Vec<_> = (0..4)
        .map(|k| {
            let r = p
                .iter()
                .enumerate()
                .fold(Vector3::zeros(), |sum, (i, p)| sum + p * if i == k { a } else { b });
            (m / 4.0, r)
        })
        .collect();
    for member in types_of(&p, mass) {
        by_quadrature(&member, &gauss);
    }
}

#[test]
fn quadrature_over_a_box() {
    let random = &mut Random(11);
    let (r, shift): (_, Vector3<f64>) = (random.rotation3(), random.vector());
    let (m, half) = (2.3, v([0.3, 0.5, 0.2]));
    let moment = |a: f64, b: f64| m / 3.0 * (a * a + b * b);
    let moments = [moment(half.y, half.z), moment(half.x, half.z), moment(half.x, half.y)];
    let mass = MassProperties::from_principal_axes(m, shift, moments, r).unwrap();
    let mut gauss = Vec::new();
    for sign in 0..8 {
        let corner = Vector3::from_fn(|i, _| if sign >> i & 1 == 1 { GAUSS } else { -GAUSS });
        gauss.push((m / 8.0, shift + r * corner.component_mul(&half)));
    }
    for member in types_of(&random.nodes::<3>(4), mass) {
        by_quadrature(&member, &gauss);
    }
}

#[test]
fn quadrature_over_a_triangle() {
    let p: Vec<Vector2<f64>> = Random(12).nodes(3);
    let m = 0.9;
    let centre = (p[0] + p[1] + p[2]) / 3.0;
    let j =
        p.iter().map(|p| (p - centre) * (p - centre).transpose()).sum::<SMatrix<f64, 2, 2>>() * (m / 12.0);
    let mass = MassProperties::from_second_moment(m, centre, j).unwrap();
    let gauss: Vec<_> = (0..3).map(|k| (m / 3.0, (p[k] + p[(k + 1) % 3]) / 2.0)).collect();
    for member in types_of(&p, mass) {
        by_quadrature(&member, &gauss);
    }
    // The same body on a basis that has nothing to do with its corners.
    for member in types_of(&Random(13).nodes::<2>(3), mass) {
        by_quadrature(&member, &gauss);
    }
}

#[test]
fn quadrature_over_a_rod() {
    let (m, from, to) = (0.6, v([0.2, 0.1, -0.4]), v([0.9, 1.0, 0.3]));
    let mass = MassProperties::thin_rod(m, from, to).unwrap();
    let at = |s: f64| from + (to - from) * s;
    let gauss = [0.5 - GAUSS / 2.0, 0.5 + GAUSS / 2.0].map(|s| (m / 2.0, at(s)));
    // Basic points at the ends, and elsewhere on the axis.
    for points in [[from, to], [at(0.3), at(-1.5)]] {
        for member in types_of(&points, mass) {
            by_quadrature(&member, &gauss);
        }
    }
    // Density 1 + s from end to end: m = 3/2, s_g = 5/9, ∫ρ(s - s_g)² ds = 13/108; lengths scale by L.
    let length = (to - from).norm();
    let mass =
        MassProperties::rod(1.5 * length, at(5.0 / 9.0), to - from, 13.0 / 108.0 * length.powi(3)).unwrap();
    let gauss = [-(0.6_f64.sqrt()), 0.0, 0.6_f64.sqrt()]
        .map(|x| (x, if x == 0.0 { 8.0 / 18.0 } else { 5.0 / 18.0 }))
        .map(|(x, w)| (0.5 + x / 2.0, w))
        .map(|(s, w)| (w * (1.0 + s) * length, at(s)));
    for member in types_of(&[from, to], mass) {
        by_quadrature(&member, &gauss);
    }
}

#[test]
fn kinetic_energy_is_that_of_a_rigid_body() {
    for seed in 100..120 {
        for (s, pose, twist) in space_cases(seed) {
            let v = velocity3(&pose, &twist, &(pose.position + pose.rotation * s.centre));
            let inertia = pose.rotation * s.inertia * pose.rotation.transpose();
            let omega = twist.angular_velocity();
            let expected = 0.5 * s.mass * v.norm_squared() + 0.5 * omega.dot(&(inertia * omega));
            let energy = s.member.kinetic_energy(&s.member.place_velocity(&pose, &twist));
            assert!((energy / expected - 1.0).abs() < 1e-12, "{}", s.member.coord_type());
        }
        for (s, pose, twist) in plane_cases(seed) {
            let v = velocity2(&pose, &twist, &(pose.position + pose.rotation * s.centre));
            let omega = twist.angular_velocity();
            let spinning = if s.member.coord_type().span() == 0 { 0.0 } else { s.inertia };
            let expected = 0.5 * s.mass * v.norm_squared() + 0.5 * spinning * omega * omega;
            let energy = s.member.kinetic_energy(&s.member.place_velocity(&pose, &twist));
            assert!((energy / expected - 1.0).abs() < 1e-12, "{}", s.member.coord_type());
        }
    }
}

/// Any velocities, rigid or not: the type is only a change of variables.
#[test]
fn energy_and_points_do_not_depend_on_the_type() {
    let random = &mut Random(14);
    for (s, _, _) in space_cases(15) {
        let from = s.member.coord_type();
        let (q, q_dot) = (random.nodes::<3>(from.nodes()), random.nodes(from.nodes()));
        for to in CoordType::ALL.into_iter().filter(|t| t.span() == from.span()) {
            let other = s.member.with_type(to).unwrap();
            let (p, p_dot) = (from.convert(to, &q).unwrap(), from.convert(to, &q_dot).unwrap());
            let (a, b) = (s.member.kinetic_energy(&q_dot), other.kinetic_energy(&p_dot));
            assert!((a / b - 1.0).abs() < 1e-12);
            let g = s.member.mass_centre_weights().apply(&q);
            assert!((g - other.mass_centre_weights().apply(&p)).amax() < 1e-13);
            // There and back: the same member.
            let back = other.with_type(from).unwrap();
            assert!(distance(back.local_nodes(), s.member.local_nodes()) < 1e-15);
        }
    }
}

/// Only I_z = tr J enters a planar rigid motion, whatever its split and its products.
#[test]
fn the_planar_split_of_j_changes_no_energy() {
    let random = &mut Random(16);
    let (m, centre) = (1.3, v([0.2, -0.1]));
    let splits = [
        Matrix2::new(0.5, 0.0, 0.0, 0.5),
        Matrix2::new(1.0, 0.0, 0.0, 0.0),
        Matrix2::new(0.3, 0.4, 0.4, 0.7),
    ];
    let nodes = random.nodes::<2>(3);
    for t in [CoordType::Ruv, CoordType::Rrv, CoordType::Rrr] {
        for _ in 0..10 {
            let (pose, twist) = (random.pose2(), tg_coords::Twist::planar(random.vector(), random.unit()));
            let energies = splits.map(|j| {
                let mass = MassProperties::from_second_moment(m, centre, j).unwrap();
                let member = Member::new(t, &nodes, mass).unwrap();
                member.kinetic_energy(&member.place_velocity(&pose, &twist))
            });
            assert!((energies[0] / energies[1] - 1.0).abs() < 1e-12);
            assert!((energies[0] / energies[2] - 1.0).abs() < 1e-12);
        }
    }
    // The matrices themselves do differ.
    let [a, b] = [splits[0], splits[1]].map(|j| {
        let mass = MassProperties::from_second_moment(m, centre, j).unwrap();
        *Member::new(CoordType::Rrr, &nodes, mass).unwrap().mass_matrix()
    });
    assert!((a.get(1, 1) - b.get(1, 1)).abs() > 1e-3);
}

#[test]
fn symmetry_products_and_definiteness() {
    let random = &mut Random(17);
    for (s, _, _) in space_cases(18) {
        let matrix = s.member.mass_matrix();
        let n = matrix.len();
        let dense = DMatrix::from_fn(n, n, |i, j| matrix.get(i, j));
        assert!((&dense - dense.transpose()).amax() < 1e-14 * dense.amax());
        assert!(matrix.is_positive_definite());
        assert!(dense.symmetric_eigenvalues().min() > 0.0);
        let (a, b) = (random.nodes::<3>(n), random.nodes::<3>(n));
        let mut product = vec![Vector3::zeros(); n];
        matrix.apply_into(&b, &mut product);
        let form: f64 = a.iter().zip(&product).map(|(a, p)| a.dot(p)).sum();
        assert!((form - matrix.form(&a, &b)).abs() < 1e-13 * s.mass);
        assert!(!matrix.is_empty());
    }
    // A lamina in space has no mass along its normal; a massless member has none at all.
    let nodes = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let lamina = MassProperties::from_principal_moments(1.0, Vector3::zeros(), [1.0, 2.0, 3.0]).unwrap();
    let lamina = Member::new(CoordType::Rrrr, &nodes, lamina).unwrap();
    assert!(!lamina.mass_matrix().is_positive_definite());
    let none = MassProperties::massless(Vector3::zeros()).unwrap();
    let none = Member::new(CoordType::Rrrr, &nodes, none).unwrap();
    assert!(!none.mass_matrix().is_positive_definite());
}
