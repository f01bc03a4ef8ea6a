import { Vector3 } from 'three';

/**
 * Where the camera must stand, looking along -view, to have all points within the frame: exact for each side of the
 * frame, with the target moved until what is seen sits in the middle.
 * @returns {{target: Vector3, distance: number, halfHeight: number}}
 */
export function fit(points, view, up, aspect, fovDegrees, margin = 1.12) {
  const right = new Vector3().crossVectors(up, view).normalize();
  const top = new Vector3().crossVectors(view, right);
  const n = points.length / 3;
  const project = (axis) => Float64Array.from({ length: n }, (_, i) => points[3 * i] * axis.x + points[3 * i + 1] * axis.y + points[3 * i + 2] * axis.z);
  const [xs, ys, zs] = [project(right), project(top), project(view)];
  const middle = (a) => (a.reduce((m, v) => Math.min(m, v), Infinity) + a.reduce((m, v) => Math.max(m, v), -Infinity)) / 2;
  let [cx, cy] = [middle(xs), middle(ys)];
  const cz = middle(zs);
  const slopeY = Math.tan((fovDegrees * Math.PI) / 360) / margin;
  const slopeX = slopeY * aspect;
  let distance = 0;
  for (let round = 0; round < 4; round++) {
    distance = 1e-9;
    for (let i = 0; i < n; i++) {
      distance = Math.max(distance, zs[i] - cz + Math.abs(xs[i] - cx) / slopeX, zs[i] - cz + Math.abs(ys[i] - cy) / slopeY);
    }
    let [left, rightmost, low, high] = [Infinity, -Infinity, Infinity, -Infinity];
    for (let i = 0; i < n; i++) {
      const depth = distance - (zs[i] - cz);
      left = Math.min(left, (xs[i] - cx) / depth);
      rightmost = Math.max(rightmost, (xs[i] - cx) / depth);
      low = Math.min(low, (ys[i] - cy) / depth);
      high = Math.max(high, (ys[i] - cy) / depth);
    }
    cx += ((left + rightmost) / 2) * distance;
    cy += ((low + high) / 2) * distance;
  }
  let halfHeight = 1e-9;
  const [fx, fy] = [middle(xs), middle(ys)];
  for (let i = 0; i < n; i++) halfHeight = Math.max(halfHeight, (Math.abs(xs[i] - fx) * margin) / aspect, Math.abs(ys[i] - fy) * margin);
  const target = (x, y) => new Vector3().addScaledVector(right, x).addScaledVector(top, y).addScaledVector(view, cz);
  return { target: target(cx, cy), flatTarget: target(fx, fy), distance, halfHeight };
}
