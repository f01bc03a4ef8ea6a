import { Vector3 } from 'three';

const REACH = 7;

function distanceToSegment(px, py, a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  const square = dx * dx + dy * dy;
  const s = square > 0 ? Math.min(1, Math.max(0, ((px - a.x) * dx + (py - a.y) * dy) / square)) : 0;
  return { distance: Math.hypot(a.x + s * dx - px, a.y + s * dy - py), depth: a.z + s * (b.z - a.z) };
}

function inTriangle(px, py, a, b, c) {
  const side = (p, q) => (q.x - p.x) * (py - p.y) - (q.y - p.y) * (px - p.x);
  const [s, t, u] = [side(a, b), side(b, c), side(c, a)];
  return (s >= 0 && t >= 0 && u >= 0) || (s <= 0 && t <= 0 && u <= 0);
}

/**
 * What is under the pointer: decided on the screen, where thin things have a fair reach. Lines and points win over
 * faces, which they lie behind or on.
 */
export function pick(view, camera, width, height, px, py) {
  const { assembly, state } = view.structure;
  if (!state) return null;
  const project = (array, at) => {
    const p = new Vector3(array[at], array[at + 1], array[at + 2]).project(camera);
    return { x: ((p.x + 1) / 2) * width, y: ((1 - p.y) / 2) * height, z: p.z };
  };
  const points = Array.from({ length: assembly.vertexCount }, (_, v) => project(state.vertices, 3 * v));
  let best = null;
  const offer = (kind, index, { distance, depth }, reach) => {
    if (!(distance <= reach) || Math.abs(depth) > 1) return;
    // Within two pixels the nearer to the viewer wins, else the nearer to the pointer.
    const score = Math.max(0, distance - 2) + depth;
    if (!best || score < best.score) best = { kind, index, score };
  };
  for (const { member, a, b } of assembly.edges) offer('member', member, distanceToSegment(px, py, points[a], points[b]), REACH);
  points.forEach((p, v) => {
    const m = assembly.owner[v];
    if (assembly.members[m].kind === 'particle') offer('member', m, { distance: Math.hypot(p.x - px, p.y - py), depth: p.z }, REACH + 3);
  });
  for (let c = 0; c < state.tension.length; c++) {
    offer('cable', c, distanceToSegment(px, py, project(state.ends, 6 * c), project(state.ends, 6 * c + 3)), REACH);
  }
  if (best) return best;
  let depth = Infinity;
  for (const { member, corners } of assembly.faces) {
    const [a, b, c] = corners.map((i) => points[i]);
    const z = (a.z + b.z + c.z) / 3;
    if (z < depth && z < 1 && inTriangle(px, py, a, b, c)) {
      depth = z;
      best = { kind: 'member', index: member };
    }
  }
  return best;
}
