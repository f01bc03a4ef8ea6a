import { Vector3 } from 'three';

/** The space as it is looked at: what is up, two level directions, and where the camera stands at first. */
export function directions(up, plane) {
  if (plane) {
    const [x, y, z] = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
    // The grid of a plane structure lies in its plane.
    return { up: y, gridNormal: z, level: [x, y], view: z };
  }
  const vertical = new Vector3(...up).normalize();
  const seed = Math.abs(vertical.x) < 0.9 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
  const e1 = seed.addScaledVector(vertical, -seed.dot(vertical)).normalize();
  const e2 = new Vector3().crossVectors(vertical, e1);
  const view = e1.clone().multiplyScalar(0.6).addScaledVector(e2, -1).addScaledVector(vertical, 0.42).normalize();
  return { up: vertical, gridNormal: vertical, level: [e1, e2], view };
}
