//! Mass properties of shapes against sums over a fine grid of their inside.

use nalgebra::{Matrix3, Vector3};

use super::{assert_close, member, plane, space};

/// Volume, mass centre and ∫ (r - c)(r - c)ᵀ dV of what is inside, between two corners of a box of cells.
fn integrate(
    from: Vector3<f64>,
    to: Vector3<f64>,
    inside: impl Fn(&Vector3<f64>) -> bool,
) -> (f64, Vector3<f64>, Matrix3<f64>) {
    const CELLS: usize = 120;
    let edge = (to - from) / CELLS as f64;
    let (mut count, mut first, mut second) = (0.0, Vector3::zeros(), Matrix3::zeros());
    for k in 0..CELLS * CELLS * CELLS {
        let cell = [k % CELLS, k / CELLS % CELLS, k / CELLS / CELLS].map(|n| n as f64 + 0.5);
        let point = from + edge.component_mul(&Vector3::from(cell));
        if inside(&point) {
            count += 1.0;
            first += point;
            second += point * point.transpose();
        }
    }
    let (cell, centre) = (edge.product(), first / count);
    (count * cell, centre, (second - centre * centre.transpose() * count) * cell)
}

/// Compares a body of density 3 with the grid; a hundredth of its size is what the grid can tell.
fn assert_shape(shape: &str, (from, to): ([f64; 3], [f64; 3]), inside: impl Fn(&Vector3<f64>) -> bool) {
    let structure = space(&format!("bodies.b = {{ shape = {{ {shape} }}, density = 3 }}"));
    let mass = *structure.model.member(member(&structure.model, "b")).mass_properties();
    let (volume, centre, second) = integrate(from.into(), to.into(), inside);
    assert_close(&[mass.mass()], &[3.0 * volume], 1e-2 * mass.mass());
    assert_close(mass.centre().as_slice(), centre.as_slice(), 5e-3);
    let size = mass.second_moment().amax();
    assert_close(mass.second_moment().as_slice(), (second * 3.0).as_slice(), 1e-2 * size);
}

#[test]
fn block() {
    let inside = |r: &Vector3<f64>| r.x.abs() < 0.5 && r.y.abs() < 1.0 && r.z.abs() < 1.5;
    assert_shape("box = [1, 2, 3]", ([-0.6, -1.2, -1.8], [0.6, 1.2, 1.8]), inside);
}

#[test]
fn cylinder() {
    let inside = |r: &Vector3<f64>| r.x.hypot(r.y) < 0.5 && r.z.abs() < 1.0;
    assert_shape("cylinder = { radius = 0.5, height = 2 }", ([-0.6, -0.6, -1.2], [0.6, 0.6, 1.2]), inside);
}

#[test]
fn ball() {
    assert_shape("ball = 0.8", ([-1.0; 3], [1.0; 3]), |r| r.norm() < 0.8);
}

#[test]
fn tetrahedron() {
    let corners = [[0.1, 0.0, 0.0], [1.0, 0.2, 0.0], [0.0, 1.0, 0.1], [0.3, 0.3, 1.2]].map(Vector3::from);
    let inside = |r: &Vector3<f64>| {
        let volume = |[a, b, c, d]: [Vector3<f64>; 4]| (b - a).cross(&(c - a)).dot(&(d - a));
        let whole = volume(corners).signum();
        (0..4).all(|k| {
            let mut part = corners;
            part[k] = *r;
            volume(part) * whole > 0.0
        })
    };
    let shape = "tetrahedron = [[0.1, 0, 0], [1, 0.2, 0], [0, 1, 0.1], [0.3, 0.3, 1.2]]";
    assert_shape(shape, ([-0.1; 3], [1.3; 3]), inside);
}

/// An L: not convex, so that some triangles from its first corner count negative.
fn inside_l(x: f64, y: f64) -> bool {
    (0.2..1.2).contains(&x) && (0.0..0.4).contains(&y) || (0.2..0.5).contains(&x) && (0.0..1.0).contains(&y)
}

const L: &str = "corners = [[1.2, 0.4], [0.5, 0.4], [0.5, 1], [0.2, 1], [0.2, 0], [1.2, 0]]";

#[test]
fn thick_plate() {
    let shape = format!("plate = {{ {L}, thickness = 0.6 }}");
    assert_shape(&shape, ([0.1, -0.1, -0.4], [1.3, 1.1, 0.4]), |r| inside_l(r.x, r.y) && r.z.abs() < 0.3);
}

#[test]
fn plate_in_the_plane() {
    let (area, centre, second) =
        integrate([0.1, -0.1, -0.5].into(), [1.3, 1.1, 0.5].into(), |r| inside_l(r.x, r.y));
    for (shape, measure) in
        [(format!("plate = {{ {L} }}"), 1.0), (format!("polygon = {{ {L}, thickness = 0.1 }}"), 0.1)]
    {
        let structure = plane(&format!("bodies.b = {{ shape = {{ {shape} }}, density = 3 }}"));
        let mass = *structure.model.member(member(&structure.model, "b")).mass_properties();
        let m = 3.0 * area * measure;
        assert_close(&[mass.mass()], &[m], 1e-2 * m);
        assert_close(mass.centre().as_slice(), &centre.as_slice()[..2], 5e-3);
        let polar = (second[(0, 0)] + second[(1, 1)]) / area * m;
        assert_close(&[mass.polar_moment()], &[polar], 1e-2 * polar);
    }
}

#[test]
fn rectangle_in_the_plane() {
    let structure = plane("bodies.b = { shape = { rectangle = [3, 4] }, mass = 12 }");
    let mass = *structure.model.member(member(&structure.model, "b")).mass_properties();
    assert_close(&[mass.polar_moment()], &[25.0], 1e-12);
}

/// What stands beside the shape takes precedence.
#[test]
fn shape_and_own_properties() {
    let text = "bodies.b = { shape = { box = [1, 1, 1] }, mass = 2, centre = [0.1, 0, 0], inertia = { principal = [1, 2, 2.5] } }";
    let structure = space(text);
    let mass = *structure.model.member(member(&structure.model, "b")).mass_properties();
    assert_close(&[mass.mass()], &[2.0], 0.0);
    assert_close(mass.centre().as_slice(), &[0.1, 0.0, 0.0], 1e-15);
    assert_close(mass.inertia_matrix().diagonal().as_slice(), &[1.0, 2.0, 2.5], 1e-14);
    let pyramid = space(
        "bodies.b = { shape = { box = [1, 1, 1] }, mass = 2, points = { p1 = [7, 0, 0] } }\nrun = { duration = 1, step = 1, points = [\"b.p1\", \"b.p8\"] }",
    );
    let q = pyramid.model.initial_coordinates();
    let [own, corner] = [0, 1].map(|k| pyramid.model.form(pyramid.watched[k].1).unwrap().eval(&q));
    assert_close(own.as_slice(), &[7.0, 0.0, 0.0], 1e-15);
    assert_close(corner.as_slice(), &[0.5, 0.5, 0.5], 1e-15);
}
