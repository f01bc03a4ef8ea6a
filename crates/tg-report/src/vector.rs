//! Small vectors and unit quaternions (x, y, z, w).

pub(crate) type Vec3 = [f64; 3];
pub(crate) type Quaternion = [f64; 4];

pub(crate) fn add(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|k| a[k] + b[k])
}

pub(crate) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    std::array::from_fn(|k| a[k] - b[k])
}

pub(crate) fn scale(s: f64, a: Vec3) -> Vec3 {
    a.map(|x| s * x)
}

pub(crate) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(crate) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(crate) fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// The direction of a vector; none of a vector without length.
pub(crate) fn unit(a: Vec3) -> Option<Vec3> {
    let length = norm(a);
    (length > 0.0 && length.is_finite()).then(|| scale(1.0 / length, a))
}

/// Some unit vector across a unit vector.
pub(crate) fn across(a: Vec3) -> Vec3 {
    let least = (0..3).min_by(|&i, &j| a[i].abs().total_cmp(&a[j].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    unit(cross(a, axis)).unwrap_or([1.0, 0.0, 0.0])
}

/// Least and greatest coordinates of some points; zero where there is no finite one.
pub(crate) fn bounds(points: impl Iterator<Item = Vec3>) -> [Vec3; 2] {
    let (mut least, mut greatest) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in points.filter(|p| p.iter().all(|x| x.is_finite())) {
        for k in 0..3 {
            least[k] = least[k].min(p[k]);
            greatest[k] = greatest[k].max(p[k]);
        }
    }
    if least[0] <= greatest[0] { [least, greatest] } else { [[0.0; 3]; 2] }
}

/// The product: first b, then a.
pub(crate) fn turn(a: Quaternion, b: Quaternion) -> Quaternion {
    let [ax, ay, az, aw] = a;
    let [bx, by, bz, bw] = b;
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

/// A unit quaternion; the identity where the length is zero.
pub(crate) fn normalised(q: Quaternion) -> Quaternion {
    let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 && length.is_finite() { q.map(|x| x / length) } else { [0.0, 0.0, 0.0, 1.0] }
}

/// The shortest turn from one unit vector to another.
pub(crate) fn shortest(from: Vec3, to: Vec3) -> Quaternion {
    let cos = dot(from, to);
    if cos < -1.0 + 1e-12 {
        let [x, y, z] = across(from);
        return [x, y, z, 0.0];
    }
    let [x, y, z] = cross(from, to);
    normalised([x, y, z, 1.0 + cos])
}
